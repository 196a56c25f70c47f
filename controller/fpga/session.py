"""One FPGA as the host drives it: identity, settings, arming, uploads, plays and heartbeats.

A play that was damaged on its way is sent again behind a STOP, so that nothing plays twice.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable

from controller.board.board import Board
from controller.errors import FaultError, LinkError
from controller.fpga import configuration, frames
from controller.fpga.exchange import COMMANDS, Exchange, FpgaReset, Refused
from controller.fpga.frames import ALL_CHANNELS, FRAME_BYTES
from controller.fpga.status import Status
from controller.fpga.link import Link
from controller.fpga.registers import Control, Register, Result, Start, State
from controller.fpga.upload_image import UploadImage

BEATS_PER_TIMEOUT = 3
CHECK_TICKS = 8  # beyond one for each word, until the FPGA has checked what it stored
CLOCK_TOLERANCE = 0.005  # more than crystals and a slewed clock of the host can differ
FRESH_S = 0.25  # after a heartbeat, for which settings are taken to be those of `bring_up`
UNFIT = frozenset({Result.BAD_VALUE, Result.UNKNOWN_REGISTER, Result.READ_ONLY})  # answers to a setting that stay what they are
FORGOTTEN = frozenset({Result.NOT_ARMED, Result.EMPTY_SLOT})  # answers of an FPGA that was reset


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
    bring_up : bool
        At once; otherwise `fresh` is False until `bring_up` was called, and nothing may be asked of the FPGA before.

    Attributes
    ----------
    exchange : Exchange
        The messages below.
    bit_period : int
        Time for which one drive word is held now, in 65536ths of a clock of the FPGA.
    ramp_end_s : float
        When the outputs have arrived at their levels after the last arming or disarming.

    Raises
    ------
    LinkError
        If the FPGA does not answer, or is another one than asked for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float], *, bring_up: bool = True) -> None:
        beat_s = board.limits.heartbeat_timeout_ms * 1e-3 / BEATS_PER_TIMEOUT
        self.exchange = Exchange(link, now_s, beat_s)
        self._sent = self.exchange.sent
        self._link = link
        self._board = board
        self._build_hash = build_hash
        self._now_s = now_s
        self._upload = UploadImage(self._sent, board.waveform.samples)
        self._upload_lengths = [(*self._upload.lengths, *[FRAME_BYTES] * commands) for commands in range(COMMANDS + 1)]
        frame_ticks = 8 * FRAME_BYTES * board.link.clock_hz // board.link.sck_hz
        self._check_frames = (board.waveform.samples + CHECK_TICKS) // frame_ticks  # whole ones, before the PLAY
        self._period_s, self._period_of, self._period = 0.0, 0, 0  # the last one asked for, at which bit period, in clocks
        self._ours = False  # if anything is on, this host has armed it
        self._on = False  # it has to be, since it was armed and until it is disarmed
        self._beat_s = math.inf  # after the last heartbeat
        self._beat_ticks = 0  # the FPGA's time at that heartbeat
        self.bit_period = board.bit_period
        self.ramp_end_s = -math.inf
        if bring_up:
            self.bring_up()

    def bring_up(self) -> None:
        """Check that this is the FPGA asked for, with nothing on, and give it all its settings.

        At the start, and again whenever it may have forgotten them; `arm` comes next. Its slots may be empty.

        Raises
        ------
        IncompatibleFpga
            If it is another one, or does not take a setting.
        LinkError
            If it does not answer, or is armed. One that this host armed is told to disarm first:
            call again when its ramp has passed.
        """
        self._on = False
        self._beat_s = math.inf  # its clock may have begun anew
        self.exchange.retry(lambda _: self._commanded(Control.CLEAR, raise_faults=False))  # it answers no question before
        configuration.verify(self.exchange.read, self._board, self._build_hash)
        self._configure()
        self._ours = False

    @property
    def fresh(self) -> bool:
        """Whether a heartbeat was answered so recently that the settings are those of `bring_up`."""
        return self._beat_s < math.inf and self._now_s() - self._beat_s < FRESH_S

    @property
    def heartbeat_due_s(self) -> float:
        """When the FPGA should hear from us next."""
        return self.exchange.heartbeat_due_s

    @property
    def blocked_ns(self) -> int:
        """Time spent in the link that is not the host's own work."""
        return self._link.blocked_ns

    @property
    def wire_ns(self) -> int:
        """Time the bytes sent took on the wire."""
        return self._link.wire_ns

    def wire_free_s(self) -> float:
        """Since or until when the wire is free."""
        return self._link.wire_free_s()

    def earliest_trigger_s(self) -> float:
        """Earliest time at which a trigger given now would rise."""
        return max(self._now_s(), self._link.wire_free_s())

    def arm(self) -> float:
        """Have the outputs glide to their idle levels; the time at which they have arrived.

        Raises
        ------
        Refused
            If the FPGA will not, such as without its permits.
        FpgaReset
            If it was reset since the last heartbeat or bring-up, and would arm with other limits than the board's.
        LinkError
            If the link damages whatever is tried.
        """
        fresh = self.fresh
        self.heartbeat()
        if not fresh:  # a reset soon after the one before could have been missed
            self.bring_up()

        def send(again: bool) -> Status:
            if again:  # the ARM may have arrived, and only its answer not
                status = self.exchange.send_short(frames.pack_nop(self._sent, 0, self.exchange.sequence))
                if State.HV_ENABLE in status.state:
                    return status
            sequence = self.exchange.sequence
            end = frames.pack_nop(self._sent, 0, sequence)  # feeds the heartbeat, without which arming is refused
            end = frames.pack_unlock(self._sent, end, sequence + 1, self._build_hash)
            end = frames.pack_control(self._sent, end, sequence + 2, Control.ARM)
            return self.exchange.send_short(frames.pack_nop(self._sent, end, sequence + 3))

        self._ours = True
        self.exchange.retry(send)
        self._on = True
        self.ramp_end_s = self._in_s(configuration.arming_ticks(self._board, self.bit_period))
        return self.ramp_end_s

    def require_armed(self) -> None:
        """Raise LinkError unless the FPGA says that it is armed."""
        state = self.heartbeat().state
        if State.ARMED not in state:
            names = ", ".join(flag.name.lower().replace("_", " ") for flag in State if flag in state and flag.name)
            raise LinkError(f"the FPGA did not arm: its state is {names or 'idle'}")

    def disarm(self) -> float:
        """Have the outputs glide to 0 V; the time at which they are off."""
        self._on = False
        self.exchange.retry(lambda _: self._commanded(Control.DISARM))
        self.ramp_end_s = self._in_s(configuration.ramp_ticks(self._board, self.bit_period))
        return self.ramp_end_s

    def off(self) -> None:
        """Outputs off as far as this host can still say so; the FPGA does it without us when the heartbeat ends."""
        self._on = False
        if self._ours:
            try:
                self.exchange.control(Control.DISARM)
            except (LinkError, FaultError):
                return  # it has switched off already, or will within the heartbeat timeout
            self._ours = False

    def heartbeat(self) -> Status:
        """Tell the FPGA that the host lives; its status.

        Raises
        ------
        HostSilent, FaultError
            If the FPGA has switched off.
        FpgaReset
            If it was reset: it is off without a fault, or its clock has not gone on as this host's.
        LinkError
            If its answers are damaged again and again.
        """
        before_s = self._now_s()
        status = self.exchange.retry(lambda _: self.exchange.send_short(frames.pack_nop(self._sent, 0, self.exchange.sequence)))
        after_s = max(self._now_s(), self._link.wire_free_s())
        least_ticks = (before_s - self._beat_s) * self._board.link.clock_hz * (1 - CLOCK_TOLERANCE)
        if (self._on and State.HV_ENABLE not in status.state) or status.timestamp_ticks - self._beat_ticks < least_ticks:
            raise FpgaReset
        self._beat_s, self._beat_ticks = after_s, status.timestamp_ticks
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
        FpgaReset
            If it has forgotten the waveform.
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
                period_ticks=self._period_ticks(period_s),
                start=start,
                when_ticks=when_ticks,
                mask=mask,
            )
            return self.exchange.send_short(frames.pack_nop(self._sent, end, sequence + (stop or again) + 1))

        try:
            self.exchange.retry(send)
        except Refused as refusal:
            self._look_for_reset(refusal)
            raise

    def upload(self, slot: int, words: memoryview, crc: int | None = None) -> None:
        """Send drive words and make them the slot's waveform, without playing it.

        Parameters
        ----------
        crc : int, optional
            CRC-32 that they shall have, else they are not played: of where they come from, or of the words as they are.

        Raises
        ------
        Refused
            If the FPGA cannot take it.
        """

        stored_crc = zlib.crc32(words) if crc is None else crc

        def send(_: bool) -> Status:
            sequence = self.exchange.sequence
            end = self._upload.pack(sequence, words)
            sequence += self._upload.frames
            end = frames.pack_store(self._sent, end, sequence, slot, words.nbytes // 4, stored_crc)
            fillers = self._check_frames + 1
            for number in range(1, fillers + 1):
                end = frames.pack_nop(self._sent, end, sequence + number)
            return self.exchange.send(self._upload_lengths[1 + fillers], implied=self._upload.frames)

        self.exchange.retry(send)

    def upload_and_play(
        self,
        slot: int,
        words: memoryview,
        count: int,
        period_s: float,
        *,
        stop: bool,
        start: Start = Start.TRIGGER,
        when_ticks: int = 0,
        crc: int | None = None,
    ) -> None:
        """Send drive words, make them the slot's waveform and have it accepted: for the next trigger, at once, or at a time.

        The words are copied once, into the frames, and each frame's CRC is taken there; `crc` is as `upload` has it.
        What is sent again because it was damaged may come too late for its time: it is refused then.

        Raises
        ------
        Refused
            If the FPGA cannot take or play it.
        FpgaReset
            If it was reset meanwhile.
        LinkError
            If the link damages whatever is tried; nothing is left to play then.
        """

        stored_crc = zlib.crc32(words) if crc is None else crc

        def send(again: bool) -> Status:
            sequence = self.exchange.sequence
            commands = end = self._upload.pack(sequence, words)
            sequence += self._upload.frames
            end = frames.pack_store(self._sent, end, sequence, slot, words.nbytes // 4, stored_crc)
            sequence += 1
            if stop or again:
                end = frames.pack_control(self._sent, end, sequence, Control.STOP)
                sequence += 1
            for _ in range(self._check_frames - (stop or again)):  # the FPGA takes the CRC of what it stored meanwhile
                end = frames.pack_nop(self._sent, end, sequence)
                sequence += 1
            period_ticks = self._period_ticks(period_s)
            end = frames.pack_play(
                self._sent, end, sequence, slot, count=count, period_ticks=period_ticks, start=start, when_ticks=when_ticks
            )
            end = frames.pack_nop(self._sent, end, sequence + 1)
            return self.exchange.send(self._upload_lengths[(end - commands) // FRAME_BYTES], implied=self._upload.frames)

        try:
            self.exchange.retry(send)
        except Refused as refusal:
            self._look_for_reset(refusal)
            self.exchange.stop()  # if it was the STORE, the PLAY behind it may have taken the slot's old waveform
            raise

    def stop(self) -> None:
        """End what is repeated with the emission that sounds, and leave nothing to play.

        Raises
        ------
        LinkError
            If the link damages whatever is tried.
        """
        self.exchange.retry(lambda _: self._commanded(Control.STOP))

    def trigger(self) -> float:
        """Start what was accepted; the time of the trigger's edge."""
        return self._link.trigger()

    def set_bit_period(self, scale: float) -> bool:
        """Scale the bit clock, such as for the plate's temperature; False if something plays or waits: try again later.

        Parameters
        ----------
        scale : float
            Of the board's bit clock; above 1 plays faster. It is kept over `bring_up`.

        Raises
        ------
        Refused
            If the FPGA does not allow this rate.
        """
        period = round(self._board.bit_period / scale)
        if period == self.bit_period:
            return True
        try:
            self.exchange.retry(lambda _: self._written(Register.BIT_PERIOD, period))
        except Refused as refusal:
            if refusal.result is Result.BUSY:
                return False
            raise
        self.bit_period = period
        return True

    def actual_period_s(self, period_s: float) -> float:
        """Time from emission to emission as the FPGA counts it, where this is asked for."""
        return self._period_ticks(period_s) / self._board.link.clock_hz

    @property
    def emission_s(self) -> float:
        """T at the present bit clock."""
        return self._emission_ticks / self._board.link.clock_hz

    @property
    def _emission_ticks(self) -> int:
        return self._board.waveform.samples * self.bit_period >> 16

    def _period_ticks(self, period_s: float) -> int:
        """Clocks from emission to emission: without a pause at the board's bit clock is without one at any."""
        if period_s != self._period_s or self._period_of != self.bit_period:
            self._period_s, self._period_of, self._period = period_s, self.bit_period, self._ticks_between(period_s)
        return self._period

    def _ticks_between(self, period_s: float) -> int:
        board = self._board
        ticks = board.period_ticks(period_s)
        shortest = self._emission_ticks
        if ticks == board.emission_ticks or abs(ticks - shortest) <= 1:
            return shortest
        return ticks

    def _commanded(self, command: Control, *, raise_faults: bool = True) -> Status:
        end = frames.pack_control(self._sent, 0, self.exchange.sequence, command)
        return self.exchange.send_short(frames.pack_nop(self._sent, end, self.exchange.sequence + 1), raise_faults=raise_faults)

    def _written(self, register: Register, value: int) -> Status:
        end = frames.pack_write(self._sent, 0, self.exchange.sequence, register, value)
        return self.exchange.send_short(frames.pack_nop(self._sent, end, self.exchange.sequence + 1))

    def _look_for_reset(self, refusal: Refused) -> None:
        """Raise FpgaReset if that is why the FPGA refused."""
        if self._on and refusal.result in FORGOTTEN:
            self.heartbeat()

    def _configure(self) -> None:
        """Set what the board says."""
        if State.HV_ENABLE in self.heartbeat().state:
            if self._ours:
                self.exchange.control(Control.DISARM)
                raise LinkError("the FPGA was still armed and is told to disarm: try again when its ramp has passed")
            raise LinkError("the FPGA is armed already: another host drives it, or one has died; wait for its heartbeat timeout")
        settings = configuration.settings(self._board)
        settings[Register.BIT_PERIOD] = self.bit_period
        for register, value in settings.items():
            try:
                self.exchange.write(register, value)
            except Refused as refusal:
                kind = configuration.IncompatibleFpga if refusal.result in UNFIT else LinkError
                raise kind(f"the FPGA does not take {value} for {register.name}: {refusal.result.sentence}") from refusal
            if self.exchange.read(register) != value:
                raise LinkError(f"the FPGA did not keep the value of {register.name}: the link is not reliable")

    def _in_s(self, ticks: int) -> float:
        return self.earliest_trigger_s() + ticks / self._board.link.clock_hz
