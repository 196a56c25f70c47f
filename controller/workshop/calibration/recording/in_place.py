"""A point of the plate measured in place: the session plays the excitation through the real FPGA, a source records the sensor.

The outputs are armed for the emissions of one point and off again before anybody moves the sensor, and after any error.
"""

import selectors
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.clocks import Clock
from controller.device.bank.packing import channel_bits
from controller.device.board.board import Board
from controller.device.fpga.frames import FRAME_BYTES, UPLOAD_BYTES, Play
from controller.device.fpga.registers import Start
from controller.device.fpga.session import Session
from controller.errors import CalibrationError, LinkError
from controller.workshop.calibration.recording.alignment import begin_of, shifted

BEFORE_S: Final = 0.2e-3  # of a record, before the first drive word, to the nearest sample
LEAD_S: Final = 20e-3  # from the start of the recorder to the first emission, beside the time that an upload takes
SLACK_S: Final = 0.25  # by which a recorder may begin late
NEAR_SAMPLES: Final = 20  # by which an emission may differ from where the one before it lets it be expected
FRAMES_AT_MOST: Final = 6  # with an upload: store, play, answers


Alive = Callable[[], None]


class Recorder(Protocol):
    """Records a sensor on the plate."""

    rate_hz: float
    # Records begin with the trigger's edge, one an emission; else one record runs through all emissions, with a second track
    # that hears a channel
    triggered: bool

    def begin(self, samples: int, alive: Alive) -> None:
        """Begin to record, or wait for the trigger; `alive` is called every 20 ms at least."""

    def read(self, alive: Alive) -> Floats:
        """What was recorded: (sample, track), in the sensor's unit; waits for its end, as `begin` does.

        Raises CalibrationError if the recorder has lost samples, or does not answer.
        """

    def close(self) -> None:
        """Close the device."""


def samples_before(rate_hz: float) -> int:
    """Samples of a record before the first drive word."""
    return round(BEFORE_S * rate_hz)


def date_now() -> str:
    """Date and time of a measurement, ISO 8601; by the clock of the day, which nothing else goes by."""
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


@dataclass(frozen=True)
class Excitation:
    """What is played at each point."""

    words: NDArray[np.uint32]  # (emission, word), or (emission, word, FPGA)
    repetitions: int
    period_s: float  # least time from one emission to the next
    record_s: float  # length of a record after the first word


