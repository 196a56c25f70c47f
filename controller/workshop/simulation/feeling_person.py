"""A simulated person before a simulated panel whose wires may be swapped or dead: puts a finger where a channel moves the glass."""

import random
from typing import Final

import numpy as np

from controller.device.board.board import Board
from controller.workshop.gateware.simulated_link import SimulatedLink
from controller.workshop.simulation.ghostly_panel import Finger
from controller.workshop.simulation.simulated_touch import simulated_touch

REACTS_S: Final = 0.4  # from the first edges to the finger, or to the word that nothing is felt
HOLDS_S: Final = 0.5  # lifted before it feels the next
MISSES_MM: Final = 4.0  # at most, along x and y


class FeelingPerson:
    """A `Person`, with the panel that reports its finger.

    Captures of the link are consumed. `real` is the board that is there: its patches, each with the output that it hangs on.
    """

    def __init__(self, board: Board, link: SimulatedLink, real: Board, seed: int = 1) -> None:
        self._places = {actuator.channel: (actuator.x_mm, actuator.y_mm) for actuator in real.actuators}
        self._sides_mm = board.plate.length_mm, board.plate.width_mm
        self._link = link
        self._random = random.Random(seed)
        self._fingers: list[Finger] = []
        self.felt: list[int] = []  # outputs that have moved alone, in order
        self._says_nothing = False
        self.panel = simulated_touch(board, self._fingers, self._feels)  # reports the finger

    def fileno(self) -> None:
        """None: it speaks when it is asked."""
        return

    def feels_nothing(self) -> bool:
        """As in `Person`."""
        said, self._says_nothing = self._says_nothing, False
        return said

    def _feels(self, at_s: float) -> bool:
        """Watch the pins at a scan; False: the panel hears no edges."""
        link = self._link
        link.gateware.advance(max(link.tick(at_s), link.gateware.now))
        capture = link.take_capture()
        moved = [int(bits).bit_length() - 1 for bits in capture.words[1:] ^ capture.words[:-1] if int(bits).bit_count() == 1]
        if moved and moved[-1:] != self.felt[-1:]:
            self.felt.append(moved[-1])
            self._answer(moved[-1], at_s)
        return False

    def _answer(self, channel: int, at_s: float) -> None:
        if channel not in self._places:
            self._says_nothing = True
            return
        off = [self._random.uniform(-MISSES_MM, MISSES_MM) for _ in range(2)]
        x_mm, y_mm = (
            float(np.clip(at + by, 0, side)) for at, by, side in zip(self._places[channel], off, self._sides_mm, strict=True)
        )
        self._fingers.append((at_s + REACTS_S, at_s + REACTS_S + HOLDS_S, (x_mm, y_mm)))
