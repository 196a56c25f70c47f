"""What the tests of the benchmark share."""

import msgspec
import pytest

from controller.workshop.physics.responses.impulse_response import ResponseModel


@pytest.fixture(scope="session")
def small_board(board):
    """The simulated board at half the size and a quarter of the time: a sixteenth of the work."""

    def halved(some, *names):
        return msgspec.structs.replace(some, **{name: getattr(some, name) / 2 for name in names})

    return msgspec.structs.replace(
        board,
        plate=msgspec.structs.replace(halved(board.plate, "length_mm", "width_mm"), decay_time_ms=0.25),
        actuators=tuple(halved(actuator, "x_mm", "y_mm", "size_mm") for actuator in board.actuators),
        waveform=msgspec.structs.replace(board.waveform, duration_ms=0.5),
    )


@pytest.fixture(scope="session")
def small_model(small_board):
    return ResponseModel(small_board)
