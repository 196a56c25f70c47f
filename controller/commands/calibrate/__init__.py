"""`haptic-panel calibrate`: a bank from measurements of the plate itself. Each of its steps is a module beside this one."""

import argparse
from importlib import import_module

from controller.commands.common.arguments import Declare

STEPS = {  # in the order of --help, which prints these texts; each is a module of this package
    "channels": "which disc each channel moves: put a finger where it buzzes, no sensor needed",
    "plan": "where to measure the plate, and how long it takes",
    "measure": "measure the plate in place: play through the panel's FPGA, and record a sensor point by point",
    "wiring": "which patch each channel drives: swapped, inverted and dead channels, from a few points",
    "check": "read and deconvolve measurements, and name what is wrong with them",
    "clock": "how fast the plate is, from a few points: what makes a bank of the model suit it",
    "bank": "build the bank of a plate from its measurements",
    "fleet": "build the banks of many panels from a folder of their measurements",
    "simulate": "write the measurements of a simulated plate that differs from the board's",
}


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the steps."""
    steps = declare(
        example="haptic-panel calibrate plan --board panel",
        description="A bank of the plate model does not focus on a real plate: these steps measure the responses of the plate and "
        "build its bank from them, in the order in which they are listed.",
    ).add_subparsers(title="steps", metavar="STEP", required=True)
    for name, text in STEPS.items():
        step = steps.add_parser(name, parents=[common], help=text, description=f"{text[0].upper()}{text[1:]}.")
        import_module(f"controller.commands.calibrate.{name}").add(step)
