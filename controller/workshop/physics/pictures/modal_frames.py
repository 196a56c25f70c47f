"""Displacement of every mode at evenly spaced times of an emission: by recursion over blocks of bits, not bit by bit.

What a block of bits adds to the state of a pole by the block's end is a sum with the same weights for every block, so all blocks
are summed at once, and the recursion has one step for each. As exact as `modal_history` but for those sums, which are in float32.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from controller.workshop.physics.responses.modal_history import STATES_AT_ONCE
from controller.workshop.physics.responses.step_response import StepResponse

Floats = NDArray[np.float64]


def modal_frames(
    step: StepResponse, forces: Floats, volts: Floats, bit_period_s: float, every: int, first: int = 0
) -> Iterator[Floats]:
    """Displacement from rest at the end of the last bit and of each `every` bits before it, some frames after the others.

    `forces` (mode, 32) are in N per V, `volts` (bit, 32) above the level at rest, each held for one bit period, zero before. Frames
    at the ends of bits before `first` are left out. Yields (frame, mode) in m.
    """
    bits_at_once = max(1, STATES_AT_ONCE // step.poles.size)
    block = next(size for size in range(min(every, bits_at_once), 0, -1) if every % size == 0)
    lead = -len(volts) % block
    steps = np.concatenate([np.zeros((lead, volts.shape[1])), np.diff(volts, axis=0, prepend=np.zeros((1, volts.shape[1])))])
    ends = np.arange(block - 1, len(steps), block) - lead  # last bit of each block
    shown = (ends >= first) & ((len(volts) - 1 - ends) % every == 0)
    ages_s = np.arange(block, 0, -1) * bit_period_s
    of_block = step.residues * np.exp(np.outer(ages_s, step.poles))
    weights = of_block.real.astype(np.float32), of_block.imag.astype(np.float32)
    driver_weights = np.exp(np.outer(step.driver_poles, ages_s))
    turn, driver_turn = np.exp(step.poles * block * bit_period_s), np.exp(step.driver_poles * block * bit_period_s)[:, None]
    of_poles = forces[step.mode_of_pole].astype(np.float32)
    state, driver = np.zeros(step.poles.size, np.complex128), np.zeros((2, forces.shape[1]), np.complex128)
    at_once = max(1, bits_at_once // block)
    for start in range(0, len(ends), at_once):
        some = slice(start, start + at_once)
        stepped = steps[start * block : (start + at_once) * block]
        pushed = (stepped.astype(np.float32) @ of_poles.T).reshape(-1, block, step.poles.size)
        states = np.einsum("fbp,bp->fp", pushed, weights[0]) + 1j * np.einsum("fbp,bp->fp", pushed, weights[1])
        drivers = np.einsum("fbq,db->fdq", stepped.reshape(-1, block, forces.shape[1]), driver_weights)
        for k in range(len(states)):
            states[k] += turn * state
            drivers[k] += driver_turn * driver
            state, driver = states[k], drivers[k]
        if shown[some].any():
            here = shown[some]
            modal = step.by_mode(states[here].real.T).T + (volts[ends[some][here]] @ forces.T) * step.static
            for pole in range(2):
                modal += (drivers[here, pole].real @ forces.T) * step.driver_residues[:, pole].real
                modal -= (drivers[here, pole].imag @ forces.T) * step.driver_residues[:, pole].imag
            yield modal
