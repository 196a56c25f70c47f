"""Figures of many drawn plates: distributions, the share that is good enough, and what each tolerance costs alone."""

from pathlib import Path
from typing import Any, Final

import numpy as np
from threadpoolctl import threadpool_limits

from controller.arrays import Floats
from controller.device.board.paths import make_folder, state_folder
from controller.workshop.tolerance.study import BANKS, FIGURES, Item, Study, nominal_of
from controller.workshop.workers.map_kept import map_kept
from controller.workshop.workers.workers import Workers

PLATES_MAX: Final = 1_000_000
AT_ONCE: Final = 4  # plates of a task: some seconds
KEPT_FILES: Final = 12  # of studies; the one not used for longest goes first
CONFIDENCE: Final = 1.96  # standard errors of 95 %


def study_figures(study: Study, plates: int, alone: int, least: float, workers: Workers) -> dict[str, Any]:
    """Figures of `plates` plates, and of each tolerance alone on the first `alone` of them.

    A plate is good if its weakest place has `least` of the amplitude that the design has there. What is done is kept in the state
    folder: a study with more plates goes on from one with fewer. Raises ConfigError if patches come to lie off a plate, or modes
    cannot be computed; WorkersError and UsageError as `map_kept`.
    """
    names = study.tolerances.given(study.board)
    items: dict[int, Item] = {number: (number, None) for number in range(plates)}
    for place, name in enumerate(study.tolerances.__struct_fields__, 1):
        if name in names:
            items |= {place * PLATES_MAX + number: (number, name) for number in range(alone)}
    mapped = map_kept(study, items, kept_file(study.name()), workers, at_once=AT_ONCE, what="plates", unit="plate")
    shape = (len(BANKS), study.places, len(FIGURES))
    found = {item: np.frombuffer(mapped.results[key]).reshape(shape) for key, item in items.items()}
    with threadpool_limits(1, "blas"):  # the same bits as in a worker
        nominal = nominal_of(study)
    every = np.array([found[number, None] for number in range(plates)])
    relative = every[..., 0] / nominal.figures[:, 0]
    alone_m = {name: np.array([found[number, name][..., 0] for number in range(alone)]) for name in names if alone}
    costs = {name: np.median(moved_m / nominal.figures[:, 0], axis=2) for name, moved_m in alone_m.items()}
    return {
        "board": study.board.name,
        "plates": plates,
        **{name: getattr(study, name) for name in ("places", "seed", "points", "snr_db")},
        "least": least,
        "nominal": _median(nominal.figures),
        "banks": {bank: _of_bank(every[:, index], relative[:, index], least) for index, bank in enumerate(BANKS)},
        "alone_plates": alone,
        "alone": {
            name: {bank: {"mean": float(of.mean()), "worst": float(of.min())} for bank, of in zip(BANKS, shares.T, strict=True)}
            for name, shares in costs.items()
        },
        "weakest": {bank: relative[:, index].min(axis=1).tolist() for index, bank in enumerate(BANKS)},
        "workers": mapped.figures(),
    }


def kept_file(name: str) -> Path:
    """File of a study's results, by its name; the oldest files of others are removed."""
    folder = state_folder() / "tolerance"
    make_folder(folder)
    path = folder / f"{name}.plates"
    by_age = sorted(folder.glob("*.plates"), key=lambda old: old.stat().st_mtime, reverse=True)
    for old in [other for other in by_age if other != path][KEPT_FILES - 1 :]:
        old.unlink(missing_ok=True)
    return path


def _of_bank(figures: Floats, relative: Floats, least: float) -> dict[str, Any]:
    """Distributions over plates of a bank's figures, (plate, place, figure); `relative` (plate, place) is over the design's."""
    middle = np.median(figures, axis=1)
    good = int(np.count_nonzero(relative.min(axis=1) >= least))
    low, high = wilson(good, len(figures))
    return {
        "relative": spread(np.median(relative, axis=1)),
        "weakest": spread(relative.min(axis=1)),
        "amplitude_um": spread(1e6 * middle[:, 0]),
        "contrast": spread(middle[:, 1]),
        "spot_mm": spread(-1e3 * middle[:, 2], sign=-1),
        "good": good / len(figures),
        "good_from": low,
        "good_to": high,
    }


def spread(values: Floats, sign: int = 1) -> dict[str, float]:
    """Quantiles of `values`, of which the lowest is the worst; with `sign` -1 they are the negatives of the figures."""
    p5, p50, p95 = np.quantile(values, (0.05, 0.5, 0.95)).tolist()
    return {"p5": sign * p5, "p50": sign * p50, "p95": sign * p95, "worst": sign * float(values.min())}


def wilson(good: int, count: int) -> tuple[float, float]:
    """Interval that holds the true share with 95 %, if `good` of `count` are (Wilson, 1927)."""
    share, square = good / count, CONFIDENCE**2 / count
    middle = share + square / 2
    reach = CONFIDENCE * np.sqrt(share * (1 - share) / count + square / (4 * count))
    low, high = (middle - reach) / (1 + square), (middle + reach) / (1 + square)
    return max(0.0, float(low)), min(1.0, float(high))


def _median(figures: Floats) -> dict[str, float]:
    amplitude_m, contrast, spot_m = np.median(figures, axis=0).tolist()
    return {"amplitude_um": 1e6 * amplitude_m, "contrast": contrast, "spot_mm": 1e3 * spot_m}
