"""Weights of the cells around a place, and how the error of rounding a cell is passed on to the next ones.

The responses of places at a distance r correlate as the mean of J0(k r) over the waves in them. The best linear weights solve the
normal equations of these correlations and of the noise of rounding (kriging). That noise is shaped: what is lost by rounding a
cell is taken from its neighbours, as far as their weights let it through least (error diffusion by the prediction error filter of
the weights' own correlations), and the weights are solved again for noise of that shape.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.special import j0

from controller.device.board.panel import Plate
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.bank_builder.compact.pulses import ROUNDING_NOISE

Floats = NDArray[np.float64]

STEPS: Final = 32  # of a pitch, to which places are rounded
WHOLE: Final = 8192  # what a weight of 1 is
REACH: Final = 3  # cells, over which errors are passed on
ROUNDS: Final = 6
SIZE: Final = 64  # of the torus on which correlations are kept
SPACINGS: Final = 3000  # of tabulated correlations
EXPECTED_AT: Final = 16  # places a pitch, for the error that is expected


@dataclass(frozen=True, eq=False)
class CompactStencil:
    """Weights of `across` x `across` cells around a place on a lattice of `STEPS` a pitch, and how errors are passed on."""

    across: int
    table: NDArray[np.int16]  # (y step, x step, cell): the other half is its mirror image
    passed_on: list[tuple[int, int, float]]  # rows and columns back to a cell, and the share of its error
    together: list[tuple[int, int, float]]  # rows and columns to another cell, and how much its error counts with that of this one
    error: tuple[float, float]  # expected square error over that of the response, mean and at the worst place


def stencil(plate: Plate, pitch_m: float, across: int, power: NDArray[Any], frequency_hz: NDArray[Any]) -> CompactStencil:
    """The stencil for waves whose `power` at each `frequency_hz` is given."""
    back = np.array([(dy, dx) for dy in range(-REACH, 1) for dx in range(-REACH, REACH + 1) if dy < 0 or dx < 0])
    y, x = np.divmod(np.arange(across**2), across)
    dy, dx = (y[:, None] - y) % SIZE, (x[:, None] - x) % SIZE
    number = 2 * np.pi / bending_wavelength_m(plate, 1.0) * np.sqrt(frequency_hz)
    far_m = np.linspace(0, 2 * across * pitch_m, SPACINGS)
    mean = j0(np.outer(far_m, number)) @ (power / power.sum())
    alike = np.interp(pitch_m * np.hypot(y[:, None] - y, x[:, None] - x), far_m, mean)

    def to_cells(at_y: Floats, at_x: Floats) -> Floats:
        found: Floats = np.interp(pitch_m * np.hypot(y[:, None] - at_y.ravel(), x[:, None] - at_x.ravel()), far_m, mean)
        return found

    low = (across - 1) // 2 - (0.5 if across % 2 else 0.0)
    middle = low + (np.arange(EXPECTED_AT) + 0.5) / EXPECTED_AT
    wanted = to_cells(*np.meshgrid(middle, middle, indexing="ij"))
    share, noise, weights, own = np.zeros(len(back)), np.zeros_like(alike), wanted, np.zeros((SIZE, SIZE))
    for _ in range(ROUNDS):
        noise = ROUNDING_NOISE * _shape(back, share)[dy, dx]
        weights = np.linalg.solve(alike + noise, wanted)
        own = np.zeros((SIZE, SIZE))
        np.add.at(own, (dy, dx), weights @ weights.T / weights.shape[1])
        between = (back[:, None] - back) % SIZE
        among = own[between[..., 0], between[..., 1]] + 1e-3 * own[0, 0] * np.eye(len(back))
        share = np.linalg.solve(among, own[back[:, 0] % SIZE, back[:, 1] % SIZE])
    noise = ROUNDING_NOISE * _shape(back, share)[dy, dx]
    left = 1 - 2 * (weights * wanted).sum(axis=0) + np.einsum("ip,ij,jp->p", weights, alike + noise, weights)
    half = np.arange((across - 1) * STEPS // 2 + 1) / STEPS
    table = np.linalg.solve(alike + noise, to_cells(*np.meshgrid(half, half, indexing="ij")))
    return CompactStencil(
        across,
        np.rint(table.T * WHOLE).astype(np.int16).reshape(len(half), len(half), across**2),
        [(int(row), int(column), float(part)) for (row, column), part in zip(back, share, strict=True)],
        [
            (int(row), int(column), float(own[row, column] / own[0, 0]))
            for row in range(1 - across, across)
            for column in range(1 - across, across)
            if row or column
        ],
        (float(left.mean()), float(left.max())),
    )


def _shape(back: NDArray[Any], share: Floats) -> Floats:
    """Correlations, on a torus, of errors that are passed on."""
    kept = np.zeros((SIZE, SIZE))
    kept[0, 0] = 1
    kept[back[:, 0] % SIZE, back[:, 1] % SIZE] = -share
    shaped: Floats = np.fft.ifft2(np.abs(np.fft.fft2(kept)) ** 2).real
    return shaped
