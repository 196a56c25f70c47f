"""How much memory a plate's responses take, reported before it is taken: what cannot fit is refused, not swapped."""

import numpy as np

from controller.device.bank.file_format import REST_SAMPLES
from controller.device.board.panel import CHANNELS
from controller.errors import ConfigError
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.impulse_response import POINTS_PER_GEMM
from controller.workshop.physics.responses.modal_response import WORKING_BYTES
from controller.workshop.physics.sound import radiation_bytes

POINTS_LOADED = 16  # at once
DEFAULT_MB = 1500.0  # of 10^6 bytes; a plate with as many modes as are computed with (`closed_form.MAX_MODES`) needs less
BASE_BYTES = 140e6  # Python, NumPy, SciPy, Matplotlib and the buffers of the linear algebra
TABLE_BYTES = 128e6  # of a table of the twin that is kept; a larger one is computed in parts, each time


def entries_bytes(modes: Modes, samples: int, cells: int) -> float:
    """Bytes in which the entries of `cells` cells are computed at once, in float32."""
    rows = samples + -(-samples // REST_SAMPLES)
    kernel = 4.0 * rows * modes.count
    if modes.factors is None:  # the sum over all modes at some points at once
        summed = 4.0 * POINTS_PER_GEMM * (rows * CHANNELS + (CHANNELS + 3) * modes.count)
    else:
        summed = 4.0 * rows * CHANNELS * float(modes.factors.x_index.max() + 1)
    forces = (8 + 4 + 4) * CHANNELS * modes.count
    return BASE_BYTES + WORKING_BYTES + 2 * kernel + summed + forces + cell_bytes(samples) * cells


def cell_bytes(samples: int) -> float:
    """Bytes of the response of one cell, in float32, with its rest outside the band."""
    return 4.0 * CHANNELS * (samples + -(-samples // REST_SAMPLES))


def loaded_bytes(modes: Modes, samples: int, bit_clock_hz: float) -> float:
    """Bytes in which responses are loaded by a finger, at the receptances of their points."""
    frequencies = 2 * samples * min(0.5, float(modes.angular_frequency.max()) / (2 * np.pi * bit_clock_hz))
    resonances = 16.0 * modes.count * frequencies  # for the band, and for its rest
    rests = 3 * -(-samples // REST_SAMPLES)  # as they are added up
    return 2 * resonances + 8.0 * POINTS_LOADED * CHANNELS * (2 * samples + rests)


def focus_bytes(modes: Modes, samples: int, times: int, channels: int = CHANNELS) -> float:
    """Bytes in which a focus is computed and evaluated by the twin at this many times around T, in float64."""
    kernels = 2 * 8.0 * samples * modes.count
    at_points = 8.0 * (POINTS_PER_GEMM + 1) * channels * modes.count
    state = 8.0 * (8 * channels + 4 * times) * modes.count
    shown = 8.0 * 4 * samples * POINTS_PER_GEMM * channels
    at_times = max(at_points + state + shown, radiation_bytes(modes))  # its sound is computed last
    return BASE_BYTES + WORKING_BYTES + TABLE_BYTES + kernels + at_times


def require(needed_bytes: float, memory_mb: float | None, what: str) -> float:
    """Refuse what does not fit into `memory_mb`, or `DEFAULT_MB`; the bytes that are left.

    Raises ConfigError, saying how much it needs.
    """
    needed_mb = needed_bytes / 1e6
    memory_mb = DEFAULT_MB if memory_mb is None else memory_mb
    if not needed_mb <= memory_mb:
        raise ConfigError(
            f"{what} takes {needed_mb:.0f} MB, more than the {memory_mb:g} MB it may: give --memory-mb {needed_mb + 0.5:.0f}"
            " or more, or take a thicker or smaller plate, a lower band or a shorter waveform"
        )
    return memory_mb * 1e6 - needed_bytes
