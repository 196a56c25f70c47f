"""Builds a board's bank: responses of the cells in blocks, packed, quantised and written as they come."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import json
import resource
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.bank.file_format import Header, creator
from controller.bank.grid import Grid
from controller.bank.packing import CHANNELS, channel_bits, drive_words, edges, quantise
from controller.bank.provenance import as_parameter
from controller.bank.writer import BankWriter
from controller.bank_builder.checked_source import CheckedSource
from controller.bank_builder.compositions import compositions
from controller.bank_builder.interpolation_error import interpolation_error
from controller.bank_builder.optimised import ALONE, Words, Workers, kept_path, optimised_words, remove_kept, told
from controller.board.board import Board
from controller.board.paths import make_folder
from controller.errors import ConfigError
from controller.physics.impulse_response import ResponseModel
from controller.physics.memory import BASE_BYTES, cell_bytes, entries_bytes, require
from controller.physics.plate import mode_cut_hz, wave_scale
from controller.physics.response_source import ResponseSource
from controller.scene.scene import Spot
from controller.waveform_design.descent import Aim
from controller.waveform_design.plain import SignOfSum
from controller.waveform_design.prediction import FocusPrediction

INDEX_BYTES = 200  # of a cell of the grid, in what is known of all cells: place, number, checksums
WORDS_DEPEND_ON = ("pitch_mm", "highest_hz", "optimised")  # build parameters: optimised drive words of a cell
CELLS_JUDGED = 32  # at most, of an optimised bank: 10 ms each
CELLS_PER_BLOCK = 512  # at least one row of the grid; 74 MB of responses at 1000 samples
# (rows, inner, columns): large squares, and the shapes of the response step itself
SGEMM_SHAPES = ((1024, 1024, 1024), (1536, 1536, 1536), (1000, 1900, 512), (1000, 1900, 2048))


@dataclasses.dataclass(frozen=True)
class BuildReport:
    """Result and cost of a build.

    Attributes
    ----------
    path : str
    bytes : int
        Size of the file.
    cells : int
        Entries written.
    modes : int or None
        In every response; None: the responses do not come from modes.
    responses : str
        Where they come from, `Provenance.in_words`.
    seconds : float
        Of the whole build, by the clock.
    model_seconds, response_seconds : float
        Processor time of the plate model (none of another source) and of the responses.
    sgemm_gflops : float or None
        Best rate of matrix multiplication of this machine, for a second of processor time; None: not measured.
    sgemm_share : float or None
        Additions and multiplications that the responses need, over what this machine multiplies in `response_seconds` at that rate;
        None: not measured, or no model's.
    peak_memory_mb : float
        In MB of 10^6 bytes.
    worst_edge_rate_hz : float
        Edges per second of the busiest channel of all entries.
    interpolation_error : dict
        `InterpolationError.summary`: what fingers between cells lose.
    optimised : dict or None
        What entries were optimised for, and what became of their amplitude; None: they are plain.
    optimise_seconds : float
        By the clock.
    """

    path: str
    bytes: int
    cells: int
    modes: int | None
    responses: str
    seconds: float
    model_seconds: float
    response_seconds: float
    sgemm_gflops: float | None
    sgemm_share: float | None
    peak_memory_mb: float
    worst_edge_rate_hz: float
    interpolation_error: dict[str, Any]
    optimised: dict[str, Any] | None
    optimise_seconds: float


def build_bank(
    board: Board,
    path: Path,
    pitch_m: float | None = None,
    cells: NDArray[np.bool_] | None = None,
    *,
    spots: Sequence[Spot] = (),
    scene: str | None = None,
    progress: bool = False,
    measure_sgemm: bool = True,
    highest_hz: float | None = None,
    overwrite: bool = False,
    choice: dict[str, Any] | None = None,
    memory_mb: float | None = None,
    aim: Aim | None = None,
    workers: Workers = ALONE,
    source: ResponseSource | None = None,
) -> BuildReport:
    """Build a bank and put it in place of the one at `path`, if any.

    Parameters
    ----------
    board : Board
    path : Path
        Its folder is made if it is missing.
    pitch_m : float, optional
        Of the grid; the board's own by default.
    cells : (cells of the grid,) bool array, optional
        Cells to build; all by default.
    spots : sequence of Spot
        What they play together is composed beforehand.
    scene : str, optional
        What `cells` and `spots` came from, noted in the build parameters.
    progress : bool
        Show a bar on stderr if that is a terminal.
    measure_sgemm : bool
        Measure the best rate of matrix multiplication for `sgemm_share`: about a second.
    highest_hz : float, optional
        Modes above are left out; `mode_cut_hz` by default.
    overwrite : bool
        Replace a file at `path` even if it is no bank: for paths that this software chooses itself.
    choice : dict, optional
        What `choice.choose` told; its `composes` says whether responses are written.
    memory_mb : float, optional
        Memory that the build may take, in MB of 10^6 bytes, `DEFAULT_MB` by default; the bank is the same whatever it is.
    aim : Aim, optional
        Optimise every entry for this (`waveform_design/descent.py`). What is done of an interrupted build is kept beside `path`.
    workers : Workers
        Who optimises.
    source : ResponseSource, optional
        Of the responses; the board's plate model by default.

    Raises
    ------
    ConfigError
        If the pitch leaves no cell, `cells` is empty, an entry would switch a channel more often than the board allows,
        the build does not fit into `memory_mb`, `source` is not of this board, or entries from it are to be optimised.
    BankError
        If the folder or disk does not take the file; an old bank is untouched.
    """
    started = time.perf_counter()
    if choice is not None:
        board = msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, snap_mm=choice["snap_mm"]))
    if aim is not None and source is not None:
        raise ConfigError(f"responses that are {source.provenance.kind} cannot be optimised: that takes a model of the whole plate")
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3 if pitch_m is None else pitch_m)
    wanted = np.ones(grid.cells, bool) if cells is None else np.asarray(cells, bool)
    if wanted.shape != (grid.cells,):
        raise ValueError(f"cells are {wanted.shape}, not ({grid.cells},)")
    if not wanted.any():
        raise ConfigError(f"{scene or 'scene'}: no region reaches a cell of the {grid.pitch_m * 1e3:g} mm grid: nothing to build")
    numbers = np.flatnonzero(wanted)
    points_m = grid.points()[numbers]
    highest_hz = mode_cut_hz(board.waveform) if highest_hz is None else highest_hz
    model: ResponseModel | None = None
    if source is None:
        responses: ResponseSource = (model := ResponseModel(board, highest_hz))
    else:
        responses = CheckedSource(board, source)
    parameters: dict[str, Any] = {
        "board": board.key,
        "pitch_mm": grid.pitch_m * 1e3,
        "wave_scale": wave_scale(board),
        "highest_hz": highest_hz if model else None,
        "precision": "float32",
        "responses": as_parameter(responses.provenance),
        "scene": scene,
        "cells_sha256": hashlib.sha256(np.packbits(wanted).tobytes()).hexdigest(),
        **({} if choice is None else {"choice": choice, "composes": choice["composes"]}),
        "spots_sha256": hashlib.sha256(repr([(*spot[:3], *spot[4:]) for spot in spots]).encode()).hexdigest(),
        "optimised": aim and told(board, aim),
    }
    maker = creator()
    inputs_sha256 = _inputs_sha256(board, maker, parameters)
    parameters |= {  # results, filled in as entries are made; the header is written last
        "inputs_sha256": inputs_sha256,
        "content_sha256": "0" * 64,
        "channel_edges": 0,
        "all_edges": 0,
        "amplitude_of_plain": aim and {"cells": 10**3, "least": 0.001, "median": 0.001, "most": 0.001},
        "interpolation_error": {},
    }
    composed = compositions(board, grid, responses, spots) if spots else []
    header = Header(
        creator=maker,
        board_digest=board.digest(),
        grid=grid,
        bit_clock_hz=board.waveform.bit_clock_hz,
        samples=board.waveform.samples,
        entries=len(numbers),
        parameters=parameters,
        compositions=len(composed),
    )
    if model:
        row_bytes, many = entries_bytes(model.plate_modes, header.samples, grid.nx), f"{model.modes} modes and "
    else:
        row_bytes, many = BASE_BYTES + cell_bytes(header.samples) * grid.nx, ""
    least_bytes = row_bytes + INDEX_BYTES * grid.cells
    spare_bytes = require(least_bytes, memory_mb, f"a bank of {board.name!r} with {many}{grid.nx} cells a row")
    most = min(CELLS_PER_BLOCK, grid.nx + int(spare_bytes / cell_bytes(header.samples)))
    make_folder(path.parent)
    response_seconds = flops = 0.0
    worst_edge_rate_hz, moves = 0.0, False
    content = hashlib.sha256()
    blocks = _blocks(numbers, grid.nx, most)
    with (
        threadpool_limits(1, "blas"),  # many small products: on a busy machine a second thread costs more than it gains
        BankWriter(
            path, header, wanted, overwrite=overwrite
        ) as writer,  # a folder or disk that cannot take it is refused before the work
        tqdm(total=len(numbers), unit="cell", desc=f"bank {path.name}", disable=None if progress else True) as bar,
    ):
        before = time.process_time()
        if model:
            model.entry_kernel()
        model_seconds = time.process_time() - before
        optimised, optimise_seconds = None, 0.0
        if aim:
            before = time.perf_counter()
            kept = kept_path(path, _inputs_sha256(board, maker, {key: parameters[key] for key in WORDS_DEPEND_ON}))
            optimised = optimised_words(board, highest_hz, aim, numbers, points_m, kept, workers, progress=progress)
            optimise_seconds = time.perf_counter() - before
        room = np.empty((max(map(len, blocks)), header.samples + header.rest_rows, CHANNELS), np.float32)
        for block in blocks:
            places_m = points_m[block.start : block.stop]
            before = time.process_time()
            entries = responses.entry_responses(places_m, out=room[: len(block)])
            response_seconds += time.process_time() - before
            flops += model.entry_flops(places_m) if model else 0.0
            for index, entry in zip(block, entries, strict=True):
                cell, words = int(numbers[index]), drive_words(entry[: header.samples], board.idle_word)
                if optimised is not None:
                    words = optimised[index]
                worst_edge_rate_hz = max(worst_edge_rate_hz, _count_edges(board, words, f"cell {cell}", parameters))
                levels, scale_m_per_v = quantise(entry)
                writer.add(cell, words, levels, scale_m_per_v)
                moves = moves or scale_m_per_v > 0
                for part in (words, levels, np.float32(scale_m_per_v)):
                    content.update(part.data)
            bar.update(len(block))
        if not moves:
            raise ConfigError(
                f"board {board.name!r}: no channel moves any of the {len(numbers)} cells: a bank of nothing is not written"
            )
        for key, words in composed:
            worst_edge_rate_hz = max(worst_edge_rate_hz, _count_edges(board, words, f"{len(key)} spots", parameters))
            writer.add_composition(key, words)
            content.update(words.data)
        parameters["content_sha256"] = content.hexdigest()
        if optimised is not None:
            parameters["amplitude_of_plain"] = _amplitude_of_plain(board, responses, points_m, optimised)
        parameters["interpolation_error"] = interpolation_error(board, responses, grid, wanted).summary()
    remove_kept(path)
    seconds = time.perf_counter() - started
    with threadpool_limits(1, "blas"):  # as many threads as the response step
        rate = best_sgemm_rate() if measure_sgemm and model else None
    return BuildReport(
        path=str(path),
        bytes=header.file_bytes,
        cells=len(numbers),
        modes=model.modes if model else None,
        responses=responses.provenance.in_words(),
        seconds=seconds,
        model_seconds=model_seconds,
        response_seconds=response_seconds,
        sgemm_gflops=rate and rate / 1e9,
        sgemm_share=rate and flops / (rate * response_seconds),
        peak_memory_mb=peak_memory_mb(),
        worst_edge_rate_hz=worst_edge_rate_hz,
        interpolation_error=parameters["interpolation_error"],
        optimised={"aim": aim.name, "amplitude_of_plain": parameters["amplitude_of_plain"]} if aim else None,
        optimise_seconds=optimise_seconds,
    )


def _inputs_sha256(board: Board, maker: str, parameters: dict[str, Any]) -> str:
    """Hash of the board's physics, the program and build parameters: all of them determine a bank."""
    told = json.dumps({"board_digest": board.digest().hex(), "creator": maker, **parameters}, sort_keys=True)
    return hashlib.sha256(told.encode()).hexdigest()


