"""Which pitch and snap distance a bank gets, and whether it holds responses: the smallest bank that keeps a scene's bounds.

Candidates are settings that a device has: cells at some pitch that are played as they are, or responses interpolated between
them, with cells played within a snap distance. Each has an error, measured on the plate's model at places of the scene; a time,
from the table of the benchmark; and bytes. Those that no other pulses in all three are the front, and the choice is on it.
"""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.device.bank.memory import memory_fit
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.loop.fixed_emitters import needs_responses
from controller.device.scene.coverage import cells_needed
from controller.device.scene.scene import Scene
from controller.errors import ConfigError
from controller.workshop.bank_builder.bank_fit import asked_of
from controller.workshop.bank_builder.compact.design import PITCHES, CompactDesign, compact_grid, compact_pitch_m
from controller.workshop.bank_builder.interpolation_error import DIGITS, InterpolationError, interpolation_error
from controller.workshop.physics.plate import wave_scale
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.loaded_responses import words_source, yielding_alike
from controller.workshop.physics.responses.response_source import ResponseSource

# On the paper's plate; on others they go with the length of its waves
PITCHES_MM = (0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 32.0, 40.0, 50.0)
FINEST = 1 / 8  # of the wavelength: what lies between finer cells and these is below the other errors
SNAPS_MM = (0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0)
BEYOND = 3.0  # pitches: a cell is at most so far from any place of the plate
# Host time in us with the compiled kernel (`python -m tests.workshop.benchmark.compose_speed`, workshop/benchmark/README.md): the
# frames of a cell, the words of one finger, of ten at full and of ten at less than full amplitude
CELL_US, ONE_US, TEN_US, TEN_LESS_US = 0.14, 6.3, 268.0, 373.0
COMPACT_ONE, COMPACT_TEN, COMPACT_TEN_LESS = 1.95, 1.6, 1.4  # times as long from a compact bank


@dataclass(frozen=True)
class Setting:
    """A candidate, and what it costs."""

    pitch_mm: float
    snap_mm: float
    composes: bool  # whether the bank holds responses
    error: float  # largest loss of amplitude at the sampled places
    time_us: float  # of the largest emission
    lone_us: float  # of a lone finger, mean
    bytes: int
    compact: bool = False  # whether responses are weights of pulses, and no cell is played as it is

    def beaten_by(self, other: Self) -> bool:
        """Whether another is as good in everything, and better in something."""
        mine, its = ((s.error, s.lone_us, s.bytes) for s in (self, other))
        return its != mine and all(a <= b for a, b in zip(its, mine, strict=True))


def settings(board: Board, scene: Scene, margin_m: float, source: ResponseSource | None = None) -> list[Setting]:
    """All candidates for a scene. `margin_m` is as of `cells_needed`; responses come from the board's plate model by default."""
    wavelength_m = bending_wavelength_m(board.plate, board.waveform.band_high_hz)
    bare, scale = source or ResponseModel(board), wave_scale(board)
    source = words_source(board, bare)
    alone = not needs_responses(scene, scale) and board.application_socket is None
    ready = alone and len(scene.emitters) > 1 and not any(region.felt for region in scene.regions)  # all composed beforehand
    evaluated: list[tuple[Grid, np.ndarray[Any, np.dtype[np.bool_]], InterpolationError]] = []
    for pitch_m in (_rounded(pitch_mm * scale) * 1e-3 for pitch_mm in PITCHES_MM):
        if FINEST * wavelength_m <= pitch_m <= wavelength_m / 2:
            grid = Grid.of(board.plate, pitch_m)
            cells = cells_needed(scene, grid.points(), pitch_m, margin_m, wave_scale=scale)
            if cells.any():
                evaluated.append((grid, cells, interpolation_error(board, source, grid, cells)))
    apart_m = np.concatenate([error.distance_m for *_, error in evaluated] or [np.zeros(0)])
    lost = np.concatenate([error.nearest for *_, error in evaluated] or [np.zeros(0)])

    def of_cells(within_m: float) -> float:
        """What is lost at most by playing a cell up to some distance: the same at every pitch."""
        return float(lost[apart_m <= within_m].max(initial=0.0))

    found = []
    for grid, cells, error in evaluated:
        pitch_mm, between = grid.pitch_m * 1e3, float(error.interpolated.max(initial=0.0))
        if alone:
            worst = 0.0 if ready else round(of_cells(grid.pitch_m * 0.5**0.5), DIGITS)
            size = _bytes(board, grid, cells, composes=False)
            found.append(Setting(pitch_mm, BEYOND * pitch_mm, False, worst, CELL_US, CELL_US, size))
        for snap_mm in (_rounded(snap_mm * scale) for snap_mm in SNAPS_MM if snap_mm * scale <= pitch_mm / 2):
            snapped = np.pi * (snap_mm / pitch_mm) ** 2
            lone_us = round(snapped * CELL_US + (1 - snapped) * ONE_US, 2)
            time_us = (ONE_US if alone else TEN_US) if _full(scene) else TEN_LESS_US
            worst = round(max(between, of_cells(snap_mm * 1e-3)), DIGITS)
            found.append(Setting(pitch_mm, snap_mm, True, worst, time_us, lone_us, _bytes(board, grid, cells, composes=True)))
    if board.compose.method == "compact" or not alone:
        found += _compact_settings(board, scene, words_source(yielding_alike(board), bare))
    found = [replace(one, bytes=len(board.fpga_boards) * one.bytes) for one in found]  # a file for each
    return [one for one in found if one.compact] if board.compose.method == "compact" else found


