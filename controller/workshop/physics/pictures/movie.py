"""The plate over time (paper, fig. 6): displacement on a grid at evenly spaced times, from the state of all modes.

The state of the modes goes by blocks of bits, not bit by bit: what a block adds to the state of a pole by the block's end is a sum
with the same weights for every block, so all blocks are summed at once, and the recursion has one step for each. It is as exact as
`modal_history` but for those sums, which are in float32. Frames are two matrix products where shapes are products.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats, blocks
from controller.device.bank.packing import as_words
from controller.errors import ConfigError
from controller.workshop.physics.field import map_axis
from controller.workshop.physics.memory import BASE_BYTES, TABLE_BYTES, require
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.modal_history import STATES_AT_ONCE
from controller.workshop.physics.responses.step_response import StepResponse
from controller.workshop.physics.word_capture import volts_above_idle

Frames = NDArray[np.float32]

FRAMES = 151  # where no number is asked for
PERIODS = 13.5  # of the band's middle before and after T, where no window is asked for: 0.3 ms
MOST_FRAMES = 5000
LARGEST = 1280  # points along the longer side
WORKING_BYTES = 6 * 16.0 * STATES_AT_ONCE + 64e6  # states of poles, and frames that are not yet pictures


@dataclass(frozen=True, eq=False)
class Movie:
    """What is shown, and how much it is."""

    bits: NDArray[np.int64]  # (frame,): bits from the start of the emission at whose ends the plate is shown
    time_s: Floats  # (frame,): the same from T
    x_m: Floats  # x_m, y_m: (nx,), (ny,): grid
    y_m: Floats

    @classmethod
    def of(
        cls,
        twin: PlateTwin,
        # from_s, to_s: window from T; 0.3 ms before and after, in a band as the paper's. Before the emission the plate is
        # at rest
        from_s: float | None = None,
        to_s: float | None = None,
        step_s: float | None = None,  # from frame to frame, in whole bits; by default so that there are `frames`
        frames: int | None = None,  # `FRAMES` by default
    ) -> Self:
        """Frames of one emission; T is one of them.

        Raises ConfigError if the window does not contain T, or there are too many frames.
        """
        waveform = twin.board.waveform
        period_s, samples = waveform.bit_period_s, waveform.samples
        around_s = PERIODS / waveform.middle_hz
        first_s = max(-around_s if from_s is None else from_s, (1 - samples) * period_s)
        last_s = around_s if to_s is None else to_s
        if not (first_s <= 0 <= last_s <= 10.0):  # NaN too
            raise ConfigError(f"a movie from {first_s * 1e3:g} to {last_s * 1e3:g} ms does not show T = 0, or ends after 10 s")
        wanted = FRAMES if frames is None else frames
        if not 2 <= wanted <= MOST_FRAMES:
            raise ConfigError(f"a movie of {wanted} frames: from 2 to {MOST_FRAMES}")
        if step_s is None:
            step = max(1, int(np.ceil((last_s - first_s) / period_s / (wanted - 1) - 1e-9)))
        elif period_s * (1 - 1e-9) <= step_s <= last_s - first_s:
            step = round(step_s / period_s)
        else:
            longest_us = (last_s - first_s) * 1e6
            raise ConfigError(f"a step of {step_s * 1e6:g} us between frames: from {period_s * 1e6:g}, a bit, to {longest_us:g} us")
        before, after = int(-first_s / period_s + 1e-9) // step, int(last_s / period_s + 1e-9) // step
        if before + after + 1 > MOST_FRAMES:
            raise ConfigError(
                f"a movie of {before + after + 1} frames: at most {MOST_FRAMES}; take a longer step or a shorter window"
            )
        from_t = np.arange(-before, after + 1) * step
        spacing_m = max(twin.scale.map_step_m / 4, max(twin.modes.length_m, twin.modes.width_m) / LARGEST)
        axes = (map_axis(extent_m, spacing_m) for extent_m in (twin.modes.length_m, twin.modes.width_m))
        time_s: Floats = from_t * np.float64(period_s)
        return cls(samples - 1 + from_t, time_s, *axes)

    def bytes(self, modes: Modes) -> float:
        """Memory of a movie whose pictures are all kept until it is written, one byte a point."""
        pictures = float(len(self.bits) * self.x_m.size * self.y_m.size)
        of_modes = 8.0 * 80 * modes.count  # forces and shapes
        return BASE_BYTES + TABLE_BYTES + WORKING_BYTES + of_modes + 2 * pictures

    def frames(self, twin: PlateTwin, words: NDArray[np.uint32], memory_mb: float | None = None) -> Iterator[Frames]:
        """Displacement in m of some frames after the others, (frame, ny, nx) each, in float32.

        The words (sample,) are played from rest at the idle word, which follows them; `memory_mb` is the memory that it may take.
        Raises ConfigError if it takes more.
        """
        require(
            self.bytes(twin.modes), memory_mb, f"a movie of {len(self.bits)} frames of {self.x_m.size} x {self.y_m.size} points"
        )
        grid = PixelGrid.of(twin.modes, self.x_m, self.y_m)
        for amplitudes in self.amplitudes(twin, words):
            yield from (grid.sum(amplitudes[some]) for some in blocks(len(amplitudes), grid.at_once))

    def amplitudes(self, twin: PlateTwin, words: NDArray[np.uint32]) -> Iterator[Floats]:
        """Displacement of each mode in m at the frames, some after the others: (frame, mode)."""
        board = twin.board
        played = np.repeat(as_words(board.idle_word, words), int(self.bits[-1]) + 1, axis=0)
        count = min(len(words), len(played))
        played[:count] = words[:count]
        volts = volts_above_idle(board, played)
        every, first = int(self.bits[1] - self.bits[0]), int(self.bits[0])
        yield from modal_frames(twin.step, twin.forces, volts, board.waveform.bit_period_s, every, first)


@dataclass(frozen=True, eq=False)
class PixelGrid:
    """Sums over modes on a grid, for many frames at once."""

    modes: Modes
    x_m: Floats
    y_m: Floats
    along_x: Frames
    along_y: Frames
    at_once: int

    @classmethod
    def of(cls, modes: Modes, x_m: Floats, y_m: Floats) -> Self:
        """Factors of the shapes on the grid, once for all frames."""
        at_once = max(1, int(64e6 / (8 * x_m.size * y_m.size)))
        if modes.factors is None:
            return cls(modes, x_m, y_m, np.empty((0, 0), np.float32), np.empty((0, 0), np.float32), at_once)
        along_x, along_y = modes.factors.along_x(x_m), modes.factors.along_y(y_m)
        return cls(modes, x_m, y_m, along_x.astype(np.float32), along_y.astype(np.float32), at_once)

    def sum(self, amplitudes: Floats) -> Frames:
        """Displacement in m of frames with modal `amplitudes`, (frame, mode): (frame, ny, nx)."""
        if self.modes.factors is None:
            return np.stack([self.modes.on_grid(of_frame, self.x_m, self.y_m).astype(np.float32) for of_frame in amplitudes])
        by_factors = self.by_factors(amplitudes)
        rows = by_factors.reshape(-1, by_factors.shape[2]) @ self.along_x.T
        return self.along_y @ rows.reshape(len(amplitudes), -1, self.x_m.size)

    def by_factors(self, amplitudes: Floats) -> Frames:
        """Amplitudes by the factors of their shapes: (frame, factor along y, factor along x)."""
        factors = self.modes.factors
        assert factors is not None
        matrices = np.zeros((len(amplitudes), self.along_y.shape[1], self.along_x.shape[1]), np.float32)
        matrices[:, factors.y_index, factors.x_index] = amplitudes
        return matrices


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
