"""A focus on given points of the plate model, without a bank: its emission, the figures of merit of it, what a finger leaves of it.

`haptic-panel focus --at X Y` prints them. The waves of repeated emissions are summed exactly: all are alike, so what is left of
those before is a geometric series of each pole. The energy is summed over modes, and once more over a map.
"""

import copy
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.packing import channel_bits, framed
from controller.device.board.board import Board
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness, bending_wavelength_m
from controller.workshop.benchmark.focus.focus_figures import Figures, emit, random_points, spread
from controller.workshop.benchmark.focus.sound_figures import sound_figures
from controller.workshop.benchmark.stage.power import resistor_loss_j
from controller.workshop.physics.design.design import gate_attenuation
from controller.workshop.physics.felt import LIGHT_TOUCH, ONE_NEWTON, FeltLoad, felt_amplitudes_um, felt_crosstalk, felt_in_words
from controller.workshop.physics.field import Field, crossing, map_axis
from controller.workshop.physics.finger import Finger, point_motion
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.memory import focus_bytes, require
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.modal_history import Energy, ModalMotion, modal_energy
from controller.workshop.physics.sound import PlateSound
from controller.workshop.physics.stress import CELLS_A_WAVE, curvatures, focal_stress
from controller.workshop.physics.word_capture import volts_above_idle

PULSE: Floats = np.linspace(-0.6, 0.6, 81)  # times around T at which the pulse is looked at, in periods of the band's middle
ELSEWHERE = 9  # places of a finger beside the foci
FAR_WAVELENGTHS = 2.0  # of the band's middle: nearer to a focus it is on the spot's rim
TIMES = 201  # within half a period of the band's middle before and after T


class FocusEmission(NamedTuple):
    """An emission on the plate model: the twin that it was played on, its words, the field at T, and where it focuses."""

    twin: PlateTwin
    words: NDArray[np.uint32]
    field: Field
    points_m: Sequence[tuple[float, float]]


def emission_at(board: Board, points_m: Sequence[tuple[float, float]], memory_mb: float | None = None) -> FocusEmission:
    """Focus on several points at once.

    `memory_mb` is in MB of 10^6 bytes, `DEFAULT_MB` by default. Raises ConfigError if it does not fit into `memory_mb`.
    """
    twin = PlateTwin(board)
    needed_bytes = focus_bytes(twin.modes, board.waveform.samples, len(twin.scale.around_s) + len(PULSE), board.channels)
    require(needed_bytes, memory_mb, f"a focus on {board.name!r} with {twin.modes.count} modes")
    places = np.array(points_m)
    words = focus(twin.words_source.drive_order_responses(places, dtype=np.float64), [1.0] * len(places), board.idle_word)
    return FocusEmission(twin, words, emit(twin, words), points_m)


def evaluated_foci(emission: FocusEmission, period_s: float) -> list[Figures]:
    """Figures of each focus of an emission, in the order of its points; `period_s` from one emission to the next.

    What is felt is with a finger on each focus; all other figures are of the bare plate.
    """
    twin, field, points_m = emission.twin, emission.field, emission.points_m
    repeated, pulse = repeated_field(emission, period_s), field_of_pulse(emission)
    light_um, pressed_um = (
        felt_amplitudes_um(twin.board, twin.modes, emission.words, points_m, load).tolist() for load in (LIGHT_TOUCH, ONE_NEWTON)
    )
    rows = []
    for (x_m, y_m), light, pressed in zip(points_m, light_um, pressed_um, strict=True):
        evaluated = field.focus_metrics(x_m, y_m, points_m)
        reference_m = twin.reference_amplitude(x_m, y_m)
        rows.append(
            {
                "x_mm": x_m * 1e3,
                "y_mm": y_m * 1e3,
                "amplitude_um": evaluated.amplitude_m * 1e6,
                "relative_amplitude": evaluated.amplitude_m / reference_m if reference_m else 0.0,  # so near the edge nothing moves
                "felt_light_touch_um": light,
                "felt_1_n_um": pressed,
                "felt": felt_in_words(light),
                "contrast": evaluated.contrast,
                "contrast_all": evaluated.contrast_all,
                "spot_mm": evaluated.spot_m * 1e3,
                "peak_offset_us": evaluated.peak_offset_s * 1e6,
                "pulse_us": pulse_s(pulse, x_m, y_m) * 1e6,
                "spot_wavelengths": evaluated.spot_wavelengths,
                "contrast_repeated": repeated.focus_metrics(x_m, y_m, points_m).contrast,
            }
        )
    return rows


def repeated_field(emission: FocusEmission, period_s: float) -> Field:
    """The plate at T of one of endless emissions, each `period_s` after the one before: exact, steps to idle and back included."""
    twin, field = emission.twin, emission.field
    step = twin.step
    to_idle = -(twin.forces @ volts_above_idle(twin.board, emission.words[-1:])[0])
    plate = field.pole_amplitudes + step.residues * to_idle[step.mode_of_pole]
    driver = field.driver_amplitudes + step.driver_residues * to_idle[:, None]
    decayed, settled = np.exp(step.poles * period_s), np.exp(step.driver_poles * period_s)
    return replace(
        field,
        pole_amplitudes=field.pole_amplitudes + plate * decayed / (1 - decayed),
        driver_amplitudes=field.driver_amplitudes + driver * settled / (1 - settled),
    )


def field_of_pulse(emission: FocusEmission) -> Field:
    """The same field, to be looked at over the times of `PULSE` around T."""
    waveform = emission.twin.board.waveform
    twin = copy.copy(emission.twin)  # remembers the emission: its state is not computed again
    twin.scale = replace(twin.scale, around_s=PULSE * 2 / (waveform.band_low_hz + waveform.band_high_hz))
    return emit(twin, emission.words)


