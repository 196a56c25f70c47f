"""Rows of what one approximation costs: share of the amplitude that is kept in the band, beside an earlier trial's.

Bits come from approximate responses and are evaluated by the true ones: `paper_panel.kept`. Last, plates that words were not
computed for, and the paper's own support: foam edges, Mindlin's theory.
"""

from collections.abc import Iterator
from typing import Any, Final

import msgspec
import numpy as np
from scipy.stats.qmc import Halton

from controller.arrays import Floats
from controller.device.board.plate.plate import Foam
from controller.device.board.relations.bending_waves import mindlin_shift
from controller.workshop.benchmark.fingers_scenes import motion_of
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.benchmark.paper.paper_panel import PaperPanel, kept
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import StepResponse

CLOCKS_HZ = (1e6, 500e3, 250e3, 200e3)
OFF_MM = (1.0, 2.0, 3.0)
COARSE_M, FINE_M = 5e-3, 2e-3  # pitches of the grids
CORNERS = np.array([(0, 0), (1, 0), (0, 1), (1, 1)])  # of a cell
DETUNING = 0.005
SPEED_M_S, LAG_S = 0.2, 15e-3
REPORTS_HZ = (100.0, 250.0)
NOISE_M = 0.05e-3  # of a report
REPORTS = 30  # before a prediction
# The paper does not name its foam. This is an ordinary one, soft and 0.75 mm thick, chosen because its damping is about the paper's
FOAM_PA, FOAM_THICKNESS_M, FOAM_KG_M3 = 0.3e6, 0.75e-3, 400.0
FOAM = Foam(stiffness_n_m3=FOAM_PA / FOAM_THICKNESS_M, width_mm=9.0, dashpot_pa_s_m=(FOAM_PA * FOAM_KG_M3) ** 0.5)
FOAM_PLATE: dict[str, Any] = {"edges": "foam", "foam": FOAM, "theory": "mindlin", "decay_time_ms": 1e4}  # the foam alone damps
OTHERS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("mindlin", {"theory": "mindlin"}),
    ("free", {"edges": "free"}),
    ("clamped", {"edges": "clamped"}),
)
CLOSED_FORM = 1  # of `OTHERS`, which take no time
SHIFTED_HZ = (20e3, 70e3, 100e3)


def clock_rows(panel: PaperPanel) -> list[Row]:
    """Rows of the bit clock: what bits of each length reach, relative to 1 MHz."""
    duration_s = panel.board.waveform.samples * panel.board.waveform.bit_period_s
    reached = {}
    for clock_hz in CLOCKS_HZ:
        responses = panel.band_responses(panel.points_m, 1 / clock_hz, round(duration_s * clock_hz))
        reached[clock_hz] = np.abs(responses).sum(axis=(1, 2))
    return rows({f"clock_{hz / 1e3:g}_khz": values / reached[1e6] for hz, values in reached.items()})


def place_rows(panel: PaperPanel) -> list[Row]:
    """Rows of a focus beside the finger: the spot's flank, in all directions."""
    found = {}
    for off_mm in OFF_MM:
        found[f"off_{off_mm:g}_mm"] = [
            field.at(panel.ring(point, off_mm * 1e-3)) / amplitude
            for field, point, amplitude in zip(panel.fields, panel.points_m, panel.amplitudes_m, strict=True)
        ]
    return rows(found)


def grid_rows(panel: PaperPanel) -> list[Row]:
    """Rows of grids of cells: nearest cell, bilinear responses, bilinear 1-bit words."""
    nearest, bilinear = _between_cells(panel, COARSE_M)
    _, packed = _between_cells(panel, FINE_M, packed=True)

    def worst(found: list[float]) -> float:
        return float(np.quantile(found, 0.05))

    return rows(
        {
            "nearest": nearest,
            "nearest_worst": worst(nearest),
            "bilinear": bilinear,
            "bilinear_worst": worst(bilinear),
            "packed_worst": worst(packed),
        }
    )


def bits_rows(panel: PaperPanel) -> list[Row]:
    """Rows of responses in few bits, summed between the cells of the bank; relative to exact ones summed there."""
    pitch_m = panel.board.bank.pitch_mm * 1e-3
    found: dict[int, list[float]] = {8: [], 4: []}
    for (responses, shares), true in zip(_around(panel, pitch_m), panel.in_band, strict=True):
        exact = kept(np.tensordot(shares, responses, 1), true)
        for bits, some in found.items():
            step = np.abs(responses).max(axis=(1, 2), keepdims=True) / 2 ** (bits - 1)
            rounded = (np.floor(responses / step) + 0.5) * step  # no level at zero: a small response keeps its sign
            some.append(kept(np.tensordot(shares, rounded, 1), true) / exact)
    return rows({"bits_8": found[8], "bits_4": found[4]})


def drift_rows(panel: PaperPanel) -> list[Row]:
    """Rows of a plate whose frequencies are half a per cent off, and of a bit clock that follows."""
    waveform = panel.board.waveform
    driver = DriverResponse.of(panel.board.driver)
    as_it_is, rescaled = [], []
    for drift in (-DETUNING, DETUNING):
        step = StepResponse.of(drifted(panel.modes, drift), driver)
        true = panel.band_responses(panel.points_m, waveform.bit_period_s, waveform.samples, step)
        faster = panel.band_responses(panel.points_m, waveform.bit_period_s / (1 + drift), waveform.samples, step)
        for learned, now, then in zip(panel.in_band[:, ::-1], true, faster, strict=True):
            as_it_is.append(kept(learned, now))
            rescaled.append(float(np.vdot(np.sign(learned), then) / np.abs(now).sum()))
    return rows({"drift": as_it_is, "drift_rescaled": rescaled})


