"""What a bank is expected to do on the panel of this computer, or on a simulated one."""

from datetime import UTC, datetime

from controller.device.bank.expectation import Expectation
from controller.device.bank.file_format import Header
from controller.device.board.board import Board
from controller.device.board.identity import panel_identity, simulated_identity
from controller.device.service.installation import is_installed


def expected_of(header: Header, board: Board, plate: Board | None = None) -> Expectation | None:
    """Expectation of a bank of a board; `plate` is what is there of a simulated panel, if it is not known from the board."""
    return Expectation.of(header, board, _identity(board, plate), datetime.now(tz=UTC).date())


def _identity(board: Board, plate: Board | None) -> str | None:
    if plate is None:
        if board.link.kind != "simulated" or not is_installed("workshop"):
            return panel_identity()
        from controller.workshop.gateware.actual_panel import actual_panel

        plate = actual_panel(board).of(board)
    return simulated_identity(plate)
