"""What a build computes, chosen beforehand: cells, source of their responses, header, blocks that fit into memory."""

import hashlib
import json
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from controller.arrays import Bools, Floats, Indices, Reals
from controller.device.bank.file_format import REST_SAMPLES, Header, creator
from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS
from controller.device.bank.provenance import as_parameter
from controller.device.board.board import Board
from controller.errors import ConfigError
from controller.workshop.bank_builder.compact.design import CompactDesign, compact_grid
from controller.workshop.bank_builder.compositions import Composition, compositions
from controller.workshop.bank_builder.methods.aims import DescentAim
from controller.workshop.bank_builder.optimised import reported
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.memory import BASE_BYTES, cell_bytes, entries_bytes, require
from controller.workshop.physics.plate import band_lost, equaliser, wave_scale
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.loaded_responses import words_source, yielding_alike
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.physics.responses.transformed_responses import TransformedResponses

INDEX_BYTES = 200  # of a cell of the grid, in what is known of all cells: place, number, checksums
CELLS_PER_BLOCK = 512  # at least one row of the grid; 74 MB of responses at 1000 samples
SAME = 1e-6  # relative: numbers that differ by less are written in files


@dataclass(frozen=True)
class BankPlan:
    """What is computed, and from what."""

    board: Board
    wanted: Bools  # (cells of the grid,)
    numbers: Indices  # numbers, points_m: of the cells that are wanted
    points_m: Floats
    source: ResponseSource  # of the words: under the board's finger, if it has one
    modes: int | None  # in every response; None: the responses do not come from modes
    header: Header  # its parameters that are results are filled in as entries are made; it is written last
    composed: list[Composition]  # what the fixed emitters play together
    blocks: list[range]  # positions in `numbers` of cells that are computed at once
    design: CompactDesign | None = None  # of a compact bank

    @classmethod
    def of(cls, request: BankRequest) -> Self:
        """BankPlan a build; ConfigError where it cannot be."""
        board, source = request.board_as_chosen, request.source
        if request.aim is not None:
            refuse_aim(board, request.aim, measured=source is not None, compact=request.compact)
            if source is not None and request.plate is None:
                kind = source.provenance.kind
                raise ConfigError(f"responses that are {kind} cannot be optimised: that takes the field of the whole plate")
        pitch_m = board.bank.pitch_mm * 1e-3 if request.pitch_m is None else request.pitch_m
        grid = compact_grid(board, pitch_m) if request.compact else Grid.of(board.plate, pitch_m)
        wanted = _wanted(request, grid)
        numbers = np.flatnonzero(wanted)
        bare = ResponseModel(board, request.highest_mode_hz) if source is None else CheckedSource(board, source)
        worded = yielding_alike(board) if request.compact else board
        found = words_source(worded, bare, bare.plate_modes if isinstance(bare, ResponseModel) else None)
        parameters = _parameters(request, grid, wanted, found)
        design = CompactDesign.of(board, found, [grid])[0] if request.compact else None
        if design:
            parameters |= design.parameters
        composed = compositions(board, grid, found, request.emitters) if request.emitters else []
        header = Header(
            creator=creator(),
            board_digest=board.digest(),
            grid=grid,
            bit_clock_hz=board.waveform.bit_clock_hz,
            samples=board.waveform.samples,
            entries=len(numbers),
            parameters=parameters,
            compositions=len(composed),
        )
        more_bytes = sum(one.working_bytes for one in (design, found) if isinstance(one, (CompactDesign, TransformedResponses)))
        more_bytes += request.plate.working_bytes if request.plate else 0.0
        blocks = _blocks(numbers, grid.nx, _cells_at_once(request, header, bare, more_bytes))
        modes = bare.modes if isinstance(bare, ResponseModel) else None
        return cls(board, wanted, numbers, grid.points()[numbers], found, modes, header, composed, blocks, design)


def refuse_aim(board: Board, aim: DescentAim, *, measured: bool, compact: bool) -> None:
    """Refuse a board, responses or a form of bank that cannot be optimised for an aim; raises ConfigError."""
    if compact:
        raise ConfigError("a compact bank holds no waveforms of cells that could be optimised")
    if measured and aim.felt_turns:
        raise ConfigError("measured responses cannot be optimised to be felt: that takes a model of the plate under a finger")
    if board.finger is not None or board.waveform.drift_percent:
        key = "[finger]" if board.finger is not None else "waveform.drift_percent"
        what = "a bare plate that does not drift"
        raise ConfigError(f"board {board.name!r}: entries are optimised for {what}: leave out {key}, or --optimise")


def _wanted(request: BankRequest, grid: Grid) -> Bools:
    """Cells of the grid that are to be built."""
    wanted = np.ones(grid.cells, bool) if request.cells is None else np.asarray(request.cells, bool)
    if wanted.shape != (grid.cells,):
        raise ValueError(f"cells are {wanted.shape}, not ({grid.cells},)")
    if not wanted.any():
        raise ConfigError(
            f"{request.scene or 'scene'}: no region reaches a cell of the {grid.pitch_m * 1e3:g} mm grid: nothing to build"
        )
    return wanted


