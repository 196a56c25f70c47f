"""A link over a UART, for a laptop and a bare FPGA board: the frames of SPI, each COBS-encoded and ended by a zero byte.

The FPGA answers a frame while it receives it, so a message is written at once and its answers are read in order. Instead of a
trigger pin there is a TRIGGER command.
"""

from __future__ import annotations

import contextlib
import errno
import time
from collections.abc import Callable, Sequence
from typing import Final

import serial
from cobs import cobs

from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, ReadableBuffer
from controller.device.fpga.registers import Control, FrameType, Register
from controller.device.kernel.crc import intact
from controller.errors import LinkError

LATENCY_S: Final = 0.05  # round trip through host and USB bridge, whose latency timer is usually 16 ms
BITS_PER_BYTE: Final = 10  # 8N1
ANSWER_BYTES: Final = FRAME_BYTES + 2  # on the wire: one COBS code byte, since a status is shorter than 254 bytes, and the zero
BATCH_FRAMES: Final = 32  # their answers, 1.2 kB, fit the terminal's input buffer (4 kB) while the frames are written
STRAY_BYTES_MAX: Final = 1 << 16  # more than all buffers between FPGA and host
SEQUENCE_BYTE: Final = 3  # of a frame and of a status

# Zeros before each frame. They end anything that noise may have begun. They also give the FPGA time: it does not answer a frame
# that begins before the previous answer has ended, and the shortest frame is as long on the wire as its answer. With these it is
# 40 bytes against 38, so that no answer is lost even if the host's baud rate is 5 % higher than the FPGA's.
GUARD: Final = b"\0\0"


def on_wire(frame: ReadableBuffer) -> bytes:
    """Encode a frame for the wire: zeros, COBS, zero."""
    encoded: bytes = cobs.encode(bytes(frame))
    return GUARD + encoded + b"\0"


