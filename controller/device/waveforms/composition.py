"""Drive words for several points at once, for points between cells, and for less than full amplitude.

The arithmetic is the kernel's, on whole numbers: `controller.device.kernel.words_twin` says what is computed.
"""

from __future__ import annotations

from array import array
from collections.abc import Sequence

from controller.device import kernel
from controller.device.bank.packing import CHANNELS
from controller.device.bank.reader import Bank
from controller.device.kernel import MAX_FOCI, MAX_SAMPLES, Point
from controller.device.kernel.bank_twin import STEPS_PER_BLOCK
from controller.device.kernel.null_twin import RING
from controller.errors import BankError

__all__ = ["MAX_FOCI", "Composer", "Point"]

BLOCK_S = 96e-6  # over which the local strength of a response is taken
EQUALISER_S = BLOCK_S / STEPS_PER_BLOCK  # between the taps of an equaliser


def block_samples(bit_clock_hz: float) -> int:
    """Samples of `BLOCK_S`, in groups of the kernel."""
    groups = round(BLOCK_S * bit_clock_hz / kernel.GROUP_SAMPLES)
    return min(max(kernel.GROUP_SAMPLES * groups, kernel.GROUP_SAMPLES), kernel.MAX_BLOCK_SAMPLES)


class Composer:
    """Composes drive words from a bank's responses in memory taken once.

    The response section of the bank is mapped with the first composition; bit q of `idle_word` is the level of channel q at rest.
    Raises BankError if the bank's waveforms are longer than can be composed; ValueError if the idle word is not 32 bits.
    """

    def __init__(self, bank: Bank, idle_word: int) -> None:
        if not 0 <= idle_word < 1 << CHANNELS:
            raise ValueError(f"idle word {idle_word:#x} is not {CHANNELS} bits")
        if bank.samples > MAX_SAMPLES:
            raise BankError(f"{bank.path}: waveforms of {bank.samples} samples cannot be composed, at most {MAX_SAMPLES}")
        common = bank.responses.common
        grid = bank.grid
        self._bank = bank
        entries, scales, good = bank.responses.tables()
        plan = kernel.PLAN.pack(
            bank.samples,
            bank.sections["response"].stride,
            grid.nx,
            grid.ny,
            len(scales),
            idle_word,
            block_samples(bank.header.bit_clock_hz),
            grid.pitch_m,
            grid.x0_m,
            grid.y0_m,
            bank.header.equaliser,
            bank.header.band_lost,
        )
        tables = memoryview(array("i", entries)), memoryview(array("f", scales))
        self._buffers = kernel.BankBuffers(plan, *tables, good, b"", common)  # the responses follow once their section is mapped
        self._room = bytearray(kernel.room_bytes(bank.samples))
        self._words = bytearray(4 * bank.samples)
        self._view = memoryview(self._words).toreadonly()

    def compose(self, points: Sequence[Point], polarities: bytearray | None = None) -> memoryview:
        """Drive words that make every point jump at T, up or down, whichever lets all of them jump farther.

        Points within 2.8 mm of each other (at the simulated board's wavelength) are one place and get the smallest of their
        amplitudes. No point gets more than it asks for.

        `polarities` are `MAX_FOCI` signed bytes: as another composer left them, where this one drives further patches of the same
        plate; all 0: chosen here.

        There are 1 to `MAX_FOCI` points; those beyond the outermost cells take the nearest place among the cells. Returns 4 bytes a
        sample, as they go to the wire; valid until the next call. Raises BankError if a cell that a point needs is not in the bank,
        or damaged; ValueError if there are no points or too many, or numbers that are not finite or beyond their range.
        """
        responses = self._bank.responses
        if not self._buffers.response:
            self._buffers = self._buffers._replace(response=responses.section)
        if polarities is None:
            while (cell := kernel.compose(self._words, self._room, self._buffers, points)) >= 0:
                responses.check(cell)
            return self._view
        while (cell := kernel.compose(self._words, self._room, self._buffers, points, polarities)) >= 0:
            responses.check(cell)
        return self._view

    def keep_still(self, points: Sequence[Point], nulls: Sequence[Point]) -> None:
        """Change the words that `compose` gave for these points, so that other places stay still near T.

        At most `MAX_NULLS` places, of any amplitude above 0; those without responses in the bank are left out. Raises BankError if
        a response is damaged; ValueError if there are too many places, or numbers that are not finite or beyond their range.
        """
        responses = self._bank.responses
        there = [place for place in nulls if all(responses.has(place[0] + x_m, place[1] + y_m) for x_m, y_m in RING)]
        if not there:
            return
        while (cell := kernel.null_places(self._words, self._room, self._buffers, points, there)) >= 0:
            responses.check(cell)
