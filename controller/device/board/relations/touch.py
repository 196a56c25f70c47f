"""Relations of the touch panel's axes and the plate."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from controller.device.board.relations.relation import refuses, warns
from controller.device.board.relations.touch_area import Reached, reached

if TYPE_CHECKING:
    from controller.device.board.board import Board

LEAST_COVERED, LESS_COVERED = 0.05, 0.5  # of the plate, by the panel's range: refused, warned of
LEAST_USED, LESS_USED = 1e-4, 0.1  # of the panel's range, by the plate
SHIFTED = 0.05  # of the plate: the range reaches beyond one side by more, and falls short of the other by more
ADVICE = "haptic-panel calibrate-touch finds the axes"


def _reached(board: Board) -> Reached:
    touch, plate = board.touch, board.plate
    return reached(touch.x_mm_from_axes, touch.y_mm_from_axes, plate.length_mm, plate.width_mm)


def _rows(board: Board) -> str:
    rows = (board.touch.x_mm_from_axes, board.touch.y_mm_from_axes)
    x_row, y_row = (f"[{', '.join(f'{value:g}' for value in row)}]" for row in rows)
    return f"touch.x_mm_from_axes = {x_row} and y_mm_from_axes = {y_row}"


def _range(board: Board, found: Reached) -> str:
    plate = board.plate
    return (
        f"x from {found.x_mm[0]:g} to {found.x_mm[1]:g} mm and y from {found.y_mm[0]:g} to {found.y_mm[1]:g} mm, on a plate of"
        f" {plate.length_mm:g} × {plate.width_mm:g} mm"
    )


@refuses("`touch.x_mm_from_axes`, `y_mm_from_axes`, `plate.length_mm`, `width_mm`")
def axes(board: Board) -> Iterator[str]:
    """The panel's range reaches 5 % of the plate or more, and the plate its range."""
    found = _reached(board)
    plate_mm2 = board.plate.length_mm * board.plate.width_mm
    if not found.area_mm2 > 1e-9 * plate_mm2:
        yield f"{_rows(board)} put all touches onto one line or point; {ADVICE}"
    elif not found.on_plate_mm2:
        yield (
            f"{_rows(board)} put every touch off the plate: {_range(board, found)}; an axis that is mirrored (factor below 0)"
            f" needs the plate's extent as its offset; {ADVICE}"
        )
    elif found.on_plate_mm2 < LEAST_COVERED * plate_mm2:
        yield (
            f"{_rows(board)} reach {100 * found.on_plate_mm2 / plate_mm2:.2g} % of the plate: {_range(board, found)}; are they in"
            f" mm? {ADVICE}"
        )
    elif found.on_plate_mm2 < LEAST_USED * found.area_mm2:
        yield f"{_rows(board)} put nearly every touch off the plate: {_range(board, found)}; are they in mm? {ADVICE}"


@warns("`touch.x_mm_from_axes`, `y_mm_from_axes`, `plate.length_mm`, `width_mm`")
def _axes_in_part(board: Board) -> Iterator[str]:
    """It reaches half of the plate or more, and is not shifted."""
    found, plate_mm2 = _reached(board), board.plate.length_mm * board.plate.width_mm
    if found.on_plate_mm2 < LEAST_COVERED * plate_mm2 or found.on_plate_mm2 < LEAST_USED * found.area_mm2:
        return  # refused
    if found.on_plate_mm2 < LESS_COVERED * plate_mm2:
        yield (
            f"{_rows(board)} reach only {100 * found.on_plate_mm2 / plate_mm2:.2g} % of the plate: {_range(board, found)}; {ADVICE}"
        )
    elif found.on_plate_mm2 < LESS_USED * found.area_mm2:
        yield (
            f"{_rows(board)} put {100 - 100 * found.on_plate_mm2 / found.area_mm2:.2g} % of the panel's range off the plate:"
            f" {_range(board, found)}; {ADVICE}"
        )
    else:
        for (low, high), extent in ((found.x_mm, board.plate.length_mm), (found.y_mm, board.plate.width_mm)):
            short_mm, beyond_mm = sorted((-low, high - extent))
            if beyond_mm > SHIFTED * extent and short_mm < -SHIFTED * extent:
                yield f"{_rows(board)} are shifted: {_range(board, found)}; {ADVICE}"
                return


@refuses("`touch.no_finger_mm`, `plate.length_mm`, `width_mm`")
def _no_finger(board: Board) -> Iterator[str]:
    """Places without fingers lie on the plate, and leave some of it."""
    length_mm, width_mm = board.plate.length_mm, board.plate.width_mm
    for index, (x_mm, y_mm, along_mm, across_mm) in enumerate(board.touch.no_finger_mm):
        where = f"touch.no_finger_mm[{index}] = {[x_mm, y_mm, along_mm, across_mm]}"
        if along_mm <= 0 or across_mm <= 0:
            yield f"{where}: its length and width, the last two, must be above 0 mm"
        elif x_mm > length_mm or y_mm > width_mm or x_mm + along_mm < 0 or y_mm + across_mm < 0:
            yield f"{where} lies beside the plate (0 to {length_mm:g}, 0 to {width_mm:g} mm): nothing is left out"
        elif x_mm <= 0 and y_mm <= 0 and x_mm + along_mm >= length_mm and y_mm + across_mm >= width_mm:
            yield f"{where} covers the plate: no finger would be left"
