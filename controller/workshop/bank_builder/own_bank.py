"""A board's own bank: what it is to hold for a scene, whether the one that is there suits, and its build."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from controller.arrays import Bools
from controller.console import tell
from controller.device.bank.grid import Grid
from controller.device.bank.inspection import measured_at
from controller.device.bank.lookup import find_bank
from controller.device.bank.memory import memory_fit
from controller.device.bank.provenance import MEASURE_AGAIN
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.lookup import fpga_files
from controller.device.board.paths import bank_path, build_line
from controller.device.scene.coverage import cells_needed
from controller.device.scene.scene import Scene, load_scene
from controller.device.scene.scene_file import find_scene
from controller.errors import BankError, ConfigError
from controller.workshop.bank_builder.bank_fit import Fit, asked_of, choice_of, fit, optimised_for
from controller.workshop.bank_builder.build import BuildReport, build_bank
from controller.workshop.bank_builder.choice import choose
from controller.workshop.bank_builder.compact.design import compact_grid, compact_pitch_m
from controller.workshop.bank_builder.interpolation_error import interpolation_warning, refuse_coarse
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.plate import wave_scale
from controller.workshop.physics.responses.part_of_responses import PartOfResponses
from controller.workshop.physics.responses.response_source import ResponseSource

SMALLEST_PITCH_MM = 0.5
MET_AHEAD_M = 5e-3  # beyond its region, a moving finger is met this far ahead; farther, where it was


@dataclass(frozen=True)
class Order:
    """What a bank is to hold."""

    board: Board
    pitch_m: float
    scene: Scene | None = None  # scene, scene_file: whose cells and fixed emitters; None: the whole plate, without fixed emitters
    scene_file: Path | None = None
    choice: dict[str, Any] | None = None  # what `compose.method` = "auto" or "compact" chose
    compact: bool = False  # for the whole plate, whatever the scene

    @property
    def own_path(self) -> Path:
        """Where `run` looks for such a bank."""
        own = self.choice or (self.compact and memory_fit(self.board).compact)
        return bank_path(self.board, None if own else self.pitch_m)

    @property
    def grid(self) -> Grid:
        """The grid of its cells."""
        return compact_grid(self.board, self.pitch_m) if self.compact else Grid.of(self.board.plate, self.pitch_m)

    @property
    def cells(self) -> Bools | None:
        """Cells of the grid that the scene can reach; None: all."""
        if self.scene is None or self.compact:
            return None
        return cells_needed(self.scene, self.grid.points(), self.pitch_m, MET_AHEAD_M, wave_scale=wave_scale(self.board))

    def build(self, path: Path, cells: Bools | None = None, **how: Any) -> BuildReport:
        """Build it, its file beside or in place of another; for several FPGAs a file for each; the report is of all of them.

        `cells` (cells of the grid,) take the place of those of the scene; `how` has further fields of `BankRequest`, of which a
        `source` is of the channels of all. Raises ConfigError or BankError.
        """
        if self.choice is None:  # what was chosen keeps the bounds of its error
            refuse_coarse(self.board, self.pitch_m)
        how = {"progress": True, **how}
        wanted = BankRequest(
            self.board,
            path,
            self.pitch_m,
            self.cells if cells is None else cells,
            emitters=self.scene.emitters if self.scene else (),
            scene=self.scene_file.name if self.scene_file else None,
            overwrite=path == self.own_path,
            choice=self.choice,
            compact=self.compact,
            **how,
        )
        first, *others = reports = [build_bank(request) for request in of_each_fpga(wanted)]
        if not others:
            return first
        whole = {name: sum(getattr(one, name) for one in reports) for name in ("bytes", "seconds")}
        return replace(reports[-1], path=str(path), worst_edge_rate_hz=max(one.worst_edge_rate_hz for one in reports), **whole)


def of_each_fpga(request: BankRequest) -> list[BankRequest]:
    """What is built for each FPGA of a board: of the patches that it drives, from their responses."""
    board, source = request.board, request.source
    if not board.link.fpga:
        return [request]
    return [
        replace(request, board=one, path=file, source=None if source is None else PartOfResponses(source, number))
        for number, (one, file) in enumerate(zip(board.fpga_boards, fpga_files(request.path, len(board.link.fpga)), strict=True))
    ]


def order(board: Board, scene_file: Path | None = None, pitch_mm: float | None = None, *, compact: bool = False) -> Order:
    """The order of a bank: for the whole plate, or for the cells that a scene can reach.

    `scene_file` None: the whole plate; where the pitch is chosen, the board's own scene. `pitch_mm` None: the board's own or, where
    its `compose.method` is not "bank", a chosen one. `compact`: a compact bank of the whole plate in any case; so is one that is
    built without a pitch for a machine whose memory is too small for the board's own. Raises ConfigError if the pitch is too
    small, the scene is invalid, or no choice keeps the board's bounds.
    """
    if not pitch_of(board, pitch_mm) >= SMALLEST_PITCH_MM:  # NaN too
        raise ConfigError(f"--pitch-mm: pitch_mm = {pitch_mm:g} is not {SMALLEST_PITCH_MM:g} or more")
    memory = memory_fit(board)
    if memory.compact and pitch_mm is None and not compact:
        tell(memory.in_words())
        compact = True
    scene = load_scene(scene_file, board) if scene_file else None
    if compact:
        return Order(board, compact_pitch_m(board) if pitch_mm is None else pitch_mm * 1e-3, scene, scene_file, compact=True)
    if board.compose.method == "bank" or pitch_mm is not None:
        return Order(board, pitch_of(board, pitch_mm) * 1e-3, scene, scene_file)
    scene_file = scene_file or find_scene(board)
    scene = scene or load_scene(scene_file, board)
    choice = chosen(board, scene, scene_file)
    tell(f"{scene_file.name}: {choice['why']}")
    return Order(board, choice["pitch_mm"] * 1e-3, scene, scene_file, choice, choice["compact"])


def pitch_of(board: Board, pitch_mm: float | None) -> float:
    """The pitch that is asked for, else the board's, in mm."""
    return board.bank.pitch_mm if pitch_mm is None else pitch_mm


