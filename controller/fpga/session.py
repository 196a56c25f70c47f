"""One FPGA as the host drives it: identity, settings, arming, uploads, plays and heartbeats.

A play that was damaged on its way is sent again behind a STOP, so that nothing plays twice.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable

from controller.board import Board
from controller.errors import FaultError, LinkError
from controller.fpga import configuration, frames
from controller.fpga.clock_relation import ClockRelation
from controller.fpga.exchange import Exchange, Refused
from controller.fpga.frames import ALL_CHANNELS, FRAME_BYTES, Status, upload_slices
from controller.fpga.link import Link
from controller.fpga.registers import Control, Register, Start, State

BEATS_PER_TIMEOUT = 3
CHECK_TICKS = 8  # beyond one for each word, until the FPGA has checked what it stored


class Session:
    """One FPGA, from the check of its identity to outputs off.

    Parameters
    ----------
    link : Link
        Open link.
    board : Board
        What the FPGA is to be told: idle levels, bit clock, ramp, heartbeat timeout.
    build_hash : int
        Hash of the gateware that this host was made for.
    now_s : callable
        The loop's clock.

    Attributes
    ----------
    exchange : Exchange
        The messages below.
    clock_relation : ClockRelation or None
        If it is set, each heartbeat tells it the FPGA's time, for plays that are scheduled.

    Raises
    ------
    LinkError
        If the FPGA does not answer, or is another one than asked for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float]) -> None:
        beat_s = board.limits.heartbeat_timeout_ms * 1e-3 / BEATS_PER_TIMEOUT
        self.exchange = Exchange(link, now_s, beat_s)
        self._sent = self.exchange.sent
        self._link = link
        self._board = board
        self._build_hash = build_hash
        self._now_s = now_s
        self._upload = upload_slices(board.waveform.samples)
        self._upload_lengths = [piece.stop - piece.start for piece in self._upload]
        frame_ticks = 8 * FRAME_BYTES * board.link.clock_hz // board.link.sck_hz
        self._check_frames = (board.waveform.samples + CHECK_TICKS) // frame_ticks  # whole ones, before the PLAY
        self._on = False
        self.clock_relation: ClockRelation | None = None
        self.exchange.short(frames.pack_nop(self._sent, 0, 0), faults_matter=False)
        configuration.verify(self.exchange.read, board, build_hash)
        self._configure()

    @property
    def heartbeat_due_s(self) -> float:
        """When the FPGA should hear from us next."""
        return self.exchange.heartbeat_due_s

    @property
    def away_ns(self) -> int:
        """Time spent in the link that is not the host's own work."""
        return self._link.away_ns

    @property
    def wire_ns(self) -> int:
        """Time the bytes sent took on the wire."""
        return self._link.wire_ns

    def free_s(self) -> float:
        """Since or until when the wire is free."""
        return self._link.free_s()

    def ready_s(self) -> float:
        """Earliest time at which a trigger given now would rise."""
        return max(self._now_s(), self._link.free_s())

    def arm(self) -> float:
        """Have the outputs glide to their idle levels; the time at which they have arrived."""
        sequence = self.exchange.sequence
        end = frames.pack_nop(self._sent, 0, sequence)  # feeds the heartbeat, without which arming is refused
        end = frames.pack_unlock(self._sent, end, sequence + 1, self._build_hash)
        end = frames.pack_control(self._sent, end, sequence + 2, Control.ARM)
        self._on = True
        self.exchange.short(frames.pack_nop(self._sent, end, sequence + 3))
        return self._ramp_end_s()

    def require_armed(self) -> None:
        """Raise LinkError unless the FPGA says that it is armed."""
        state = self.heartbeat().state
        if State.ARMED not in state:
            names = ", ".join(flag.name.lower().replace("_", " ") for flag in State if flag in state and flag.name)
            raise LinkError(f"the FPGA did not arm: its state is {names or 'idle'}")

    def disarm(self) -> float:
        """Have the outputs glide to 0 V; the time at which they are off."""
        self.exchange.control(Control.DISARM)
        return self._ramp_end_s()

    def off(self) -> None:
        """Outputs off as far as this host can still say so; the FPGA does it without us when the heartbeat ends."""
        if self._on:
            self._on = False
            try:
                self.exchange.control(Control.DISARM)
            except (LinkError, FaultError):
                return  # it has switched off already, or will within the heartbeat timeout

    def clear_faults(self) -> None:
        """Clear what is latched, so that arming is possible again."""
        self.exchange.control(Control.CLEAR, faults_matter=False)

    def heartbeat(self) -> Status:
        """Tell the FPGA that the host lives; its status.

        Raises
        ------
        HostSilent, FaultError
            If the FPGA has switched off.
        LinkError
            If its answers are damaged again and again.
        """
        before_s = self._now_s()
        status = self.exchange.insist(lambda _: self.exchange.short(frames.pack_nop(self._sent, 0, self.exchange.sequence)))
        if self.clock_relation is not None:
            self.clock_relation.add(before_s, max(self._now_s(), self._link.free_s()), status.timestamp_ticks)
        return status

    def play(
        self,
        slot: int,
        count: int,
        period_s: float,
        *,
        stop: bool,
        start: Start = Start.TRIGGER,
        when_ticks: int = 0,
        mask: int = ALL_CHANNELS,
    ) -> None:
        """Have a resident waveform accepted: for the next trigger, at once, or at a time.

        Parameters
        ----------
        count : int
            Emissions, `period_s` apart from start to start; 0 for ever.
        stop : bool
            End a running repetition first.
        start, when_ticks, mask
            As `frames.pack_play` has them.

        Raises
        ------
        Refused
            If the FPGA cannot play it.
        """

        def send(again: bool) -> Status:
            sequence, end = self.exchange.sequence, 0
            if stop or again:
                end = frames.pack_control(self._sent, 0, sequence, Control.STOP)
            end = frames.pack_play(
                self._sent,
                end,
                sequence + (stop or again),
                slot,
                count=count,
                period_ticks=self._board.period_ticks(period_s),
                start=start,
                when_ticks=when_ticks,
                mask=mask,
            )
            return self.exchange.short(frames.pack_nop(self._sent, end, sequence + (stop or again) + 1))

        self.exchange.insist(send)

    def upload(self, slot: int, words: memoryview) -> None:
        """Send drive words and make them the slot's waveform, without playing it.

        Raises
        ------
        Refused
            If the FPGA cannot take it.
        """

        def send(_: bool) -> Status:
            sequence = self.exchange.sequence
            end = frames.pack_upload(self._sent, 0, sequence, words)
            end = frames.pack_store(self._sent, end, sequence + len(self._upload), slot, words.nbytes // 4, zlib.crc32(words))
            fillers = self._check_frames + 1
            for number in range(fillers):
                end = frames.pack_nop(self._sent, end, sequence + len(self._upload) + 1 + number)
            return self.exchange.message([*self._upload_lengths, *[FRAME_BYTES] * (1 + fillers)])

        self.exchange.insist(send)

    def upload_and_play(self, slot: int, words: memoryview, count: int, period_s: float, *, stop: bool) -> None:
        """Send drive words, make them the slot's waveform and have it accepted for the next trigger.

        The words are copied once, into the frames, and each frame's CRC is taken there.

        Raises
        ------
        Refused
            If the FPGA cannot take or play it.
        LinkError
            If the link damages whatever is tried; nothing is left to play then.
        """

        def send(again: bool) -> Status:
            sequence = self.exchange.sequence
            end = frames.pack_upload(self._sent, 0, sequence, words)
            commands = end
            end = self._pack_commands(end, sequence + len(self._upload), slot, words, count, period_s, stop or again)
            return self.exchange.message([*self._upload_lengths, *[FRAME_BYTES] * ((end - commands) // FRAME_BYTES)])

        try:
            self.exchange.insist(send)
        except Refused:  # if it was the STORE, the PLAY behind it may have taken the slot's old waveform
            self.exchange.stop()
            raise

    def trigger(self) -> float:
        """Start what was accepted; the time of the trigger's edge."""
        return self._link.trigger()

    def _pack_commands(self, end: int, sequence: int, slot: int, words: memoryview, count: int, period_s: float, stop: bool) -> int:
        """STORE, STOP if asked, PLAY, NOP; returns the end."""
        end = frames.pack_store(self._sent, end, sequence, slot, words.nbytes // 4, zlib.crc32(words))
        sequence += 1
        if stop:
            end = frames.pack_control(self._sent, end, sequence, Control.STOP)
            sequence += 1
        for _ in range(self._check_frames - stop):  # the FPGA takes the CRC of what it stored meanwhile
            end = frames.pack_nop(self._sent, end, sequence)
            sequence += 1
        period_ticks = self._board.period_ticks(period_s)
        end = frames.pack_play(self._sent, end, sequence, slot, count=count, period_ticks=period_ticks)
        return frames.pack_nop(self._sent, end, sequence + 1)

    def _configure(self) -> None:
        """Disarm, clear, and set what the board says."""
        self.clear_faults()
        if State.HV_ENABLE in self.heartbeat().state:
            raise LinkError("the FPGA is armed already: another host drives it, or one has died; wait for its heartbeat timeout")
        for register, value in configuration.settings(self._board, self.exchange.read(Register.EDGE_WINDOW_TICKS)).items():
            try:
                self.exchange.write(register, value)
            except Refused as refusal:
                raise LinkError(f"the FPGA does not take {value} for {register.name}: {refusal.result.sentence}") from refusal
            if self.exchange.read(register) != value:
                raise LinkError(f"the FPGA did not keep the value of {register.name}: the link is not reliable")

    def _ramp_end_s(self) -> float:
        samples = (
            configuration.ramp_samples(self._board) + 5
        )  # the word that sounds, the idle word behind it, and the FPGA its own way
        return self.ready_s() + samples * self._board.waveform.bit_period_s
