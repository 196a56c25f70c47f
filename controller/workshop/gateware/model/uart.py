"""The UART of the gateware model, byte by byte: `uart_peripheral.v`, `frame_relay.v` and the decoder between them."""

from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.registers import Result
from controller.workshop.gateware.model.decoder import Frame, decode
from controller.workshop.gateware.pin_timing import UartTiming

BYTE_TO_PULSE_TICKS = 1  # from the tick of a byte to the output of the COBS decoder
ANSWER_TICKS = 40  # from a frame's first byte to the start bit of its answer
BEGIN_TICKS = 2  # from the end of a frame to the first tick in which it may be delivered
DELIVER_TICKS = 40  # from then until it is executed, in addition to one tick for each word


def cobs_encoded(data: bytes) -> bytes:
    """COBS encoding of `data`, at most 253 bytes, with the terminating zero."""
    return b"".join(bytes([len(block) + 1]) + block for block in data.split(b"\0")) + b"\0"


class UartPeripheral:
    """State of the UART peripheral."""

    def __init__(self, timing: UartTiming) -> None:
        self.timing = timing
        self.pending: Frame | None = None  # accepted frame that waits for a pause of the SPI, or is being delivered in one
        self.tx_ticks: list[int] = []  # changes of the transmit line
        self._synced = self._open = self._taken = self._zero = False
        self._left = 0  # of the COBS block
        self._frame = bytearray()
        self._answer_from = 0  # the first tick in which another answer may be begun
        self._free_from = 0  # and that in which its start bit may be
        self._fraction = 0  # of a tick, in 256ths, that the transmitter has left

    def receive(self, byte: int) -> tuple[bool, Frame | None]:
        """Receive a byte.

        Returns whether a frame begins with this byte, and the frame that ends with it; it is BUSY if another was pending when it
        began.
        """
        in_block = self._open and self._left != 0
        if byte == 0:
            ended, self._open, self._synced = self._open, False, True
            return False, self._decoded(partial=in_block) if ended else None
        if not self._synced:
            return False, None
        begins = not self._open
        if begins:
            self._taken = self.pending is None
            self._frame.clear()
        elif in_block:
            self._frame.append(byte)
        elif self._zero:
            self._frame.append(0)
        if not in_block:
            self._zero = byte != 0xFF
        self._left = (self._left if in_block else byte) - 1
        self._open = True
        return begins, None

    def answer(self, tick: int, status: bytes) -> None:
        """Send `status` for a frame that begins in `tick`, unless the last byte of the answer before has not yet begun."""
        if tick < self._answer_from:
            return
        wire = cobs_encoded(status[:FRAME_BYTES])
        bits = "".join("0" + f"{byte:08b}"[::-1] + "1" for byte in wire)
        start, bit_256 = max(tick + ANSWER_TICKS, self._free_from), self.timing.bit_256
        for number, (before, level) in enumerate(zip("1" + bits[:-1], bits, strict=True)):
            if level != before:
                self.tx_ticks.append(start + (self._fraction + number * bit_256 >> 8))
        self._answer_from = start + (self._fraction + 10 * (len(wire) - 1) * bit_256 >> 8)
        whole_ticks, self._fraction = divmod(self._fraction + len(bits) * bit_256, 256)
        self._free_from = start + whole_ticks

    def take_tx(self, now: int) -> list[int]:
        """Remove and return the changes of the transmit line up to `now`."""
        due = sum(tick <= now for tick in self.tx_ticks)
        taken, self.tx_ticks = self.tx_ticks[:due], self.tx_ticks[due:]
        return taken

    def _decoded(self, *, partial: bool) -> Frame:
        if not self._taken:
            return Frame(Result.BUSY)
        if not self._frame:
            return Frame(Result.BAD_SYNC)
        frame = decode(memoryview(bytes(self._frame)))
        if partial and frame.refusal in (Result.OK, Result.BAD_CRC):
            return Frame(Result.BAD_LENGTH)
        return frame
