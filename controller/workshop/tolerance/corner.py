"""A panel on which all that takes minutes of the paper's takes a second: eight channels on a ninth of the plate, half the time."""

import msgspec

from controller.device.board.board import Board


def corner_of(board: Board) -> Board:
    """Two discs of the simulated board on a plate of 70 x 50 mm of their own, with emissions of 0.8 ms."""
    replace = msgspec.structs.replace
    near = tuple(actuator for actuator in board.actuators if actuator.x_mm < 100 and actuator.y_mm < 50)
    spread = {26.5: 12.5, 31.5: 17.5, 90.5: 52.5, 95.5: 57.5}
    return replace(
        board,
        plate=replace(board.plate, length_mm=70.0, width_mm=50.0),
        actuators=tuple(replace(actuator, x_mm=spread[actuator.x_mm]) for actuator in near),
        waveform=replace(board.waveform, duration_ms=0.8),
    )
