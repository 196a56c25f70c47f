"""Drive words from responses, in NumPy: the specification of the compiled kernel, and what serves where there is none.

All that reaches a bit is whole numbers; what sets weights and thresholds is IEEE double arithmetic in one order, without library
functions. So the words are the same on every machine.

Responses
---------
A point between cells has the response `r = sum(w level)` of up to four cells, their weights in 256ths: 16 bits. It is negated in
channels that idle high, so that a bit deviates from idle where a sum of responses is above a threshold of at least zero, and
then adds the response itself to the displacement.

Several points
--------------
`S = sum(q r)`, with a weight of 15 bits and a polarity for each point: 32 bits. A response is divided by the sum of its absolute
values, which is what the point would get alone; one of zeros has no part in the sum.

A kick is felt either way, so polarities are free. Those are taken for which the energy of the sum is largest (`s' G s`, G: inner
products of the responses), so that responses that are opposite add up; of those and their opposites the one with fewer negative
points. Then weights are balanced: twice, each is divided by what its point gets, so that all points get the same share of their
own maximum, next to the largest that all can have. Inner products and shares are those of every fourth and every second sample.

Less than full amplitude
------------------------
An amplitude is a share of what the same point would get if all points were composed at full amplitude. The ratio of the weights
sets the ratio of the amplitudes; their common level is set by leaving bits at idle where `S` is weak against the mean of its
absolute value in the same block of samples and the same channel. Both are found by measuring: the displacement at a point is
linear in the bits, an inner product of them with the point's response, in the band and outside it.

Full amplitude is the level that all points have together: the mean of their shares in the band, weighed as they are, which is
next to the largest share that all can have. A point that differs from it by more than a sixteenth has its own, since its neighbours
move it.

Points that are near move together. Where responses are more than half alike (correlation of the sketches), points are one place,
and none is asked for more than the least of them; soon below that each has its own. What is too much after the last
round is lowered together with all others.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Readable = bytes | bytearray | memoryview
Writable = bytearray | memoryview
Point = tuple[float, float, float]  # x_m, y_m, amplitude
Patch = list[tuple[int, int]]  # response and weight of up to four cells
Numbers = NDArray[Any]

CHANNELS: Final = 32
REST_SAMPLES: Final = 4  # samples to a row of the rest outside the band
GROUP_SAMPLES: Final = 8  # of which blocks consist
MAX_FOCI: Final = 10
LEAST_AMPLITUDE: Final = 1 / 1024  # less is no displacement either, and quotients of it would leave the range of floats
MAX_SAMPLES: Final = 2000  # so that sums of absolute values stay below 2^31
MAX_BLOCK_SAMPLES: Final = 256
LARGEST: Final = (1 << 31) - 1
WEIGHT_SUM: Final = 256  # of the cells around a point: four roundings may add 2, and 258 * 127 is still within 16 bits
POINT_WEIGHT_SUM: Final = 32767  # of the points
STRENGTH_SHIFT: Final = 8  # bits that absolute values of sums lose before they are added up
THRESHOLD_BITS: Final = 24  # behind the point of a threshold
SKETCH_STEP: Final = 2  # of all samples, one of so many is in the sketch from which polarities and weights are found
SKETCH_SHIFT: Final = 4  # bits that responses lose there, so that 256 products add up to less than 2^31
PRODUCT_BITS: Final = 30  # of the largest inner product of two responses
BALANCING_ROUNDS: Final = 2
MAX_CORRECTION: Final = 2.0  # of a weight in a round
THRESHOLD_SHIFT: Final = np.array(THRESHOLD_BITS - STRENGTH_SHIFT, np.int64)

# What a composition needs to know of bank and board: samples, bytes from one response to the next, cells along x and y,
# responses, idle word, samples of a block; pitch, x and y of cell 0 in m.
PLAN: Final = struct.Struct("<7q3d")
ENTRY: Final = struct.Struct("=i")
SCALE: Final = struct.Struct("=f")

# Share of the full amplitude that is left when every sample is masked whose response is below a threshold,
# in units of the mean of its absolute value over 96 us: median over 120 points of the simulated board.
THRESHOLDS: Final = (0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 3.0)
SHARES: Final = (1.0, 0.9764, 0.9089, 0.8022, 0.6727, 0.5347, 0.3991, 0.2781, 0.155, 0.067)
MAX_ROUNDS: Final = 6  # of measuring what the bits give; most emissions need two or three. If none is good, the best one is played
MAX_LOWERINGS: Final = 3  # behind them
TOO_MUCH: Final = 1.03  # of what was asked for: then all are lowered
ONE_PLACE: Final = 0.5  # correlation of responses: 2.8 mm on the simulated board
RATIO_SLOPE: Final = 30.0  # by which ratio amplitudes may differ, for each correlation below: 4 at 0.4, 3.1 mm
OWN_LEVEL: Final = 1 / 16  # difference from the common level from which on a point has its own
TOLERANCE: Final = 0.01  # of an amplitude: well below a step

ZERO: Final = np.array(0, np.int32)
ZERO_SHORT: Final = np.array(0, np.int16)
NOTHING: Final = np.array(0.0)
SKETCH_UNIT: Final = np.array(1 / (1 << SKETCH_SHIFT))
LARGEST_LONG: Final = np.array(LARGEST, np.int64)
PACKING: Final = np.array(0x0102_0408_1020_4080, "<u8")  # moves the lowest bits of eight bytes to the highest byte


def room_bytes(samples: int) -> int:
    """Bytes of memory in which waveforms of so many samples are composed.

    Raises
    ------
    ValueError
        If there are none, or more than `MAX_SAMPLES`.
    """
    if not 1 <= samples <= MAX_SAMPLES:
        raise ValueError(f"{samples} samples to compose, not 1 to {MAX_SAMPLES}")
    # 32 bits for each value of the points' responses, of their sum, and five more in what follows
    # and 64 bits for each of their sketches, of the sum of these and two more
    of_sketches = (MAX_FOCI + 2) * (samples + 2 * SKETCH_STEP)
    return 4 * CHANNELS * ((MAX_FOCI + 2) * (samples + _rest_rows(samples)) + 5 * (samples + MAX_BLOCK_SAMPLES) + of_sketches)


def compose(
    words: Writable,
    room: Writable,
    plan: Readable,
    entries: Readable,
    scales: Readable,
    good: Readable,
    response: Readable,
    points: Sequence[Point],
) -> int:
    """Drive words that make every point jump at the end of the emission.

    Parameters
    ----------
    words : writable buffer
        Filled with 4 bytes for each sample.
    room : writable buffer
        `room_bytes` at least; what is in it does not matter.
    plan : buffer
        As `PLAN` packs it.
    entries : buffer of int32
        For each cell the number of its response; below 0 for none.
    scales : buffer of float32
        m per V of one level of each response.
    good : buffer of bytes
        For each response whether it may be used; zero if not yet.
    response : buffer
        The responses: levels of 8 bits, then those of the rest outside the band, a mean over 4 samples each.
    points : sequence of (x_m, y_m, amplitude)
        1 to `MAX_FOCI`; above 0 to 1, less than `LEAST_AMPLITUDE` counts as that. Points beyond the outermost cells take the
        nearest place among the cells.

    Returns
    -------
    int
        -1: done. Otherwise a cell that a point needs, which has no response or one that may not be used; nothing was composed.

    Raises
    ------
    ValueError
        If there are no points or too many, or numbers that are not finite or beyond their range, or buffers too short for them.
    """
    bank = _Responses(plan, entries, scales, good, response)
    count = len(points)
    if not 1 <= count <= MAX_FOCI:
        raise ValueError(f"{count} points to compose, not 1 to {MAX_FOCI}")
    for x_m, y_m, amplitude in points:
        if not (math.isfinite(x_m) and math.isfinite(y_m)):
            raise ValueError("a place of the points to compose is not finite")
        if not 0 < amplitude <= 1:
            raise ValueError("an amplitude of the points to compose is not above 0 and at most 1")
    filled = memoryview(words).cast("B")
    if filled.nbytes < 4 * bank.samples:
        raise ValueError(f"{bank.samples} words do not fit into {filled.nbytes} bytes")
    if memoryview(room).nbytes < room_bytes(bank.samples):
        raise ValueError(f"{bank.samples} samples need {room_bytes(bank.samples)} bytes of room, not {memoryview(room).nbytes}")
    patches = []
    for x_m, y_m, _ in points:
        patch, cell = bank.patch(x_m, y_m)
        if cell >= 0:
            return cell
        patches.append(patch)
    work = _work(room, bank)
    work.compose(bank, patches, [max(amplitude, LEAST_AMPLITUDE) for _, _, amplitude in points])
    work.pack(filled)
    return -1


class _Responses:
    """The responses of a bank, in buffers that are as long as the plan says."""

    def __init__(self, plan: Readable, entries: Readable, scales: Readable, good: Readable, response: Readable) -> None:
        if memoryview(plan).nbytes != PLAN.size:
            raise ValueError(f"a plan has {PLAN.size} bytes, not {memoryview(plan).nbytes}")
        samples, stride, nx, ny, count, idle_word, block, pitch_m, x0_m, y0_m = PLAN.unpack(plan)
        if not 1 <= samples <= MAX_SAMPLES:
            raise ValueError(f"{samples} samples to compose, not 1 to {MAX_SAMPLES}")
        if not GROUP_SAMPLES <= block <= MAX_BLOCK_SAMPLES or block % GROUP_SAMPLES:
            raise ValueError(f"blocks of {block} samples: not {GROUP_SAMPLES} to {MAX_BLOCK_SAMPLES}, in eights")
        values = (samples + _rest_rows(samples)) * CHANNELS
        if not (
            0 <= idle_word < 1 << CHANNELS
            and 1 <= nx <= LARGEST
            and 1 <= ny <= LARGEST
            and 0 <= count <= LARGEST
            and values <= stride <= LARGEST
            and 0 < pitch_m < math.inf
            and math.isfinite(x0_m)
            and math.isfinite(y0_m)
        ):
            raise ValueError("a number of the plan is beyond its range")
        self.entries, self.scales = memoryview(entries).cast("B"), memoryview(scales).cast("B")
        self.good, self.response = memoryview(good).cast("B"), memoryview(response).cast("B")
        if self.entries.nbytes < 4 * nx * ny or self.scales.nbytes < 4 * count or self.good.nbytes < count:
            raise ValueError("the tables are too short for the plan")
        self.samples, self.block_samples, self.idle_word, self.count = samples, block, idle_word, count
        self.stride, self.values, self.nx, self.ny = stride, values, nx, ny
        self.pitch_m, self.x0_m, self.y0_m = pitch_m, x0_m, y0_m

    def patch(self, x_m: float, y_m: float) -> tuple[Patch, int]:
        """Responses around a point that have a weight, with their weights; and -1, or the first cell without one."""
        ix, right = self._along(x_m - self.x0_m, self.nx - 1)
        iy, up = self._along(y_m - self.y0_m, self.ny - 1)
        corner = iy * self.nx + ix
        cells = [(corner, (1 - up) * (1 - right))]
        if right:
            cells.append((corner + 1, (1 - up) * right))
        if up:
            cells.append((corner + self.nx, up * (1 - right)))
            if right:
                cells.append((corner + self.nx + 1, up * right))
        numbers, shares, total = [], [], 0.0
        for cell, share in cells:
            (entry,) = ENTRY.unpack_from(self.entries, 4 * cell)
            if not 0 <= entry < self.count or not self.good[entry]:
                return [], cell
            if entry * self.stride + self.values > self.response.nbytes:
                raise ValueError("the responses are too short for the plan")
            (scale,) = SCALE.unpack_from(self.scales, 4 * entry)
            if not 0 <= scale < math.inf:
                raise ValueError(f"the scale of response {entry} is not finite, or below 0")
            numbers.append(entry)
            shares.append(share * scale)
            total += share * scale
        if len(cells) == 1:
            return [(numbers[0], WEIGHT_SUM)], -1
        unit = WEIGHT_SUM / total if total > 0 else 0.0
        return [(entry, round(share * unit)) for entry, share in zip(numbers, shares, strict=True)], -1

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


class _Work:
    """Arrays in the room of the caller, and what does not change."""

    def __init__(self, room: Writable, samples: int, idle_word: int, block: int) -> None:
        self.room, self.told = room, (samples, idle_word, block)
        rows, blocks = _rest_rows(samples), -(-samples // block)
        values, padded, rest_values = samples * CHANNELS, blocks * block * CHANNELS, rows * REST_SAMPLES * CHANNELS
        taken = 0

        def take(kind: str, *shape: int) -> Numbers:
            nonlocal taken
            size = math.prod(shape) * np.dtype(kind).itemsize
            array: Numbers = np.frombuffer(room, np.uint8, size, taken).view(kind).reshape(shape)
            taken += size
            return array

        self._sketch = _Sketch(samples, take)  # first, for its alignment
        responses = take("i4", MAX_FOCI, values + rows * CHANNELS)
        self._responses, self._in_band, self._outside = list(responses), list(responses[:, :values]), list(responses[:, values:])
        self._sum = take("i4", values)
        product, bit_values, threshold = take("i4", padded), take("i4", padded), take("i4", padded)
        self._product, self._product_of_no_sample = product[:values], product[values:]
        self._product_by_block = product.reshape(blocks, block, CHANNELS)
        self._bit_values, self._bits_of_no_sample = bit_values[:values], bit_values[values:rest_values]
        self._bits_by_rest_row = bit_values[:rest_values].reshape(rows, REST_SAMPLES, CHANNELS)
        self._threshold = threshold[:values]
        self._threshold_by_run = threshold.reshape(blocks, block // GROUP_SAMPLES, GROUP_SAMPLES * CHANNELS)
        self._short, self._part = take("i2", values + rows * CHANNELS), take("i2", values + rows * CHANNELS)
        self._packed, self._bits = take("<u8", values // 8), take("?", values)
        self._eights, self._highest = self._bits.view("<u8"), self._packed.view(np.uint8)[7::8]
        # small, or constant, and so not in the room
        self._block_samples = block
        self._rest_bits, self._rest_ones = np.empty((rows, 1, CHANNELS), np.int32), np.ones((1, REST_SAMPLES), np.int32)
        self._flat_rest_bits = self._rest_bits.reshape(-1)
        self._rest_product = np.empty(rows * CHANNELS, np.int32)
        self._product_halves, self._rest_product_halves = _halves(self._product), _halves(self._rest_product)
        self._strength_sum, self._block_ones = np.empty((blocks, 1, CHANNELS), np.int32), np.ones((1, block), np.int32)
        self._strength, self._scaled = np.empty((2, blocks, 1, CHANNELS), np.int64)
        self._run = np.empty((blocks, GROUP_SAMPLES, CHANNELS), np.int32)
        self._run_by_block = self._run.reshape(blocks, 1, GROUP_SAMPLES * CHANNELS)
        self._weight, self._point_weight, self._scale = np.empty((), np.int16), np.empty((), np.int32), np.empty((), np.int64)
        idle_high = np.array([idle_word >> q & 1 for q in range(CHANNELS)], np.int16)
        self._flip = np.tile(1 - 2 * idle_high, samples + rows)
        self._idle_words = np.full(samples, idle_word, "<u4").view(np.uint8)

    def pack(self, words: memoryview) -> None:
        """Words of the bits."""
        np.multiply(self._eights, PACKING, out=self._packed)
        np.bitwise_xor(self._highest, self._idle_words, out=np.frombuffer(words, np.uint8, self._highest.size))

    def compose(self, bank: _Responses, patches: list[Patch], asked: list[float]) -> None:
        """Set the bits: where they deviate from idle."""
        count, full = len(patches), all(amplitude == 1 for amplitude in asked)
        levels = np.frombuffer(bank.response, np.int8)
        for row, patch in enumerate(patches):
            self._interpolate(levels, bank.stride, patch)
            if full and count == 1:
                np.greater(self._short[: self._bits.size], ZERO_SHORT, out=self._bits)
                return
            np.copyto(self._responses[row], self._short)
        divisors, balance = [float(self._norm(row)) or math.inf for row in range(count)], [1.0]
        if count > 1:
            self._sketch.take(self._in_band[:count])
            asked, divisors = self._sketch.polarised(asked, divisors)
            balance = self._sketch.balanced(divisors)
        unit = self._add(balance, divisors)
        np.greater(self._sum, ZERO, out=self._bits)
        if unit and not full:
            self._solve(asked, self._wanted(asked, divisors, balance), divisors, balance)

    def _wanted(self, asked: list[float], divisors: list[float], balance: list[float]) -> list[float]:
        """Displacements at less than full amplitude, from those at full amplitude, which the bits give.

        Of several points from those in the band: what bits do outside it depends on all polarities, up to 8 % of a tenth point.
        """
        measured, in_band = self._measured(divisors)
        if len(asked) == 1:
            return [asked[0] * measured[0]]
        level = _product(balance, in_band) / _product(balance, [1.0] * len(balance))
        nearly = level * OWN_LEVEL
        return [share * (got - max(-nearly, min(nearly, got - level))) for share, got in zip(asked, in_band, strict=True)]

    def _interpolate(self, levels: Numbers, stride: int, patch: Patch) -> None:
        """Response of a point, negated in channels that idle high."""
        short, part, weight = self._short, self._part, self._weight
        for index, (entry, share) in enumerate(patch):  # one by one: a ufunc that broadcasts allocates
            to = part if index else short
            np.copyto(to, levels[entry * stride : entry * stride + short.size])
            weight[...] = share
            np.multiply(to, weight, out=to)
            if index:
                np.add(short, part, out=short)
        np.multiply(short, self._flip, out=short)

    def _norm(self, row: int) -> int:
        """Sum of the absolute values of a response in the band."""
        np.abs(self._in_band[row], out=self._product)
        return _total(self._product_halves)

    def _add(self, weights: list[float], divisors: list[float]) -> float:
        """Sum of the responses, each divided by its divisor, in whole multiples next to the weights times what is returned."""
        whole, unit = _whole_weights(weights, divisors)
        for row, weight in enumerate(whole):
            self._point_weight[...] = weight
            to = self._product if row else self._sum
            np.multiply(self._in_band[row], self._point_weight, out=to)
            if row:
                np.add(self._sum, self._product, out=self._sum)
        return unit

    def _measured(self, divisors: list[float]) -> tuple[list[float], list[float]]:
        """Displacement that the bits give at each point, divided by its divisor: all of it, and what is in the band."""
        np.copyto(self._bit_values, self._bits)
        self._bits_of_no_sample[:] = 0
        np.matmul(self._rest_ones, self._bits_by_rest_row, out=self._rest_bits)
        found, in_band = [], []
        for row, divisor in enumerate(divisors):
            np.multiply(self._in_band[row], self._bit_values, out=self._product)
            np.multiply(self._outside[row], self._flat_rest_bits, out=self._rest_product)
            inside = _total(self._product_halves)
            in_band.append(inside / divisor)
            found.append((inside + _total(self._rest_product_halves)) / divisor)
        return found, in_band

    def _measure_strength(self) -> None:
        """Sum of the absolute values of each block and channel of the sum of responses."""
        np.abs(self._sum, out=self._product)
        np.right_shift(self._product, STRENGTH_SHIFT, out=self._product)
        self._product_of_no_sample[:] = 0
        np.matmul(self._block_ones, self._product_by_block, out=self._strength_sum)
        np.copyto(self._strength, self._strength_sum)

    def _mask(self, threshold: float) -> None:
        """Set the bits where the sum is above a threshold, in units of its local strength when that was measured."""
        scale = threshold / self._block_samples * (1 << THRESHOLD_BITS)
        self._scale[...] = round(scale) if scale < LARGEST else LARGEST
        np.multiply(self._strength, self._scale, out=self._scaled)
        np.right_shift(self._scaled, THRESHOLD_SHIFT, out=self._scaled)
        np.minimum(self._scaled, LARGEST_LONG, out=self._scaled)
        np.copyto(self._run, self._scaled, casting="unsafe")  # laid out by copies: a ufunc that broadcasts allocates
        np.copyto(self._threshold_by_run, self._run_by_block)
        np.greater(self._sum, self._threshold, out=self._bits)

    def _solve(self, asked: list[float], wanted: list[float], divisors: list[float], balance: list[float]) -> None:
        """Set the bits that give the wanted displacement at each point.

        The ratio of the weights sets the ratio of the displacements; the Euclidean norm of the weights sets how much is
        masked, since the displacements of independent points are proportional to their weights. So each round adds the
        residuals to the weights, from the second round on by Anderson acceleration of depth one, since points that are near
        each other are not independent.

        Parameters
        ----------
        asked : list of float
            Amplitude of each point: the first weights.
        wanted : list of float
            Displacement of each point, as `_measured` gives it.
        divisors : list of float
            Of the points' responses: the sums of their absolute values, with the points' polarities.
        balance : list of float
            Weights at full amplitude.
        """
        count = len(asked)
        first_unit = unit = self._add(_products(balance, asked), divisors)
        first_norm = math.sqrt(_product(asked, asked))
        self._measure_strength()
        weights = weights_before = residuals_before = best = asked
        gain, least = 0.0, math.inf
        last = MAX_ROUNDS + MAX_LOWERINGS - 1
        for turn in range(last + 1):
            norm = math.sqrt(_product(weights, weights)) or first_norm
            if turn and count > 1:  # the sum of a single point stays as it is
                scaled = [weight * first_norm / norm for weight in weights]
                unit = self._add(_products(balance, scaled), divisors)
            self._mask(masking_threshold(norm / math.sqrt(count)) * (unit / first_unit))
            if turn == last:
                return
            measured, _ = self._measured(divisors)
            if all(abs(want - got) <= TOLERANCE * want for want, got in zip(wanted, measured, strict=True)):
                return
            gain = gain or _product(measured, weights) / (norm * norm)
            if not gain > 0:
                return
            error = max(abs(want - got) / want if want > 0 else 0.0 for want, got in zip(wanted, measured, strict=True))
            if turn < MAX_ROUNDS and error < least:
                least, best = error, weights
            if turn == MAX_ROUNDS - 1 and error > least:
                weights = best
                continue
            if turn >= MAX_ROUNDS - 1:
                most = max(got / want if want > 0 else 0.0 for want, got in zip(wanted, measured, strict=True))
                if min(measured) < 0:
                    weights = asked
                elif most > TOO_MUCH:
                    weights = [weight / most for weight in weights]
                else:
                    return
                continue
            residuals = [(want - got) / gain for want, got in zip(wanted, measured, strict=True)]
            mixing = 0.0
            if turn:
                change = [new - old for new, old in zip(residuals, residuals_before, strict=True)]
                squared = _product(change, change)
                mixing = _product(residuals, change) / squared if squared > 0 else 0.0
            further = []
            for index in range(count):
                new, old = weights[index] + residuals[index], weights_before[index] + residuals_before[index]
                further.append(new + mixing * (old - new) if turn else new)
            weights_before, residuals_before, weights = weights, residuals, further


class _Sketch:
    """Every second sample of the points' responses: whole numbers in float64, whose sums are exact in any order.

    Samples 0, 4, 8, .. lie before samples 2, 6, 10, ..; inner products of responses are those of the former.
    """

    def __init__(self, samples: int, take: Callable[..., Numbers]) -> None:
        values, before = CHANNELS * -(-samples // SKETCH_STEP), CHANNELS * -(-samples // (2 * SKETCH_STEP))
        self._rows, self._sum, self._bit_values = take("f8", MAX_FOCI, values), take("f8", values), take("f8", values)
        self._bits = np.empty(values, np.bool_)
        self._samples, self._parts = samples, []
        for row in self._rows:
            self._parts.append((row[:before].reshape(-1, CHANNELS), row[before:].reshape(-1, CHANNELS)))
        self._tables: dict[int, _SketchTables] = {}

    def take(self, responses: list[Numbers]) -> None:
        """Sketch the responses, (sample x channel,) each."""
        for row, (before, behind), response in zip(self._rows, self._parts, responses, strict=False):
            by_sample = response.reshape(self._samples, CHANNELS)
            np.copyto(before, by_sample[:: 2 * SKETCH_STEP])
            np.copyto(behind, by_sample[SKETCH_STEP :: 2 * SKETCH_STEP])
            np.multiply(row, SKETCH_UNIT, out=row)
            np.floor(row, out=row)

    def _tables_for(self, count: int) -> _SketchTables:
        if count not in self._tables:
            self._tables[count] = _SketchTables(self._rows[:count], self._parts[0][0].size)
        return self._tables[count]

    def polarised(self, asked: list[float], norms: list[float]) -> tuple[list[float], list[float]]:
        """What can be asked for, and the norms, with the signs of the points for which the energy of the sum is largest."""
        count, tables, products, largest = len(norms), self._tables_for(len(norms)), [], 0.0
        np.matmul(tables.before, tables.before_transposed, out=tables.gram)
        for i in range(count):
            for j in range(i):
                product = float(tables.gram[i, j]) / norms[i] / norms[j]
                products.append((i, j, product))
                largest = max(largest, abs(product))
        if largest == 0:
            return asked, norms
        alike = [] if min(asked) == max(asked) else tables.correlations()
        unit = (1 << PRODUCT_BITS) / largest
        tables.gram.fill(0)
        for i, j, product in products:
            tables.gram[i, j] = tables.gram[j, i] = round(product * unit)
        np.matmul(tables.signs, tables.gram, out=tables.fields)
        np.multiply(tables.fields, tables.signs, out=tables.fields)
        np.matmul(tables.fields, tables.ones, out=tables.energies)
        best = int(np.argmax(tables.energies))
        turned = 1 if 2 * best.bit_count() > count else 0
        signs = [1 - 2 * (best << 1 >> i & 1 ^ turned) for i in range(count)]
        asked = list(asked)
        for _ in range(count if alike else 0):
            before = list(asked)
            for i, j, correlation in alike:
                together = correlation * signs[i] * signs[j]
                if together > 0:
                    room = 1 + (ONE_PLACE - together) * RATIO_SLOPE if together < ONE_PLACE else 1.0
                    asked[i] = min(asked[i], asked[j] * room)
                    asked[j] = min(asked[j], asked[i] * room)
            if asked == before:
                break
        return asked, [norm * sign for norm, sign in zip(norms, signs, strict=True)]

    def balanced(self, norms: list[float]) -> list[float]:
        """Weights with which all points get about the same share of their maximum; 0 where there is nothing to be had."""
        count, tables = len(norms), self._tables_for(len(norms))
        weights = [1.0 if math.isfinite(norm) else 0.0 for norm in norms]
        moving = _product(weights, weights) or 1.0
        for _ in range(BALANCING_ROUNDS):
            for index, whole in enumerate(_whole_weights(weights, norms)[0]):
                tables.weights[index] = whole
            np.matmul(tables.weights, tables.rows, out=self._sum)
            np.greater(self._sum, NOTHING, out=self._bits)
            np.copyto(self._bit_values, self._bits)
            np.matmul(tables.rows, self._bit_values, out=tables.got)
            shares = [float(got) / norm for got, norm in zip(tables.got, norms, strict=True)]
            mean = _product(shares, [1.0] * count) / moving
            for index, share in enumerate(shares):
                correction = mean / share if share > 0 else MAX_CORRECTION
                weights[index] *= min(max(correction, 1 / MAX_CORRECTION), MAX_CORRECTION)
        return weights


class _SketchTables:
    """Arrays of a sketch for a number of points."""

    def __init__(self, rows: Numbers, before: int) -> None:
        count = len(rows)
        self.rows, self.before, self.before_transposed = rows, rows[:, :before], rows[:, :before].T
        self.gram, self.weights, self.got, self.ones = np.empty((count, count)), np.empty(count), np.empty(count), np.ones(count)
        choices = np.arange(1 << (count - 1))  # the first point is positive
        self.signs = 1.0 - 2 * (choices[:, None] << 1 >> np.arange(count) & 1)
        self.fields, self.energies = np.empty(self.signs.shape), np.empty(len(choices))

    def correlations(self) -> list[tuple[int, int, float]]:
        """Of the responses of each two points."""
        found, count = [], len(self.gram)
        sizes = [float(self.gram[i, i]) for i in range(count)]
        for i in range(count):
            for j in range(i):
                if sizes[i] > 0 and sizes[j] > 0:
                    found.append((i, j, float(self.gram[i, j]) / math.sqrt(sizes[i] * sizes[j])))
        return found


def _whole_weights(weights: list[float], divisors: list[float]) -> tuple[list[int], float]:
    """Whole numbers next to the weights over the divisors, times what is returned with them."""
    shares, total = [], 0.0
    for weight, divisor in zip(weights, divisors, strict=True):
        shares.append(weight / divisor)
        total += abs(weight / divisor)
    unit = POINT_WEIGHT_SUM / total if 0 < total < math.inf else 0.0
    return [round(share * unit) if unit else 0 for share in shares], unit


def masking_threshold(share: float) -> float:
    """Threshold, in local strengths, that leaves about this share of the full amplitude."""
    for index in range(1, len(SHARES)):
        if share >= SHARES[index]:
            above, below = SHARES[index - 1], SHARES[index]
            part = max(above - share, 0.0) / (above - below)
            return THRESHOLDS[index - 1] + part * (THRESHOLDS[index] - THRESHOLDS[index - 1])
    return THRESHOLDS[-1]


Halves = tuple[list[tuple[Numbers, Numbers]], Numbers, Numbers, Numbers]


def _halves(numbers: Numbers) -> Halves:
    """For `_total`: the halves of an array, those of its first half, and so on; what is left, as many ones, room."""
    found, size = [], numbers.size
    while size % 2 == 0:
        size //= 2
        found.append((numbers[:size], numbers[size : 2 * size]))
    return found, numbers[:size], np.ones(size, np.int32), np.empty((), np.int32)


def _total(halves: Halves) -> int:
    """Sum of an array, which it overwrites; NumPy's own takes memory each time."""
    pairs, left, ones, total = halves
    for first, second in pairs:
        np.add(first, second, out=first)
    np.matmul(left, ones, out=total)
    return int(total)


def _product(left: list[float], right: list[float]) -> float:
    """Inner product, term by term: `sum` of floats is compensated from Python 3.12 on."""
    total = 0.0
    for one, other in zip(left, right, strict=True):
        total += one * other
    return total


def _products(left: list[float], right: list[float]) -> list[float]:
    return [one * other for one, other in zip(left, right, strict=True)]


def _rest_rows(samples: int) -> int:
    return -(-samples // REST_SAMPLES)


_last: _Work | None = None


def _work(room: Writable, bank: _Responses) -> _Work:
    """The arrays of the last call, if it was of the same room: they take longer to make than to use."""
    global _last  # noqa: PLW0603
    told = bank.samples, bank.idle_word, bank.block_samples
    if _last is None or _last.room is not room or _last.told != told:
        _last = _Work(room, *told)
    return _last
