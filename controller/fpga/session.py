"""One FPGA as the host drives it: identity, settings, arming, uploads, plays and heartbeats.

A play that was damaged on its way is sent again behind a STOP, so that nothing plays twice.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable

from controller.board import Board
from controller.errors import FaultError, LinkError
from controller.fpga import frames
from controller.fpga.exchange import Exchange, Refused
from controller.fpga.frames import FRAME_BYTES, Status, upload_slices
from controller.fpga.link import Link
from controller.fpga.registers import CHANNELS, DUTY_FULL, IDENTITY_MAGIC, PROTOCOL_VERSION, Control, Register, State

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

    Raises
    ------
    LinkError
        If the FPGA does not answer, or is another one than asked for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float]) -> None:
        beat_s = board.limits.heartbeat_timeout_ms * 1e-3 / BEATS_PER_TIMEOUT
        self._exchange = Exchange(link, now_s, beat_s)
        self._sent = self._exchange.sent
        self._link = link
        self._board = board
        self._build_hash = build_hash
        self._now_s = now_s
        self._upload = upload_slices(board.waveform.samples)
        self._upload_lengths = [piece.stop - piece.start for piece in self._upload]
        self._ramp_samples = max(1, round(board.limits.ramp_ms * 1e-3 * board.waveform.bit_clock_hz))
        frame_ticks = 8 * FRAME_BYTES * board.link.clock_hz // board.link.sck_hz
        self._check_frames = (board.waveform.samples + CHECK_TICKS) // frame_ticks  # whole ones, before the PLAY
        self._on = False
        self._verify()
        self._configure()

    @property
    def heartbeat_due_s(self) -> float:
        """When the FPGA should hear from us next."""
        return self._exchange.heartbeat_due_s

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
        sequence = self._exchange.sequence
        end = frames.pack_nop(self._sent, 0, sequence)  # feeds the heartbeat, without which arming is refused
        end = frames.pack_unlock(self._sent, end, sequence + 1, self._build_hash)
        end = frames.pack_control(self._sent, end, sequence + 2, Control.ARM)
        self._on = True
        self._exchange.short(frames.pack_nop(self._sent, end, sequence + 3))
        return self._ramp_end_s()

    def require_armed(self) -> None:
        """Raise LinkError unless the FPGA says that it is armed."""
        state = self.heartbeat().state
        if State.ARMED not in state:
            names = ", ".join(flag.name.lower().replace("_", " ") for flag in State if flag in state and flag.name)
            raise LinkError(f"the FPGA did not arm: its state is {names or 'idle'}")

    def disarm(self) -> float:
        """Have the outputs glide to 0 V; the time at which they are off."""
        self._exchange.control(Control.DISARM)
        return self._ramp_end_s()

    def off(self) -> None:
        """Outputs off as far as this host can still say so; the FPGA does it without us when the heartbeat ends."""
        if self._on:
            self._on = False
            try:
                self._exchange.control(Control.DISARM)
            except (LinkError, FaultError):
                return  # it has switched off already, or will within the heartbeat timeout

    def clear_faults(self) -> None:
        """Clear what is latched, so that arming is possible again."""
        self._exchange.control(Control.CLEAR, faults_matter=False)

    def heartbeat(self) -> Status:
        """Tell the FPGA that the host lives; its status.

        Raises
        ------
        HostSilent, FaultError
            If the FPGA has switched off.
        LinkError
            If its answers are damaged again and again.
        """
        return self._exchange.insist(lambda _: self._exchange.short(frames.pack_nop(self._sent, 0, self._exchange.sequence)))

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
            return self._exchange.short(self._pack_commands(0, self._exchange.sequence, slot, None, count, period_s, stop or again))

        self._exchange.insist(send)

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
            sequence = self._exchange.sequence
            end = frames.pack_upload(self._sent, 0, sequence, words)
            commands = end
            end = self._pack_commands(end, sequence + len(self._upload), slot, words, count, period_s, stop or again)
            return self._exchange.message([*self._upload_lengths, *[FRAME_BYTES] * ((end - commands) // FRAME_BYTES)])

        try:
            self._exchange.insist(send)
        except Refused:  # if it was the STORE, the PLAY behind it may have taken the slot's old waveform
            self._exchange.stop()
            raise

    def trigger(self) -> float:
        """Start what was accepted; the time of the trigger's edge."""
        return self._link.trigger()

    def _pack_commands(
        self, end: int, sequence: int, slot: int, words: memoryview | None, count: int, period_s: float, stop: bool
    ) -> int:
        """STORE if something was loaded, STOP if asked, PLAY, NOP; returns the end."""
        if words is not None:
            end = frames.pack_store(self._sent, end, sequence, slot, words.nbytes // 4, zlib.crc32(words))
            sequence += 1
        if stop:
            end = frames.pack_control(self._sent, end, sequence, Control.STOP)
            sequence += 1
        if words is not None:  # the FPGA takes the CRC of what it stored meanwhile
            for _ in range(self._check_frames - stop):
                end = frames.pack_nop(self._sent, end, sequence)
                sequence += 1
        period_ticks = round(period_s * self._board.link.clock_hz)
        end = frames.pack_play(self._sent, end, sequence, slot, count=count, period_ticks=period_ticks)
        return frames.pack_nop(self._sent, end, sequence + 1)

    def _verify(self) -> None:
        """Refuse any FPGA but the one this host was made for."""
        self._exchange.short(frames.pack_nop(self._sent, 0, 0), faults_matter=False)
        expected = {
            Register.IDENTITY: IDENTITY_MAGIC,
            Register.PROTOCOL: PROTOCOL_VERSION,
            Register.BUILD_HASH: self._build_hash,
            Register.CLOCK_HZ: self._board.link.clock_hz,
        }
        for register, value in expected.items():
            found = self._exchange.read(register)
            if found != value:
                raise LinkError(
                    f"the FPGA's {register.name} is 0x{found:08X}, not 0x{value:08X}: load the gateware that belongs to this host"
                )
        geometry = self._exchange.read(Register.GEOMETRY)
        slots, depth, channels = geometry & 0xFF, geometry >> 8 & 0xFFFF, geometry >> 24
        if slots < self._board.link.slots or depth < self._board.waveform.samples or channels != CHANNELS:
            raise LinkError(
                f"the FPGA has {slots} slots of {depth} words and {channels} channels; "
                f"the board asks for {self._board.link.slots}, {self._board.waveform.samples} and {CHANNELS}"
            )

    def _configure(self) -> None:
        """Disarm, clear, and set what the board says."""
        self.clear_faults()
        if State.HV_ENABLE in self.heartbeat().state:
            raise LinkError("the FPGA is armed already: another host drives it, or one has died; wait for its heartbeat timeout")
        for register, value in self._settings().items():
            self._exchange.write(register, value)
            if self._exchange.read(register) != value:
                raise LinkError(f"the FPGA did not keep the value of {register.name}: the link is not reliable")

    def _settings(self) -> dict[Register, int]:
        """Registers as the board says; what is beyond the FPGA's own limits it refuses."""
        board, limits, clock_hz = self._board, self._board.limits, self._board.link.clock_hz
        window_s = self._exchange.read(Register.EDGE_WINDOW_TICKS) / clock_hz
        return {
            Register.IDLE_WORD: board.idle_word,
            Register.CHANNEL_MASK: board.channel_mask,
            Register.BIT_PERIOD: board.bit_period,
            Register.RAMP_SAMPLES: self._ramp_samples,
            Register.HEARTBEAT_TICKS: round(limits.heartbeat_timeout_ms * 1e-3 * clock_hz),
            Register.PULSE_TICKS: math.ceil(limits.min_pulse_us * 1e-6 * clock_hz),
            Register.CHANNEL_EDGES: int(limits.max_channel_edge_rate_hz * window_s),
            Register.TOTAL_EDGES: int(limits.max_total_edge_rate_hz * window_s),
            Register.EMISSION_TICKS: round(limits.longest_emission_ms * 1e-3 * clock_hz),
            Register.DUTY_SHARE: round(limits.max_duty * DUTY_FULL),
            Register.DUTY_TICKS: round(limits.duty_budget_ms * 1e-3 * clock_hz),
        }

    def _ramp_end_s(self) -> float:
        samples = self._ramp_samples + 5  # the word that sounds, the idle word behind it, and the FPGA its own way
        return self.ready_s() + samples * self._board.waveform.bit_period_s
