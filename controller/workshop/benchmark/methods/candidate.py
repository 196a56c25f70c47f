"""A method of finding drive words at one of its settings: a point of the work-precision diagrams."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from controller.arrays import Words
from controller.device.bank.packing import WORD
from controller.device.kernel import SHORT_FRAME_BYTES, Point, load_frames_bytes

Place = tuple[float, float]
COMMAND_FRAMES = 4  # STORE, PLAY and a NOP for the answer to each
RESIDENT_WIRE_BYTES = 2 * SHORT_FRAME_BYTES


def wire_bytes(samples: int) -> int:
    """Bytes on the wire of an upload of this many drive words that is played."""
    return load_frames_bytes(4 * samples) + COMMAND_FRAMES * SHORT_FRAME_BYTES


def words_of_buffer(composed: Any) -> Words:
    """Drive words of a buffer that may be overwritten by the next composition."""
    return np.frombuffer(composed, WORD).astype(np.uint32)


@dataclass(frozen=True)
class Candidate:
    """A method at one setting."""

    curve: str  # the method; its settings are the points of one curve
    setting: str  # label of the point
    # from points (x_m, y_m, amplitude) to what it makes, which may be overwritten by the next call. This is what is timed. With
    # `keeps_nulls`, places that shall stay still are its second argument
    compose: Callable[..., Any]
    memory_bytes: int  # that must be resident or in a file for the whole plate
    wire_bytes: int  # on the wire for one emission
    most_fingers: int = 10  # that it can serve at once
    free_polarity: bool = False  # whether it may kick a point downwards
    keeps_nulls: bool = False  # whether it is given the places that are to stay still
    tabled: bool = False  # whether it takes tables of responses, which are computed for each scene
    slow: bool = False  # whether it takes tenths of a second
    words_of: Callable[[Any], Words] = words_of_buffer  # from what `compose` gave to a copy of its drive words

    def run(self, points: Sequence[Point], nulls: Place) -> Any:
        """Compose points; `nulls` shall stay still."""
        return self.compose(points, [nulls]) if self.keeps_nulls else self.compose(points)
