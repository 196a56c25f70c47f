"""The check of a board's touch panel for `haptic-panel doctor`: whether it answers, what is odd, who else gets its touches."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from controller.device.board.board import Board
from controller.device.board.panel_status import FOLDER, NAME, read_now
from controller.device.board.touch_panels import DrivenPanel, I2cTouch, SerialTouch, TouchPanel
from controller.device.doctor.finding import Finding
from controller.device.service.drivers import open_panel, recording_path
from controller.device.touch.event_reader import EventReader
from controller.device.touch.panels.linux_input import LinuxInputTouch
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.reports import FAULTS, describe_warnings

OpenPanel = Callable[[Board], EventReader]
NOT_SHARED = "no other program on this machine gets its touches; [touch] share = true hands them on"


def look_at_touch_panel(board: Board, now_s: Callable[[], float], opened: OpenPanel = open_panel) -> str | Finding:
    """Open the panel without taking it from others, or take what the service that reads it has found."""
    touch = board.touch
    if not touch.has_device:
        return f"recording {Recording.open(recording_path(board, None)).name}"
    if isinstance(touch, LinuxInputTouch):
        board = msgspec.structs.replace(board, touch=msgspec.structs.replace(touch, grab=False))
    if isinstance(touch, I2cTouch | SerialTouch) and (served := _served(board)):
        return served  # its devices are the service's alone
    panel = opened(board)
    try:
        panel.read(now_s())  # a first look, also at the lines
        faults = [panel.description.remark, *describe_warnings({kind: panel.warnings[kind] for kind in FAULTS})]
    finally:
        panel.close()
    hindered = _not_handed_on(touch)
    said = [f"{touch.__struct_config__.tag} answers", *filter(None, [*faults, hindered])]
    warns = len(said) > 1
    if not hindered:
        said += _sharing(touch)
    if touch.no_finger_mm:
        said.append(f"no finger in {len(touch.no_finger_mm)} rectangles of the plate")
    if isinstance(touch, I2cTouch):
        said.append(
            f"whether line {touch.interrupt_line!r} announces reports shows when it is touched: `calibrate channels`, `status`"
            if touch.interrupt_line
            else "polled, as the board names no interrupt line"
        )
    return Finding("touch panel", True, "; ".join(said), warns=warns)


def _sharing(touch: TouchPanel) -> list[str]:
    """Whether other programs get the panel's touches, if it is for the board to say."""
    if not isinstance(touch, DrivenPanel):
        return []  # the kernel gives them
    return ["its contacts are handed on" if touch.share else NOT_SHARED]


def _not_handed_on(touch: TouchPanel) -> str:
    """Why contacts that the board shares would not be handed on; empty: they would."""
    if not (isinstance(touch, DrivenPanel) and touch.share):
        return ""
    from controller.device.touch.drivers.screen import why_not

    reason = why_not()
    return reason and f"touch.share: its contacts are not handed on to other programs: {reason}"


def _served(board: Board) -> Finding | None:
    """What the running service has found of the board's touch panel; None if no service has this panel now."""
    status, old = read_now(FOLDER / NAME)
    if status is None or old or status.board != board.name or not status.panel_present:
        return None
    counts = {kind: status.touch_warnings.get(kind, 0) for kind in FAULTS}
    faults = [status.touch_remark, *describe_warnings(counts)]
    said = ["read by the running service", *filter(None, faults)]
    sharing = [] if status.touch_remark else _sharing(board.touch)  # why it is not shared stands there
    return Finding("touch panel", True, "; ".join([*said, *sharing]), warns=len(said) > 1)