def chosen(board: Board, scene: Scene, scene_file: Path, source: ResponseSource | None = None) -> dict[str, Any]:
    """What `compose.method` = "auto" or "compact" chooses for a scene (`choice.choose`)."""
    with threadpool_limits(1, "blas"):
        return choose(board, scene, scene_file, MET_AHEAD_M, source)


def own_bank(board: Board, scene: Scene, scene_file: Path) -> Bank:
    """The board's own bank, built if it is missing, and built again if it does not suit board or scene.

    Raises BankError if it does not suit and was measured, or cannot be built.
    """
    path, to = find_bank(board).path, bank_path(board)
    wanted, found = _wanted(board, scene, scene_file, path)
    if not found.reason:
        return Bank.open(path, board)
    if measured_at(path):
        raise BankError(
            f"{path}: {found.reason}; its responses were measured, so it is not replaced by one from the plate model: build it"
            f" again, {MEASURE_AGAIN}, or give another with --bank"
        )
    tell(f"building the bank {path}: {found.reason}; {int(found.cells.sum()):,} cells, some seconds")
    if aim := optimised_for(path):
        tell(f"its entries were optimised, and become plain: {build_line(path, board)} --optimise {aim}")
    warn_of_pitch(to, wanted.build(to, found.cells))
    return Bank.open(to, board)


def warn_of_pitch(path: Path, report: BuildReport) -> None:
    """Say what a pitch costs, if it costs much."""
    if warning := interpolation_warning(report.interpolation_error):
        tell(f"{path}: {warning}")


def _wanted(board: Board, scene: Scene, scene_file: Path, path: Path) -> tuple[Order, Fit]:
    """What the scene needs, and whether the bank at `path` has it."""
    reason = ""
    if memory_fit(board).compact:
        wanted = Order(board, compact_pitch_m(board), scene, scene_file, compact=True)
    elif board.compose.method == "bank":
        wanted = Order(board, board.bank.pitch_mm * 1e-3, scene, scene_file)
    else:
        there = choice_of(path)
        choice = there if there and there["asked"] == asked_of(board, scene_file) else chosen(board, scene, scene_file)
        wanted = Order(board, choice["pitch_mm"] * 1e-3, scene, scene_file, choice, choice.get("compact", False))
        kinds = ("pitch_mm", "snap_mm", "composes", "compact")
        if there and any(there.get(name, False) != choice.get(name, False) for name in kinds):
            reason = f"{scene_file.name} needs {choice['why'].partition(':')[0]}"
    needed = wanted.cells
    cells = np.ones(wanted.grid.cells, bool) if needed is None else needed
    return wanted, Fit(reason, cells) if reason else fit(path, board, cells)
