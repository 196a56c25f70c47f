"""The way from a new board to a panel that is felt, and which of its steps are done, as far as the device shows it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Final, NamedTuple

from controller.device.board.board import Board
from controller.device.board.lookup import fpga_files
from controller.device.doctor.finding import Finding
from controller.device.fpga.bitstreams.bitstream import differences, read_identity
from controller.device.service.drivers import gateware_hash
from controller.errors import ControllerError

DRAWN_MM: Final = 0.1  # axes in whole tenths are drawn; measured ones have three digits
OF_FPGA: Final = re.compile(r"^FPGA \d: ")
MARKS: Final = {True: "[x]", False: "[ ]", None: "[?]"}


class WayStep(NamedTuple):
    """A step of the way."""

    name: str  # what is done when it is done
    command: str  # how
    done: bool | None  # None: this device does not show it now


def way(board: Board, findings: Iterable[Finding] = ()) -> list[WayStep]:
    """Steps of the page "A panel of your own", for a board and what `doctor` has found; nothing found: what the folder shows."""
    found: dict[str, Finding] = {}
    for finding in findings:
        about = OF_FPGA.sub("", finding.about)
        if about not in found or found[about].good:  # of several FPGAs, the first that is not
            found[about] = finding

    def good(about: str, *, warned: bool = True) -> bool | None:
        return found[about].good and (warned or not found[about].warns) if about in found else None

    command, bitstreams = (
        "haptic-panel {} --board " + board.called,
        fpga_files(board.folder / board.bitstream, len(board.fpga_boards)),
    )
    built = [f"{command.format('gateware build')}{f' --fpga {n}' * (n > 0)} --out {file}" for n, file in enumerate(bitstreams)]
    load = f"{command.format('gateware load')} --flash"
    if board.link.fpga and board.gateware is None:
        load = "each into its flash, by the tool of its board, such as openFPGALoader"
    calibrated = [
        f"{command.format('calibrate plan')} --out points.csv",
        f"{command.format('calibrate measure measured')} --points points.csv",
        command.format("calibrate bank measured"),
    ]
    return [
        WayStep("board.toml and its scene are valid", f"haptic-panel board check {board.called}", good("scene") is not False),
        WayStep("the bitstream has this board's limits", ", ".join(built), _built(board, bitstreams)),
        WayStep("the FPGA is loaded with it", load, good("identity and settings")),
        WayStep("its link carries every bit", command.format("doctor --link"), good("bits")),
        WayStep("the bank fits board and scene", command.format("bank build"), good("bank")),
        WayStep("the touch panel answers", command.format("doctor"), good("touch panel")),
        WayStep("its axes are measured", f"{command.format('calibrate-touch')} --write", _axes_measured(board)),
        WayStep("each channel moves its own disc", command.format("calibrate channels"), None),
        WayStep("the plate's responses are measured", ", ".join(calibrated), good("responses", warned=False)),
        WayStep("a finger feels it", command.format("run"), None),
    ]


def _built(board: Board, bitstreams: Iterable[Path]) -> bool:
    try:
        return not any(
            differences(read_identity(file), one, gateware_hash()) for one, file in zip(board.fpga_boards, bitstreams, strict=True)
        )
    except (ControllerError, OSError):
        return False


def _axes_measured(board: Board) -> bool:
    """Whether the axes are finer than anybody draws them."""
    tenths = [value / DRAWN_MM for value in (*board.touch.x_mm_from_axes, *board.touch.y_mm_from_axes)]
    return any(abs(value - round(value)) > 1e-6 for value in tenths)


def in_lines(steps: Iterable[WayStep]) -> list[str]:
    """The steps as a checklist; of what is not done, how to do it."""
    return [f"{MARKS[step.done]} {step.name}" + ("" if step.done else f": {step.command}") for step in steps]
