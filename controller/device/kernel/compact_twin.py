"""Responses of a compact bank, in NumPy: the specification of the compiled kernel, as `words_twin` is.

A cell has weights of pulses in place of samples, in four bits, with a scale for each channel and one of four bits for each block of
its weights. A place is
served by `across` x `across` cells, whose shares are tabulated. Sums of weights times pulses ("taps") are even samples; odd ones
lie between four of these. What the band leaves out has cells, weights and pulses of its own; but what a slope leaves out within the
band is made of the band: each row is a share of its two samples, and one of those a quarter of a wave before and after.

All that reaches a sample is whole numbers of 16 bits, which go round beyond; shifts round down, but for the half of a sum between
two samples. What they drop is given back: a bit that is always lost moves nothing by itself, but is the same for thousands of bits,
and a faint finger beside strong ones was off by a fifth.
"""

from __future__ import annotations

import math
import struct
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[Any]

CHANNELS: Final = 32
# in the band and beside it: cells across a stencil, its steps a pitch, weights, weights of a block, taps; then taps of odd samples;
# cells of the rest along x and y; their pitch, x and y of the first in m
HEAD: Final = struct.Struct("<14i3d")
# behind it: samples from the own two of a row to the outer two, tap of the sum of the own, of the outer
OF_BAND: Final = struct.Struct("<3i")
TABLES_AT: Final = 128
LINE: Final = 64
LOUDEST: Final = 15  # levels are the odd numbers from -15 to 15
SHARE_SUM: Final = 2130  # of all cells' absolute shares: times 15, with all roundings, it is within 16 bits
TAP_BITS: Final = 15
SCALED_BITS: Final = 6  # dropped of a share times the scale of a channel, and of that times the scale of a block
EVEN_BEYOND: Final = 2  # even samples beyond the last, between which odd ones lie
MIN_ACROSS: Final = 2
MAX_ACROSS: Final = 6
MAX_WEIGHTS: Final = 1024
MAX_TAPS: Final = 16
MAX_STEPS: Final = 64
MAX_APART: Final = 256  # samples
LARGEST_OF_BAND: Final = 24_000  # taps together
# Channels in the order in which they are kept: as 16 bytes of four-bit numbers fall into four vectors of 16 bits
ORDER: Final = np.array([first + 2 * lane for first in (0, 1, 16, 17) for lane in range(8)])


