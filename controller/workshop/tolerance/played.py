"""What drive words move on a plate whose channels differ: each has a stage, a capacitance and a moment of its own.

Each mode is stepped exactly over the bit periods, as everywhere (`responses/step_response.py`). The sum over samples is one matrix
product for all channels and emissions: of exponentials of the plate's poles, (sample, pole), which do not depend on the channel,
and voltages, (sample, channel and emission). What the stage of a channel does to each pole is a factor of the product.
"""

from dataclasses import dataclass
from typing import Self

import msgspec
import numpy as np
from numpy.typing import NDArray

from controller.arrays import Complex, Floats, Indices
from controller.device.board.board import Board
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import StepResponse, channel_forces

BLOCK = 32  # samples: exponentials are products of those at the blocks' starts and those within a block


@dataclass(frozen=True, eq=False)
class PlayedPlate:
    """Partial fractions of every mode on every channel that has a patch."""

    channels: Indices  # (channel,)
    step: StepResponse  # of the board's own stage: poles, and which mode they belong to
    pole_gain: Complex  # (channel, pole): m per V after a unit step
    driver_poles: Complex  # (channel, 2)
    driver_gain: Complex  # (channel, mode, 2): m per V

    @classmethod
    def of(cls, board: Board, modes: Modes, gain: Floats, capacitance: Floats) -> Self:
        """The plate of a board with `modes`; moments and capacitances of its channels, (32,) both, are over the board's."""
        forces = channel_forces(board, modes) * gain
        channels = np.sort([actuator.channel for actuator in board.actuators])
        steps: dict[float, StepResponse] = {}
        for share in {1.0, *capacitance[channels].tolist()}:
            driver = msgspec.structs.replace(board.driver, capacitance_f=board.driver.capacitance_f * share)
            steps[share] = StepResponse.of(modes, DriverResponse.of(driver))
        own = steps[1.0]
        each = [(steps[float(capacitance[channel])], forces[:, channel]) for channel in channels]
        return cls(
            channels=channels,
            step=own,
            pole_gain=np.array([step.residues * force[own.mode_of_pole] for step, force in each]),
            driver_poles=np.array([step.driver_poles for step, _ in each]),
            driver_gain=np.array([step.driver_residues * force[:, None] for step, force in each]),
        )

    def modal(self, volts: Floats, bit_period_s: float) -> Floats:
        """Displacement of each mode at T, in m, by emissions of some voltages, (emission, sample, 32): (emission, mode).

        In single precision, 1e-6 of the largest.
        """
        driven = volts[:, :, self.channels].transpose(0, 2, 1)
        emissions, channels, samples = driven.shape
        poles = self.step.poles
        since = _exponentials(poles * bit_period_s, samples)
        flat = np.ascontiguousarray(driven, np.float32).reshape(-1, samples)
        summed = (flat @ since.view(np.float32)).view(np.complex64).reshape(emissions, channels, len(poles))
        gain = self.pole_gain * np.expm1(poles * bit_period_s)
        modal: Floats = self.step.by_mode(np.einsum("ecp,cp->pe", summed, gain, optimize=True).real.astype(np.float64))
        decay = np.exp(np.multiply.outer(np.arange(samples - 1, -1, -1) * bit_period_s, self.driver_poles))  # (sample, channel, 2)
        settled = np.einsum("ecn,ncd->ecd", driven, decay, optimize=True) * np.expm1(self.driver_poles * bit_period_s)
        modal += np.einsum("ecd,cmd->me", settled, self.driver_gain, optimize=True).real
        return modal.T


def _exponentials(exponent: Complex, samples: int) -> NDArray[np.complex64]:
    """exp(exponent * n) for n from `samples` - 1 down to 0, (sample, pole): phases in double precision."""
    blocks = -(-samples // BLOCK)
    starts = np.exp(np.multiply.outer(np.arange(blocks) * BLOCK, exponent)).astype(np.complex64)
    within = np.exp(np.multiply.outer(np.arange(BLOCK), exponent)).astype(np.complex64)
    rising = (starts[:, None] * within).reshape(blocks * BLOCK, -1)[:samples]
    return np.ascontiguousarray(rising[::-1])