def _amplitude_of_plain(board: Board, source: ResponseSource, points_m: NDArray[np.float64], words: Words) -> dict[str, Any]:
    """Amplitudes of optimised entries over those of plain ones, by all modes, at cells evenly spaced among those of the bank."""
    some = np.unique(np.linspace(0, len(points_m) - 1, CELLS_JUDGED).round().astype(int))
    plain, prediction = SignOfSum(board, source), FocusPrediction(board, source)
    shares = [
        float(
            prediction.at_focus(words[index], points_m[index])[0] / (plain.design([(*points_m[index], 1.0)]).displacement_m[0] or 1)
        )
        for index in some.tolist()
    ]
    found = {name: round(float(find(shares)), 3) for name, find in (("least", np.min), ("median", np.median), ("most", np.max))}
    return {"cells": len(some), **found}


def _blocks(numbers: NDArray[np.intp], cells_per_row: int, most: int) -> list[range]:
    """Positions in `numbers`, ascending cells of a grid, of blocks of whole rows: at most so many cells, but one row."""
    at_once = max(most // cells_per_row, 1) * cells_per_row
    firsts = np.flatnonzero(np.diff(numbers // at_once, prepend=-1)).tolist()
    return [range(first, end) for first, end in zip(firsts, [*firsts[1:], len(numbers)], strict=True)]


def _count_edges(board: Board, words: NDArray[np.uint32], name: str, parameters: dict[str, Any]) -> float:
    """Edges per second of the busiest channel of a waveform, refused above the board's limit; the largest numbers are noted."""
    idle = np.array([board.idle_word], np.uint32)
    counts = edges(np.concatenate([idle, words, idle]))
    own_edges = counts - channel_bits(words[[0, -1]] ^ idle).sum(axis=0)  # without those from and to the idle word
    rate_hz = float(own_edges.max()) / board.waveform.duration_s
    if rate_hz > board.limits.max_edge_rate_hz:
        raise ConfigError(
            f"board {board.name!r}: limits.max_edge_rate_hz = {board.limits.max_edge_rate_hz:g} is less than the {rate_hz:g}"
            f" edges per second of channel {int(own_edges.argmax())} in the waveform of {name}: raise it if the driver allows it"
        )
    parameters["channel_edges"] = max(parameters["channel_edges"], int(counts.max()))
    parameters["all_edges"] = max(parameters["all_edges"], int(counts.sum()))
    return rate_hz


@functools.cache  # of the machine: the same for every build
def best_sgemm_rate(shapes: tuple[tuple[int, int, int], ...] = SGEMM_SHAPES, repeats: int = 4) -> float:
    """Best rate of float32 matrix multiplication, in additions and multiplications for a second of processor time.

    Parameters
    ----------
    shapes : tuple of (int, int, int)
        Rows, inner dimension and columns of the products.
    repeats : int
        Of each shape.
    """
    best = 0.0
    for rows, inner, columns in shapes:
        a, b = np.ones((rows, inner), np.float32), np.ones((inner, columns), np.float32)
        product = np.empty((rows, columns), np.float32)
        for _ in range(repeats):
            before = time.process_time()
            np.matmul(a, b, out=product)
            best = max(best, 2.0 * rows * inner * columns / (time.process_time() - before))
    return best


def peak_memory_mb() -> float:
    """Largest resident memory of this process so far, in MB of 10^6 bytes."""
    try:
        status = Path("/proc/self/status").read_text(encoding="ascii")  # ru_maxrss also counts what exec replaced
        return float(status.partition("VmHWM:")[2].split()[0]) * 1024e-6
    except (OSError, IndexError):
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024e-6