class SerialLink:
    """`Link` to a panel at a serial port.

    `device` is a path such as /dev/ttyUSB0, or better one below /dev/serial/by-id; `baud` is what the gateware was built for;
    `latency_s` is the longest delay of an answer beyond its time on the wire. Raises LinkError if the port cannot be opened.
    """

    def __init__(self, device: str, baud: int, now_s: Callable[[], float], latency_s: float = LATENCY_S) -> None:
        self.bytes_sent = 0
        self.wire_ns = 0
        self.blocked_ns = 0
        self._device = device
        self._baud = baud
        self._now_s = now_s
        self._latency_s = latency_s
        self._frame = bytearray(FRAME_BYTES)
        self._sequence: int | None = None  # of the last frame sent, which the next answer is about
        self._message = 0  # number of the last frame of a message
        self._pending = 0  # answers to triggers that were not read yet
        self._unsure = True  # what is in the input may belong to other frames
        self._free_s = now_s()
        self._port = self._opened()

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Send frames and store each answer at the frame's offset, with zeros after it; parameters as in `Link.exchange`.

        Raises LinkError if an answer is missing or damaged, or the port fails; the next call opens a failed port again.
        """
        started_ns = time.perf_counter_ns()
        if not self._port.is_open:
            self._port = self._opened()
        try:
            if self._unsure or self._port.in_waiting > self._pending * ANSWER_BYTES:
                self._resynchronise()
            self._unsure = True
            doubtful = False
            start = 0
            for first in range(0, len(lengths), BATCH_FRAMES):
                batch = lengths[first : first + BATCH_FRAMES]
                answers = self._batch(sent[start:], batch)
                for length, answer in zip(batch, answers, strict=True):
                    shown = min(length, FRAME_BYTES)
                    received[start : start + length] = answer[:shown] + bytes(length - shown)
                    doubtful |= self._sequence not in (None, answer[SEQUENCE_BYTE])
                    self._sequence = sent[start + SEQUENCE_BYTE] if length > SEQUENCE_BYTE else None
                    start += length
            self._message = self._sequence or 0
            self._unsure = doubtful  # a frame was refused, or answers are out of step; the caller notices by the sequence number
        except OSError as error:  # serial.SerialException is one
            self.close()
            raise LinkError(f"{self._device} failed ({error}): is it still plugged in, and does nothing else use it?") from error
        finally:
            self.blocked_ns += time.perf_counter_ns() - started_ns

    def trigger(self) -> float:
        """Send a TRIGGER command; its answer is read with the next message.

        Returns when its last bit is sent, on the loop's clock; a USB bridge may add a millisecond. Raises LinkError if the port
        fails.
        """
        # half the range away from the next message, so that it is never taken for one of that message's frames
        sequence = (self._message + 0x80) & 0xFF
        frames.pack_short(self._frame, 0, FrameType.WRITE, sequence, Register.CONTROL, Control.TRIGGER)
        try:
            self._write(on_wire(self._frame), FRAME_BYTES)
        except OSError as error:
            self._unsure = True
            self.close()
            raise LinkError(f"{self._device} failed ({error}): is it still plugged in?") from error
        self._pending += 1
        self._sequence = sequence
        return self._free_s

    def wire_free_s(self) -> float:
        """When everything sent so far has left the wire, on the loop's clock."""
        return self._free_s

    def close(self) -> None:
        """Release the port."""
        with contextlib.suppress(OSError):
            self._port.close()

    def _opened(self) -> serial.Serial:
        """Open the port exclusively; its input may hold anything."""
        longest_s = self._wire_s(BATCH_FRAMES * (frames.LOAD_FRAME_BYTES + 8))
        try:
            port = serial.Serial(self._device, self._baud, timeout=self._latency_s, write_timeout=longest_s + 1, exclusive=True)
        except (OSError, ValueError) as error:
            raise LinkError(_why_not_open(self._device, self._baud, error)) from error
        with contextlib.suppress(OSError, ValueError, NotImplementedError, AttributeError):
            port.set_low_latency_mode(True)  # 1 ms instead of 16 with many bridges; not supported by others
        self._unsure = True
        return port

    def _batch(self, sent: memoryview, lengths: Sequence[int]) -> list[bytes]:
        """Send some frames and read their answers."""
        wire = bytearray()
        start = 0
        for length in lengths:
            wire += on_wire(sent[start : start + length])
            start += length
        pending, self._pending = self._pending, 0
        count = pending + len(lengths)
        deadline_s = time.monotonic() + self._latency_s + self._wire_s(len(wire) + count * ANSWER_BYTES)
        self._write(wire, start)
        data = b""
        while len(data) < count * ANSWER_BYTES and time.monotonic() < deadline_s:
            data += self._port.read(count * ANSWER_BYTES - len(data))
        lines = data.split(b"\0")
        if len(lines) != count + 1 or lines[-1]:
            raise LinkError(self._missing_answers(data, len(lines) - 1, count))
        return [self._decoded(line) for line in lines[pending:-1]]

    def _decoded(self, line: bytes) -> bytes:
        """Decode one answer and check its length and CRC."""
        try:
            answer: bytes = cobs.decode(line)
        except cobs.DecodeError:
            answer = b""
        if len(answer) != FRAME_BYTES or not intact(answer):
            raise LinkError(f"{self._device}: an answer was damaged on its way; {self._advice}")
        return answer

    @property
    def _advice(self) -> str:
        return f"check the cable, or build the gateware for a lower rate than {self._baud} baud"

    def _missing_answers(self, data: bytes, came: int, wanted: int) -> str:
        if not data:
            return (
                f"{self._device} does not answer: is it the panel's port, and is gateware loaded that listens there at"
                f" {self._baud} baud?"
            )
        return f"{self._device}: {came} of {wanted} answers came back whole; {self._advice}"

    def _resynchronise(self) -> None:
        """End a partial frame in the FPGA's receiver, and discard all pending answers."""
        self._port.write(GUARD)
        self._pending = 0
        strays = 0
        while stray := self._port.read(STRAY_BYTES_MAX):  # returns empty when nothing came for latency_s
            strays += len(stray)
            if strays > STRAY_BYTES_MAX:
                raise LinkError(f"{self._device} sends without being asked: is it the panel's port, at {self._baud} baud?")

    def _write(self, wire: bytes | bytearray, frame_bytes: int) -> None:
        self._free_s = max(self._now_s(), self._free_s) + self._wire_s(len(wire))
        self._port.write(wire)
        self.bytes_sent += frame_bytes
        self.wire_ns += round(self._wire_s(len(wire)) * 1e9)

    def _wire_s(self, size_bytes: int) -> float:
        return size_bytes * BITS_PER_BYTE / self._baud


def _why_not_open(device: str, baud: int, error: Exception) -> str:
    number = getattr(error, "errno", None)
    if number in (errno.ENOENT, errno.ENXIO, errno.ENODEV, errno.EIO):
        return f"there is no serial port {device}: is the board plugged in and powered? Its name is below /dev/serial/by-id"
    if number in (errno.EACCES, errno.EPERM):
        return f"{device} may not be opened by this user: add it to the group that owns the device (on Debian: dialout)"
    if number in (errno.EBUSY, errno.EAGAIN):
        return f"{device} is in use by another program: end it first"
    return f"{device} could not be opened at {baud} baud: {error}"
