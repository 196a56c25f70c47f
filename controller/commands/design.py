"""`haptic-panel design`: a panel's performance, estimated from its parameters by the equations of the paper."""

import argparse
import textwrap
from pathlib import Path
from typing import Any

import msgspec

from controller.commands.common.arguments import Declare
from controller.commands.common.named_board import board_of
from controller.commands.common.output import picture_path, show
from controller.device.board.board import Board
from controller.device.board.descriptions import unit_of
from controller.device.board.plate.parts import Parts
from controller.device.board.records import as_record
from controller.device.board.reference import attributes
from controller.errors import ConfigError

ROWS = {  # what is printed of each figure; numbers in brackets are those of the paper's equations
    "felt_um": "felt amplitude (µm), estimate",
    "felt": "that is",
    "gains_percent": "10 % more of it adds (%)",
    "possible_amplitude_um": "amplitude in reach (µm), estimate",
    "amplitude_um": "amplitude taken (µm)",
    "finger_left": "left under a finger (7)",
    "finger_left_of_band": "left under a point mass",
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
    "one_bit_share": "share of an endless emission, 1 bit",
    "linear_share": "share of an endless emission, linear",
    "energy_uj": "energy at T (µJ) (6)",
    "energy_of_band_uj": "energy of the band's modes (µJ)",
    "energy_with_background_uj": "energy at T (µJ), estimate",
    "kinetic_share": "of that kinetic, estimate",
    "energy_decay_ms": "decay of energy (ms)",
    "mechanical_power_mw": "mechanical power in T (mW)",
    "stress": "stress (MPa), field (MV/m)",
    "sound": "sound at 0.3 m, dB(A), estimate",
    "resistors_w": "resistors, all emitting (W)",
    "resistors_repeated_w": "resistors, every Tr (W)",
    "supply_ma": "supply current, every Tr (mA)",
    "edges_khz": "edges a second of a channel (1000)",
    "edge_limit_khz": "its resistor bears at most (1000)",
    "points_to_learn": "points to learn, 4 S / wavelength²",
    "learning_grid": "grid of half waves, Mindlin",
    "learning_pitch_mm": "its largest pitch (mm)",
    "in_wavelengths": "in wavelengths",
}
COLUMNS = ("felt_um", "amplitude_um", "spot_mm", "contrast", "contrast_outside", "resistors_w", "edge_limit_khz",
           "mechanical_power_mw", "points_to_learn")  # fmt: skip
FOUND = ("thickness_mm", "disc", "discs", "channels", "felt_um", "spot_mm", "contrast_outside", "resistors_w",
         "edge_limit_khz")  # fmt: skip


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    from controller.workshop.physics.design.design_inputs import NUMBERS, DesignInputs

    command = declare(
        example="haptic-panel design --thickness-mm 1",
        parents=[common],
        description="Estimate a panel's performance from its parameters, by the equations of the paper, with warnings where these "
        "do not hold. A parameter that is not given is the board's, or follows from those that are: of a disc its capacitance and "
        "moment on this glass, of both and the band the stage's R and L.",
    )
    command.add_argument(
        "--sweep", metavar="NAME=FROM:TO:STEP", help="a table over one of the parameters, such as thickness_mm=0.3:2:0.1"
    )
    command.add_argument("--plot", metavar="FILE", help="draw the sweep (.png, .svg, .pdf)")
    command.add_argument(
        "--find",
        metavar="WHAT",
        help="search panels that are felt, over one or more of thickness,channels,disc: fewest channels first",
    )
    command.add_argument(
        "--felt-um", type=float, metavar="µm", help="felt amplitude that --find wants (default: from which it is known to be felt)"
    )
    command.add_argument(
        "--price",
        action="append",
        default=[],
        metavar="NAME=COST",
        help="with --find, the cheapest first: what a channel with its stage costs (channel=4), and a disc (7BB-20-6=0.8, disc=1); "
        "what has no price costs nothing",
    )
    command.add_argument("--disc", help="piezo disc of the catalogue, in place of the board's: C, R, L and moment follow")
    command.add_argument("--sectors", type=int, metavar="N", help="actuators that a disc is cut into")
    numbers = command.add_argument_group("parameters of the design")
    texts = attributes(DesignInputs)
    for name in NUMBERS:
        text = texts.get(name, "").rstrip(".")
        unit = unit_of(name)
        numbers.add_argument(f"--{name.replace('_', '-')}", dest=name, type=float, metavar=unit or "N", help=text)
    command.set_defaults(command=design)