def pulse_s(field: Field, x_m: float, y_m: float) -> float:
    """Time for which (x_m, y_m) of a `field_of_pulse` is above half of its peak at T; to the end of `PULSE` if it stays above."""
    times_s = field.scale.around_s
    u = field.around((x_m, y_m))
    u = u if field.at((x_m, y_m))[0] >= 0 else -u
    middle = len(times_s) // 2
    near = slice(middle - middle // 4, middle + middle // 4 + 1)
    top = near.start + int(np.argmax(u[near]))
    return float(times_s[1] - times_s[0]) * (crossing(u[top:], u[top] / 2) + crossing(u[top::-1], u[top] / 2))


def emission_figures(emission: FocusEmission, period_s: float) -> Figures:
    """Figures of an emission as a whole: energy at T, heat in the stages, scale.

    `energy_uj` by modes and `energy_integrated_uj` by a map; `stages_uj` of one emission, to idle and back included, and of each
    channel under `channels`. `sound` as in `sound_figures`, `stress` as in `focal_stress`.
    """
    twin, field = emission.twin, emission.field
    board = twin.board
    waveform, plate = board.waveform, board.plate
    energy = modal_energy(twin.modes, ModalMotion(field.modal[None], field.modal_velocity[None]))
    highest_hz = float(twin.modes.angular_frequency[-1]) / (2 * np.pi)
    integrated = mapped_energy(plate, field, bending_wavelength_m(plate, highest_hz))
    total_j = float(energy.kinetic_j[0] + energy.potential_j[0])
    integrated_j = float(integrated.kinetic_j[0] + integrated.potential_j[0])
    levels = channel_bits(framed(board.idle_word, emission.words, board.idle_word)).astype(np.int8)
    heat_uj = resistor_loss_j(board.driver, levels, waveform.bit_period_s) * 1e6
    edges = (levels[1:] != levels[:-1]).sum(axis=0)
    used = sorted(actuator.channel for actuator in board.actuators)
    middle_m = field.scale.wave_m
    return {
        "energy_uj": total_j * 1e6,
        "kinetic_share": float(energy.kinetic_j[0]) / total_j if total_j else 0.0,  # so near the edge nothing moves
        "energy_integrated_uj": integrated_j * 1e6,
        "kinetic_share_integrated": float(integrated.kinetic_j[0]) / integrated_j if integrated_j else 0.0,
        "mechanical_power_mw": total_j / waveform.duration_s * 1e3,
        "stages_uj": float(heat_uj[used].sum()),
        "channel_uj": {"median": float(np.median(heat_uj[used])), "max": float(heat_uj[used].max())},
        "stages_w": float(heat_uj[used].sum()) * 1e-6 / period_s,
        "period_ms": period_s * 1e3,
        "sound": sound_figures(board, PlateSound(board, twin.modes), emission.words),
        "stress": focal_stress(board, twin.modes, field.modal, emission.points_m),
        "in_wavelengths": {"length": plate.length_m / middle_m, "width": plate.width_m / middle_m, "middle_mm": middle_m * 1e3},
        "channels": [{"channel": q, "edges": int(edges[q]), "energy_uj": float(heat_uj[q])} for q in used],
    }


def mapped_energy(plate: Plate, field: Field, shortest_m: float) -> Energy:
    """Kinetic and bending energy at T, (1,) arrays in J, from maps of displacement and velocity (appendix B, eq. (8)).

    It takes no mode's frequency or mass, so it checks the sum over modes. Bending energy is Kirchhoff's, of the bare plate: with
    another theory, with layers or with patches, modes hold some percent more or less.

    A map has `CELLS_A_WAVE` points in the shortest wave there is (`shortest_m`), within 1e-4 of the whole energy.
    """
    step_m = min(shortest_m / CELLS_A_WAVE, plate.length_m / 16, plate.width_m / 16)
    x_m, y_m = map_axis(plate.length_m, step_m), map_axis(plate.width_m, step_m)
    cell_m2 = (x_m[1] - x_m[0]) * (y_m[1] - y_m[0])
    velocity = field.modes.on_grid(field.modal_velocity, x_m, y_m)
    xx, yy, xy = curvatures(field.modes, field.modal, x_m, y_m)
    bent = xx**2 + yy**2 + 2 * plate.poisson_ratio * xx * yy + 2 * (1 - plate.poisson_ratio) * xy**2
    kinetic_j = plate.density_kg_m3 * plate.thickness_m / 2 * float((velocity**2).sum()) * cell_m2
    potential_j = bending_stiffness(plate) / 2 * float(bent.sum()) * cell_m2
    return Energy(np.array([kinetic_j]), np.array([potential_j]))


def finger_figures(emission: FocusEmission, finger: Finger, seed: int) -> tuple[list[Figures], Figures]:
    """Amplitudes with a finger on each focus, and shares kept with one elsewhere.

    The first, with equal fingers on all foci: amplitude of each at T, and the largest within half a period of the band's middle,
    with their shares of those of the free plate, and the share by the paper's eq. (7) with half a wavelength at the band's upper
    edge as spot. The second: min, median and max of the share that a focus keeps of its amplitude at T with one finger at a random
    place two wavelengths away or more; and what that finger feels
    of what the first focus's finger feels, with fingers on all foci.
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
    load = FeltLoad(finger.mass_kg, finger.damping_n_s_m, finger.stiffness_n_m)
    felt = [float(felt_crosstalk(board, modes, emission.words, foci[0], [*foci[1:], place], load)[-1]) for place in places]
    return on_each, {
        "places": len(places),
        "kept": spread(np.concatenate(kept).tolist()) if kept else None,
        "felt_share": spread(felt) if felt else None,
    }
