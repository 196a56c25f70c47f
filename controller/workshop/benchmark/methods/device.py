"""What the device does today: entries of the bank, responses composed by the kernel, shorter emissions, resident waveforms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np

from controller.device import kernel
from controller.device.bank.reader import Bank
from controller.device.kernel import Point, unpack_loads, words_twin
from controller.device.waveforms.composition import Composer
from controller.device.waveforms.selection import Selection
from controller.workshop.benchmark.methods.candidate import RESIDENT_WIRE_BYTES, Candidate, Place, Words, wire_bytes
from controller.workshop.benchmark.methods.laboratory import Laboratory

CELL_PITCHES_MM = (1.0, 2.5, 5.0, 10.0)
PITCHES_MM = (1.0, 2.5, 5.0)
SHARES = (0.25, 0.5, 0.75, 1.0)  # of the board's emission


def candidates(laboratory: Laboratory) -> Iterator[Candidate]:
    """All of them."""
    board = laboratory.board
    samples = board.waveform.samples
    for pitch_mm in CELL_PITCHES_MM:
        bank = laboratory.bank(pitch_mm * 1e-3)
        drive_bytes = bank.grid.cells * bank.sections["drive"].stride
        yield Candidate(
            "nearest entry", f"{pitch_mm:g} mm", NearestEntry(bank), drive_bytes, wire_bytes(samples), 1, words_of=_unpacked
        )
    for pitch_mm in PITCHES_MM:
        bank = laboratory.bank(pitch_mm * 1e-3)
        memory = bank.grid.cells * (bank.sections["drive"].stride + bank.sections["response"].stride)
        composer = Composer(bank, board.idle_word)
        setting = f"{pitch_mm:g} mm"
        if kernel.COMPILED:
            yield Candidate("device, compiled kernel", setting, composer.compose, memory, wire_bytes(samples), free_polarity=True)
        yield Candidate(
            "device, NumPy twin", setting, TwinComposer(bank, board.idle_word), memory, wire_bytes(samples), free_polarity=True
        )
        if pitch_mm == board.bank.pitch_mm:
            for share in SHARES:
                last = round(share * samples)
                label = f"{1e3 * last / board.waveform.bit_clock_hz:g} ms"
                compose = composer.compose if last == samples else Shorter(composer, last)
                yield Candidate("device, shorter emission", label, compose, memory, wire_bytes(last), free_polarity=True)
            yield Candidate(
                "device, another finger still",
                setting,
                KeepingStill(composer),
                memory,
                wire_bytes(samples),
                free_polarity=True,
                keeps_nulls=True,
            )
            selection = Selection(bank, board.bank.snap_mm * 1e-3, board.idle_word)
            yield Candidate(
                "resident waveform",
                f"{1e3 * selection.lattice_m:g} mm lattice",
                Resident(selection, composer),
                memory,
                RESIDENT_WIRE_BYTES,
                free_polarity=True,
                words_of=partial(_of_lattice, selection.lattice_m),
            )


class NearestEntry:
    """The frames of the cell nearest to a single point."""

    def __init__(self, bank: Bank) -> None:
        self._bank = bank

    def __call__(self, points: Sequence[Point]) -> memoryview:
        """LOAD frames of the cell."""
        ((x_m, y_m, _),) = points
        return self._bank.drive.frames(self._bank.grid.nearest(x_m, y_m)[0])[0]


def _unpacked(frames: memoryview) -> Words:
    samples = next(count for count in range(1, kernel.MAX_SAMPLES) if kernel.load_frames_bytes(4 * count) == len(frames))
    words = bytearray(4 * samples)
    unpack_loads(words, frames)
    return np.frombuffer(words, "<u4").astype(np.uint32)


class TwinComposer:
    """`Composer` with the NumPy twin of the kernel, whether or not there is a compiled one."""

    def __init__(self, bank: Bank, idle_word: int) -> None:
        self._bank, self._composer = bank, Composer(bank, idle_word)

    def __call__(self, points: Sequence[Point]) -> bytearray:
        """Drive words as bytes."""
        own, bank = self._composer, self._bank
        buffers = own._buffers._replace(response=bank.responses.section)
        while (cell := words_twin.compose(own._words, own._room, buffers, points)) >= 0:  # what `Composer` gives to its kernel
            bank.responses.check(cell)
        return own._words


class KeepingStill:
    """`Composer` with a place that stays still near T, as for a finger that shall feel nothing."""

    def __init__(self, composer: Composer) -> None:
        self._composer = composer

    def __call__(self, points: Sequence[Point], nulls: Sequence[Place]) -> memoryview:
        """Drive words as bytes."""
        words = self._composer.compose(points)
        self._composer.keep_still(points, [(x_m, y_m, 1.0) for x_m, y_m in nulls])
        return words


class Shorter:
    """Only the end of a composed waveform is sent: the waves have less time to build up."""

    def __init__(self, composer: Composer, samples: int) -> None:
        self._composer, self._from_byte = composer, -4 * samples

    def __call__(self, points: Sequence[Point]) -> memoryview:
        """Drive words as bytes."""
        return self._composer.compose(points)[self._from_byte :]


class Resident:
    """The FPGA still holds the waveform of the same points on the lattice: only its key is found again."""

    def __init__(self, selection: Selection, composer: Composer) -> None:
        self._selection, self._composer = selection, composer
        self._held: dict[Any, int] = {}

    def __call__(self, points: Sequence[Point]) -> tuple[Composer, Sequence[Point], int]:
        """Slot of the waveform."""
        key = self._selection.key(points)
        return self._composer, points, self._held.setdefault(key, len(self._held))


def _of_lattice(lattice_m: float, found: tuple[Composer, Sequence[Point], int]) -> Words:
    """Words that were composed for the lattice's points when they were uploaded."""
    composer, points, _ = found
    rounded = [(round(x_m / lattice_m) * lattice_m, round(y_m / lattice_m) * lattice_m, share) for x_m, y_m, share in points]
    return np.frombuffer(composer.compose(rounded), "<u4").astype(np.uint32)
