"""The way from a new board to a panel that is felt, and which of its steps are done, as far as the device shows it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, NamedTuple

from controller.device.board.board import Board
from controller.device.doctor.finding import Finding
from controller.device.fpga.bitstream import differences, read_identity
from controller.device.service.drivers import gateware_hash
from controller.errors import ControllerError

DRAWN_MM: Final = 0.1  # axes in whole tenths are drawn; measured ones have three digits
MARKS: Final = {True: "[x]", False: "[ ]", None: "[?]"}


class WayStep(NamedTuple):
    """A step of the way."""

    name: str  # what is done when it is done
    command: str  # how
    done: bool | None  # None: this device does not show it now


def way(board: Board, findings: Iterable[Finding] = ()) -> list[WayStep]:
    """Steps of the page "A panel of your own", for a board and what `doctor` has found; nothing found: what the folder shows."""
    found = {finding.about: finding for finding in findings}

    def good(about: str, *, warned: bool = True) -> bool | None:
        return found[about].good and (warned or not found[about].warns) if about in found else None

    command, bitstream = "haptic-panel {} --board " + board.called, board.folder / board.bitstream
    calibrated = [
        f"{command.format('calibrate plan')} --out points.csv",
        f"{command.format('calibrate measure measured')} --points points.csv",
        command.format("calibrate bank measured"),
    ]
    return [
        WayStep("board.toml and its scene are valid", f"haptic-panel board check {board.called}", good("scene") is not False),
        WayStep("the bitstream has this board's limits", f"{command.format('gateware build')} --out {bitstream}", _built(board)),
        WayStep("the FPGA is loaded with it", f"{command.format('gateware load')} --flash", good("identity and settings")),
        WayStep("its link carries every bit", command.format("doctor --link"), good("bits")),
        WayStep("the bank fits board and scene", command.format("bank build"), good("bank")),
        WayStep("the touch panel answers", command.format("doctor"), good("touch panel")),
        WayStep("its axes are measured", f"{command.format('calibrate-touch')} --write", _axes_measured(board)),
        WayStep("each channel moves its own disc", command.format("calibrate channels"), None),
        WayStep("the plate's responses are measured", ", ".join(calibrated), good("responses", warned=False)),
        WayStep("a finger feels it", command.format("run"), None),
    ]


def _built(board: Board) -> bool:
    try:
        return not differences(read_identity(board.folder / board.bitstream), board, gateware_hash())
    except (ControllerError, OSError):
        return False


def _axes_measured(board: Board) -> bool:
    """Whether the axes are finer than anybody draws them."""
    tenths = [value / DRAWN_MM for value in (*board.touch.x_mm_from_axes, *board.touch.y_mm_from_axes)]
    return any(abs(value - round(value)) > 1e-6 for value in tenths)


def in_lines(steps: Iterable[WayStep]) -> list[str]:
    """The steps as a checklist; of what is not done, how to do it."""
    return [f"{MARKS[step.done]} {step.name}" + ("" if step.done else f": {step.command}") for step in steps]