def row_bytes(weights: int, block_rows: int) -> int:
    """Bytes of the weights of a cell, and their scales."""
    return (weights + -(-weights // block_rows)) * CHANNELS // 2 + CHANNELS


def packed(numbers: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Numbers of 0 to 15 (weight, 32) as bytes: each 16 bits have channels 2 n, 2 n + 1, 16 + 2 n, 17 + 2 n, lowest first."""
    four = numbers[:, ORDER].reshape(-1, 4, 8).astype("<u2")
    found: NDArray[np.uint8] = (
        np.ascontiguousarray(four[:, 0] | four[:, 1] << 4 | four[:, 2] << 8 | four[:, 3] << 12).view(np.uint8).ravel()
    )
    return found


def unpacked(numbers: NDArray[np.uint8]) -> NDArray[np.int32]:
    """The reverse of `packed`: (weight, 32)."""
    fours = numbers.view("<u2").reshape(-1, 1, 8) >> np.array([0, 4, 8, 12], "<u2")[:, None] & 15
    found = np.empty((len(fours), CHANNELS), np.int32)
    found[:, ORDER] = fours.reshape(-1, CHANNELS)
    return found


class PulseLayer(NamedTuple):
    """What is said of the band, or of what it leaves out."""

    across: int
    steps: int
    weights: int
    block_rows: int
    taps: int


class OfBand(NamedTuple):
    """What of the rest is made of the band: nothing, unless the band has a slope."""

    apart: int = 0
    own: int = 0
    outer: int = 0

    @property
    def there(self) -> bool:
        """Whether there is such a part."""
        return self.own != 0 or self.outer != 0

    @property
    def possible(self) -> bool:
        """Whether each number is within its range."""
        taps = abs(self.own), abs(self.outer)
        return 0 <= self.apart <= MAX_APART and max(taps) < 1 << 14 and sum(taps) <= LARGEST_OF_BAND

    def rows(self, samples: Numbers) -> Numbers:
        """What it adds to rows of the rest, (row, 32), of samples (sample, 32) in 16 bits."""
        own, outer = (sums.astype(np.int32) for sums in self.pairs(samples))
        dropped = (own | outer) != 0  # half of a bit each, on average
        rows: Numbers = (own * self.own >> TAP_BITS) + (outer * self.outer >> TAP_BITS) + dropped
        return rows.astype(np.int16)

    def pairs(self, samples: Numbers) -> tuple[Numbers, Numbers]:
        """Sums of the own two samples (.., sample, 32) of each row, and of the outer two; there is nothing beyond the ends."""
        before, count = self.apart, samples.shape[-2]
        padded = np.pad(samples, [(0, 0)] * (samples.ndim - 2) + [(before, before + 1), (0, 0)])
        first, last = slice(before, before + count, 2), slice(before + 1, before + 1 + count, 2)
        return (
            padded[..., first, :] + padded[..., last, :],
            padded[..., 0:count:2, :] + padded[..., 2 * before + 1 : 2 * before + 1 + count : 2, :],
        )


class CompactTables:
    """What a compact bank has for all its cells. Raises ValueError if it is not as it should be."""

    def __init__(self, given: bytes | bytearray | memoryview, samples: int, rest_rows: int) -> None:
        view = memoryview(given).cast("B")
        if view.nbytes < TABLES_AT:
            raise ValueError("the tables of a compact bank are too short")
        numbers = HEAD.unpack_from(view)
        self.in_band, self.rest = PulseLayer(*numbers[:5]), PulseLayer(*numbers[5:10])
        self.odd_near, self.odd_far, self.rest_nx, self.rest_ny = numbers[10:14]
        self.pitch_m, self.x0_m, self.y0_m = numbers[14:]
        self.of_band = OfBand(*OF_BAND.unpack_from(view, HEAD.size))
        even = samples // 2 + EVEN_BEYOND
        if not (
            all(_possible(layer) for layer in (self.in_band, self.rest))
            and all(0 <= tap < 1 << 14 for tap in (self.odd_near, self.odd_far))
            and self.of_band.possible
            and self.rest.across <= min(self.rest_nx, self.rest_ny)
            and max(self.rest_nx, self.rest_ny) < 1 << 15
            and 0 < self.pitch_m < math.inf
            and math.isfinite(self.x0_m)
            and math.isfinite(self.y0_m)
        ):
            raise ValueError("a number of the compact bank's tables is beyond its range")
        self._view, self._at = view, TABLES_AT
        self.stencil, self.pulses = self._layer(self.in_band, even)
        self.rest_stencil, self.rest_pulses = self._layer(self.rest, rest_rows)
        cells = self.rest_nx * self.rest_ny
        self.rest_scales = self._take("<f4", cells)
        self.rest_row_bytes = row_bytes(self.rest.weights, self.rest.block_rows)
        self.rest_rows = self._take("u1", cells * self.rest_row_bytes).reshape(cells, -1)
        if not (np.isfinite(self.rest_scales) & (self.rest_scales >= 0)).all():
            raise ValueError("a scale of the compact bank's rest is not finite, or below 0")

    def _layer(self, layer: PulseLayer, outputs: int) -> tuple[Numbers, Numbers]:
        half = (layer.across - 1) * layer.steps // 2 + 1
        stencil = self._take("<i2", half * half * layer.across**2).reshape(half, half, layer.across, layer.across)
        pulses = self._take("<i2", outputs * (1 + layer.taps)).reshape(outputs, -1)
        if (pulses[:, 0] < 0).any() or (pulses[:, 0] > layer.weights - layer.taps).any():
            raise ValueError("a pulse of the compact bank is beyond its weights")
        if (np.abs(pulses[:, 1:].astype(np.int32)).sum(axis=1) >= 1 << (TAP_BITS - 1)).any():
            raise ValueError("the taps of the compact bank are too large")
        return stencil, pulses

    def _take(self, kind: str, count: int) -> Numbers:
        size = count * np.dtype(kind).itemsize
        if self._at + size > self._view.nbytes:
            raise ValueError("the tables of a compact bank are too short")
        found = np.frombuffer(self._view, kind, count, self._at)
        self._at += -(-size // LINE) * LINE
        return found


def tables_bytes(layers: tuple[PulseLayer, PulseLayer], outputs: tuple[int, int], rest_cells: int) -> int:
    """Bytes of the tables."""
    total = TABLES_AT
    for layer, count in zip(layers, outputs, strict=True):
        half = (layer.across - 1) * layer.steps // 2 + 1
        for size in (2 * half * half * layer.across**2, 2 * count * (1 + layer.taps)):
            total += -(-size // LINE) * LINE
    rest = row_bytes(layers[1].weights, layers[1].block_rows)
    return total + sum(-(-size // LINE) * LINE for size in (4 * rest_cells, rest * rest_cells))


def _possible(layer: PulseLayer) -> bool:
    return (
        MIN_ACROSS <= layer.across <= MAX_ACROSS
        and 2 <= layer.steps <= MAX_STEPS
        and layer.steps % 2 == 0
        and 1 <= layer.taps <= min(layer.weights, MAX_TAPS)
        and layer.weights <= MAX_WEIGHTS
        and 1 <= layer.block_rows <= layer.weights
    )


def along(distance_m: float, pitch_m: float, count: int, layer: PulseLayer) -> tuple[int, float]:
    """First cell of a stencil along one axis, and steps of the place beyond it; places outside the grid are moved into it."""
    steps, last = distance_m / pitch_m * layer.steps, float((count - 1) * layer.steps)
    steps = 0.0 if not steps > 0 else min(steps, last)
    first = (int(steps) + (layer.steps // 2 if layer.across % 2 else 0)) // layer.steps - (layer.across - 1) // 2
    first = min(max(first, 0), count - layer.across)
    return first, steps - first * layer.steps


def shares(stencil: Numbers, layer: PulseLayer, x_steps: float, y_steps: float) -> Numbers:
    """Shares of the cells around a place, (across, across): between those of the four steps around it, linear along both axes."""
    all_steps = (layer.across - 1) * layer.steps
    x, y = min(int(x_steps), all_steps - 1), min(int(y_steps), all_steps - 1)
    right, up = x_steps - x, y_steps - y
    found: Numbers = (1 - up) * (1 - right) * _shares_at(stencil, all_steps, x, y)
    found += (1 - up) * right * _shares_at(stencil, all_steps, x + 1, y)
    found += up * (1 - right) * _shares_at(stencil, all_steps, x, y + 1)
    found += up * right * _shares_at(stencil, all_steps, x + 1, y + 1)
    return found


def _shares_at(stencil: Numbers, all_steps: int, x: int, y: int) -> Numbers:
    rows, columns = (slice(None, None, -1 if 2 * steps > all_steps else 1) for steps in (y, x))
    mirrored: Numbers = stencil[min(y, all_steps - y), min(x, all_steps - x)][rows, columns].astype(np.float64)
    return mirrored


def outputs(rows: list[tuple[Numbers, int]], layer: PulseLayer, pulses: Numbers, turned: Numbers) -> Numbers:
    """Sums of the pulses of some cells, (output, 32), each cell's row of bytes with its whole share; negated where turned."""
    level_bytes = layer.weights * CHANNELS // 2
    total, driven = np.zeros((layer.weights, CHANNELS), np.int32), np.zeros(CHANNELS, bool)
    for row, share in rows:
        base = np.empty(CHANNELS, np.int32)
        base[ORDER] = row[level_bytes : level_bytes + CHANNELS]
        scaled = (share * base >> SCALED_BITS) * (1 - 2 * turned)
        driven |= scaled != 0
        weight = scaled * (1 + unpacked(row[level_bytes + CHANNELS :])) >> SCALED_BITS
        levels = 2 * unpacked(row[:level_bytes]) - LOUDEST
        total += np.repeat(weight, layer.block_rows, axis=0)[: layer.weights] * levels
    found = np.tile(driven * np.int32(layer.taps // 2), (len(pulses), 1))  # what shifts drop: half of a bit each, on average
    for tap in range(layer.taps):
        found += total[pulses[:, 0] + tap] * pulses[:, 1 + tap : 2 + tap].astype(np.int32) >> TAP_BITS
    return found


def samples_of(even: Numbers, samples: int, near: int, far: int) -> Numbers:
    """Samples (sample, 32) from even ones."""
    found = np.zeros((samples, CHANNELS), np.int32)
    found[::2] = even[: (samples + 1) // 2]
    count = samples // 2
    before = np.concatenate([np.zeros((1, CHANNELS), np.int32), even])
    inner, outer = even[:count] + even[1 : count + 1], before[:count] + even[2 : count + 2]
    found[1::2] = (inner + 1 >> 1) + (inner * near >> TAP_BITS) - (outer * far >> TAP_BITS)
    return found
