"""For pytest: the compiled gateware is that of mutants.py, in the folder that HAPTIC_PANEL_MUTANTS names."""

import os
from pathlib import Path

from controller.workshop.gateware import rtl_build
from controller.workshop.gateware.rtl_build import Design

FOLDER = Path(os.environ["HAPTIC_PANEL_MUTANTS"])
CACHE = Path(os.environ["STATE_DIRECTORY"])  # before tests have another


def design():
    files = (FOLDER / "mutants.sv", *sorted(FOLDER.glob("*.v")))
    options = ("--x-initial", "unique", "-Wno-fatal", "-Wno-lint", "-Wno-style")
    return Design("haptic_core", files, FOLDER / "simulation" / "wrapper.cpp", options)


rtl_build.core_design = design
rtl_build.state_folder = lambda: CACHE  # one for all mutants: each set of parameters is compiled once
