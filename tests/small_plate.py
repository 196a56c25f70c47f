"""A panel whose waveforms are optimised in a tenth of a second."""

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.tolerance.corner import corner_of

WHOLE = load_board(find_board("simulated"))


def small_board():
    """Eight channels on a ninth of the plate, half the time: an entry in a tenth of a second."""
    return corner_of(WHOLE)
