"""Builds a board's bank: responses of the cells in blocks, packed, quantised and written as they come."""

import resource
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.arrays import Indices, Reals, Words
from controller.device.bank.packing import CHANNELS, WORD, drive_words
from controller.device.board.paths import make_folder
from controller.workshop.bank_builder.cells import CellEntries, cells_by_workers
from controller.workshop.bank_builder.compact.design import CompactDesign
from controller.workshop.bank_builder.compact.trial import Trial
from controller.workshop.bank_builder.entries import Entries
from controller.workshop.bank_builder.interpolation_error import interpolation_error
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.bank_builder.methods.prediction import FocusPrediction
from controller.workshop.bank_builder.optimised import Cell, Optimise, contrast_of_plain, kept_path, optimised_words, remove_kept
from controller.workshop.bank_builder.plan import BankPlan, inputs_sha256
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.bank_builder.said_amplitude import said_amplitude
from controller.workshop.bank_builder.writer import BankWriter
from controller.workshop.workers.kept_file import writing
from controller.workshop.workers.map_kept import Mapped

WORDS_DEPEND_ON = ("pitch_mm", "highest_hz", "responses", "optimised")  # build parameters: optimised drive words of a cell
CELLS_COMPARED = 32  # at most, of an optimised bank: 10 ms each


@dataclass(frozen=True)
class BuildReport:
    """Result and cost of a build."""

    path: str
    bytes: int  # size of the file
    cells: int  # entries written
    modes: int | None  # in every response; None: the responses do not come from modes
    responses: str  # where they come from, `Provenance.in_words`
    seconds: float  # of the whole build, by the clock
    peak_memory_mb: float  # in MB of 10^6 bytes
    worst_edge_rate_hz: float  # edges per second of the busiest channel of all entries
    interpolation_error: dict[str, Any]  # `InterpolationError.summary`: what fingers between cells lose
    optimised: dict[str, Any] | None  # what entries were optimised for, and what became of their amplitude; None: they are plain
    workers: dict[str, Any] | None  # `Mapped.figures`: who optimised, or who computed the cells; None: this process


def build_bank(request: BankRequest) -> BuildReport:
    """Build a bank and put it in place of the one at `request.path`, if any.

    Raises ConfigError if the pitch leaves no cell, no cell is wanted, an entry would switch a channel more often than the board
    allows, the build does not fit into `memory_mb`, the source is not of this board, or entries from it are to be optimised. Raises
    BankError if the folder or disk does not take the file; an old bank is untouched.
    """
    started = time.perf_counter()
    plan = BankPlan.of(request)
    path, aim, source = request.path, request.aim, plan.source
    make_folder(path.parent)
    with (
        threadpool_limits(1, "blas"),  # many small products: on a busy machine a second thread costs more than it gains
        BankWriter(path, plan.header, plan.wanted, overwrite=request.overwrite) as writer,  # before the work: it may be refused
    ):
        entries = Entries(plan.board, plan.header, writer)
        optimised, mapped = _optimised(request, plan) if aim else (None, None)
        if not (in_process := bool(aim) or request.workers.is_this_process):
            mapped = cells_by_workers(request, plan)
        if plan.design:
            error = _write_compact(plan, plan.design, entries)
        else:
            _write_cells(request, plan, entries, optimised, {} if in_process or mapped is None else mapped.results)
            error = interpolation_error(plan.board, source, plan.header.grid, plan.wanted).summary()
        for key, words in plan.composed:
            entries.add_composition(key, words)
        results = plan.header.parameters
        results["content_sha256"] = entries.content.hexdigest()
        if optimised is not None:
            results["amplitude_of_plain"] = _amplitude_of_plain(plan, optimised)
        results["interpolation_error"] = error
        results["amplitude_um"] = said_amplitude(plan.board, source, plan.points_m, results["amplitude_of_plain"])
    remove_kept(path)
    return BuildReport(
        path=str(path),
        bytes=plan.header.file_bytes,
        cells=len(plan.numbers),
        modes=plan.modes,
        responses=source.provenance.in_words(),
        seconds=time.perf_counter() - started,
        peak_memory_mb=peak_memory_mb(),
        worst_edge_rate_hz=entries.worst_edge_rate_hz,
        interpolation_error=results["interpolation_error"],
        optimised={
            "aim": aim.name,
            **{name: results[name] for name in ("amplitude_of_plain", "contrast_of_plain") if name in results},
        }
        if aim
        else None,
        workers=None if mapped is None else mapped.figures(),
    )


