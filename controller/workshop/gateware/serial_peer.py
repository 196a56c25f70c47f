"""A simulated panel on a pseudo-terminal: the gateware model behind a UART, to try a serial link without a board.

`python -m controller.workshop.gateware.serial_peer [board]` prints its device and serves until it is interrupted.
"""

import contextlib
import os
import select
import sys
import threading
import time
import tty
from collections.abc import Callable
from typing import Self

from cobs import cobs

from controller.console import flush, say
from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder, find_board
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.links.serial_link import ANSWER_BYTES, BITS_PER_BYTE
from controller.workshop.gateware.gateware import Gateware, Permit
from controller.workshop.gateware.model.model import GatewareModel


class UartPanel:
    """The gateware model behind its UART: bytes in, bytes out.

    The gateware was just reset; its permits are set here. A byte takes the time of ten bits. Bytes that a busy terminal delivers
    late are taken to have arrived one after the other until now. So an answer never reports a time in the future, unless its host
    writes faster than the line sends. Tick 0 is the present value of `now_s`, which the gateware's clock follows.
    """

    def __init__(self, gateware: GatewareModel, clock_hz: int, baud: int, now_s: Callable[[], float]) -> None:
        self.gateware: Gateware = gateware
        self._clock_hz = clock_hz
        self._byte_ticks = BITS_PER_BYTE * clock_hz / baud
        self._now_s = now_s
        self.start_s = now_s()  # time of tick 0
        self._tick = 0.0  # when the last byte had come
        self._answer_until = 0.0  # a frame that begins earlier is not answered
        self._line = bytearray()
        self._select_tick = 0
        self._synced = False
        for permit in Permit:
            gateware.permit(0, level=True, which=permit)

    def receive(self, data: bytes) -> bytes:
        """Receive `data`; returns the bytes of the answers."""
        now, line_ticks = (self._now_s() - self.start_s) * self._clock_hz, len(data) * self._byte_ticks
        last = max(self._tick + line_ticks, now)
        first = max(last - line_ticks, self.gateware.now)  # no byte comes before a moment that the gateware has passed
        byte_ticks = (last - first) / max(len(data), 1)
        self._tick = first
        answers = bytearray()
        for byte in data:
            self._tick += byte_ticks
            if byte and self._synced:
                if not self._line:
                    self._select_tick = int(self._tick)
                self._line.append(byte)
            elif not byte:
                self._synced = True
                if self._line:
                    answers += self._frame()
                    self._line.clear()
        return bytes(answers)

    def _frame(self) -> bytes:
        """Execute a complete frame; its answer, unless the previous one was still being sent."""
        sent = decoded(self._line)
        answer = bytearray(max(FRAME_BYTES, len(sent)))
        self.gateware.exchange(self._select_tick, int(self._tick), sent, memoryview(answer))
        if self._select_tick < self._answer_until:
            return b""
        self._answer_until = self._select_tick + (ANSWER_BYTES - 1) * self._byte_ticks
        encoded: bytes = cobs.encode(bytes(answer[:FRAME_BYTES]))
        return encoded + b"\0"


def decoded(line: bytes | bytearray) -> bytes:
    """Decode the COBS block `line`; if it ends early, pad the frame to a length that no frame has, so that it is refused."""
    whole = bytearray(line)
    code = end = 0
    while end < len(whole):
        code, end = end, end + whole[end]
    malformed = end > len(whole)
    if malformed:
        whole[code] = len(whole) - code
    frame: bytes = cobs.decode(bytes(whole))
    if malformed and len(frame) % 4 == 0:
        frame += b"\xff"
    return frame or b"\0"  # an empty frame has no sync word: refused for that


class PseudoTerminal:
    """A pseudo-terminal that a thread answers; a context manager.

    `answer` takes the bytes received and returns the bytes to send.
    """

    def __init__(self, answer: Callable[[bytes], bytes]) -> None:
        self._answer = answer
        self._controller, self._terminal = os.openpty()  # the terminal stays open here, so that clients may come and go
        tty.setraw(self._terminal)
        os.set_blocking(self._controller, False)  # like a UART: bytes that nobody reads are lost
        self.device = os.ttyname(self._terminal)  # path of the terminal
        self._stop, self._stopper = os.pipe()
        self._thread = threading.Thread(target=self._serve, name=f"panel at {self.device}", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Close the terminal, as if the board were unplugged."""
        os.write(self._stopper, b"\0")
        self._thread.join()
        for descriptor in (self._controller, self._terminal, self._stop, self._stopper):
            os.close(descriptor)

    def _serve(self) -> None:
        while True:
            ready, _, _ = select.select([self._controller, self._stop], [], [])
            if self._stop in ready:
                return
            answer = self._answer(os.read(self._controller, 4096))
            with contextlib.suppress(BlockingIOError):
                os.write(self._controller, answer)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def main(name: str = "simulated") -> None:
    """Serve the gateware of the board `name` in real time, until interrupted."""
    board = load_board(find_board(name))
    link = board.link
    model = GatewareModel(BuildParameters.of(board, build_hash(data_folder("fpga_rtl"))))
    panel = UartPanel(model, link.clock_hz, link.baud, time.monotonic)
    with contextlib.suppress(KeyboardInterrupt), PseudoTerminal(panel.receive) as terminal:
        say(terminal.device)
        flush()
        threading.Event().wait()


if __name__ == "__main__":
    main(*sys.argv[1:])
