"""A compact bank tried at a sample of places, by the kernel that plays it: what it loses, and which gain of its rest it needs."""

from array import array
from collections.abc import Callable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Reals
from controller.device import kernel
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.board.board import Board
from controller.device.waveforms.composition import block_samples
from controller.workshop.bank_builder.compact.design import CompactDesign
from controller.workshop.bank_builder.interpolation_error import DIGITS
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.physics.word_capture import idle_levels

PLACES: Final = 48
SEED: Final = 2  # other places than those from which pulses were learned
AMPLITUDES: Final = 0.5, 0.25, 0.1  # for which the gain of the rest is found
GAIN_STEPS: Final = 32  # to 1, so that a scale times the gain is the same on all machines
MOST_GAIN: Final = 2.0
TRIED_GAIN: Final = 1.25  # from 1 to which amplitudes fall with the gain as with any near them


class Trial:
    """Words of a compact bank, and what they do by exact responses.

    `there` are cells that have rows; `rows` (cell, byte) and `scales` (cell,) are of all cells, `tables_of` gives the tables for a
    gain of the rest.
    """

    def __init__(
        self,
        board: Board,
        source: ResponseSource,
        design: CompactDesign,
        there: Bools,
        rows: NDArray[np.uint8],
        scales: NDArray[np.float32],
        tables_of: Callable[[float], bytes],
    ) -> None:
        self._board, self._samples, self._tables_of = board, design.samples, tables_of
        self._words, self._room = bytearray(4 * design.samples), bytearray(kernel.room_bytes(design.samples))
        grid = design.grid
        block = block_samples(board.waveform.bit_clock_hz)
        numbers = design.samples, rows.shape[1], grid.nx, grid.ny, grid.cells, board.idle_word, block
        self._buffers = kernel.BankBuffers(
            kernel.PLAN.pack(*numbers, grid.pitch_m, grid.x0_m, grid.y0_m, 0.0, 0.0),
            memoryview(array("i", np.where(there, np.arange(grid.cells), -1).tolist())),
            memoryview(array("f", scales.tolist())),
            b"\1" * grid.cells,
            memoryview(rows.data).cast("B"),
            tables_of(1.0),
        )
        points_m = np.random.default_rng(SEED).uniform((0, 0), (board.plate.length_m, board.plate.width_m), (PLACES, 2))
        inside = (points_m >= (grid.x0_m, grid.y0_m)).all(axis=1) & (points_m <= grid.place(grid.cells - 1)).all(axis=1)
        self._places = [place for place in points_m[inside].tolist() if self._composes(place, 1.0)]
        there = np.array(self._places).reshape(-1, 2)
        self._whole = source.responses(there)[:, ::-1].astype(np.float32)
        best = [drive_words(response, board.idle_word) for response in source.drive_order_responses(there)]
        self._most = [self._displacement(words, whole) for words, whole in zip(best, self._whole, strict=True)]

    def rest_gain(self) -> float:
        """Gain of the rest for which amplitudes below full come out as asked on average, of what exact words give at full.

        The rest's weights say nothing of what lies above the band, which moves the plate the more, the lower the amplitude; below
        it the rest, which has a part in these only, makes up for it.
        """
        more, gain = self._too_much(1.0), 1.0
        fall = more - self._too_much(TRIED_GAIN)
        if fall > 0:
            gain = min(max(1 + more / fall * (TRIED_GAIN - 1), 1 / MOST_GAIN), MOST_GAIN)
        return round(gain * GAIN_STEPS) / GAIN_STEPS

    def loss(self, gain: float) -> dict[str, Any]:
        """Amplitude lost by words, as `InterpolationError.summary` reports it; empty without a place."""
        lost = [
            1 - reached / most if most else 0.0 for reached, most in zip(self._displacements(gain, 1.0), self._most, strict=True)
        ]
        if not lost:
            return {}
        worst, median = (round(float(of(lost)), DIGITS + 1) for of in (np.max, np.median))
        return {"places": len(lost), "interpolated": {"median": median, "worst": worst}}

    def _too_much(self, gain: float) -> float:
        """By how much reduced amplitudes are above what was asked for, on average, as a share of it."""
        full = np.array(self._most)
        moved = full > 0
        found = [np.array(self._displacements(gain, asked))[moved] / (asked * full[moved]) - 1 for asked in AMPLITUDES]
        return float(np.mean(found)) if moved.any() else 0.0

    def _displacements(self, gain: float, amplitude: float) -> list[float]:
        self._buffers = self._buffers._replace(tables=self._tables_of(gain))
        found = []
        for place, whole in zip(self._places, self._whole, strict=True):
            self._composes(place, amplitude)
            found.append(self._displacement(np.frombuffer(self._words, "<u4"), whole))
        return found

    def _composes(self, place: list[float], amplitude: float) -> bool:
        """Whether a place has all its cells; its words are in `_words` then."""
        return kernel.compose(self._words, self._room, self._buffers, [(place[0], place[1], amplitude)]) < 0

    def _displacement(self, words: NDArray[np.uint32], whole: Reals) -> float:
        return float(((channel_bits(words) - idle_levels(self._board)) * whole).sum())