def _optimised(request: BankRequest, plan: BankPlan) -> tuple[Words, Mapped]:
    """Optimised drive words of all cells, and who found them; what an interrupted build has kept is not computed again."""
    assert request.aim
    board, plate, parameters = plan.board, request.plate, plan.header.parameters
    kept = kept_path(request.path, inputs_sha256(board, {key: parameters[key] for key in WORDS_DEPEND_ON}))
    cells: list[Cell] = [tuple(place_m) for place_m in plan.points_m.tolist()]
    file = None
    if plate:
        file = kept.with_suffix(".plate")
        plain = _plain_words(plan)
        cells = [(*cell, words.tobytes()) for cell, words in zip(cells, plain, strict=True)]
        with writing(file):
            plate.write(file)
    optimise = Optimise(board, request.highest_mode_hz, request.aim, file)
    numbered = dict(zip(plan.numbers.tolist(), cells, strict=True))
    found, mapped = optimised_words(optimise, numbered, kept, request.workers, progress=request.progress)
    if plate:
        some = _compared(plan)
        form, points_m = optimise.method.field, plan.points_m[some]
        parameters["contrast_of_plain"] = contrast_of_plain(form, plate, points_m, plain[some], found[some])
    return found, mapped


def _plain_words(plan: BankPlan) -> Words:
    """Plain drive words of all cells: (cell, sample)."""
    found = np.empty((len(plan.numbers), plan.header.samples), WORD)
    for block in plan.blocks:
        some = slice(block.start, block.stop)
        responses = plan.source.drive_order_responses(plan.points_m[some])
        found[some] = [drive_words(response, plan.board.idle_word) for response in responses]
    return found


def _compared(plan: BankPlan) -> Indices:
    """Which of the cells are compared with plain ones: evenly spaced among those of the bank."""
    return np.unique(np.linspace(0, len(plan.points_m) - 1, CELLS_COMPARED).round().astype(np.intp))


def _write_cells(
    request: BankRequest, plan: BankPlan, entries: Entries, optimised: Words | None, done: Mapping[int, bytes]
) -> None:
    """Write the entries of all cells; those of blocks that are not `done` are computed."""
    cells = CellEntries.of(plan)
    room = None if done else np.empty((max(map(len, plan.blocks)), cells.rows, CHANNELS), np.float32)
    hidden = None if request.progress else True
    with tqdm(total=len(plan.numbers), unit="cell", desc=f"bank {request.path.name}", disable=hidden) as bar:
        for block in plan.blocks:
            points_m = plan.points_m[block.start : block.stop]
            found = cells.read(done[block.start], len(block)) if done else cells.entries(points_m, room)
            for index, (plain, levels, scale_m_per_v) in zip(block, found, strict=True):
                words = plain if optimised is None else optimised[index]
                entries.add_cell(int(plan.numbers[index]), words, levels, scale_m_per_v)
            bar.update(len(block))
    entries.require_motion(len(plan.numbers))


def _write_compact(plan: BankPlan, design: CompactDesign, entries: Entries) -> dict[str, Any]:
    """Compute and write rows and tables of a compact bank; what it loses."""

    def count(cell: int, response: Reals) -> None:
        entries.count_edges(drive_words(response, plan.board.idle_word), f"cell {cell}")

    rows, scales = design.rows(plan.source, plan.wanted, count)
    rest_rows, rest_scales = design.rest_rows(plan.source)

    def tables_of(gain: float) -> bytes:
        return design.tables(rest_rows, rest_scales * np.float32(gain))

    trial = Trial(plan.board, plan.source, design, plan.wanted, rows, scales, tables_of)
    gain = trial.rest_gain()
    for cell in plan.numbers.tolist():
        entries.add_row(cell, rows[cell], float(scales[cell]))
    entries.set_tables(tables_of(gain))
    entries.require_motion(len(plan.numbers))
    return trial.loss(gain)


def _amplitude_of_plain(plan: BankPlan, words: Words) -> dict[str, Any]:
    """Amplitudes of optimised entries over those of plain ones, by all modes."""
    board, source, points_m, some = plan.board, plan.source, plan.points_m, _compared(plan)
    plain, prediction = SignOfSum(board, source), FocusPrediction(board, source)
    shares = [
        float(
            prediction.at_focus(words[index], points_m[index])[0] / (plain.design([(*points_m[index], 1.0)]).displacement_m[0] or 1)
        )
        for index in some.tolist()
    ]
    found = {name: round(float(find(shares)), 3) for name, find in (("least", np.min), ("median", np.median), ("most", np.max))}
    return {"cells": len(some), **found}


def peak_memory_mb() -> float:
    """Largest resident memory of this process so far, in MB of 10^6 bytes."""
    try:
        status = Path("/proc/self/status").read_text(encoding="ascii")  # ru_maxrss also counts what exec replaced
        return float(status.partition("VmHWM:")[2].split()[0]) * 1024e-6
    except (OSError, IndexError):
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024e-6
