"""What the loop leaves out in six scenes, and what that saves: each is played as on the device, and again without skipping.

    haptic-panel benchmark skipping

Loop, tracker, scheduler and session are the device's, on the simulated clock; the FPGA is its model. Without skipping everything is
composed for the place itself, sent again, emission by emission, with the outputs on all the time, from a bank that was read whole.
What only leaves out work (`loop.skips.EXACT`) is compared with doing it, nothing else being left out of an emission: where no
finger moves, each emission has the same bits.
"""

import math
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.lookup import find_board
from controller.device.board.relations.stage_heat import half_charge_j
from controller.device.fpga.capture import Capture
from controller.device.loop.skips import ALL, EXACT, Skips
from controller.device.scene.coverage import cells_needed
from controller.device.scene.scene import Scene, load_scene
from controller.metrics import Counters
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.benchmark.device.skip_cases import CASES, SkipCase, recording
from controller.workshop.simulation.simulated_run import Run, play

PAGE_BYTES = 4096
IDLE_DISARM_S = 1.0  # where the board has none
REPEATS = 5  # of each run, for the least host time
NONE = Skips(**dict.fromkeys((field.name for field in fields(Skips)), False))


def skipping(board: Board, bank_file: Path, case: SkipCase, off: Sequence[str] = (), repeats: int = REPEATS) -> dict[str, Any]:
    """Play one case with and without skipping.

    The board's plate is the simulated one's, its touch panel the case's recording; `bank_file` is of the whole plate. `off` are
    fields of `Skips` that are switched off in the second run; all by default. `repeats` are further runs of each for `host_ms`,
    from a bank that is checked beforehand as for the service. Returns `done` and `without`: figures of both runs; `saved`: their
    differences; `exact_bits`: whether exact skipping leaves every output bit as it is; `must_be_exact`; `other_bits`: share of the
    bits that differ between both runs, None if they have not as many emissions; `bank`: cells that the scene needs, of how many.
    """
    fewer = NONE if not off else replace(ALL, **dict.fromkeys(off, False))
    done, without = (figures(board, bank_file, case, skips) for skips in (ALL, fewer))
    for _ in range(repeats):  # in turns; the least of each counts
        for found, skips in ((done, ALL), (without, fewer)):
            again, _ = _run(board, bank_file, case, skips, checked=True)
            found["host_ms"] = min(found["host_ms"], _typical_ms("host", again.counters))
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
    board = msgspec.structs.replace(board, idle_disarm_s=board.idle_disarm_s or IDLE_DISARM_S)
    scene = _scene(board, case)
    played = done.pop("words"), without.pop("words")
    return {
        "case": case.name,
        "scene": case.scene,
        "switched_off": sorted(off) or [field.name for field in fields(Skips)],
        "done": done,
        "without": without,
        "saved": {name: value - done[name] for name, value in without.items()},
        "exact_bits": exact_bits(board, bank_file, case),
        "must_be_exact": case.equal_bits,
        "other_bits": _other_bits(*played),
        "bank": {"cells": int(cells_needed(scene, grid.points(), grid.pitch_m, 5e-3).sum()), "of": grid.cells},
    }


def _scene(board: Board, case: SkipCase) -> Scene:
    return load_scene(find_board("simulated") / f"{case.scene}.toml", board)


