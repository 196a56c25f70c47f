"""What the times of methods are compared with: plain C, copying, CRC-32, the wire, the machine's best matrix product."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from controller.bank.packing import CHANNELS
from controller.bank.reader import Bank
from controller.bank_builder.build import best_sgemm_rate
from controller.benchmark.methods.candidate import wire_bytes
from controller.benchmark.plain_c import PlainC
from controller.board.board import Board
from controller.errors import ConfigError
from controller.kernel import Point

CORNERS = 4  # cells around a point


@dataclass(frozen=True)
class Baseline:
    """A job whose time others are compared with: its calls, one for each scene."""

    name: str
    calls: list[Callable[[], object]]


class Baselines:
    """The baselines of a machine.

    Parameters
    ----------
    board : Board
    bank : Bank
        With the cells of all scenes.
    folder : Path
        For compiled C.

    Attributes
    ----------
    left_out : list of str
        What is missing, and why.
    sgemm_rate : float
        Additions and multiplications of float32 for a second of processor time, at best, on one thread.
    """

    def __init__(self, board: Board, bank: Bank, folder: Path) -> None:
        self._board = board
        self.left_out: list[str] = []
        self._c: PlainC | None = None
        try:
            self._c = PlainC(folder, bank, board.idle_word)
        except ConfigError as error:
            self.left_out.append(str(error))
        self.sgemm_rate = best_sgemm_rate()

    @property
    def wire_us(self) -> float | None:
        """Time of an upload on the wire; None for a board without SPI clock."""
        sck_hz = getattr(self._board.link, "sck_hz", None)
        return 8e6 * wire_bytes(self._board.waveform.samples) / sck_hz if sck_hz else None

    def sgemm_us(self, modes: int) -> float:
        """Time of one response of every channel as a sum over modes, at the best rate of matrix multiplication."""
        return 1e6 * 2 * self._board.waveform.samples * CHANNELS * modes / self.sgemm_rate

    def jobs(self, scenes: Sequence[Sequence[Point]]) -> list[Baseline]:
        """Jobs of the same size as composing each of `scenes`."""
        values = self._board.waveform.samples * CHANNELS
        found = []
        if self._c:
            found.append(Baseline("plain C, vectors of 128 bits", [_composing(self._c, points) for points in scenes]))
        source, target = bytearray(CORNERS * 10 * values), bytearray(CORNERS * 10 * values)
        words = bytes(values // 8)
        sizes = [min(CORNERS * len(points) * values, len(source)) for points in scenes]
        found.append(Baseline("copy of the responses that are read", [_copying(source, target, size) for size in sizes]))
        found.append(Baseline("zlib.crc32 of the words", [lambda: zlib.crc32(words)] * len(scenes)))
        return found


def _composing(plain_c: PlainC, points: Sequence[Point]) -> Callable[[], object]:
    return lambda: plain_c.compose(points)


def _copying(source: bytearray, target: bytearray, size: int) -> Callable[[], object]:
    given, room = memoryview(source)[:size], memoryview(target)[:size]

    def copy() -> None:
        room[:] = given

    return copy