def _compact_settings(board: Board, scene: Scene, source: ResponseSource) -> list[Setting]:
    """Compact banks of the whole plate; none where none can be; ConfigError if only such a bank will do."""
    pitches_m = [compact_pitch_m(board, share) for share in PITCHES]
    try:
        designs = CompactDesign.of(board, source, [compact_grid(board, pitch_m) for pitch_m in pitches_m])
    except ConfigError:
        if board.compose.method == "compact":
            raise
        return []
    time_us, lone_us = (TEN_US * COMPACT_TEN if _full(scene) else TEN_LESS_US * COMPACT_TEN_LESS), ONE_US * COMPACT_ONE
    made = []
    for pitch_m, design in zip(pitches_m, designs, strict=True):
        header = Header("", b"", design.grid, board.waveform.bit_clock_hz, design.samples, design.grid.cells, design.parameters)
        error = round(design.expected_loss, DIGITS + 1)
        made.append(Setting(_rounded(1e3 * pitch_m), 0.0, True, error, round(time_us), round(lone_us, 2), header.file_bytes, True))
    return made


def choose(board: Board, scene: Scene, scene_file: Path, margin_m: float, source: ResponseSource | None = None) -> dict[str, Any]:
    """What `compose.method` = "auto" or "compact" chooses for a scene, to be written into its bank.

    `margin_m` is as of `cells_needed`; responses come from the board's plate model by default. Returns the fields of the chosen
    `Setting`; `asked`, as `bank_fit.asked_of`; `scene`; `why`, a line for people; `front`: pitch, snap (None: no responses),
    error, time of a lone finger and bytes of each setting on the front. Raises ConfigError if no setting keeps all bounds.
    """
    found = settings(board, scene, margin_m, source)
    front = [one for one in found if not any(one.beaten_by(other) for other in found)]
    bounds, most_bytes = board.compose, 1e6 * (board.compose.max_bank_mb or math.inf)
    kept = [one for one in front if one.error <= bounds.max_error and one.time_us <= bounds.max_time_us and one.bytes <= most_bytes]
    memory = memory_fit(board)
    small = [one for one in kept if one.compact or one.bytes <= memory.most_bytes]
    if kept and not small:  # better late than from a bank that does not stay in memory
        small = [one for one in found if one.compact and one.error <= bounds.max_error and one.bytes <= most_bytes]
    kept = small or kept
    if not kept:
        raise ConfigError(_none(board, scene_file.name, found))
    best = min(kept, key=lambda one: (one.bytes, one.lone_us))
    in_time = best.time_us <= bounds.max_time_us
    then = (
        f"and take at most {bounds.max_time_us:g} us"
        if in_time
        else f"though it takes {best.time_us:g} us: others take much memory"
    )
    how = f"responses every {best.pitch_mm:g} mm, cells within {best.snap_mm:g} mm of a lone finger"
    if best.compact:
        how = f"a compact bank of the whole plate, cells every {best.pitch_mm:g} mm"
    if not best.composes:
        how = f"cells every {best.pitch_mm:g} mm without responses: the scene asks for nothing between them"
    return asdict(best) | {
        "asked": asked_of(board, scene_file),
        "scene": scene_file.name,
        "why": f"{how}: the smallest of {len(kept)} settings on the front that lose at most {100 * bounds.max_error:g} % {then}",
        "front": [[one.pitch_mm, one.snap_mm if one.composes else None, one.error, one.lone_us, one.bytes] for one in front],
    }


def _rounded(length_mm: float) -> float:
    """To three digits, for people."""
    return float(f"{length_mm:.3g}")


def _none(board: Board, called: str, found: Sequence[Setting]) -> str:
    bounds = board.compose
    said = f"board {board.name!r}: compose.max_error = {bounds.max_error:g} and compose.max_time_us = {bounds.max_time_us:g}"
    together = "both"
    if bounds.max_bank_mb is not None:
        said, together = f"{said} and compose.max_bank_mb = {bounds.max_bank_mb:g}", "all"
    if not found:
        return f"{said}: {called} reaches no cell of a grid between {FINEST:g} and 0.5 wavelengths"
    least, fastest = min(found, key=lambda one: one.error), min(found, key=lambda one: one.time_us)
    smallest = min(found, key=lambda one: (one.bytes, one.error))
    return (
        f"{said} cannot {together} be kept for {called}: the least error is {least.error:g} ({least.time_us:g} us), the least time"
        f" {fastest.time_us:g} us (error {min(one.error for one in found if one.time_us == fastest.time_us):g}), the smallest bank"
        f" {smallest.bytes / 1e6:.2g} MB (error {smallest.error:g})"
    )


def _full(scene: Scene) -> bool:
    """Whether everything in a scene has full amplitude."""
    trains = [train for region in scene.regions for train in (*region.press, *region.release, *region.enter, *region.leave)]
    steps = [
        *(step.amplitude for region in scene.regions for step in region.spacings),
        *(emitter.amplitude for emitter in scene.emitters),
    ]
    return all(step == 1 for step in steps) and not any(train.amplitude != 1 or train.envelope for train in trains)


def _bytes(board: Board, grid: Grid, cells: Any, *, composes: bool) -> int:
    """Size of a bank's file."""
    header = Header("", b"", grid, board.waveform.bit_clock_hz, board.waveform.samples, int(cells.sum()), {"composes": composes})
    return header.file_bytes
