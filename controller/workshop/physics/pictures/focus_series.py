"""One emission over time: what a few channels play, what their piezos get, how the focus moves, and its spectrum."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.packing import as_words, channel_bits
from controller.workshop.physics.modes.modes import slowest_decay_s
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.modal_history import modal_history

SHOWN_CHANNELS = 4
PARTS = 4  # of a bit, each a time
REST_TAUS = 3.0  # after T


@dataclass(frozen=True, eq=False)
class FocusSeries:
    """Series of an emission."""

    time_s: Floats  # (time,): from T
    displacement_m: Floats  # (time,): of the focus, from its rest at the idle word
    channels: NDArray[np.int64]  # (channel,): those of the voltages
    # stage_v, piezo_v: (time, channel): voltage of the push-pull stage just before each time, and on the piezo behind its
    # driver
    stage_v: Floats
    piezo_v: Floats

    def spectrum(self) -> tuple[Floats, Floats]:
        """Frequency in Hz and size of the displacement's Fourier transform in m s: (frequency,) each."""
        step_s = float(self.time_s[1] - self.time_s[0])
        length = 1 << int(np.ceil(np.log2(2 * len(self.time_s))))
        size: Floats = np.abs(np.fft.rfft(self.displacement_m, length)).astype(np.float64) * step_s
        return np.fft.rfftfreq(length, step_s).astype(np.float64), size


def focus_series(twin: PlateTwin, words: NDArray[np.uint32], point_m: tuple[float, float]) -> FocusSeries:
    """Play words on a plate at rest at the idle word, and watch one point until some decay times after T."""
    board = twin.board
    rest = int(min(np.ceil(REST_TAUS * slowest_decay_s(twin.modes) / board.waveform.bit_period_s), 4 * len(words)))
    idle = as_words(board.idle_word, words)
    played = np.concatenate([words, *[idle] * rest])
    levels = np.repeat(channel_bits(played).astype(np.float64) * board.driver.supply_v, PARTS, axis=0)
    idle_v = channel_bits(idle).astype(np.float64) * board.driver.supply_v
    period_s = board.waveform.bit_period_s / PARTS
    shape = twin.modes.shapes([point_m])[0]
    moved = [motion.displacement @ shape for motion in modal_history(twin.step, twin.forces, levels - idle_v, period_s)]
    used = sorted(actuator.channel for actuator in board.actuators)
    channels = np.array(used[:: max(1, len(used) // SHOWN_CHANNELS)][:SHOWN_CHANNELS])
    time_s: Floats = (np.arange(len(levels), dtype=np.float64) + 1) * period_s - len(words) * board.waveform.bit_period_s
    return FocusSeries(
        time_s=time_s,
        displacement_m=np.concatenate(moved),
        channels=channels,
        stage_v=levels[:, channels],
        piezo_v=_behind(DriverResponse.of(board.driver), levels[:, channels], idle_v[:, channels], period_s),
    )


def _behind(driver: DriverResponse, stage_v: Floats, before_v: Floats, period_s: float) -> Floats:
    """Voltage on the piezos at the end of each period: (time, channel)."""
    turn = np.exp(driver.poles * period_s)[:, None]
    state = np.zeros((2, stage_v.shape[1]), np.complex128)
    settling = np.empty(stage_v.shape)
    for k, step_v in enumerate(np.diff(stage_v, axis=0, prepend=before_v)):
        state = (state + step_v) * turn
        settling[k] = (driver.residues @ state).real
    return stage_v + settling