def _run(
    board: Board, bank_file: Path, case: SkipCase, skips: Skips, *, whole: bool = False, checked: bool = False
) -> tuple[Run, int]:
    """Play once from a bank that is opened for it: the run, and how many pages of the bank were read for it.

    `whole`: all of the bank is read first; `checked`: its entries have been checked beside the loop, as for the service.
    """
    board = msgspec.structs.replace(board, idle_disarm_s=board.idle_disarm_s or IDLE_DISARM_S)
    scene = _scene(board, case)
    with Bank.open(bank_file, board) as bank:
        if checked:
            cells = np.flatnonzero(bank.cells).tolist()
            bank.drive.check_frames(cells)
            for cell in cells:
                bank.responses.verify(cell)
        if whole:
            for cell in np.flatnonzero(bank.cells).tolist():
                bank.drive.frames(cell)
                bank.responses.check(cell)
            bank.counters.lookups = 0
        run = play(board, scene, bank, recording(board, case), real_time=False, skips=skips)
        used = {"drive": bank.counters.drive_checked, "response": bank.counters.response_checked}
        pages = sum(count * -(-bank.sections[name].row_bytes // PAGE_BYTES) for name, count in used.items())
    return run, pages


def exact_bits(board: Board, bank_file: Path, case: SkipCase) -> bool:
    """Whether every emission of a case has the same bits with exact skipping as without, all other work being done."""
    worked_out = replace(NONE, together=True)
    runs = (_run(board, bank_file, case, skips)[0] for skips in (replace(worked_out, **dict.fromkeys(EXACT, True)), worked_out))
    exact, plain = (_words(board, run.capture) for run in runs)
    return np.array_equal(exact, plain)


def figures(board: Board, bank_file: Path, case: SkipCase, skips: Skips) -> dict[str, Any]:
    """Counts and costs of one way of playing a case, and `words`, the drive words of its emissions, (emission, sample)."""
    run, pages = _run(board, bank_file, case, skips, whole=skips == NONE)
    counters = run.counters
    sent = counters.uploads + counters.prefetched
    words, on = run.capture.words, run.capture.hv.astype(bool)
    on_s = float(np.diff(run.capture.ticks.astype(np.float64))[on[:-1]].sum()) / board.link.clock_hz
    edges = int(np.bitwise_count(words[1:] ^ words[:-1]).sum())
    return {
        "emissions": int(run.capture.focus_ticks.size),
        "fingers_and_spots_served": counters.foci,
        "waveforms_sent": sent,
        "composed": sent - run.lookups,
        "from_the_bank": run.lookups,
        "resident_plays": counters.resident,
        "of_a_place_near_by": counters.near,
        "sent_ahead": counters.prefetched,
        "heartbeats": counters.heartbeats,
        "bytes_on_the_wire": run.link.bytes_sent,
        "pages_of_the_bank": pages,
        "samples_without_work": counters.skipped.outside_region + counters.skipped.between_emissions,
        "replaced_by_newer": counters.skipped.merged,
        "host_ms": _typical_ms("host", counters),
        "wire_before_a_start_ms": _typical_ms("wire", counters) / max(counters.emissions, 1),
        "outputs_on_s": on_s,
        "stages_mj": edges * half_charge_j(board.driver) * 1e3,
        "words": _words(board, run.capture),
    }


def _typical_ms(stage: str, counters: Counters) -> float:
    """Time of a stage of all emissions: the median of uploads and of resident plays, times their numbers."""
    both = (getattr(stages, stage) for stages in (counters.upload_latency, counters.resident_latency))
    return math.fsum(found.percentiles_ns([0.5])[0] * found.count for found in both if found.count) * 1e-6


def _words(board: Board, capture: Capture) -> NDArray[np.uint32]:
    """Drive words of each completed emission: (emission, sample), read at the pins in the middle of each sample."""
    samples = board.waveform.samples
    ticks_per_sample = board.link.clock_hz / board.waveform.bit_clock_hz
    before = (samples - np.arange(samples) - 0.5) * ticks_per_sample
    at = capture.focus_ticks.astype(np.float64)[:, None] - before
    return capture.words[np.searchsorted(capture.ticks.astype(np.float64), at, "right") - 1]


def _other_bits(done: NDArray[np.uint32], without: NDArray[np.uint32]) -> float | None:
    if done.shape != without.shape:
        return None
    return float(np.bitwise_count(done ^ without).sum()) / (32 * max(done.size, 1))


def table(found: dict[str, Any]) -> str:
    """Text of what `skipping` found."""
    lines = [f"{found['case']} ({found['scene']}.toml)", f"  {'':<26}{'skipping':>12}{'without':>12}{'saved':>12}"]
    for name, value in found["done"].items():
        row = (value, found["without"][name], found["saved"][name])
        lines.append(
            f"  {name.replace('_', ' '):<26}"
            + "".join(f"{cell:>12,.4g}" if isinstance(cell, float) else f"{cell:>12,}" for cell in row)
        )
    bank, bits = found["bank"], found["other_bits"]
    lines.append(f"  cells of the bank needed: {bank['cells']:,} of {bank['of']:,}")
    lines.append(
        f"  output bits, exact skipping against none: {'equal' if found['exact_bits'] else 'differ'}"
        + (" (must be equal)" if found["must_be_exact"] else " (fingers move)")
        + ("" if bits is None else f"; all skipping: {100 * bits:.2g} % differ")
    )
    return "\n".join(lines)


def all_cases(
    board: Board, off: Sequence[str] = (), repeats: int = REPEATS, progress: Callable[[int, int], None] | None = None
) -> dict[str, Any]:
    """Play all cases from a bank that is built for it; `cases`: what `skipping` found, for each.

    The arguments are as for `skipping`; `progress` is called with the number of cases done and of all cases.
    """
    found = []
    with tempfile.TemporaryDirectory() as folder, threadpool_limits(1, "blas"):
        bank_file = Path(folder) / "whole plate.bank"
        emitters = [emitter for case in CASES for emitter in _scene(board, case).emitters]
        build_bank(BankRequest(board, bank_file, emitters=list(dict.fromkeys(emitters))))
        for number, case in enumerate(CASES, start=1):
            found.append(skipping(board, bank_file, case, off, repeats))
            if progress:
                progress(number, len(CASES))
    return {"board": board.name, "cases": found}
