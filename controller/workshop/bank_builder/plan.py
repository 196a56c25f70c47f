"""What a build computes, chosen beforehand: cells, source of their responses, header, blocks that fit into memory."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.device.bank.file_format import Header, creator
from controller.device.bank.grid import Grid
from controller.device.bank.provenance import as_parameter
from controller.device.board.board import Board
from controller.errors import ConfigError
from controller.workshop.bank_builder.checked_source import CheckedSource
from controller.workshop.bank_builder.compositions import Composition, compositions
from controller.workshop.bank_builder.optimised import reported
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.memory import BASE_BYTES, cell_bytes, entries_bytes, require
from controller.workshop.physics.plate import wave_scale
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.response_source import ResponseSource

INDEX_BYTES = 200  # of a cell of the grid, in what is known of all cells: place, number, checksums
CELLS_PER_BLOCK = 512  # at least one row of the grid; 74 MB of responses at 1000 samples


@dataclass(frozen=True)
class BankPlan:
    """What is computed, and from what."""

    board: Board
    wanted: NDArray[np.bool_]  # (cells of the grid,)
    numbers: NDArray[np.intp]  # numbers, points_m: of the cells that are wanted
    points_m: NDArray[np.float64]
    source: ResponseSource
    header: Header  # its parameters that are results are filled in as entries are made; it is written last
    composed: list[Composition]  # what the fixed emitters play together
    blocks: list[range]  # positions in `numbers` of cells that are computed at once

    @classmethod
    def of(cls, request: BankRequest) -> BankPlan:
        """BankPlan a build; ConfigError where it cannot be."""
        board, source = request.board_as_chosen, request.source
        if request.aim is not None and source is not None:
            kind = source.provenance.kind
            raise ConfigError(f"responses that are {kind} cannot be optimised: that takes a model of the whole plate")
        grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3 if request.pitch_m is None else request.pitch_m)
        wanted = _wanted(request, grid)
        numbers = np.flatnonzero(wanted)
        found = ResponseModel(board, request.highest_mode_hz) if source is None else CheckedSource(board, source)
        parameters = _parameters(request, grid, wanted, found)
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
        blocks = _blocks(numbers, grid.nx, _cells_at_once(request, header, found))
        return cls(board, wanted, numbers, grid.points()[numbers], found, header, composed, blocks)

    @property
    def model(self) -> ResponseModel | None:
        """The plate model, where responses come from it."""
        return self.source if isinstance(self.source, ResponseModel) else None


def _wanted(request: BankRequest, grid: Grid) -> NDArray[np.bool_]:
    """Cells of the grid that are to be built."""
    wanted = np.ones(grid.cells, bool) if request.cells is None else np.asarray(request.cells, bool)
    if wanted.shape != (grid.cells,):
        raise ValueError(f"cells are {wanted.shape}, not ({grid.cells},)")
    if not wanted.any():
        raise ConfigError(
            f"{request.scene or 'scene'}: no region reaches a cell of the {grid.pitch_m * 1e3:g} mm grid: nothing to build"
        )
    return wanted


def _parameters(request: BankRequest, grid: Grid, wanted: NDArray[np.bool_], source: ResponseSource) -> dict[str, Any]:
    """Build parameters, as the header has them, and places for what is known at the end."""
    board, choice, emitters, aim = request.board_as_chosen, request.choice, request.emitters, request.aim
    parameters: dict[str, Any] = {
        "board": board.key,
        "pitch_mm": grid.pitch_m * 1e3,
        "wave_scale": wave_scale(board),
        "highest_hz": request.highest_mode_hz if request.source is None else None,
        "precision": "float32",
        "responses": as_parameter(source.provenance),
        "scene": request.scene,
        "cells_sha256": hashlib.sha256(np.packbits(wanted).tobytes()).hexdigest(),
        **({} if choice is None else {"choice": choice, "composes": choice["composes"]}),
        "spots_sha256": hashlib.sha256(repr([(*emitter[:3], *emitter[4:]) for emitter in emitters]).encode()).hexdigest(),
        "optimised": aim and reported(board, aim),
    }
    return parameters | {
        "inputs_sha256": inputs_sha256(board, parameters),
        "content_sha256": "0" * 64,
        "channel_edges": 0,
        "all_edges": 0,
        "amplitude_of_plain": aim and {"cells": 10**3, "least": 0.001, "median": 0.001, "most": 0.001},
        "interpolation_error": {},
    }


def _cells_at_once(request: BankRequest, header: Header, source: ResponseSource) -> int:
    """Cells for which the memory that the build may take is enough."""
    grid, samples = header.grid, header.samples
    if isinstance(source, ResponseModel):
        row_bytes, many = entries_bytes(source.plate_modes, samples, grid.nx), f"{source.modes} modes and "
    else:
        row_bytes, many = BASE_BYTES + cell_bytes(samples) * grid.nx, ""
    what = f"a bank of {request.board.name!r} with {many}{grid.nx} cells a row"
    spare_bytes = require(row_bytes + INDEX_BYTES * grid.cells, request.memory_mb, what)
    return min(CELLS_PER_BLOCK, grid.nx + int(spare_bytes / cell_bytes(samples)))


def inputs_sha256(board: Board, parameters: dict[str, Any]) -> str:
    """Hash of the board's physics, the program and build parameters: all of them determine a bank."""
    text = json.dumps({"board_digest": board.digest().hex(), "creator": creator(), **parameters}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _blocks(numbers: NDArray[np.intp], cells_per_row: int, most: int) -> list[range]:
    """Positions in `numbers`, ascending cells of a grid, of blocks of whole rows: at most `most` cells, but one row."""
    at_once = max(most // cells_per_row, 1) * cells_per_row
    firsts = np.flatnonzero(np.diff(numbers // at_once, prepend=-1)).tolist()
    return [range(first, end) for first, end in zip(firsts, [*firsts[1:], len(numbers)], strict=True)]