def slip_rows(panel: PaperPanel) -> list[Row]:
    """Rows of what goes wrong between learning and playing: a sample of slip, the driver left out."""
    slipped = [kept(np.roll(h, by, axis=0), h) for h in panel.in_band for by in (1, -1)]
    board = panel.board
    prompt = msgspec.structs.replace(board.driver, resistance_ohm=1.0, inductance_h=1e-9)
    step = StepResponse.of(panel.modes, DriverResponse.of(prompt))
    learned = panel.band_responses(panel.points_m, board.waveform.bit_period_s, board.waveform.samples, step)
    found = [kept(without, h) for without, h in zip(learned, panel.in_band[:, ::-1], strict=True)]
    return rows({"slip": slipped, "driver_left_out": found})


def finger_motion_rows(panel: PaperPanel) -> list[Row]:
    """Rows of a finger that moves at 200 mm/s under a panel with 15 ms of lag: as reported, and as the product predicts it."""
    random = np.random.default_rng(panel.seed)
    behind, ahead = [], []
    for field, point, amplitude in zip(panel.fields, panel.points_m, panel.amplitudes_m, strict=True):
        for turned in random.uniform(0, 2 * np.pi, 4):
            direction = np.array([np.cos(turned), np.sin(turned)])
            behind.append(float(field.at(point + SPEED_M_S * LAG_S * direction)[0] / amplitude))
            missed = _predicted_m(random, direction) - direction * SPEED_M_S * LAG_S
            ahead.append(float(field.at(point - missed)[0] / amplitude))
    return rows({"moving": behind, "moving_predicted": ahead})


def _predicted_m(random: np.random.Generator, direction: Floats) -> Floats:
    """Where the product expects a finger `LAG_S` after the true place of its last report, from that place: (2,)."""
    period_s = 1 / random.uniform(*REPORTS_HZ)
    steps = np.arange(1 - REPORTS, 1)
    places = np.outer(steps * period_s * SPEED_M_S, direction) + random.normal(0, NOISE_M, (REPORTS, 2))
    times_s = (steps + REPORTS) * period_s
    return np.array(motion_of(places, times_s).predict(times_s[-1], times_s[-1], LAG_S, period_s))


def _between_cells(panel: PaperPanel, pitch_m: float, *, packed: bool = False) -> tuple[list[float], list[float]]:
    """What nearest cell and interpolation keep at the foci on a grid: of responses, or of signs if `packed`."""
    nearest, between = [], []
    for (responses, shares), true in zip(_around(panel, pitch_m), panel.in_band, strict=True):
        nearest.append(kept(responses[np.argmax(shares)], true))
        between.append(kept(np.tensordot(shares, np.sign(responses) if packed else responses, 1), true))
    return nearest, between


def _around(panel: PaperPanel, pitch_m: float) -> Iterator[tuple[Floats, Floats]]:
    """For each focus, anywhere in a cell: responses of its corners in drive order, (4, sample, 32), and bilinear shares, (4,)."""
    places = Halton(2, scramble=False).random(len(panel.points_m) + 1)[1:]  # even over the cell: few foci stand for all
    for point, (right, up) in zip(panel.points_m, places, strict=True):
        corners = point + pitch_m * (CORNERS - (right, up))
        responses = panel.twin.responses.drive_order_responses(corners, dtype=np.float64)
        shares = np.prod(np.where(CORNERS == 1, (right, up), (1 - right, 1 - up)), axis=1)
        yield np.asarray(responses, np.float64), shares


def shift_rows(panel: PaperPanel) -> list[Row]:
    """Rows of how much lower shear and rotary inertia make frequencies."""
    return rows({f"mindlin_{hz / 1e3:g}_khz": mindlin_shift(panel.board.plate, hz) * 100 for hz in SHIFTED_HZ})


def wrong_plate_rows(panel: PaperPanel, how_many: int) -> list[Row]:
    """Rows of words of the board's model on the first `how_many` of `OTHERS`."""
    kept = {}
    for key, changes in OTHERS[:how_many]:
        plate = msgspec.structs.replace(panel.board.plate, **changes)
        twin = PlateTwin(msgspec.structs.replace(panel.board, plate=plate))
        kept[f"on_{key}"] = [
            float(emit(twin, words).at(point)[0] / amplitude)
            for words, point, amplitude in zip(panel.words, panel.points_m, panel.amplitudes_m, strict=True)
        ]
    return rows(kept)


def foam_rows(panel: PaperPanel) -> list[Row]:
    """Rows of the paper's own support, with responses learned on it."""
    plate = msgspec.structs.replace(panel.board.plate, **FOAM_PLATE)
    other = PaperPanel(msgspec.structs.replace(panel.board, plate=plate), panel.seed, len(panel.points_m))
    evaluated = [field.focus_metrics(*point) for field, point in zip(other.fields, other.points_m.tolist(), strict=True)]
    hz = other.modes.angular_frequency / (2 * np.pi)
    waveform = panel.board.waveform
    in_band = (hz >= waveform.band_low_hz) & (hz < waveform.band_high_hz)
    return rows(
        {
            "foam_tau_ms": 1e3 / other.modes.decay_rate[in_band],
            "foam_um": other.amplitudes_m * 1e6,
            "foam_contrast": [one.contrast for one in evaluated],
            "foam_spot_mm": [one.spot_m * 1e3 for one in evaluated],
        }
    )


OF_PANEL: Final = clock_rows, place_rows, grid_rows, bits_rows, drift_rows, slip_rows, finger_motion_rows, shift_rows
