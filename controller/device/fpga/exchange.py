"""Messages of frames to the FPGA, with a check of every answer and retries of what was damaged or lost.

The result of a frame is in the answer to the next one, so each message ends with a NOP that fetches the last result.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from typing import TypeVar

from controller.device.fpga import frames
from controller.device.fpga.diagnosis import diagnose
from controller.device.fpga.frames import FRAME_BYTES, UPLOAD_BYTES
from controller.device.fpga.links.link import Link
from controller.device.fpga.registers import READ_SLOT_CRC, Control, Fault, Register, Result
from controller.device.fpga.status import DONE, DamagedStatus, Status, parse_status
from controller.device.kernel import statuses_good
from controller.errors import FaultError, LinkError

ATTEMPTS = 3
COMMANDS = 8  # short frames that the buffers hold after an upload
T = TypeVar("T")
DAMAGED = frozenset({Result.BAD_SYNC, Result.BAD_LENGTH, Result.BAD_CRC, Result.INCOMPLETE})


class Refused(LinkError):
    """The FPGA received a command and refused it; its state is unchanged."""

    def __init__(self, result: Result) -> None:
        super().__init__(f"the FPGA refused: {result.sentence}")
        self.result = result  # the reason


class OutOfStep(LinkError):
    """The FPGA's queue holds other plays than this host had accepted."""


class HostSilent(FaultError):
    """The FPGA switched off because it got no heartbeat in time: the only fault that the host may clear by itself."""


class FpgaReset(LinkError):
    """The FPGA was reset while the host used it: it is disarmed, its settings and slots are lost."""

    def __init__(self) -> None:
        super().__init__("the FPGA was reset, or lost its supply: it has forgotten its settings and waveforms; outputs are off")


