"""Frames there and back, each answer checked: what was damaged or lost on the way is an error or goes again.

Every frame's result comes with the next one, so each message ends with a NOP that fetches the last.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import accumulate

from controller.errors import FaultError, LinkError
from controller.fpga import frames
from controller.fpga.diagnosis import diagnose
from controller.fpga.frames import FRAME_BYTES, UPLOAD_BYTES
from controller.fpga.status import DamagedStatus, Status, parse_status, status_ok
from controller.fpga.link import Link
from controller.fpga.registers import READ_SLOT_CRC, Control, Fault, Register, Result

ATTEMPTS = 3
COMMANDS = 8  # short frames that fit behind an upload
PATTERNS_MAX = 32  # of lengths of frames; the loop has fewer
Answers = tuple[tuple[memoryview, int], ...]
DAMAGED = frozenset({Result.BAD_SYNC, Result.BAD_LENGTH, Result.BAD_CRC, Result.INCOMPLETE})


class Refused(LinkError):
    """The FPGA understood and said no; its state is as before."""

    def __init__(self, result: Result) -> None:
        super().__init__(f"the FPGA refused: {result.sentence}")
        self.result = result


class HostSilent(FaultError):
    """The FPGA switched off because this host was silent for too long: the one fault the host may clear by itself."""


class FpgaReset(LinkError):
    """The FPGA began anew behind our back: it is disarmed, its settings and slots are gone."""

    def __init__(self) -> None:
        super().__init__("the FPGA was reset, or lost its supply: it has forgotten its settings and waveforms; outputs are off")


class Exchange:
    """Messages of frames over a link.

    Parameters
    ----------
    link : Link
    now_s : callable
        The loop's clock.
    beat_s : float
        A heartbeat is due this long after the last message.

    Attributes
    ----------
    sent : memoryview
        Where frames are packed, from 0 on, before they are sent.
    received : memoryview
        What came back with each, at its place.
    sequence : int
        Number for the first of them.
    heartbeat_due_s : float
        When the FPGA should hear from us next.
    """

    def __init__(self, link: Link, now_s: Callable[[], float], beat_s: float) -> None:
        size = UPLOAD_BYTES + COMMANDS * FRAME_BYTES
        self.sent = memoryview(bytearray(size))
        self.sequence = 0
        self.heartbeat_due_s = now_s()
        self.received = memoryview(bytearray(size))
        self._link = link
        self._now_s = now_s
        self._beat_s = beat_s
        self._answers: dict[tuple[int, ...], Answers] = {}

    def send(self, lengths: Sequence[int], *, raise_faults: bool = True, implied: int = 0) -> Status:
        """Send frames and check every answer; the last status, which is that of the frame before the last.

        Parameters
        ----------
        implied : int
            So many frames at the beginning need no answer of their own if all behind them was done: LOADs before their
            STORE, which is done only if all that it stores arrived as it was sent.

        Raises
        ------
        HostSilent, FaultError
            If a fault is latched.
        Refused
            With the first result that is not OK.
        DamagedStatus
            If an answer is no status, with what may be wrong with the wires.
        LinkError
            If a frame or an answer was damaged or lost.
        """
        sequence = self.sequence
        self.sequence = (sequence + len(lengths)) & 0xFF
        self._link.exchange(self.sent, lengths, self.received)
        self.heartbeat_due_s = self._now_s() + self._beat_s
        answers = self._answers_to(tuple(lengths))
        start = 0
        try:
            if not implied or not _all_ok(answers, sequence, implied):  # the first that is not as it should be says why
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
        """Send the short frames packed up to `end`; as `message`."""
        return self.send([FRAME_BYTES] * (end // FRAME_BYTES), raise_faults=raise_faults)

    def retry(self, send: Callable[[bool], Status]) -> Status:
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
            self.stop()
            raise

    def stop(self) -> None:
        """Leave nothing to play; on a link that damages everything, as well as it can be done."""
        for _ in range(ATTEMPTS):
            try:
                self.control(Control.STOP)
                return
            except FaultError:
                return  # its outputs are off
            except LinkError:
                continue

    def control(self, command: Control, *, raise_faults: bool = True) -> None:
        """Give one command."""
        end = frames.pack_control(self.sent, 0, self.sequence, command)
        self.send_short(frames.pack_nop(self.sent, end, self.sequence + 1), raise_faults=raise_faults)

    def write(self, register: Register, value: int) -> None:
        """Write one register."""
        end = frames.pack_write(self.sent, 0, self.sequence, register, value)
        self.send_short(frames.pack_nop(self.sent, end, self.sequence + 1))

    def read(self, register: Register) -> int:
        """Value of one register."""
        return self.read_address(register)

    def read_slot_crc(self, slot: int) -> int:
        """CRC-32 that the FPGA found for what a slot holds."""
        return self.read_address(READ_SLOT_CRC + slot)

    def read_address(self, address: int) -> int:
        """Value of a register, a word of memory, or whatever else READ knows."""
        end = frames.pack_read(self.sent, 0, self.sequence, address)
        return self.send_short(frames.pack_nop(self.sent, end, self.sequence + 1)).data

    def send_unchecked(self, lengths: list[int]) -> int:
        """Send frames whatever becomes of them; how many answers were damaged."""
        self.sequence = (self.sequence + len(lengths)) & 0xFF
        self._link.exchange(self.sent, lengths, self.received)
        self.heartbeat_due_s = self._now_s() + self._beat_s
        damaged = start = 0
        for length in lengths:
            try:
                parse_status(self.received, start)
            except LinkError:
                damaged += 1
            start += length
        return damaged

    def _answers_to(self, lengths: tuple[int, ...]) -> Answers:
        """Where the answers to a message of such frames come to lie; the first is about the message before and left out."""
        known = self._answers.get(lengths)
        if known is None:
            if len(self._answers) >= PATTERNS_MAX:
                self._answers.clear()
            known = tuple((self.received[start : start + FRAME_BYTES], start) for start in accumulate(lengths[:-1]))
            self._answers[lengths] = known
        return known

    def _explain(self, status: Status, raise_faults: bool) -> None:
        """Raise what an answer that is not plain OK stands for; a fault that does not matter is none."""
        if status.faults and raise_faults:
            kind = HostSilent if status.faults == Fault.HOST_SILENT else FaultError
            raise kind(f"outputs off: {status.faults.sentence}", status.faults)
        if status.result is not Result.OK:
            raise Refused(status.result)
        if not status.faults:
            raise LinkError(f"a frame was lost on its way: the FPGA's last one is number {status.sequence}")


def _all_ok(answers: Answers, sequence: int, first: int) -> bool:
    """Whether all answers from the first on are well; the frame before all of them has this number."""
    for index in range(first, len(answers)):  # noqa: SIM110 — a generator would cost as much as the answers
        if not status_ok(answers[index][0], (sequence + index) & 0xFF):
            return False
    return True
