"""Selects the waveform for a set of points: an entry of the bank as it is, or responses composed.

A single point near a cell's centre at full amplitude plays the bank's entry without any arithmetic. Farther off, at a lower
amplitude, and for several points at once, responses are interpolated, summed and signed. Points are first rounded to a lattice
and amplitudes to steps, so that a finger at rest asks for the same waveform again and finds it resident in the FPGA.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Sequence
from math import floor
from typing import Final

from controller.device.bank.grid import TO_WHOLE, Grid
from controller.device.bank.reader import Bank
from controller.device.fpga.frames import ReadyFrames, Waveform
from controller.device.kernel import MAX_NULLS
from controller.device.waveforms.amplitude import AMPLITUDES, amplitude_step
from controller.device.waveforms.channel_test import chirp_words
from controller.device.waveforms.composition import Composer, Point
from controller.errors import BankError

# On the paper's plate; on others they go with the length of its waves (`Bank.wave_scale`)
LATTICE_M: Final = 0.25e-3  # at most 0.18 mm off: less than 1 % of the amplitude
REUSE_RADIUS_M: Final = 0.4e-3  # a waveform for a place this near serves as well: at most 2.5 % less amplitude (README.md)

FINER: Final = 8  # lattice of several points: what strong ones do to a faint one beside them changes within less than that
LatticePoint = tuple[int, int, int]  # x and y in lattice steps, amplitude in its steps below full
Key = int | tuple[LatticePoint, ...]  # a cell, or points on the lattice
NULL: Final = -1  # in place of a step of amplitude: a place that is kept still
CHANNEL: Final = -2  # in its place: no focus, but the test of the channel that stands in place of x
NULL_APART_M: Final = 9e-3  # a place nearer to a focus than this cannot be kept still, at least not for a bearable loss


class Selection:
    """Keys and drive words for points on the plate.

    A single point of full amplitude at most `snap_m` from a cell's centre plays that cell. Bit q of `idle_word` is the level of
    channel q at rest. `band_hz`, the board's, is for the test of a channel; None: none is tested. Unless `ready`, what the bank has
    composed beforehand is composed all the same.
    """

    def __init__(
        self, bank: Bank, snap_m: float, idle_word: int, band_hz: tuple[float, float] | None = None, *, ready: bool = True
    ) -> None:
        self._bank = bank
        self._grid: Grid = bank.grid
        self.lattice_m = LATTICE_M * bank.wave_scale  # distance of the points to which places are rounded
        self._null_apart_m = NULL_APART_M * bank.wave_scale
        self.reuse_m = REUSE_RADIUS_M * bank.wave_scale  # a waveform for a place this near serves as well
        self._compositions = bank.drive.compositions if ready else {}
        self._snap_m = snap_m
        self._idle_word = idle_word
        self._band_hz = band_hz
        self._composer: Composer | None = None

    @property
    def composes(self) -> bool:
        """Whether anything was composed so far; the bank's response section is mapped then."""
        return self._composer is not None

    def prepare(self) -> None:
        """Take the memory for composing, and map the responses, before playing begins.

        Raises BankError if the bank's first entry is damaged.
        """
        if not self._bank.composes:
            return
        if self._composer is None:
            self._composer = Composer(self._bank, self._idle_word)
        for x_m, y_m in self._bank.grid.points()[self._bank.cells].tolist():
            if self._bank.responses.has(x_m, y_m):
                self._composer.compose([(x_m, y_m, 1.0), (x_m, y_m, 0.5)])
                break

    def key(self, points: Sequence[Point]) -> Key:
        """Name of the waveform for these points (x_m, y_m, amplitude); equal keys have equal words.

        Raises ValueError if an amplitude is not above 0 and at most 1, or a place is NaN; OverflowError if a place is infinite.
        """
        if len(points) == 1:
            x_m, y_m, amplitude = points[0]
            step = 0 if amplitude == 1 else amplitude_step(amplitude)
            if step == 0:
                cell = self._grid.within(x_m, y_m, self._snap_m)
                if cell >= 0:
                    return cell
            lattice_m = self.lattice_m
            return ((floor(x_m / lattice_m + TO_WHOLE - TO_WHOLE), floor(y_m / lattice_m + TO_WHOLE - TO_WHOLE), step),)
        return lattice_key(points, self.lattice_m)

    def null_key(self, points: Sequence[Point], places: Sequence[tuple[float, float]]) -> Key:
        """Name of the waveform for points that leaves other places (x_m, y_m) still, at most four: those nearest to a point.

        Places within 9 mm of a point (on the paper's plate) are left as they are.

        Raises ValueError if an amplitude is not above 0 and at most 1.
        """
        apart = []
        for x_m, y_m in places:
            distance_m = min([math.hypot(x_m - to_x_m, y_m - to_y_m) for to_x_m, to_y_m, _ in points])
            if distance_m >= self._null_apart_m:
                apart.append((distance_m, x_m, y_m))
        if not apart:
            return self.key(points)
        apart.sort()
        finer_m = self.lattice_m / FINER
        still = _on_lattice([(x_m, y_m, 1.0) for _, x_m, y_m in apart[:MAX_NULLS]], finer_m)
        return (*_on_lattice(points, finer_m), *[(x, y, NULL) for x, y, _ in still])

    def channel_key(self, channel: int) -> Key:
        """Name of the waveform that tests a channel."""
        return ((channel, 0, CHANNEL),)

    def waveform(self, key: Key, polarities: bytearray | None = None) -> Waveform:
        """Waveform of a key: the bank's frames as they are, or composed drive words, which are valid until the next call.

        `polarities` as in `Composer.compose`.

        With frames comes the CRC-32 with which they were built, so that the FPGA finds whatever changed since. Points that the bank
        has composed beforehand are taken from there; if that is damaged, they are composed here.

        Raises BankError if an entry it needs is damaged or not in the bank, or the file was changed in place.
        """
        if isinstance(key, int):
            return ReadyFrames(*self._bank.drive.frames(key))
        if key[0][2] == CHANNEL:
            assert self._band_hz is not None
            return chirp_words(key[0][0], self._bank.samples, self._bank.header.bit_clock_hz, self._idle_word, self._band_hz)
        if key in self._compositions:
            with contextlib.suppress(BankError):
                return ReadyFrames(*self._bank.drive.composed(key))
        if self._composer is None:  # maps the response section: only scenes that need it pay for it
            self._composer = Composer(self._bank, self._idle_word)
        lattice_m = self._lattice_of(key)
        points = self.foci(key)
        words = self._composer.compose(points, polarities)
        if len(points) < len(key):
            self._composer.keep_still(points, [(x * lattice_m, y * lattice_m, 1.0) for x, y, step in key if step == NULL])
        self._bank.file.require_unchanged()
        return words

    def foci(self, key: tuple[LatticePoint, ...]) -> list[Point]:
        """Points that are composed for a key, as they lie on the lattice."""
        lattice_m = self._lattice_of(key)
        return [(x * lattice_m, y * lattice_m, AMPLITUDES[step]) for x, y, step in key if step != NULL]

    def _lattice_of(self, key: tuple[LatticePoint, ...]) -> float:
        return self.lattice_m if len(key) == 1 else self.lattice_m / FINER

    def recheck(self, key: Key) -> None:
        """Check the entry of a key again, of which the FPGA refused a frame or the words for a wrong CRC.

        Raises BankError if they are wrong in the bank.
        """
        if isinstance(key, int):
            self._bank.drive.recheck(key)
        else:
            self._bank.drive.recheck_composed(key)

    def reusable(self, key: Key, resident: Key) -> bool:
        """Whether a resident waveform serves instead of another: both of a single point, of one amplitude, within `reuse_m`."""
        wanted, there = self.single_focus(key), self.single_focus(resident)
        if wanted is None or there is None or wanted[2] != there[2]:
            return False
        return math.hypot(wanted[0] - there[0], wanted[1] - there[1]) <= self.reuse_m

    def single_focus(self, key: Key) -> tuple[float, float, int] | None:
        """Place (x_m, y_m) and amplitude step of a key of a single point; None for a key of several."""
        if isinstance(key, int):
            return (*self._grid.place(key), 0)
        if len(key) != 1:
            return None
        x, y, step = key[0]
        lattice_m = self.lattice_m
        return None if step == CHANNEL else (x * lattice_m, y * lattice_m, step)


def lattice_key(points: Sequence[Point], lattice_m: float) -> tuple[LatticePoint, ...]:
    """Points (x_m, y_m, amplitude) on a lattice of `lattice_m` for one point, `FINER` for several, in ascending order."""
    return _on_lattice(points, lattice_m if len(points) == 1 else lattice_m / FINER)


def _on_lattice(points: Sequence[Point], lattice_m: float) -> tuple[LatticePoint, ...]:
    lattice = []
    for x_m, y_m, amplitude in points:
        step = 0 if amplitude == 1 else amplitude_step(amplitude)
        lattice.append((floor(x_m / lattice_m + TO_WHOLE - TO_WHOLE), floor(y_m / lattice_m + TO_WHOLE - TO_WHOLE), step))
    lattice.sort()
    return tuple(lattice)