def _parameters(request: BankRequest, grid: Grid, wanted: Bools, source: ResponseSource) -> dict[str, Any]:
    """Build parameters, as the header has them, and places for what is known at the end."""
    board, choice, emitters, aim = request.board_as_chosen, request.choice, request.emitters, request.aim
    parameters: dict[str, Any] = {
        "board": board.key,
        "pitch_mm": grid.pitch_m * 1e3,
        "wave_scale": wave_scale(board),
        "equaliser": equaliser(board, grid.pitch_m),
        "band_lost": band_lost(board, grid.pitch_m),
        "highest_hz": request.highest_mode_hz if request.source is None else None,
        "precision": "float32",
        "responses": as_parameter(source.provenance),
        "scene": request.scene,
        "cells_sha256": hashlib.sha256(np.packbits(wanted).tobytes()).hexdigest(),
        **({} if choice is None else {"choice": choice, "composes": choice["composes"]}),
        "spots_sha256": hashlib.sha256(repr([(*emitter[:3], *emitter[4:]) for emitter in emitters]).encode()).hexdigest(),
        "optimised": aim and reported(board, aim, request.plate),
    }
    return parameters | {
        "inputs_sha256": inputs_sha256(board, parameters),
        "content_sha256": "0" * 64,
        "channel_edges": 0,
        "all_edges": 0,
        "amplitude_of_plain": aim and {"cells": 10**3, "least": 0.001, "median": 0.001, "most": 0.001},
        **({"contrast_of_plain": {"by_responses": 0.001, "with_error": 0.001}} if request.plate else {}),
        "interpolation_error": {},
        "amplitude_um": [0.0001111] * 3,  # of most digits
    }


def _cells_at_once(request: BankRequest, header: Header, source: ResponseSource, more_bytes: float) -> int:
    """Cells for which the memory that the build may take is enough."""
    grid, samples = header.grid, header.samples
    if isinstance(source, ResponseModel):
        row_bytes, many = entries_bytes(source.plate_modes, samples, grid.nx), f"{source.modes} modes and "
    else:
        row_bytes, many = BASE_BYTES + cell_bytes(samples) * grid.nx, ""
    what = f"a bank of {request.board.name!r} with {many}{grid.nx} cells a row"
    spare_bytes = require(row_bytes + INDEX_BYTES * grid.cells + more_bytes, request.memory_mb, what)
    return min(CELLS_PER_BLOCK, grid.nx + int(spare_bytes / cell_bytes(samples)))


def inputs_sha256(board: Board, parameters: dict[str, Any]) -> str:
    """Hash of the board's physics, the program and build parameters: all of them determine a bank."""
    text = json.dumps({"board_digest": board.digest().hex(), "creator": creator(), **parameters}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _blocks(numbers: Indices, cells_per_row: int, most: int) -> list[range]:
    """Positions in `numbers`, ascending cells of a grid, of blocks of whole rows: at most `most` cells, but one row."""
    at_once = max(most // cells_per_row, 1) * cells_per_row
    firsts = np.flatnonzero(np.diff(numbers // at_once, prepend=-1)).tolist()
    return [range(first, end) for first, end in zip(firsts, [*firsts[1:], len(numbers)], strict=True)]


class CheckedSource:
    """A `ResponseSource` whose responses are checked before they are used.

    Raises ConfigError if the source is of another plate, bit clock or length of an emission.
    """

    def __init__(self, board: Board, source: ResponseSource) -> None:
        self._source = source
        self.provenance, self.samples = source.provenance, source.samples
        self.bit_clock_hz, self.plate_m = source.bit_clock_hz, source.plate_m
        self._undriven = np.setdiff1d(np.arange(CHANNELS), [a.channel for a in board.actuators])
        waveform, plate = board.waveform, board.plate
        for what, unit, theirs, own in (
            ("a bit clock of", "Hz", source.bit_clock_hz, waveform.bit_clock_hz),
            ("an emission of", "samples", source.samples, waveform.samples),
            ("a plate whose length is", "m", source.plate_m[0], plate.length_m),
            ("a plate whose width is", "m", source.plate_m[1], plate.width_m),
        ):
            if abs(theirs - own) > SAME * own:
                raise ConfigError(
                    f"board {board.name!r}: the {source.provenance.kind} responses are for {what} {theirs:g} {unit}, the"
                    f" board has {own:g} {unit}: choose the board that was measured, or measure this one"
                )

    def responses(
        self, points_m: ArrayLike, *, band_limited: bool = False, dtype: DTypeLike = np.float64, out: Reals | None = None
    ) -> Reals:
        """As `ResponseSource.responses`."""
        found = self._source.responses(points_m, band_limited=band_limited, dtype=dtype, out=out)
        return self._checked(found, points_m, self.samples)

    def drive_order_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource.drive_order_responses`."""
        return self._checked(self._source.drive_order_responses(points_m, out, dtype), points_m, self.samples)

    def entry_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource.entry_responses`."""
        rows = self.samples + -(-self.samples // REST_SAMPLES)
        return self._checked(self._source.entry_responses(points_m, out, dtype), points_m, rows)

    def _checked(self, found: Reals, points_m: ArrayLike, rows: int) -> Reals:
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        if found.shape != (len(points), rows, CHANNELS):
            raise ConfigError(f"{self._called}: they are {found.shape}, not {(len(points), rows, CHANNELS)}")
        bad = np.flatnonzero(~np.isfinite(found).all(axis=(1, 2)))
        if bad.size:
            x_mm, y_mm = 1e3 * points[bad[0]]
            raise ConfigError(f"{self._called}: that of ({x_mm:g}, {y_mm:g}) mm has values that are not finite")
        moved = self._undriven[found[:, :, self._undriven].any(axis=(0, 1))]
        if moved.size:
            raise ConfigError(f"{self._called}: channel {moved[0]} moves the plate, but has no actuator on this board")
        return found

    @property
    def _called(self) -> str:
        return f"the {self.provenance.kind} responses cannot be used"
