"""A session with several FPGAs that play as one: on one clock, one trigger line, and one line of run permit and faults.

Each FPGA has its own ticks, of one clock, counted since its own reset. A pulse of the trigger line, which all see in the same tick,
says how far they are apart; so what begins at a time begins in the same tick on all pins, as what the trigger starts does. The
pulse is given with the outputs off, in each bring-up, and proves the line as well.

A fault of one shuts all by the wire, not by this host: the line of the run permit is low while one of them reports a fault, so that
the others shut for NO_PERMIT. Raised is what the first one had, with the number of the FPGA, and only after all have been asked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Final

from controller.device.board.board import Board
from controller.device.fpga.belief import BUSY
from controller.device.fpga.exchange import OutOfStep, Refused
from controller.device.fpga.frames import Play, Waveform, parted
from controller.device.fpga.links.link_group import LinkGroup
from controller.device.fpga.registers import Register, Start, State
from controller.device.fpga.session import Session
from controller.device.fpga.several.asking import NamedFpga, answers_of_all, ask_all, rank
from controller.device.fpga.status import Status
from controller.device.fpga.supervision import Supervision
from controller.errors import ControllerError, LinkError

APART_TICKS: Final = 2  # by which PLLs on one oscillator may differ
WATCHED_S: Final = 1.0  # from one look at the last trigger to the next, while something is played
ANY: Final = State.HV_ENABLE | BUSY  # of a state: true if it is of one FPGA; the others if they are of all


class WideSession(Session):
    """The session of the first FPGA, which those of the others follow: each step is done with all, or with none.

    Waveforms are those of all FPGAs (`frames.joined`). Start.NOW is for single FPGAs. Parameters and errors as of `Session`.
    """

    def __init__(
        self, links: LinkGroup, board: Board, build_hash: int, now_s: Callable[[], float], *, bring_up: bool = True
    ) -> None:
        boards = board.fpga_boards
        self._others = [
            Session(link, one, build_hash, now_s, bring_up=False) for link, one in zip(links.links[1:], boards[1:], strict=True)
        ]
        self._resident: list[Waveform | None] = [None] * len(self._others)  # in place of waveforms that are there
        self.ahead_ticks = [0] * len(self._others)  # by which the ticks of each are ahead of the first one's
        self._looked_s = -math.inf  # when the last trigger was looked at
        self._triggered = False  # since then
        self._emissions: list[int] = []  # of each when they last were at rest; empty: not known
        self._all_asked: ControllerError | None = None  # the error that was raised when all had been asked last
        self._of = [NamedFpga(number) for number in range(len(boards))]
        super().__init__(links, boards[0], build_hash, now_s, bring_up=bring_up)

    @property
    def on_anywhere(self) -> bool:
        """As in `Supervision`, of all FPGAs."""
        return self.may_be_on or any(one.may_be_on for one in self._others)

    @property
    def of_each(self) -> tuple[Supervision, ...]:
        """As in `Supervision`."""
        return (self, *self._others)

    def bring_up(self) -> None:
        """As in `Supervision`, of all FPGAs, also if one of them is being loaded; then the ticks of each are compared.

        Raises LinkError if the trigger line does not reach one of them.
        """
        others_first = [*self._of[1:], self._of[0]]  # then none has a fault of before
        answers_of_all(others_first, [*[one.bring_up for one in self._others], super().bring_up])
        self.compare_ticks()

    def arm(self) -> float:
        """As in `Session`, of all FPGAs; when the last ramp ends."""
        self._emissions = []
        with self._of[0]:
            self.ramp_end_s = super().arm()
        for named, one in zip(self._of[1:], self._others, strict=True):
            one.counters, one.never_began = self.counters, self.never_began
            with named:
                self.ramp_end_s = max(self.ramp_end_s, one.arm())
        return self.ramp_end_s

    def disarm(self) -> float:
        """As in `Session`, of all FPGAs, also if one of them does not answer; when the last ramp ends."""
        self.ramp_end_s = max(answers_of_all(self._of, [super().disarm, *[one.disarm for one in self._others]]))
        return self.ramp_end_s

    def off(self) -> None:
        """As in `Supervision`, of all FPGAs."""
        super().off()
        for one in self._others:
            one.off()

    def heartbeat(self) -> Status:
        """As in `Session`, of all FPGAs; the status of the first one, with the state of all.

        Raises OutOfStep if they have played different numbers of emissions, or do not count the ticks of one clock.
        """
        statuses, failed = ask_all(self._of, [super().heartbeat, *[one.heartbeat for one in self._others]])
        if failed:
            self._all_asked = min(failed, key=rank)
            raise self._all_asked
        state = statuses[0].state
        for status in statuses[1:]:
            state = state & status.state | (state | status.state) & ANY
        if self._armed and not state & BUSY:
            self._compare_emissions([status.emissions for status in statuses])
            self._watch_ticks()
        return statuses[0]._replace(state=state)

    def cause_of(self, error: ControllerError) -> ControllerError:
        """As in `Supervision`: all FPGAs are asked, before a fault of another than the one that was at work is cleared."""
        if error is self._all_asked or not self.on_anywhere:
            return error
        _, failed = ask_all(self._of, [super().heartbeat, *[one.heartbeat for one in self._others]])
        return min([error, *failed], key=rank)

    def play(self, play: Play, *, stop: bool) -> None:
        """As in `Session`, on all FPGAs, or none."""
        with self._of[0]:
            super().play(play, stop=stop)
        self._follow(play, self._resident, stop=stop)

    def upload(self, slot: int, waveform: Waveform) -> None:
        """As in `Session`, to all FPGAs."""
        first, *others = parted(waveform, 1 + len(self._others))
        with self._of[0]:
            super().upload(slot, first)
        self._upload_others(slot, others)

    def upload_and_play(self, play: Play, waveform: Waveform, *, stop: bool) -> None:
        """As in `Session`, on all FPGAs, or none: nothing begins, or ends, before all have their waveform."""
        first, *others = parted(waveform, 1 + len(self._others))
        ahead = stop or play.start is Start.TIME
        if ahead:
            self._upload_others(play.slot, others)
        with self._of[0]:
            super().upload_and_play(play, first, stop=stop)
        self._follow(play, self._resident if ahead else others, stop=stop)

    def stop(self) -> None:
        """As in `Session`, on all FPGAs; between two of them a repetition may begin once more, on those that are yet to stop."""
        self._emissions = []
        with self._of[0]:
            super().stop()
        for named, one in zip(self._of[1:], self._others, strict=True):
            with named:
                one.stop()

    def trigger(self) -> float:
        """As in `Session`: one edge starts what waits in all FPGAs."""
        at_s = super().trigger()
        self._triggered = True
        for one in self._others:
            one.belief.triggered()
        return at_s

    def set_bit_period(self, scale: float) -> bool:
        """As in `Session`, of all FPGAs, or of none."""
        before = self._board.bit_period / self.bit_period
        setters = (super().set_bit_period, *[one.set_bit_period for one in self._others])
        for number, set_one in enumerate(setters):
            if not set_one(scale):
                for changed in setters[:number]:
                    changed(before)
                return False
        return True

    def compare_ticks(self) -> None:
        """Pulse the trigger line, with nothing queued and the outputs off, and note how far the ticks are apart.

        Raises LinkError if it does not reach one of the FPGAs, or that does not answer.
        """
        sessions = (self, *self._others)
        before = [one.exchange.read(Register.TRIGGERS) for one in sessions]
        self.link.trigger()
        ticks = []
        for number, (one, count) in enumerate(zip(sessions, before, strict=True)):
            seen = one.exchange.read(Register.TRIGGERS) - count & 0xFFFFFFFF
            if seen != 1:
                raise LinkError(f"FPGA {number} saw {seen} edges of the trigger line and not one: is the line wired to each FPGA?")
            low = one.exchange.read(Register.TRIGGER_TIME_LOW)
            ticks.append(one.exchange.read(Register.TRIGGER_TIME_HIGH) << 32 | low)
        self.ahead_ticks = [tick - ticks[0] for tick in ticks[1:]]

    def _upload_others(self, slot: int, parts: Sequence[Waveform]) -> None:
        for named, one, part in zip(self._of[1:], self._others, parts, strict=True):
            with named:
                one.upload(slot, part)

    def _follow(self, play: Play, waveforms: Sequence[Waveform | None], *, stop: bool) -> None:
        """Have the others accept what the first FPGA has accepted, with what they have to play unless it is resident.

        It is withdrawn from all if one of them does not. What has begun on the first one by then was not refused: a single emission
        is left to end, a repetition is ended for good.
        """
        if stop:
            self._emissions = []  # as in `stop`
        try:
            for named, one, ahead_ticks, waveform in zip(self._of[1:], self._others, self.ahead_ticks, waveforms, strict=True):
                own = play._replace(when_ticks=play.when_ticks + ahead_ticks) if play.start is Start.TIME else play
                with named:
                    if waveform is None:
                        one.play(own, stop=stop)
                    else:
                        one.upload_and_play(own, waveform, stop=stop)
        except ControllerError as error:
            self._emissions = []  # what was to begin just now may have begun where it was accepted
            self.stop()
            if not isinstance(error, Refused) or play.start is not Start.TIME or not self._began(play._replace(emissions=1)):
                raise
            self.counters.misplaced += 1
            if play.emissions != 1:
                raise OutOfStep(f"a repetition has begun on FPGA 0 that another refused, and was ended: {error}") from error

    def _watch_ticks(self) -> None:
        """Once a second, of the last edge of the trigger: whether the ticks of all are as far apart as they were."""
        now_s = self._now_s()
        if not self._triggered or now_s < self._looked_s + WATCHED_S:
            return
        self._triggered, self._looked_s = False, now_s
        lows = answers_of_all(self._of, [partial(one.exchange.read, Register.TRIGGER_TIME_LOW) for one in self.of_each])
        for number, (low, ahead_ticks) in enumerate(zip(lows[1:], self.ahead_ticks, strict=True), 1):
            more = (low - lows[0] - ahead_ticks + (1 << 31)) % (1 << 32) - (1 << 31)
            if abs(more) > APART_TICKS:
                raise OutOfStep(
                    f"FPGA {number} counts {more} ticks more than FPGA 0 since they were compared: have all run from one oscillator"
                )

    def _compare_emissions(self, emissions: list[int]) -> None:
        """Compare how many emissions each FPGA has had since they were last at rest, as they are now."""
        if self._emissions:
            had = [now - before & 0xFFFFFFFF for now, before in zip(emissions, self._emissions, strict=True)]
            if len(set(had)) > 1:
                self._emissions = []
                raise OutOfStep(f"the FPGAs have played {', '.join(map(str, had))} emissions where all were to play the same")
        self._emissions = emissions
