"""The host's side of the frames: identity, arming, uploads, plays, heartbeats, and what the answers mean.

Every frame's result comes with the next one, so each message ends with a NOP that fetches the last.
A message that was damaged on its way is sent again, after a STOP, so that nothing plays twice.
"""

from __future__ import annotations

from collections.abc import Callable

from controller.board import Board
from controller.errors import FaultError, LinkError
from controller.fpga import frames
from controller.fpga.frames import FRAME_BYTES, UPLOAD_BYTES, Status, answered_well, parse_status, upload_slices
from controller.fpga.link import Link
from controller.fpga.registers import CHANNELS, IDENTITY_MAGIC, PROTOCOL_VERSION, Control, Fault, Register, Result, State

ATTEMPTS = 3
BEATS_PER_TIMEOUT = 3
DAMAGED = frozenset({Result.BAD_SYNC, Result.BAD_LENGTH, Result.BAD_CRC, Result.INCOMPLETE})


class Refused(LinkError):
    """The FPGA understood and said no; its state is as before."""

    def __init__(self, result: Result) -> None:
        super().__init__(f"the FPGA refused: {result.sentence}")
        self.result = result


class HostSilent(FaultError):
    """The FPGA switched off because this host was silent for too long: the one fault the host may clear by itself."""


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

    Raises
    ------
    LinkError
        If the FPGA does not answer, or is another one than asked for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float]) -> None:
        self.heartbeat_due_s = now_s()
        self.status: Status | None = None
        self._link = link
        self._board = board
        self._build_hash = build_hash
        self._now_s = now_s
        self._beat_s = board.limits.heartbeat_timeout_ms * 1e-3 / BEATS_PER_TIMEOUT
        self._sequence = 0
        self._upload = upload_slices(board.waveform.samples)
        self._upload_lengths = [piece.stop - piece.start for piece in self._upload]
        size = UPLOAD_BYTES + 8 * FRAME_BYTES
        self._sent = memoryview(bytearray(size))
        self._received = memoryview(bytearray(size))
        self._ramp_samples = max(1, round(board.limits.ramp_ms * 1e-3 * board.waveform.bit_clock_hz))
        self._on = False
        self._verify()
        self._configure()

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
        sequence = self._sequence
        end = frames.pack_nop(self._sent, 0, sequence)  # feeds the heartbeat, without which arming is refused
        end = frames.pack_arm(self._sent, end, sequence + 1, self._build_hash)
        self._on = True
        self._exchange_short(frames.pack_nop(self._sent, end, sequence + 2))
        return self._ramp_end_s()

    def require_armed(self) -> None:
        """Raise LinkError unless the FPGA says that it is armed."""
        if State.ARMED not in self.heartbeat().state:
            raise LinkError(f"the FPGA did not arm: its state is {self._state_in_words()}")

    def disarm(self) -> float:
        """Have the outputs glide to 0 V; the time at which they are off."""
        self._control(Control.DISARM)
        return self._ramp_end_s()

    def off(self) -> None:
        """Outputs off as far as this host can still say so; the FPGA does it without us when the heartbeat ends."""
        if self._on:
            self._on = False
            try:
                self._control(Control.DISARM)
            except (LinkError, FaultError):
                return  # it has switched off already, or will within the heartbeat timeout

    def clear_faults(self) -> None:
        """Clear what is latched, so that arming is possible again."""
        end = frames.pack_control(self._sent, 0, self._sequence, Control.CLEAR)
        self._exchange_short(frames.pack_nop(self._sent, end, self._sequence + 1), faults_matter=False)

    def heartbeat(self) -> Status:
        """Tell the FPGA that the host lives; its status.

        Raises
        ------
        HostSilent, FaultError
            If the FPGA has switched off.
        LinkError
            If its answers are damaged again and again.
        """
        return self._insist(lambda _: self._exchange_short(frames.pack_nop(self._sent, 0, self._sequence)))

    def play(self, slot: int, count: int, period_s: float, *, stop: bool) -> None:
        """Have a resident waveform accepted for the next trigger.

        Parameters
        ----------
        count : int
            Emissions, `period_s` apart from start to start; 0 for ever.
        stop : bool
            End a running repetition first.

        Raises
        ------
        Refused
            If the FPGA cannot play it.
        """

        def send(again: bool) -> Status:
            return self._exchange_short(self._pack_commands(0, self._sequence, slot, None, count, period_s, stop or again))

        self._insist(send)

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
            sequence = self._sequence
            end = frames.pack_upload(self._sent, 0, sequence, words)
            commands = end
            end = self._pack_commands(end, sequence + len(self._upload), slot, words.nbytes // 4, count, period_s, stop or again)
            return self._exchange([*self._upload_lengths, *[FRAME_BYTES] * ((end - commands) // FRAME_BYTES)])

        try:
            self._insist(send)
        except Refused:  # if it was the STORE, the PLAY behind it may have taken the slot's old waveform
            self._stop()
            raise

    def trigger(self) -> float:
        """Start what was accepted; the time of the trigger's edge."""
        return self._link.trigger()

    def _pack_commands(
        self, end: int, sequence: int, slot: int, length: int | None, count: int, period_s: float, stop: bool
    ) -> int:
        """STOP if asked, STORE if something was loaded, PLAY, NOP; returns the end."""
        if stop:
            end = frames.pack_control(self._sent, end, sequence, Control.STOP)
            sequence += 1
        if length is not None:
            end = frames.pack_store(self._sent, end, sequence, slot, length)
            sequence += 1
        period_ticks = round(period_s * self._board.link.clock_hz)
        end = frames.pack_play(self._sent, end, sequence, slot, count=count, period_ticks=period_ticks)
        return frames.pack_nop(self._sent, end, sequence + 1)

    def _insist(self, send: Callable[[bool], Status]) -> Status:
        """Send again what was damaged on its way there or back; `send` is told whether it is again."""
        for again in (False, *[True] * (ATTEMPTS - 2)):
            try:
                return send(again)
            except LinkError as error:
                if isinstance(error, Refused) and error.result not in DAMAGED:
                    raise
        try:
            return send(True)
        except LinkError:
            self._stop()
            raise

    def _stop(self) -> None:
        """Leave nothing to play; on a link that damages everything, as well as it can be done."""
        for _ in range(ATTEMPTS):
            try:
                self._control(Control.STOP)
                return
            except LinkError:
                continue

    def _control(self, command: Control) -> None:
        end = frames.pack_control(self._sent, 0, self._sequence, command)
        self._exchange_short(frames.pack_nop(self._sent, end, self._sequence + 1))

    def _exchange_short(self, end: int, *, faults_matter: bool = True) -> Status:
        return self._exchange([FRAME_BYTES] * (end // FRAME_BYTES), faults_matter=faults_matter)

    def _exchange(self, lengths: list[int], *, faults_matter: bool = True) -> Status:
        """Send frames and check every answer; the last status, which is that of the frame before the last.

        Raises
        ------
        HostSilent, FaultError
            If a fault is latched.
        Refused
            With the first result that is not OK.
        LinkError
            If a frame or an answer was damaged or lost.
        """
        sequence = self._sequence
        self._sequence = (sequence + len(lengths)) & 0xFF
        self._link.exchange(self._sent, lengths, self._received)
        self.heartbeat_due_s = self._now_s() + self._beat_s
        start = lengths[0]  # the first answer is about the message before
        for index, length in enumerate(lengths[1:]):
            if not answered_well(self._received, start, (sequence + index) & 0xFF):
                self._explain(parse_status(self._received, start), faults_matter)
            start += length
        self.status = parse_status(self._received, start - lengths[-1])
        if self.status.faults:
            self._explain(self.status, faults_matter)
        return self.status

    def _explain(self, status: Status, faults_matter: bool) -> None:
        """Raise what an answer that is not plain OK stands for; a fault that does not matter is none."""
        if status.faults and faults_matter:
            self._on = False
            kind = HostSilent if status.faults == Fault.HOST_SILENT else FaultError
            raise kind(f"outputs off: {status.faults.sentence}")
        if status.result is not Result.OK:
            raise Refused(status.result)
        if not status.faults:
            raise LinkError(f"a frame was lost on its way: the FPGA's last one is number {status.sequence}")

    def _verify(self) -> None:
        """Refuse any FPGA but the one this host was made for."""
        self._exchange_short(frames.pack_nop(self._sent, 0, 0), faults_matter=False)
        expected = {
            Register.IDENTITY: IDENTITY_MAGIC,
            Register.PROTOCOL: PROTOCOL_VERSION,
            Register.BUILD_HASH: self._build_hash,
            Register.CLOCK_HZ: self._board.link.clock_hz,
        }
        for register, value in expected.items():
            found = self._read(register)
            if found != value:
                raise LinkError(
                    f"the FPGA's {register.name} is 0x{found:08X}, not 0x{value:08X}: load the gateware that belongs to this host"
                )
        geometry = self._read(Register.GEOMETRY)
        slots, depth, channels = geometry & 0xFF, geometry >> 8 & 0xFFFF, geometry >> 24
        if slots < self._board.link.slots or depth < self._board.waveform.samples or channels != CHANNELS:
            raise LinkError(
                f"the FPGA has {slots} slots of {depth} words and {channels} channels; "
                f"the board asks for {self._board.link.slots}, {self._board.waveform.samples} and {CHANNELS}"
            )

    def _configure(self) -> None:
        """Disarm, clear, and set what the board says."""
        board = self._board
        self.clear_faults()
        if self.status is not None and State.HV_ENABLE in self.status.state:
            raise LinkError("the FPGA is armed already: another host drives it, or one has died; wait for its heartbeat timeout")
        for register, value in {
            Register.IDLE_WORD: board.idle_word,
            Register.BIT_TICKS: board.bit_ticks,
            Register.RAMP_SAMPLES: self._ramp_samples,
            Register.HEARTBEAT_TICKS: round(board.limits.heartbeat_timeout_ms * 1e-3 * board.link.clock_hz),
            Register.CHANNEL_MASK: board.channel_mask,
        }.items():
            end = frames.pack_write(self._sent, 0, self._sequence, register, value)
            self._exchange_short(frames.pack_nop(self._sent, end, self._sequence + 1))
            if self._read(register) != value:
                raise LinkError(f"the FPGA did not keep the value of {register.name}: the link is not reliable")

    def _read(self, register: Register) -> int:
        end = frames.pack_read(self._sent, 0, self._sequence, register)
        return self._exchange_short(frames.pack_nop(self._sent, end, self._sequence + 1)).data

    def _ramp_end_s(self) -> float:
        samples = self._ramp_samples + 2
        return self.ready_s() + samples * self._board.waveform.bit_period_s

    def _state_in_words(self) -> str:
        state = self.status.state if self.status is not None else State(0)
        return ", ".join(flag.name.lower().replace("_", " ") for flag in State if flag in state and flag.name) or "idle"
