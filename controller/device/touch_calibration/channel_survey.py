"""One channel after the other buzzes; a person puts a finger where it does, and the touch panel says where that is.

A channel alone toggles once an emission, 150 times a second at a duty of 0.3: what a fingertip feels best, with as few edges as
there can be. The outputs are armed only while a survey runs, and off at its end, whatever ends it.
"""

from __future__ import annotations

import math
import selectors
from collections.abc import Callable, Iterator, Sequence
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from controller.clocks import Clock
from controller.device.board.board import Board
from controller.device.fpga.frames import ALL_CHANNELS, Play
from controller.device.fpga.registers import Start
from controller.device.fpga.session import Session
from controller.device.touch.source import TouchSource
from controller.device.touch_calibration.calibration import StationaryTouches
from controller.device.touch_calibration.channel_map import Place
from controller.errors import CalibrationError

SLOT: Final = 0


class Person(Protocol):
    """Whoever puts a finger down, or says that nothing is felt."""

    def fileno(self) -> int | None:
        """File that is readable when they have said something; None: there is none."""

    def feels_nothing(self) -> bool:
        """Whether they have said so since the last call."""


def buzz_words(board: Board) -> NDArray[np.uint32]:
    """Drive words of one emission, (sample,): every channel leaves its idle level for the second half."""
    words = np.full(board.waveform.samples, board.idle_word, np.uint32)
    words[board.waveform.samples // 2 :] ^= np.uint32(ALL_CHANNELS)
    return words


def survey(
    session: Session,
    board: Board,
    clock: Clock,
    source: TouchSource,
    channels: Sequence[int],
    person: Person,
    ask: Callable[[int], None],  # called with a channel that buzzes now
) -> Iterator[tuple[int, Place | None]]:
    """Buzz on one channel after the other until each was touched; the outputs are off at the end.

    Yields a channel, and where the finger was held still; None: nothing was felt. Raises LinkError or FaultError if the FPGA does
    not answer, or has switched off; TouchError or CalibrationError if the touch panel fails, or its touches end.
    """
    period_ticks = session.timing.period_ticks(board.waveform.duration_s / board.limits.max_duty)
    session.upload(SLOT, memoryview(buzz_words(board).astype("<u4").tobytes()))
    held = StationaryTouches()
    with selectors.DefaultSelector() as selector:
        for file in (source.fileno(), person.fileno()):
            if file is not None:
                selector.register(file, selectors.EVENT_READ)

        def wait(until_s: float) -> Place | None:
            """A finger held still, or the time until which nobody was asked."""
            while True:
                now_s = clock.now_s()
                if now_s >= session.heartbeat_due_s:
                    session.heartbeat()
                place = held.take(source.read(now_s), now_s)
                if now_s >= until_s or (until_s == math.inf and (place is not None or person.feels_nothing())):
                    return place
                source_s = source.next_time_s()
                if source_s is None and source.fileno() is None:
                    raise CalibrationError("the touch panel's recording ends before every channel was touched")
                clock.wait(selector, min(until_s, session.heartbeat_due_s, held.due_s, math.inf if source_s is None else source_s))

        try:
            wait(session.arm())
            session.require_armed()
            for channel in channels:
                play = Play(SLOT, emissions=0, start=Start.NOW, period_ticks=period_ticks, mask=1 << channel)
                session.play(play, stop=False)
                person.feels_nothing()  # what was said before is not of this channel
                ask(channel)
                yield channel, wait(math.inf)
                session.stop()
            wait(session.disarm())
        finally:
            session.off()
