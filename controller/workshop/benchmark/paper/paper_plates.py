"""Rows of plates that words were not computed for, and of the paper's own support: foam edges, Mindlin's theory."""

from __future__ import annotations

from typing import Any

import msgspec
import numpy as np

from controller.device.board.panel import Foam
from controller.device.board.relations.bending_waves import mindlin_shift
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.plate_twin import PlateTwin

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