class InPlace:
    """Plays the excitation for one point after another."""

    def __init__(
        self,
        session: Session,  # of an FPGA that was brought up
        board: Board,
        clock: Clock,
        recorder: Recorder,
        excitation: Excitation,
        sync_channel: int,  # that the second track hears
    ) -> None:
        self._session, self._board, self._clock, self._recorder = session, board, clock, recorder
        self._words = excitation.words.astype("<u4")  # sent by columns: those of each FPGA behind the other's
        self._repetitions = excitation.repetitions
        self._record_s = excitation.record_s
        upload_s = len(board.fpga_boards) * board.link.wire_s(UPLOAD_BYTES + FRAMES_AT_MOST * FRAME_BYTES)
        self.period_s = max(excitation.period_s, self._record_s + 2 * BEFORE_S, 1.5 * upload_s / self._repetitions)
        self._lead_s = LEAD_S + 1.5 * upload_s
        self._sync_channel = sync_channel

    def measure(self) -> Floats:
        """Play all emissions and record them; the outputs are off afterwards.

        The records (emission, repetition, sample) are in the sensor's unit; the first sample is `samples_before` the first word,
        or at the trigger. Raises LinkError or FaultError if the FPGA does not play all of them; CalibrationError if the recorder
        fails, or does not hear them.
        """
        session = self._session
        with selectors.DefaultSelector() as selector:
            try:
                self._rest(selector, session.arm())
                session.require_armed()
                before = session.heartbeat().emissions
                records = self._triggered(selector) if self._recorder.triggered else self._running(selector)
                done = session.heartbeat().emissions - before & 0xFFFFFFFF
                expected = len(self._words) * self._repetitions
                if done != expected:
                    raise LinkError(f"the FPGA has played {done} of {expected} emissions to their end")
                self._rest(selector, session.disarm())
            finally:
                session.off()
        return records if self._recorder.triggered else self._cut(self._recorder.read(lambda: None))

    def _running(self, selector: selectors.BaseSelector) -> Floats:
        """Play all emissions at times of the FPGA's clock, while one record runs."""
        session, clock_hz = self._session, self._board.link.clock_hz
        period_ticks = round(self.period_s * clock_hz)
        whole_s = len(self._words) * self._repetitions * self.period_s
        self._recorder.begin(round((SLACK_S + self._lead_s + whole_s + self._record_s) * self._recorder.rate_hz), self._alive)
        begin_ticks = session.heartbeat().timestamp_ticks + round(self._lead_s * clock_hz)
        begin_s = session.earliest_trigger_s() + self._lead_s
        slots = min(self._board.link.slots, 2)
        for emission, words in enumerate(self._words):
            start = emission * self._repetitions
            self._rest(selector, begin_s + (start - (self._repetitions if slots > 1 else 0)) * self.period_s)
            when_ticks = begin_ticks + start * period_ticks
            waveform = memoryview(words.T.tobytes())
            play = Play(
                emission % slots,
                emissions=self._repetitions,
                start=Start.TIME,
                period_ticks=0 if self._repetitions == 1 else session.timing.period_ticks(self.period_s),
                when_ticks=when_ticks,
            )
            session.upload_and_play(play, waveform, stop=False)
        self._rest(selector, begin_s + whole_s + self._record_s)
        return np.zeros((0, 0, 0))

    def _triggered(self, selector: selectors.BaseSelector) -> Floats:
        """Play each emission by the trigger, which also starts its record."""
        session, recorder = self._session, self._recorder
        records = []
        for words in self._words:
            session.upload(0, memoryview(words.T.tobytes()))
            for _ in range(self._repetitions):
                session.play(Play(0), stop=False)
                recorder.begin(round(self._record_s * recorder.rate_hz), self._alive)
                self._rest(selector, session.trigger() + self.period_s)
                records.append(recorder.read(self._alive)[:, 0])
        return np.array(records).reshape(len(self._words), self._repetitions, -1)

    def _cut(self, track: Floats) -> Floats:
        """Records of all emissions from one that runs through; each begins at its own emission, to a hundredth of a sample."""
        rate_hz, waveform, slack = self._recorder.rate_hz, self._board.waveform, round(SLACK_S * self._recorder.rate_hz)
        count = round((BEFORE_S + self._record_s) * rate_hz)
        records = np.empty((len(self._words), self._repetitions, count))
        nominal = self._lead_s * rate_hz
        for emission, repetition in np.ndindex(records.shape[:2]):
            levels = channel_bits(self._words[emission])[:, self._sync_channel].astype(bool)
            first = not emission and not repetition
            try:
                if first:  # what else is heard in so long a time would shift it
                    nominal = begin_of(track[:, 1], rate_hz, levels, waveform.bit_clock_hz, nominal, slack)
                begin = begin_of(track[:, 1], rate_hz, levels, waveform.bit_clock_hz, nominal, NEAR_SAMPLES)
            except CalibrationError as error:
                raise CalibrationError(f"emission {emission}, repetition {repetition}: {error}") from None
            records[emission, repetition] = shifted(track[:, 0], begin, samples_before(rate_hz), count)
            nominal = begin + self.period_s * rate_hz
        return records

    def _rest(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Wait, with heartbeats."""
        while self._clock.now_s() < until_s:
            self._alive()
            self._clock.wait(selector, min(until_s, self._session.heartbeat_due_s))

    def _alive(self) -> None:
        """Send a heartbeat if one is due."""
        if self._clock.now_s() >= self._session.heartbeat_due_s:
            self._session.heartbeat()
