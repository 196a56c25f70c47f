"""A bank's responses in memory, and what a caller gives beside them, checked as the compiled kernel checks them."""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.device.kernel import compact_twin
from controller.device.kernel.compact_twin import CompactTables

Numbers = NDArray[Any]

Readable = bytes | bytearray | memoryview
Writable = bytearray | memoryview
Point = tuple[float, float, float]  # x_m, y_m, amplitude
Cells = list[tuple[int, int]]  # number and weight of each
Shares = list[tuple[int, float]]  # index along an axis and share of each


class PlaceCells(NamedTuple):
    """What serves a place: responses, and for the rest outside the band the same or cells of a compact bank, with their weights."""

    responses: Cells
    rest: Cells
    tap: int = 0  # of the equaliser, in 2^-14


CHANNELS: Final = 32
REST_SAMPLES: Final = 2  # samples to a row of the rest outside the band
GROUP_SAMPLES: Final = 8  # of which blocks consist
MAX_FOCI: Final = 10
MAX_SAMPLES: Final = 2000  # so that sums of absolute values stay below 2^31
MAX_BLOCK_SAMPLES: Final = 256
SKETCHED_PER_BLOCK: Final = 16  # samples of a response that are in its sketch: every third of the shipped boards'
STEPS_PER_BLOCK: Final = 12  # steps of 8 us: between the taps of an equaliser, and between times near T
LARGEST_EQUALISER: Final = 0.5  # so that an equalised response is within 16 bits
TAP_BITS: Final = 15  # behind the point of a product with a tap
LARGEST: Final = (1 << 31) - 1
WEIGHT_SUM: Final = 256  # of the cells around a point: four roundings may add 2, and 258 * 127 is still within 16 bits
WIDE_CELLS: Final = 6  # around a point among many; they share one less, as six roundings may add 3
LEAST_MORE: Final = 1 / 48  # share of the farthest of them from which on they are worth reading

# What a composition needs to know of bank and board: samples, bytes from one response to the next, cells along x and y,
# responses, idle word, samples of a block; pitch, x and y of cell 0 in m; the equaliser (`Responses.equalised`), and what it leaves
# lost of the band half-way between cells, over x (1 - x) + y (1 - y): the rest outside the band is taken for as much less.
PLAN: Final = struct.Struct("<7q5d")
ENTRY: Final = struct.Struct("=i")
SCALE: Final = struct.Struct("=f")


class BankBuffers(NamedTuple):
    """What the kernel reads of a bank; of the compiled one a tuple of these."""

    plan: Readable  # as `PLAN` packs it
    entries: Readable  # for each cell the number of its response; below 0 for none
    scales: Readable  # m per V of one level of each response
    good: Readable  # for each response whether it may be used; zero if not yet
    response: Readable  # the responses: levels of 8 bits, then those of the rest outside the band, a mean over 2 samples each
    tables: Readable = b""  # of a compact bank, whose responses are weights (`compact_twin`): what all of them have in common


def room_bytes(samples: int) -> int:
    """Bytes of memory in which waveforms of this many samples are composed.

    Raises ValueError if there are none, or more than `MAX_SAMPLES`.
    """
    if not 1 <= samples <= MAX_SAMPLES:
        raise ValueError(f"{samples} samples to compose, not 1 to {MAX_SAMPLES}")
    # 32 bits for each value of the points' responses, alone and with all that bits do, of their sum, and five more in what follows;
    # and at most as much for their sketches, the sum of these and two more
    of_sketches = (MAX_FOCI + 2) * (samples + GROUP_SAMPLES)
    of_nulls = 27 * (samples + rest_rows(samples) + MAX_BLOCK_SAMPLES)  # 16 bits for each value of five sums at four pads, and more
    of_points = (MAX_FOCI + 2) * (samples + rest_rows(samples)) + 5 * (samples + MAX_BLOCK_SAMPLES)
    return 4 * CHANNELS * (of_points + of_sketches) + 2 * CHANNELS * of_nulls


