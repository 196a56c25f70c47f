"""Responses in 8 to 1 bits between cells of 1 to 7 mm: interpolated, each over its size, summed, quantised to their sign.

One bit of a response is its packed drive word: interpolating it is a vote of the cells' words, bit by bit.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from controller.arrays import Words
from controller.device.bank.packing import CHANNELS, drive_words
from controller.device.kernel import Point
from controller.workshop.benchmark.methods.candidate import Candidate, wire_bytes
from controller.workshop.benchmark.methods.interpolation import BandInterpolation, Interpolation, bilinear, cubic, nearest
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.benchmark.methods.response_table import Floats, ResponseTable

PITCHES_MM = (1.0, 2.0, 2.5, 3.5, 5.0)
COARSE_MM = (3.5, 5.0, 6.0)


def candidates(laboratory: Laboratory) -> Iterator[Candidate]:
    """All of them."""
    board, modes = laboratory.board, laboratory.model.plate_modes
    four, eight = (BandInterpolation(board, modes, size) for size in (4, 8))
    for bits, name, interpolation, pitches_mm in (
        (8, "8 bits, nearest", nearest, PITCHES_MM),
        (8, "8 bits, bilinear", bilinear, PITCHES_MM),
        (8, "8 bits, cubic", cubic, PITCHES_MM[1:]),
        (8, "8 bits, band 4 × 4", four, PITCHES_MM[2:]),
        (8, "8 bits, band 8 × 8", eight, COARSE_MM),
        (4, "4 bits, bilinear", bilinear, PITCHES_MM),
        (4, "4 bits, band 4 × 4", four, PITCHES_MM[2:]),
        (2, "2 bits, bilinear", bilinear, PITCHES_MM),
        (2, "2 bits, band 4 × 4", four, PITCHES_MM[2:]),
        (1, "packed words, bilinear vote", bilinear, PITCHES_MM),
    ):
        for pitch_mm in pitches_mm:
            table = laboratory.table(pitch_mm * 1e-3, bits, interpolation)
            weights_bytes = interpolation.table_bytes() if isinstance(interpolation, BandInterpolation) else 0
            yield Candidate(
                curve=name,
                setting=f"{pitch_mm:g} mm",
                compose=FromTable(table, interpolation, board.idle_word),
                memory_bytes=table.memory_bytes + weights_bytes,
                wire_bytes=wire_bytes(board.waveform.samples),
                tabled=True,
            )


class FromTable:
    """Drive words from a table of flat responses."""

    def __init__(self, table: ResponseTable, interpolation: Interpolation, idle_word: int) -> None:
        self._table, self._interpolation, self._idle_word = table, interpolation, idle_word

    def __call__(self, points: Sequence[Point]) -> Words:
        """Drive words for points of full amplitude."""
        return drive_words(self.sum(points).reshape(-1, CHANNELS), self._idle_word)

    def sum(self, points: Sequence[Point]) -> Floats:
        """Sum of the points' flat responses, each over the sum of its absolute values."""
        total: Floats | None = None
        for x_m, y_m, _ in points:
            response = self._table.interpolate(self._interpolation(self._table.grid, x_m, y_m))
            if len(points) > 1:
                response /= max(float(np.abs(response).sum()), 1e-30)
            total = response if total is None else total + response
        assert total is not None
        return total