def design(options: argparse.Namespace) -> int:
    """Print the figures of a design, of a sweep, or of what a search found."""
    from controller.workshop.physics.design.design_figures import design_figures
    from controller.workshop.physics.design.design_inputs import NUMBERS, inputs_of, sweep

    if options.plot and not options.sweep:
        raise ConfigError("--plot draws a sweep: give --sweep NAME=FROM:TO:STEP too")
    if options.price and not options.find:
        raise ConfigError("--price is of use with --find")
    if options.find and options.sweep:
        raise ConfigError("--find and --sweep: give one of both")
    picture = picture_path(options)
    board = board_of(options)
    parts = _parts(board, options)
    changes = {name: value for name in NUMBERS if (value := getattr(options, name)) is not None}
    if options.find:
        return _find(options, board, changes, parts)
    if not options.sweep:
        show(options, {"board": board.name, **design_figures(board, changes, parts)}, _table)
        return 0
    name, values = sweep(options.sweep)
    for value in values:  # all are possible, before any is computed
        inputs_of(board, {**changes, name: value}, parts)
    rows = [design_figures(board, {**changes, name: value}, parts) for value in values]
    figures: dict[str, Any] = {"board": board.name, "swept": name, "values": values, "designs": rows}
    if picture:
        _plot(picture, figures)
    show(options, figures, _sweep_table)
    return 0


def _parts(board: Board, options: argparse.Namespace) -> Parts | None:
    """The parts that were asked for; None: the board's."""
    from controller.workshop.physics.design.from_parts import ASSUMED

    asked = {name: value for name in ("disc", "sectors") if (value := getattr(options, name)) is not None}
    if not asked:
        return None
    return as_record("--disc, --sectors: ", msgspec.to_builtins(board.parts or ASSUMED) | asked, Parts)


def _find(options: argparse.Namespace, board: Board, changes: dict[str, float], parts: Parts | None) -> int:
    from controller.workshop.physics.design.find_design import find_designs
    from controller.workshop.physics.felt import DETECTION_UM

    felt_um = DETECTION_UM[1] if options.felt_um is None else options.felt_um
    if not felt_um > 0:
        raise ConfigError(f"--felt-um {felt_um:g}: must be above 0")
    rows = find_designs(board, changes, parts, options.find.split(","), felt_um, _prices(options.price))
    reached = rows[0]["felt_um"] >= felt_um
    show(options, {"board": board.name, "felt_um": felt_um, "reached": reached, "designs": rows}, _found_table)
    return 0 if reached else 1


def _prices(given: list[str]) -> dict[str, float]:
    """Costs by name, of NAME=COST."""
    prices = {}
    for text in given:
        name, _, cost = text.partition("=")
        try:
            prices[name] = float(cost)
        except ValueError:
            prices[name] = -1.0
        if not 0 <= prices[name] < 1e9:
            raise ConfigError(f"--price {text}: must be NAME=COST, a number from 0")
    return prices


def _plot(picture: Path, figures: dict[str, Any]) -> None:
    from controller.workshop.physics.design.plot_design import plot_sweep
    from controller.workshop.physics.felt import DETECTION_UM

    titles = {name: ROWS[name] for name in COLUMNS}
    plot_sweep(picture, figures["swept"], figures["values"], figures["designs"], titles, {COLUMNS[0]: DETECTION_UM[1]})


def _table(figures: dict[str, Any]) -> str:
    given = textwrap.fill("  ".join(f"{name} {_shown(v)}" for name, v in figures["inputs"].items() if v is not None), 120)
    width = max(map(len, ROWS.values()))
    lines = [given, ""]
    for name, title in ROWS.items():
        value = figures[name]
        parts = value.items() if isinstance(value, dict) else [("", value)]
        lines.append(f"{title:<{width}}  " + ", ".join(f"{part.replace('_', ' ')} {_shown(v)}".strip() for part, v in parts))
    return "\n".join(lines + [f"warning: {warning}" for warning in figures["warnings"]])


def _found_table(figures: dict[str, Any]) -> str:
    reached = figures["reached"]
    priced = "cost" in figures["designs"][0]
    least = "Cheapest" if priced else "Fewest channels"
    said = f"{f'{least} that reach' if reached else 'None reaches'} a felt amplitude of {figures['felt_um']:g} µm"
    names = ("cost", *FOUND) if priced else FOUND
    rows = [names, *([_shown(row[name]) for name in names] for row in figures["designs"])]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    table = ["  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True)) for row in rows]
    return "\n".join([f"{said}{'' if reached else '; the strongest'}:", *table])


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
