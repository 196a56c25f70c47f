"""`haptic-panel design`: a panel's performance, estimated from its parameters by the equations of the paper."""

from __future__ import annotations

import argparse
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

from controller.commands.common.output import picture_path, show
from controller.device.board.board import load_board
from controller.device.board.descriptions import unit_of
from controller.device.board.lookup import find_board
from controller.device.board.reference import attributes
from controller.errors import ConfigError

if TYPE_CHECKING:
    from controller.commands.common.output import Declare

ROWS = {  # what is printed of each figure; numbers in brackets are those of the paper's equations
    "tc_ms": "Tc = modes per kHz (2)",
    "modes_in_band": "modes in the band, Tc B",
    "modes_counted": "modes in the band, counted",
    "modal_overlap": "modes that overlap",
    "contrast": "contrast, all points (1)",
    "contrast_bound": "its bound, sqrt(B Tc)",
    "contrast_all": "contrast, all points, estimate",
    "contrast_outside": "contrast outside a radius, estimate",
    "outside_mm": "that radius (mm)",
    "contrast_repeated": "contrast (1) when repeated",
    "repetition_factor": "sqrt(1 - exp(-2 Tr/tau))",
    "wavelength_mm": "wavelength (mm) (5)",
    "mindlin_wavelength_mm": "wavelength (mm), Mindlin",
    "mindlin_shift": "Mindlin's shift of the upper edge",
    "resolution_mm": "resolution (mm) (3)",
    "spot_mm": "spot, half height (mm), estimate",
    "spot_3db_mm": "spot, -3 dB (mm), estimate",
    "gate_us": "duration (µs) (4)",
    "pulse_us": "duration, half height (µs), estimate",
    "possible_amplitude_um": "amplitude in reach (µm), estimate",
    "amplitude_um": "amplitude taken (µm)",
    "one_bit_share": "share of an endless emission, 1 bit",
    "linear_share": "share of an endless emission, linear",
    "energy_uj": "energy at T (µJ) (6)",
    "energy_of_band_uj": "energy of the band's modes (µJ)",
    "energy_with_background_uj": "energy at T (µJ), estimate",
    "kinetic_share": "of that kinetic, estimate",
    "energy_decay_ms": "decay of energy (ms)",
    "mechanical_power_mw": "mechanical power in T (mW)",
    "resistors_w": "resistors, all emitting (W)",
    "resistors_repeated_w": "resistors, every Tr (W)",
    "finger_left": "left under a finger (7)",
    "finger_left_of_band": "left under a point mass",
    "amplitude_under_finger_um": "amplitude under the finger (µm)",
    "points_to_learn": "points to learn, 4 S / wavelength²",
    "learning_grid": "grid of half waves, Mindlin",
    "learning_pitch_mm": "its largest pitch (mm)",
    "in_wavelengths": "in wavelengths",
}
COLUMNS = ("tc_ms", "contrast", "contrast_outside", "spot_mm", "amplitude_um", "amplitude_under_finger_um", "mechanical_power_mw",
           "resistors_w", "points_to_learn")  # fmt: skip


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    from controller.workshop.physics.design.design_inputs import NUMBERS, DesignInputs

    command = declare(
        example="haptic-panel design --thickness-mm 1",
        parents=[common],
        description="Estimate a panel's performance from its parameters, by the equations of the paper, with warnings where these "
        "do not hold. A parameter that is not given is the board's.",
    )
    command.add_argument(
        "--sweep", metavar="NAME=FROM:TO:STEP", help="a table over one of the parameters, such as thickness_mm=0.3:2:0.1"
    )
    command.add_argument("--plot", metavar="FILE", help="draw the sweep (.png, .svg, .pdf)")
    numbers = command.add_argument_group("parameters of the design")
    texts = attributes(DesignInputs)
    for name in NUMBERS:
        text = texts.get(name, "").rstrip(".")
        unit = unit_of(name)
        numbers.add_argument(f"--{name.replace('_', '-')}", dest=name, type=float, metavar=unit or "N", help=text)
    command.set_defaults(command=design)


def design(options: argparse.Namespace) -> int:
    """Print the figures of a design, or of a sweep."""
    from controller.workshop.physics.design.design_figures import design_figures
    from controller.workshop.physics.design.design_inputs import NUMBERS, inputs_of, sweep

    if options.plot and not options.sweep:
        raise ConfigError("--plot draws a sweep: give --sweep NAME=FROM:TO:STEP too")
    picture = picture_path(options)
    board = load_board(find_board(options.board))
    changes = {name: value for name in NUMBERS if (value := getattr(options, name)) is not None}
    if not options.sweep:
        show(options, {"board": board.name, **design_figures(board, changes)}, _table)
        return 0
    name, values = sweep(options.sweep)
    for value in values:  # all are possible, before any is computed
        inputs_of(board, {**changes, name: value})
    rows = [design_figures(board, {**changes, name: value}) for value in values]
    figures: dict[str, Any] = {"board": board.name, "swept": name, "values": values, "designs": rows}
    if picture:
        _plot(picture, figures)
    show(options, figures, _sweep_table)
    return 0


def _plot(picture: Path, figures: dict[str, Any]) -> None:
    from controller.workshop.physics.design.plot_design import plot_sweep

    plot_sweep(picture, figures["swept"], figures["values"], figures["designs"], {name: ROWS[name] for name in COLUMNS})


def _table(figures: dict[str, Any]) -> str:
    given = textwrap.fill("  ".join(f"{name} {_shown(v)}" for name, v in figures["inputs"].items() if v is not None), 120)
    width = max(map(len, ROWS.values()))
    lines = [given, ""]
    for name, title in ROWS.items():
        value = figures[name]
        parts = value.items() if isinstance(value, dict) else [("", value)]
        lines.append(f"{title:<{width}}  " + ", ".join(f"{part.replace('_', ' ')} {_shown(v)}".strip() for part, v in parts))
    return "\n".join(lines + [f"warning: {warning}" for warning in figures["warnings"]])


def _sweep_table(figures: dict[str, Any]) -> str:
    names = (figures["swept"], *COLUMNS, "warnings")
    lines = ["  ".join(names)]
    for value, row in zip(figures["values"], figures["designs"], strict=True):
        cells = [value, *(row[name] for name in COLUMNS), len(row["warnings"])]
        lines.append("  ".join(f"{_shown(cell):>{len(name)}}" for name, cell in zip(names, cells, strict=True)))
    return "\n".join(lines)


def _shown(value: Any) -> str:
    """A figure in four digits; a dash where there is none."""
    return "–" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)
