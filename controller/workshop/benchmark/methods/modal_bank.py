"""Modal bank: mode shapes and couplings in place of a grid of cells, evaluated anywhere on the plate.

The sum over fingers is taken on the modes, so several cost hardly more than one. Two forms: straight to the 1,000 samples, or to
the complex weights of `baseband` first. What is stored for a panel is one coupling for each mode and channel; the responses of
the modes to a pulse follow from their frequencies.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Words
from controller.device.bank.packing import drive_words
from controller.device.kernel import Point
from controller.workshop.benchmark.methods.baseband import pulse_matrix
from controller.workshop.benchmark.methods.candidate import Candidate, wire_bytes
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.physics.responses.impulse_response import ResponseModel

Floats = NDArray[np.float32]
SHARES = (1.0, 0.999, 0.99, 0.95)  # of the energy of all modes that the kept ones have
DECIMATION = 7
AUDIBLY_NONE = 1e-9  # share of the strongest mode: outside the band


def candidates(laboratory: Laboratory) -> Iterator[Candidate]:
    """All of them."""
    board = laboratory.board
    pulses = pulse_matrix(board.waveform, DECIMATION)
    for name, synthesis in (("modal bank", None), ("modal bank, baseband", pulses)):
        for share in SHARES:
            bank = ModalBank(laboratory.model, share, board.idle_word, synthesis)
            yield Candidate(
                curve=name,
                setting=f"{bank.modes} modes",
                compose=bank,
                memory_bytes=bank.memory_bytes,
                wire_bytes=wire_bytes(board.waveform.samples),
            )


class ModalBank:
    """Drive words from modes.

    The strongest modes are kept that have `energy_share` of the energy of all; `pulses` (sample, weight) are of
    `baseband.pulse_matrix`.
    """

    def __init__(self, model: ResponseModel, energy_share: float, idle_word: int, pulses: NDArray[np.float64] | None) -> None:
        plate = model.plate_modes
        of_kernel = (model.modal_band**2).sum(axis=1)
        energy = of_kernel * (model.forces**2).sum(axis=1)
        strongest = np.argsort(-energy)
        cumulative = np.cumsum(energy[strongest]) / energy.sum()
        count = (
            int(np.searchsorted(cumulative, energy_share)) + 1
            if energy_share < 1
            else int((energy > AUDIBLY_NONE * energy.max()).sum())
        )
        kept = np.sort(strongest[:count])
        self.modes = len(kept)  # kept
        self._idle_word = idle_word
        self._plate = plate
        self._kept = kept
        self._energy = energy[kept].astype(np.float32)
        self._couplings: Floats = model.forces[kept].astype(np.float32)
        kernel = np.ascontiguousarray(model.modal_band[kept, ::-1].T)
        self._pulses: Floats | None = None
        if pulses is not None:
            self._pulses = pulses.astype(np.float32)
            kernel = np.linalg.pinv(pulses) @ kernel
        scale = np.abs(kernel).max()  # m/N: too small for float32 squares otherwise
        self._kernel: Floats = np.ascontiguousarray(kernel / scale, np.float32)
        # couplings, and the factors of the products
        self.memory_bytes = self._couplings.nbytes + self._kernel.nbytes + (0 if self._pulses is None else self._pulses.nbytes)

    def __call__(self, points: Sequence[Point]) -> Words:
        """Drive words for points of full amplitude."""
        shapes = self._plate.shapes([point[:2] for point in points])[:, self._kept]
        sizes = np.sqrt(shapes**2 @ self._energy)  # proportional to the sum of absolute values, nearly
        combined = (shapes / np.maximum(sizes, 1e-30)[:, None]).sum(axis=0)
        total = self._kernel @ (self._couplings * combined[:, None].astype(np.float32))
        if self._pulses is not None:
            total = self._pulses @ total
        return drive_words(total, self._idle_word)