class Exchange:
    """Sends messages of frames over a link and checks the answers.

    A heartbeat is due `heartbeat_interval_s` after the last message, on the loop's clock.
    """

    def __init__(self, link: Link, now_s: Callable[[], float], heartbeat_interval_s: float) -> None:
        size = UPLOAD_BYTES + COMMANDS * FRAME_BYTES
        self.sent = memoryview(bytearray(size))  # send buffer: pack the frames of a message here, back to back from 0 on
        self.sequence = 0  # sequence number for the first frame of the next message
        self.heartbeat_due_s = now_s()  # when the next heartbeat is due, on the loop's clock
        self.received = memoryview(bytearray(size))  # receive buffer: the answer to each frame, at the frame's offset
        self._link = link
        self._now_s = now_s
        self._heartbeat_interval_s = heartbeat_interval_s

    def send(self, lengths: Sequence[int], *, raise_faults: bool = True) -> Status:
        """Send the frames packed in `sent`, of these lengths in bytes, and check every answer.

        Returns the last one, which reports the result of the last frame but one. A latched fault is an error if `raise_faults`.
        Raises HostSilent or FaultError if a fault is latched; Refused with the first result that is not OK; DamagedStatus if an
        answer is no valid status, with a diagnosis of the wires; LinkError if a frame or an answer was damaged or lost.
        """
        return self._check(lengths, self._exchange(lengths), raise_faults=raise_faults)

    def deliver(self, lengths: Sequence[int], loads: int = 0) -> int:
        """Send the frames packed in `sent`, of whose statuses only few fields are needed; raises as `send`.

        The first `loads` frames are LOADs before their STORE, which succeeds only if everything that it stores arrived intact:
        their answers are not checked if all after them are good. All frames after them are short. Returns where the last answer
        begins in `received`.
        """
        sequence = self._exchange(lengths)
        start, count = sum(lengths[: loads + 1]), len(lengths) - loads - 1
        if not statuses_good(self.received, start, count, DONE, sequence + loads):
            self._check(lengths, sequence, raise_faults=True)  # raises: it finds the first bad answer, which has the reason
        return start + (count - 1) * FRAME_BYTES

    def send_short(self, end: int, *, raise_faults: bool = True) -> Status:
        """Send the short frames packed in `sent` from 0 to `end`; `raise_faults`, result and errors as in `send`."""
        return self.send([FRAME_BYTES] * (end // FRAME_BYTES), raise_faults=raise_faults)

    def ask(self, pack: Callable[..., int], *arguments: int, raise_faults: bool = True) -> Status:
        """Send a short frame, packed by one of `frames`, with a NOP behind it; the status about it, errors as in `send`."""
        end = pack(self.sent, 0, self.sequence, *arguments)
        return self.send_short(frames.pack_nop(self.sent, end, self.sequence + 1), raise_faults=raise_faults)

    def retry(self, send: Callable[[], T], *, then_stop: bool = True) -> T:
        """Pack and send a message up to three times, until no frame and no answer of it is damaged; returns what `send` returned.

        If `then_stop`, STOP follows the last failure, since something of the message may be left to play. Raises Refused or
        FaultError at once, as `send` raises it; LinkError after the last attempt.
        """
        for _ in range(ATTEMPTS - 1):
            try:
                return send()
            except LinkError as error:
                if isinstance(error, Refused) and error.result not in DAMAGED:
                    raise
        try:
            return send()
        except LinkError:
            if then_stop:
                self.stop()
            raise

    def stop(self) -> None:
        """Send STOP up to three times, so that nothing is left to play; never raises."""
        with contextlib.suppress(LinkError, FaultError):  # after a fault its outputs are off
            self.control(Control.STOP)

    def control(self, command: Control, *, raise_faults: bool = True) -> Status:
        """Send a command that may be given twice (neither ARM nor TRIGGER), up to three times; the rest as in `send`."""
        return self.retry(lambda: self.ask(frames.pack_control, command, raise_faults=raise_faults), then_stop=False)

    def write(self, register: Register, value: int) -> None:
        """Write `value` (u32) to a register, up to three times; errors as in `send`."""
        self.retry(lambda: self.ask(frames.pack_write, register, value), then_stop=False)

    def read(self, register: Register) -> int:
        """Value (u32) of one register; as `read_address`."""
        return self.read_address(register)

    def read_slot_crc(self, slot: int) -> int:
        """CRC-32 that the FPGA computed of a slot's waveform; as `read_address`."""
        return self.read_address(READ_SLOT_CRC + slot)

    def read_address(self, address: int) -> int:
        """Value (u32) at an address of READ: a register, a slot's CRC, a word of the queue or of waveform memory.

        It is asked for up to three times; errors as in `send`.
        """
        return self.retry(lambda: self.ask(frames.pack_read, address), then_stop=False).data

    def send_unchecked(self, lengths: list[int]) -> int:
        """Send frames of these lengths in bytes and accept any result; returns how many answers were damaged."""
        self._exchange(lengths)
        damaged = start = 0
        for length in lengths:
            try:
                parse_status(self.received, start)
            except LinkError:
                damaged += 1
            start += length
        return damaged

    def _exchange(self, lengths: Sequence[int]) -> int:
        """Send the frames packed in `sent` and receive the answers; the sequence number of the first frame."""
        sequence = self.sequence
        self.sequence = (sequence + len(lengths)) & 0xFF
        self._link.exchange(self.sent, lengths, self.received)
        self.heartbeat_due_s = self._now_s() + self._heartbeat_interval_s
        return sequence

    def _check(self, lengths: Sequence[int], sequence: int, *, raise_faults: bool) -> Status:
        """Check each answer but the first, which concerns the message before; the last one."""
        start = 0
        try:
            status = parse_status(self.received) if len(lengths) == 1 else None
            for number, length in enumerate(lengths[:-1]):
                start += length
                status = parse_status(self.received, start)
                if status.result is not Result.OK or status.faults or status.sequence != sequence + number & 0xFF:
                    self._explain(status, raise_faults=raise_faults)
        except DamagedStatus as error:
            why = diagnose(bytes(self.received[start : start + FRAME_BYTES]), bytes(self.sent[start : start + FRAME_BYTES]))
            raise DamagedStatus(why) from error
        assert status is not None  # there is at least one frame
        if status.faults:
            self._explain(status, raise_faults=raise_faults)
        return status

    def _explain(self, status: Status, *, raise_faults: bool) -> None:
        """Raise the error that an answer reports, if any."""
        if status.faults and raise_faults:
            kind = HostSilent if status.faults == Fault.HOST_SILENT else FaultError
            raise kind(f"outputs off: {status.faults.sentence}", status.faults)
        if status.result is not Result.OK:
            raise Refused(status.result)
        if not status.faults:
            raise LinkError(f"a frame was lost: the last one that the FPGA received is number {status.sequence}")
