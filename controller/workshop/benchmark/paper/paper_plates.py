"""Rows of plates that words were not computed for, and of the paper's own support: foam edges, Mindlin's theory."""

from __future__ import annotations

from typing import Any

import msgspec
import numpy as np

from controller.device.board.panel import Foam
from controller.device.board.relations.bending_waves import mindlin_shift
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row
from controller.workshop.physics.plate_twin import PlateTwin

# The paper does not name its foam. This is an ordinary one, soft and 0.75 mm thick, chosen because its damping is about the paper's
FOAM_PA, FOAM_THICKNESS_M, FOAM_KG_M3 = 0.3e6, 0.75e-3, 400.0
FOAM = Foam(stiffness_n_m3=FOAM_PA / FOAM_THICKNESS_M, width_mm=9.0, dashpot_pa_s_m=(FOAM_PA * FOAM_KG_M3) ** 0.5)
FOAM_PLATE: dict[str, Any] = {"edges": "foam", "foam": FOAM, "theory": "mindlin", "decay_time_ms": 1e4}  # the foam alone damps
OTHERS: tuple[tuple[str, str, dict[str, Any], float], ...] = (
    ("mindlin", "a plate by Mindlin's theory", {"theory": "mindlin"}, 1.63 / 7.76),
    ("free", "a plate with free edges", {"edges": "free"}, 0.30 / 7.76),
    ("clamped", "a plate with clamped edges", {"edges": "clamped"}, -0.11 / 7.76),
)
CLOSED_FORM = 1  # of `OTHERS`, which take no time
SHIFTED_HZ = {20e3: 0.64, 70e3: 2.17, 100e3: 3.05}


def shift_rows(panel: PaperPanel) -> list[Row]:
    """Rows of how much lower shear and rotary inertia make frequencies."""
    plate = panel.board.plate
    return [
        Row.of(
            f"mindlin_{hz / 1e3:g}_khz",
            f"a mode at {hz / 1e3:g} kHz is lower by (%)",
            trial,
            mindlin_shift(plate, hz) * 100,
            "Mindlin's theory; the paper's equations are Kirchhoff's",
            trial=True,
        )
        for hz, trial in SHIFTED_HZ.items()
    ]


def wrong_plate_rows(panel: PaperPanel, how_many: int) -> list[Row]:
    """Rows of words of the board's model on the first `how_many` of `OTHERS`."""
    rows = []
    for key, name, changes, trial in OTHERS[:how_many]:
        plate = msgspec.structs.replace(panel.board.plate, **changes)
        twin = PlateTwin(msgspec.structs.replace(panel.board, plate=plate))
        found = [
            float(emit(twin, words).at(point)[0] / amplitude)
            for words, point, amplitude in zip(panel.words, panel.points_m, panel.amplitudes_m, strict=True)
        ]
        why = "so banks of real plates come from measured responses; at other edges chance alone is left"
        rows.append(Row.of(f"on_{key}", f"kept: the model's words on {name}", trial, found, why, trial=True))
    return rows


def foam_rows(panel: PaperPanel) -> list[Row]:
    """Rows of the paper's own support, with responses learned on it."""
    plate = msgspec.structs.replace(panel.board.plate, **FOAM_PLATE)
    other = PaperPanel(msgspec.structs.replace(panel.board, plate=plate), panel.seed, len(panel.points_m))
    evaluated = [field.focus_metrics(*point) for field, point in zip(other.fields, other.points_m.tolist(), strict=True)]
    hz = other.modes.angular_frequency / (2 * np.pi)
    waveform = panel.board.waveform
    in_band = (hz >= waveform.band_low_hz) & (hz < waveform.band_high_hz)
    why = "the paper does not name its foam; an ordinary one, 0.3 MPa, 400 kg/m³, 9 mm wide, explains τ by itself"
    return [
        Row.of(
            "foam_tau_ms",
            "on foam edges (Mindlin): τ of the modes in the band (ms)",
            1.0,
            1e3 / other.modes.decay_rate[in_band],
            why,
        ),
        Row.of(
            "foam_um",
            "on foam edges: amplitude (µm)",
            7.68,
            other.amplitudes_m * 1e6,
            "the same piezo constant: the support hardly counts where responses are learned on it",
        ),
        Row.of("foam_contrast", "on foam edges: contrast outside 10 mm", 29.0, [one.contrast for one in evaluated], "as above"),
        Row.of("foam_spot_mm", "on foam edges: spot at half height (mm)", 5.2, [one.spot_m * 1e3 for one in evaluated], "as above"),
    ]
