"""Messages of frames to the FPGA, with a check of every answer and retries of what was damaged or lost.

The result of a frame is in the answer to the next one, so each message ends with a NOP that fetches the last result.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import accumulate

from controller.errors import FaultError, LinkError
from controller.fpga import frames
from controller.fpga.diagnosis import diagnose
from controller.fpga.frames import FRAME_BYTES, UPLOAD_BYTES
from controller.fpga.link import Link
from controller.fpga.registers import READ_SLOT_CRC, Control, Fault, Register, Result
from controller.fpga.status import DamagedStatus, Status, all_ok, parse_status, status_ok

ATTEMPTS = 3
COMMANDS = 8  # short frames that the buffers hold after an upload
PATTERNS_MAX = 32  # patterns of frame lengths that are remembered; the loop has fewer
Answers = tuple[tuple[memoryview, int], ...]
DAMAGED = frozenset({Result.BAD_SYNC, Result.BAD_LENGTH, Result.BAD_CRC, Result.INCOMPLETE})


class Refused(LinkError):
    """The FPGA received a command and refused it; its state is unchanged.

    Attributes
    ----------
    result : Result
        The reason.
    """

    def __init__(self, result: Result) -> None:
        super().__init__(f"the FPGA refused: {result.sentence}")
        self.result = result


class HostSilent(FaultError):
    """The FPGA switched off because it got no heartbeat in time: the only fault that the host may clear by itself."""


class FpgaReset(LinkError):
    """The FPGA was reset while the host used it: it is disarmed, its settings and slots are lost."""

    def __init__(self) -> None:
        super().__init__("the FPGA was reset, or lost its supply: it has forgotten its settings and waveforms; outputs are off")


class Exchange:
    """Sends messages of frames over a link and checks the answers.

    Parameters
    ----------
    link : Link
    now_s : callable
        The loop's clock.
    heartbeat_interval_s : float
        A heartbeat is due this long after the last message.

    Attributes
    ----------
    sent : memoryview of bytes
        Send buffer: pack the frames of a message here, back to back from 0 on.
    received : memoryview of bytes
        Receive buffer: the answer to each frame, at the frame's offset.
    sequence : int
        Sequence number for the first frame of the next message.
    heartbeat_due_s : float
        When the next heartbeat is due, on the loop's clock.
    """

    def __init__(self, link: Link, now_s: Callable[[], float], heartbeat_interval_s: float) -> None:
        size = UPLOAD_BYTES + COMMANDS * FRAME_BYTES
        self.sent = memoryview(bytearray(size))
        self.sequence = 0
        self.heartbeat_due_s = now_s()
        self.received = memoryview(bytearray(size))
        self._link = link
        self._now_s = now_s
        self._heartbeat_interval_s = heartbeat_interval_s
        self._answers: dict[tuple[int, ...], Answers] = {}

    def send(self, lengths: Sequence[int], *, raise_faults: bool = True, implied: int = 0) -> Status:
        """Send the frames packed in `sent` and check every answer.

        Parameters
        ----------
        lengths : sequence of int
            Bytes of each frame.
        raise_faults : bool
            Whether a latched fault is an error.
        implied : int
            This many frames at the beginning are not checked if all answers after them are good: LOADs before their STORE,
            which succeeds only if everything it stores arrived intact.

        Returns
        -------
        Status
            The last answer, which reports the result of the last frame but one.

        Raises
        ------
        HostSilent, FaultError
            If a fault is latched.
        Refused
            With the first result that is not OK.
        DamagedStatus
            If an answer is no valid status, with a diagnosis of the wires.
        LinkError
            If a frame or an answer was damaged or lost.
        """
        sequence = self.sequence
        self.sequence = (sequence + len(lengths)) & 0xFF
        self._link.exchange(self.sent, lengths, self.received)
        self.heartbeat_due_s = self._now_s() + self._heartbeat_interval_s
        answers = self._answers_to(tuple(lengths))
        start = 0
        try:
            if not implied or not all_ok(answers, sequence, implied):  # find the first bad answer, which has the reason
                for answer, start in answers:
                    if not status_ok(answer, sequence & 0xFF):
                        self._explain(parse_status(self.received, start), raise_faults)
                    sequence += 1
            start = answers[-1][1] if answers else 0
            status = parse_status(self.received, start)
        except DamagedStatus as error:
            why = diagnose(bytes(self.received[start : start + FRAME_BYTES]), bytes(self.sent[start : start + FRAME_BYTES]))
            raise DamagedStatus(why) from error
        if status.faults:
            self._explain(status, raise_faults)
        return status

    def send_short(self, end: int, *, raise_faults: bool = True) -> Status:
        """Send the short frames packed in `sent` from 0 to `end`; `raise_faults`, result and errors as in `send`."""
        return self.send([FRAME_BYTES] * (end // FRAME_BYTES), raise_faults=raise_faults)

    def retry(self, send: Callable[[bool], Status]) -> Status:
        """Send a message up to three times, until no frame and no answer of it is damaged; after the last failure, STOP.

        Parameters
        ----------
        send : callable
            Packs and sends the message; its argument says whether this is a repetition.

        Returns
        -------
        Status
            What `send` returned.

        Raises
        ------
        Refused, FaultError
            At once, as `send` raises it.
        LinkError
            After the last attempt.
        """
        for again in (False, *[True] * (ATTEMPTS - 2)):
            try:
                return send(again)
            except LinkError as error:
                if isinstance(error, Refused) and error.result not in DAMAGED:
                    raise
        try:
            return send(True)
        except LinkError:
            self.stop()
            raise

    def stop(self) -> None:
        """Send STOP up to three times, so that nothing is left to play; never raises."""
        for _ in range(ATTEMPTS):
            try:
                self.control(Control.STOP)
                return
            except FaultError:
                return  # its outputs are off
            except LinkError:
                continue

    def control(self, command: Control, *, raise_faults: bool = True) -> None:
        """Send one command; `raise_faults` and errors as in `send`."""
        end = frames.pack_control(self.sent, 0, self.sequence, command)
        self.send_short(frames.pack_nop(self.sent, end, self.sequence + 1), raise_faults=raise_faults)

    def write(self, register: Register, value: int) -> None:
        """Write `value` (u32) to a register; errors as in `send`."""
        end = frames.pack_write(self.sent, 0, self.sequence, register, value)
        self.send_short(frames.pack_nop(self.sent, end, self.sequence + 1))

    def read(self, register: Register) -> int:
        """Value (u32) of one register; raises as `send`."""
        return self.read_address(register)

    def read_slot_crc(self, slot: int) -> int:
        """CRC-32 that the FPGA computed of a slot's waveform; raises as `send`."""
        return self.read_address(READ_SLOT_CRC + slot)

    def read_address(self, address: int) -> int:
        """Value (u32) at an address of READ: a register, a slot's CRC, a word of the queue or of waveform memory."""
        end = frames.pack_read(self.sent, 0, self.sequence, address)
        return self.send_short(frames.pack_nop(self.sent, end, self.sequence + 1)).data

    def send_unchecked(self, lengths: list[int]) -> int:
        """Send frames of these lengths in bytes and accept any result; returns how many answers were damaged."""
        self.sequence = (self.sequence + len(lengths)) & 0xFF
        self._link.exchange(self.sent, lengths, self.received)
        self.heartbeat_due_s = self._now_s() + self._heartbeat_interval_s
        damaged = start = 0
        for length in lengths:
            try:
                parse_status(self.received, start)
            except LinkError:
                damaged += 1
            start += length
        return damaged

    def _answers_to(self, lengths: tuple[int, ...]) -> Answers:
        """Views of the answers to frames of these lengths, with their offsets; not the first, which concerns the message before."""
        known = self._answers.get(lengths)
        if known is None:
            if len(self._answers) >= PATTERNS_MAX:
                self._answers.clear()
            known = tuple((self.received[start : start + FRAME_BYTES], start) for start in accumulate(lengths[:-1]))
            self._answers[lengths] = known
        return known

    def _explain(self, status: Status, raise_faults: bool) -> None:
        """Raise the error that an answer reports, if any."""
        if status.faults and raise_faults:
            kind = HostSilent if status.faults == Fault.HOST_SILENT else FaultError
            raise kind(f"outputs off: {status.faults.sentence}", status.faults)
        if status.result is not Result.OK:
            raise Refused(status.result)
        if not status.faults:
            raise LinkError(f"a frame was lost: the last one that the FPGA received is number {status.sequence}")
