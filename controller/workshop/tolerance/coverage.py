"""How often the truth lies within the intervals that banks state, on plates that no constant was fitted to (`unseen.py`)."""

import math
from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from datetime import date, timedelta
from typing import Any, Final

import msgspec
import numpy as np

from controller.arrays import Reals
from controller.device.bank.expectation import Expectation, Interval
from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.device.bank.provenance import Provenance, as_parameter
from controller.device.board.board import Board
from controller.device.board.devices import Temperature
from controller.workshop.tolerance.corner import corner_of
from controller.workshop.tolerance.figures import kept_file, wilson
from controller.workshop.tolerance.tolerances import Tolerances
from controller.workshop.tolerance.unseen import KINDS, PlateRecord, Unseen
from controller.workshop.workers.map_kept import map_kept
from controller.workshop.workers.workers import Workers

TODAY: Final = date(2026, 1, 1)  # of all plates: only ages count
BOARD_DIGEST: Final = bytes(32)  # nobody looks at it
HERE, ELSEWHERE = "0" * 16, "1" * 16
SENSOR: Final = Temperature(kind="hwmon", device="sensor", coefficient_per_k=-2e-4)
WHOLE_SEED: Final = 5000  # of whole panels: other plates than those of the corner
Stated = Callable[[Board, PlateRecord], tuple[Interval, float]]  # of a plate: what its bank states, and the truth


def drawn_from(board: Board, tolerances: Tolerances) -> Unseen:
    """Plates of a board; temperature, capacitance and channels are drawn by `Unseen` itself, and none is dead."""
    return Unseen(board, msgspec.structs.replace(tolerances, temperature_k=None, capacitance_percent=None, dead_probability=0.0))


def interval_figures(board: Board, tolerances: Tolerances, plates: int, workers: Workers, *, whole: bool = False) -> dict[str, Any]:
    """What becomes of intervals on plates of the corner of a board, or of the whole one with its own bank; errors as `map_kept`."""
    study = drawn_from(board if whole else corner_of(board), tolerances)
    if whole:
        study = replace(study, seed=WHOLE_SEED, others=False)
    return {"plates": plates, "seed": study.seed, "intervals": coverage(study.board, records_of(study, plates, workers))}


def records_of(study: Unseen, plates: int, workers: Workers) -> list[PlateRecord]:
    """Records of the first plates; what is done is kept. Errors as `map_kept`."""
    kept = kept_file(study.name())
    mapped = map_kept(study, {number: number for number in range(plates)}, kept, workers, what="plates", unit="plate")
    return [record_of(np.frombuffer(mapped.results[number])) for number in range(plates)]


def record_of(values: Reals) -> PlateRecord:
    """From the values of a record."""
    return PlateRecord._make(values.tolist())


def coverage(board: Board, records: Collection[PlateRecord], names: Iterable[str] = ()) -> dict[str, dict[str, dict[str, Any]]]:
    """By what is stated, or those of it that have names, and by kind of plate: how often it holds the truth, and how wide it is."""
    found: dict[str, dict[str, dict[str, Any]]] = {}
    for name in names or STATED:
        pairs = [STATED[name](board, record) for record in records]
        if any(math.isnan(truth_um) for _, truth_um in pairs):
            continue  # it was not played
        found[name] = {"all": _counted(pairs)}
        for number, kind in enumerate(KINDS):
            if some := [pair for pair, record in zip(pairs, records, strict=True) if record.kind == number]:
                found[name][kind] = _counted(some)
    return found


def _counted(pairs: list[tuple[Interval, float]]) -> dict[str, Any]:
    within = sum(low_um <= truth_um <= high_um for (low_um, _, high_um), truth_um in pairs)
    low, high = wilson(within, len(pairs))
    widths = [interval.high_um / interval.low_um for interval, _ in pairs if interval.low_um]
    return {
        "plates": len(pairs),
        "within": within / len(pairs),
        "within_from": low,
        "within_to": high,
        "below": sum(truth_um < interval.low_um for interval, truth_um in pairs) / len(pairs),
        "width": float(np.median(widths)) if widths else None,
    }


def expected_of(board: Board, record: PlateRecord, *, kind: str = "measured", panel: str = HERE) -> Expectation:
    """What a device makes of what is known of a plate."""
    places_um = [record.low_um, record.middle_um, record.high_um]
    if kind == "modelled":
        places_um = [record.model_middle_um] * 3
    made = Provenance(
        "modelled" if kind == "modelled" else "measured",
        "",
        date=(TODAY - timedelta(days=round(record.age_d))).isoformat(),
        temperature_c=record.bank_c,
        foreseen=(record.foreseen_mean, record.foreseen_deviation),
        panel=panel,
    )
    waveform = board.waveform
    parameters = {"responses": as_parameter(made), "amplitude_um": places_um}
    header = Header("", BOARD_DIGEST, Grid.of(board.plate, 4e-3), waveform.bit_clock_hz, waveform.samples, 1, parameters)
    if not math.isnan(record.reading_c):
        board = msgspec.structs.replace(board, temperature=msgspec.structs.replace(SENSOR, reference_c=record.reference_c))
    found = Expectation.of(header, board, HERE, TODAY)
    assert found is not None
    return found


def _free(expected: Expectation, record: PlateRecord) -> Interval:
    return expected.free(record.reading_c, round(record.foci))


def _felt(expected: Expectation, record: PlateRecord, **mass: Any) -> Interval:
    return expected.felt(record.reading_c, round(record.foci), round(record.fingers) - 1, **mass)


STATED: Final[dict[str, Stated]] = {
    "bare plate": lambda board, one: (_free(expected_of(board, one), one), one.free_um),
    "finger": lambda board, one: (_felt(expected_of(board, one), one), one.felt_um),
    "finger of known mass": lambda board, one: (
        _felt(expected_of(board, one), one, mass_kg=(one.mass_kg, one.mass_kg)),
        one.felt_um,
    ),
    "bank of another plate: bare plate": lambda board, one: (
        _free(expected_of(board, one, panel=ELSEWHERE), one),
        one.other_free_um,
    ),
    "bank of another plate: finger": lambda board, one: (_felt(expected_of(board, one, panel=ELSEWHERE), one), one.other_felt_um),
    "model's bank: bare plate": lambda board, one: (_free(expected_of(board, one, kind="modelled"), one), one.model_free_um),
    "model's bank: finger": lambda board, one: (_felt(expected_of(board, one, kind="modelled"), one), one.model_felt_um),
}
