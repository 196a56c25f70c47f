"""What a finger leaves of a focus: on the focus itself, and elsewhere on the plate (`haptic-panel focus --finger-load`)."""

from __future__ import annotations

import numpy as np

from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.benchmark.focus.focus_emission import FocusEmission
from controller.workshop.benchmark.focus.focus_figures import Figures, random_points, spread
from controller.workshop.physics.design.design import gate_attenuation
from controller.workshop.physics.finger import Finger, point_motion

ELSEWHERE = 9  # places of a finger beside the foci
FAR_WAVELENGTHS = 2.0  # of the band's middle: nearer to a focus it is on the spot's rim
TIMES = 201  # within half a period of the band's middle before and after T


def finger_figures(emission: FocusEmission, finger: Finger, seed: int) -> tuple[list[Figures], Figures]:
    """Amplitudes with a finger on each focus, and shares kept with one elsewhere.

    The first, with equal fingers on all foci: amplitude of each at T, and the largest within half a period of the band's middle,
    with their shares of those of the free plate, and the share by the paper's eq. (7) with half a wavelength at the band's upper
    edge as spot. The second: min, median and max of the share that a focus keeps of its amplitude at T with one finger at a random
    place two wavelengths away or more.
    """
    board, modes = emission.twin.board, emission.twin.modes
    waveform, plate = board.waveform, board.plate
    middle_hz = (waveform.band_low_hz + waveform.band_high_hz) / 2
    around_s = np.linspace(-0.5, 0.5, TIMES) / middle_hz
    foci = np.array(emission.points_m)
    margin_m = min(10e-3, plate.length_m / 4, plate.width_m / 4)
    places = random_points(board, seed, 40 * ELSEWHERE, margin_m)
    far_m = FAR_WAVELENGTHS * bending_wavelength_m(plate, middle_hz)
    apart = np.hypot(*(places[:, None] - foci).transpose(2, 0, 1)).min(axis=1)
    places = places[apart >= far_m][:ELSEWHERE]  # none on a plate that is all focus
    motion = point_motion(board, modes, emission.words, np.concatenate([foci, places]), after_s=float(around_s[-1]))
    on_foci = range(len(foci))
    free = motion.displacement({}, around_s)[:, : len(foci)]
    loaded = motion.displacement(dict.fromkeys(on_foci, finger), around_s)[:, : len(foci)]
    now = TIMES // 2
    sign = np.where(free[now] < 0, -1, 1)
    spot_m = bending_wavelength_m(plate, waveform.band_high_hz) / 2
    upright, free_upright = sign * loaded, sign * free
    on_each = [
        {
            "amplitude_um": float(loaded[now, at]) * 1e6,
            "kept": float(loaded[now, at] / free[now, at]),
            "peak_um": float(upright[:, at].max()) * 1e6,
            "peak_kept": float(upright[:, at].max() / free_upright[:, at].max()),
            "peak_kept_by_eq_7": gate_attenuation(plate, finger.mass_kg, spot_m),
        }
        for at in on_foci
    ]
    kept = [motion.displacement({len(foci) + place: finger})[0, : len(foci)] / free[now] for place in range(len(places))]
    return on_each, {"places": len(places), "kept": spread(np.concatenate(kept).tolist()) if kept else None}
