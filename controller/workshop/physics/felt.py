"""What a finger feels of an emission, in one number: the figure of merit of foci, words, designs and quiet places.

The paper judges a focus at one point of a bare plate at one instant. A finger loads the plate, touches it with a pad that is almost
a wavelength wide, and cannot tell times a fraction of a millisecond apart. So the felt amplitude is taken from u, the displacement
of the loaded plate, averaged over the pad by its pressure (`finger.py`; the finger's force is spread over the pad in the same way):

    felt^2 = 2 max over t within 0.2 ms of T of  integral of  u(t - t')^2 exp(-t' / tau) / tau  over t' > 0

The exponential is the skin's filter. It takes squares, as skin is thrown either way; of u itself nothing is left below 16 kHz.
The factor 2 makes the felt amplitude of a lasting vibration of the pad its amplitude; a pulse of the band, much shorter than tau,
counts by its energy.

Sources of the numbers; what is an assumption is called so:
- mass: 70 to 230 mg in literature, 140 mg at 1 N (Hudin et al. 2015, section V, after Wiertlewski and Hayward, J. Biomech. 45,
  2012). Spread over the pad, 140 mg leaves 0.47 at the pad's middle where the paper has 3 of 7 um at 1 N; a mass at a point has to
  be 69 mg for that. 70 mg for a light touch is an assumption: the least in literature.
- damping 1 N s/m, stiffness 1 N/mm: Konyo et al., ROBOMECH J. 4, 2017, table 1; measured along the skin and below 1 kHz.
- pressure: an inverted paraboloid (Pawluk and Howe, J. Biomech. Eng. 121, 1999); a pad of 8 mm is an assumption.
- tau: mass over damping of the same skin (Konyo et al.: 0.1 g, 1 N s/m), in which moved skin comes to rest. It agrees with Dalecki
  et al. (J. Acoust. Soc. Am. 97, 1995): pulses of 0.1 ms are felt at little more force than those of 1 ms and longer.
- 0.2 ms: the skin is off the plate for 0.3 ms (Hudin et al., section VI).
It is not a model of the throw itself, for which there is `skin.py`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.waveforms.pad import PAD_M
from controller.workshop.physics.finger import Finger
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.pad_motion import PadMotion
from controller.workshop.physics.word_capture import volts_above_idle

AROUND_S = 0.2e-3  # before and after T
SKIN_S = 1e-4  # tau
# Felt amplitude below which nothing is known to be felt, and from which it is felt strongly. Below the first, skin pressed with
# 0.5 N stays on the plate (F / (M w^2) of 70 mg at 45 kHz: 0.09 um), and the band alone is far beyond what a finger senses. The
# second is that of the paper's panel at 1 N, "strongly felt" (sections V and VI). In between nobody has measured a threshold for
# such pulses
DETECTION_UM = (0.1, 0.88)


@dataclass(frozen=True)
class FeltLoad(Finger):
    """A finger that rests on the plate with its pad."""

    pad_mm: float = PAD_M * 1e3  # diameter


LIGHT_TOUCH = FeltLoad(mass_kg=0.7e-4, damping_n_s_m=1.0, stiffness_n_m=1e3)
ONE_NEWTON = FeltLoad(mass_kg=1.4e-4, damping_n_s_m=1.0, stiffness_n_m=1e3)


def felt_amplitudes_um(
    board: Board,
    modes: Modes,  # of its plate
    words: NDArray[np.uint32],  # (sample,)
    fingers_m: ArrayLike,  # (finger, 2): x and y in m; all rest on the plate at once
    load: FeltLoad = LIGHT_TOUCH,
) -> Floats:
    """What each finger feels of an emission that ends at T: (finger,) in um."""
    found: Floats = felt_by_all_um(board, modes, volts_above_idle(board, words)[None], fingers_m, load)[0]
    return found


def felt_by_all_um(
    board: Board,
    modes: Modes,
    volts: Floats,  # (emission, sample, channel): above rest
    fingers_m: ArrayLike,
    load: FeltLoad = LIGHT_TOUCH,
) -> Floats:
    """The same of many emissions at the same places: (emission, finger)."""
    return felt_by_motion_um(pads(board, modes, fingers_m, load, volts.shape[1]), volts, board.waveform.bit_period_s)


def pads(board: Board, modes: Modes, fingers_m: ArrayLike, load: FeltLoad, samples: int) -> PadMotion:
    """Fingers at places, for `felt_by_motion_um` of emissions of this many samples."""
    return PadMotion(board, modes, fingers_m, load, load.pad_mm * 1e-3, samples, AROUND_S)


def felt_by_motion_um(motion: PadMotion, volts: Floats, period_s: float) -> Floats:
    """As `felt_by_all_um`, by fingers that are kept for further emissions."""
    samples, around = volts.shape[1], int(AROUND_S / period_s)
    felt_m = felt_history(motion.history(volts), period_s)[max(samples - around, 0) : samples + around + 1]
    found: Floats = felt_m.max(axis=0).T * 1e6
    return found


def felt_history(pad_motion: Floats, period_s: float) -> Floats:
    """Felt amplitude at each time of displacements of pads, (time, ...) from rest on, in their unit."""
    forgotten = float(np.exp(-period_s / SKIN_S))
    power = 2 * (1 - forgotten) * pad_motion**2
    for n in range(1, len(power)):  # scipy.signal has this, and takes a second to import
        power[n] += forgotten * power[n - 1]
    found: Floats = np.sqrt(power)
    return found


def felt_crosstalk(
    board: Board,
    modes: Modes,
    words: NDArray[np.uint32],
    finger_m: ArrayLike,  # (2,): the finger that is meant to feel the emission
    others_m: ArrayLike,  # (other, 2): fingers that rest on the plate with it
    load: FeltLoad = LIGHT_TOUCH,
) -> Floats:
    """What other fingers feel of an emission over what the one feels that is meant: (other,)."""
    fingers = np.concatenate([np.asarray(one, np.float64).reshape(-1, 2) for one in (finger_m, others_m)])
    felt = felt_amplitudes_um(board, modes, words, fingers, load)
    found: Floats = felt[1:] / felt[0]
    return found


def felt_in_words(felt_um: float) -> str:
    """What is known of a felt amplitude: `felt`, `may be felt` or `not felt`."""
    low_um, high_um = DETECTION_UM
    if felt_um >= high_um:
        return "felt"
    return "may be felt" if felt_um >= low_um else "not felt"
