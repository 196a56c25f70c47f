"""What the times of methods are compared with: plain C, copying, CRC-32, the wire, the machine's best matrix product."""

import time
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np

from controller.device.bank.packing import CHANNELS
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.errors import ConfigError
from controller.workshop.benchmark.device.plain_c import PlainC
from controller.workshop.benchmark.methods.candidate import wire_bytes

CORNERS = 4  # cells around a point
# (rows, inner, columns): large squares, and the shapes of the response step itself
SGEMM_SHAPES = ((1024, 1024, 1024), (1536, 1536, 1536), (1000, 1900, 512), (1000, 1900, 2048))
SGEMM_REPEATS = 4


@dataclass(frozen=True)
class Baseline:
    """A job whose time others are compared with: its calls, one for each scene."""

    name: str
    calls: list[Callable[[], object]]


class Baselines:
    """The baselines of a machine. `bank` has the cells of all scenes; `folder` is for compiled C."""

    def __init__(self, board: Board, bank: Bank, folder: Path) -> None:
        self._board = board
        self.left_out: list[str] = []  # what is missing, and why
        self._c: PlainC | None = None
        try:
            self._c = PlainC(folder, bank, board.idle_word)
        except ConfigError as error:
            self.left_out.append(str(error))
        # Additions and multiplications of float32 for a second of processor time, at best, on one thread
        self.sgemm_rate = best_sgemm_rate()

    def rates(self, modes: int) -> dict[str, float | None]:
        """What the machine does at best, and what one response of every channel as a sum over `modes` needs of it."""
        sck_hz = getattr(self._board.link, "sck_hz", None)
        multiplications = self._board.waveform.samples * CHANNELS * modes
        return {
            "sgemm_gflops": self.sgemm_rate * 1e-9,
            "wire_us": 8e6 * wire_bytes(self._board.waveform.samples) / sck_hz if sck_hz else None,
            "sgemm_response_us": 1e6 * 2 * multiplications / self.sgemm_rate,
            "multiplications_of_a_response": multiplications,
        }

    def jobs(self, scenes: Sequence[Sequence[Point]]) -> list[Baseline]:
        """Jobs of the same size as composing each of `scenes`."""
        values = self._board.waveform.samples * CHANNELS
        found = []
        if self._c:
            found.append(Baseline("plain C, vectors of 128 bits", [partial(self._c.compose, points) for points in scenes]))
        source, target = bytearray(CORNERS * 10 * values), bytearray(CORNERS * 10 * values)
        words = bytes(values // 8)
        sizes = [min(CORNERS * len(points) * values, len(source)) for points in scenes]
        found.append(Baseline("copy of the responses that are read", [_copying(source, target, size) for size in sizes]))
        found.append(Baseline("zlib.crc32 of the words", [lambda: zlib.crc32(words)] * len(scenes)))
        return found


def _copying(source: bytearray, target: bytearray, size: int) -> Callable[[], object]:
    given, room = memoryview(source)[:size], memoryview(target)[:size]

    def copy() -> None:
        room[:] = given

    return copy


@cache  # of the machine: the same for every build
def best_sgemm_rate() -> float:
    """Best rate of float32 matrix multiplication, in additions and multiplications for a second of processor time."""
    best = 0.0
    for rows, inner, columns in SGEMM_SHAPES:
        a, b = np.ones((rows, inner), np.float32), np.ones((inner, columns), np.float32)
        product = np.empty((rows, columns), np.float32)
        for _ in range(SGEMM_REPEATS):
            before = time.process_time()
            np.matmul(a, b, out=product)
            best = max(best, 2.0 * rows * inner * columns / (time.process_time() - before))
    return best