def checked_words(bank: Responses, words: Writable, room: Writable, points: Sequence[Point]) -> memoryview:
    """The words as bytes; raises ValueError if a buffer is too short, or a number of the points not finite or beyond its range."""
    for x_m, y_m, amplitude in points:
        if not (math.isfinite(x_m) and math.isfinite(y_m)):
            raise ValueError("a place of the points to compose is not finite")
        if not 0 < amplitude <= 1:
            raise ValueError("an amplitude of the points to compose is not above 0 and at most 1")
    filled = memoryview(words).cast("B")
    if filled.nbytes < 4 * bank.samples:
        raise ValueError(f"{bank.samples} words do not fit into {filled.nbytes} bytes")
    if memoryview(room).readonly:
        raise ValueError("the room is read-only")
    if memoryview(room).nbytes < room_bytes(bank.samples):
        raise ValueError(f"{bank.samples} samples need {room_bytes(bank.samples)} bytes of room, not {memoryview(room).nbytes}")
    return filled


class Responses:
    """The responses of a bank, in buffers that are as long as the plan says."""

    def __init__(self, bank: BankBuffers) -> None:
        plan, entries, scales, good, response, tables = bank
        if memoryview(plan).nbytes != PLAN.size:
            raise ValueError(f"a plan has {PLAN.size} bytes, not {memoryview(plan).nbytes}")
        samples, stride, nx, ny, count, idle_word, block, pitch_m, x0_m, y0_m, equaliser, band_lost = PLAN.unpack(plan)
        if not 1 <= samples <= MAX_SAMPLES:
            raise ValueError(f"{samples} samples to compose, not 1 to {MAX_SAMPLES}")
        if not GROUP_SAMPLES <= block <= MAX_BLOCK_SAMPLES or block % GROUP_SAMPLES:
            raise ValueError(f"blocks of {block} samples: not {GROUP_SAMPLES} to {MAX_BLOCK_SAMPLES}, in eights")
        values = (samples + rest_rows(samples)) * CHANNELS
        self.tables = CompactTables(tables, samples, rest_rows(samples)) if len(tables) else None
        across = self.tables.in_band.across if self.tables else 1
        if self.tables:
            values = compact_twin.row_bytes(self.tables.in_band.weights, self.tables.in_band.block_rows)
        if not (
            0 <= idle_word < 1 << CHANNELS
            and across <= nx <= LARGEST
            and across <= ny <= LARGEST
            and 0 <= count <= LARGEST
            and values <= stride <= LARGEST
            and 0 < pitch_m < math.inf
            and math.isfinite(x0_m)
            and math.isfinite(y0_m)
            and 0 <= equaliser <= LARGEST_EQUALISER
            and 0 <= band_lost <= 1
        ):
            raise ValueError("a number of the plan is beyond its range")
        self.entries, self.scales = memoryview(entries).cast("B"), memoryview(scales).cast("B")
        self.good, self.response = memoryview(good).cast("B"), memoryview(response).cast("B")
        if self.entries.nbytes < 4 * nx * ny or self.scales.nbytes < 4 * count or self.good.nbytes < count:
            raise ValueError("the tables are too short for the plan")
        self.samples, self.block_samples, self.idle_word, self.count = samples, block, idle_word, count
        self.stride, self.values, self.nx, self.ny = stride, values, nx, ny
        self.pitch_m, self.x0_m, self.y0_m = pitch_m, x0_m, y0_m
        self._equaliser, self._band_lost = equaliser, band_lost
        self.step, self.sketch_step = max(block // STEPS_PER_BLOCK, 1), max(block // SKETCHED_PER_BLOCK, 1)

    def patch(self, x_m: float, y_m: float, *, wide: bool = False) -> tuple[PlaceCells, int]:
        """Responses around a point that have a weight, with their weights; and -1, or the first cell without one.

        Along an axis on which a point lies halfway between cells, interpolation takes more from the waves than along one on which
        it lies on a cell. If `wide`, cells of a third row are added along the latter where the bank has them, so that as much is
        taken in all directions, which the equaliser then gives back.
        """
        if self.tables:
            return self._stencil(self.tables, x_m, y_m)
        ix, right = self._along(x_m - self.x0_m, self.nx - 1)
        iy, up = self._along(y_m - self.y0_m, self.ny - 1)
        along_x, along_y = right * (1 - right), up * (1 - up)
        between, more = along_x + along_y, abs(along_x - along_y) / 2
        cells = self._cells(row_shares(ix, right, more * (along_y > along_x)), row_shares(iy, up, more * (along_x > along_y)))
        if wide and more > LEAST_MORE and all(map(self._has, cells)):
            between += 2 * more
        else:
            cells = self._cells(row_shares(ix, right), row_shares(iy, up))
        numbers, shares, total = [], [], 0.0
        for cell, share in cells.items():
            entry, scale = self._entry(cell)
            if entry < 0:
                return PlaceCells([], []), cell
            numbers.append(entry)
            shares.append(share * scale)
            total += share * scale
        if len(cells) == 1:
            alone = [(numbers[0], WEIGHT_SUM)]
            return PlaceCells(alone, alone), -1
        unit = (WEIGHT_SUM - (len(cells) == WIDE_CELLS)) / total if total > 0 else 0.0
        tap = round(self._equaliser * between * (1 << TAP_BITS - 1))
        rest = _whole(numbers, shares, unit * (1 - self._band_lost * between))
        return PlaceCells(_whole(numbers, shares, unit), rest, tap), -1

    def _cells(self, columns: Shares, rows: Shares) -> dict[int, float]:
        """Cells with their shares of a place; -1 for any beyond the grid."""
        cells = {}
        for y, of_row in rows:
            for x, of_column in columns:
                if of_row * of_column:
                    within = 0 <= x < self.nx and 0 <= y < self.ny
                    cells[y * self.nx + x if within else -1] = of_row * of_column
        return cells

    def _has(self, cell: int) -> bool:
        """Whether a cell has a response, which may be used or not yet."""
        return cell >= 0 and 0 <= ENTRY.unpack_from(self.entries, 4 * cell)[0] < self.count

    def _entry(self, cell: int) -> tuple[int, float]:
        """Number and scale of the response of a cell; below 0 if it has none, or one that may not be used."""
        (entry,) = ENTRY.unpack_from(self.entries, 4 * cell)
        if not 0 <= entry < self.count or not self.good[entry]:
            return -1, 0.0
        if entry * self.stride + self.values > self.response.nbytes:
            raise ValueError("the responses are too short for the plan")
        (scale,) = SCALE.unpack_from(self.scales, 4 * entry)
        if not 0 <= scale < math.inf:
            raise ValueError(f"the scale of response {entry} is not finite, or below 0")
        return entry, scale

    def _stencil(self, tables: CompactTables, x_m: float, y_m: float) -> tuple[PlaceCells, int]:
        """The same of a compact bank, whose weights are shares."""
        layer, numbers, shares, totals = tables.in_band, [], [], [0.0, 0.0]
        ix, right = compact_twin.along(x_m - self.x0_m, self.pitch_m, self.nx, layer)
        iy, up = compact_twin.along(y_m - self.y0_m, self.pitch_m, self.ny, layer)
        for (y, x), share in np.ndenumerate(compact_twin.shares(tables.stencil, layer, right, up)):
            cell = (iy + y) * self.nx + ix + x
            entry, scale = self._entry(cell)
            if entry < 0:
                return PlaceCells([], []), cell
            numbers.append(entry)
            shares.append(float(share) * scale)
            totals[0] += abs(shares[-1])
        layer, cells, parts = tables.rest, [], []
        ix, right = compact_twin.along(x_m - tables.x0_m, tables.pitch_m, tables.rest_nx, layer)
        iy, up = compact_twin.along(y_m - tables.y0_m, tables.pitch_m, tables.rest_ny, layer)
        for (y, x), share in np.ndenumerate(compact_twin.shares(tables.rest_stencil, layer, right, up)):
            cells.append((iy + y) * tables.rest_nx + ix + x)
            parts.append(float(share) * float(tables.rest_scales[cells[-1]]))
            totals[1] += abs(parts[-1])
        unit = compact_twin.SHARE_SUM / max(totals) if 0 < max(totals) < math.inf else 0.0
        return PlaceCells(_whole(numbers, shares, unit), _whole(cells, parts, unit)), -1

    def turned(self, patch: PlaceCells) -> Numbers:
        """Response of a patch and its rest, (row, 32) in 16 bits, negated in channels that idle high."""
        turned = np.array([self.idle_word >> q & 1 for q in range(CHANNELS)], np.int16)
        if self.tables:
            return self._from_weights(self.tables, patch, turned)
        levels, short = np.frombuffer(self.response, np.int8), np.zeros(self.values, np.int16)
        first = self.samples * CHANNELS  # of the rest
        for (entry, share), (_, share_of_rest) in zip(patch.responses, patch.rest, strict=True):
            of_cell = levels[entry * self.stride :]
            short[:first] += np.multiply(of_cell[:first], share, dtype=np.int16)
            short[first:] += np.multiply(of_cell[first : self.values], share_of_rest, dtype=np.int16)
        found: Numbers = short.reshape(-1, CHANNELS) * (1 - 2 * turned)
        return found

    def equalised(self, patch: PlaceCells) -> Numbers:
        """The same, halved, with what interpolation takes from the shorter waves in the band given back (`equaliser` of a bank).

        Of a compact bank the same as it is, as it is faint and nothing is taken; with what of the rest is made of the band.
        """
        met = self.turned(patch)
        if self.tables:
            if self.tables.of_band.there:
                met[self.samples :] += self.tables.of_band.rows(met[: self.samples])
            return met
        beside = np.pad(met[: self.samples].astype(np.int32), ((self.step, self.step), (0, 0))) * patch.tap >> TAP_BITS
        halved: Numbers = met >> 1
        halved[: self.samples] -= (beside[: self.samples] + beside[2 * self.step :]).astype(np.int16)
        return halved

    def whole(self, equalised: Numbers) -> Numbers:
        """Of responses (place, row, 32) all that bits do: in the band, and the rest of the same samples."""
        beside = np.repeat(equalised[:, self.samples :], REST_SAMPLES, axis=1)[:, : self.samples]
        together: Numbers = equalised[:, : self.samples] + beside
        return together

    def _from_weights(self, tables: CompactTables, patch: PlaceCells, turned: Numbers) -> Numbers:
        levels = np.frombuffer(self.response, np.uint8)
        rows = [(levels[entry * self.stride :][: self.values], share) for entry, share in patch.responses]
        even = compact_twin.outputs(rows, tables.in_band, tables.pulses, turned)
        rests = [(tables.rest_rows[cell], share) for cell, share in patch.rest]
        rest = compact_twin.outputs(rests, tables.rest, tables.rest_pulses, turned)
        samples = compact_twin.samples_of(even, self.samples, tables.odd_near, tables.odd_far)
        return np.concatenate([samples, rest]).astype(np.int16)

    def _along(self, distance_m: float, last: int) -> tuple[int, float]:
        """Index of a row of cells and the distance beyond it, in pitches; 0 outside the grid.

        The distance is rounded to a millionth of a pitch, so that a point on a cell needs no neighbours.
        """
        millionths = distance_m / self.pitch_m * 1e6
        if not millionths > 0:
            return 0, 0.0
        if millionths >= last * 1e6:
            return last, 0.0
        index, beyond = divmod(round(millionths), 1_000_000)
        return index, beyond * 1e-6


def row_shares(index: int, beyond: float, more: float = 0.0) -> Shares:
    """Indices of cells along an axis and their shares of a place `beyond` the first; with `more`, of three, farther apart."""
    if not more:
        return [(index, 1 - beyond), (index + 1, beyond)]
    if beyond <= 0.5:
        return [(index - 1, more), (index, 1 - beyond - 2 * more), (index + 1, beyond + more)]
    return [(index, 1 - beyond + more), (index + 1, beyond - 2 * more), (index + 2, more)]


def _whole(numbers: list[int], shares: list[float], unit: float) -> Cells:
    return [(number, round(share * unit)) for number, share in zip(numbers, shares, strict=True)]


def rest_rows(samples: int) -> int:
    """Rows of the rest outside the band, of a response of this many samples."""
    return -(-samples // REST_SAMPLES)
