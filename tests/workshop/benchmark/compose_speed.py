"""How long composing takes, beside the same in plain C: `python -m tests.workshop.benchmark.compose_speed`.

The product's time is that of the whole call from Python, from a plain bank and from a compact one. All take turns on the same
scenes; of each scene the shortest time counts, of the scenes the median.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import numpy as np

from controller.device import kernel
from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.waveforms.composition import Composer, Point
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.compact.design import compact_pitch_m
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.benchmark.device.plain_c import PlainC

FINGERS = (1, 2, 4, 10)
SCENES = 12
TURNS = 60
MARGIN_M = 12e-3


def scenes_of(grid: Grid, fingers: int, on_grid: bool, amplitude: float, scenes: int = SCENES) -> list[list[Point]]:
    """Fingers at random places, or on cells."""
    random = np.random.default_rng(fingers)
    far = np.array([grid.place(grid.cells - 1)]) - MARGIN_M
    made = []
    for _ in range(scenes):
        places = random.uniform(MARGIN_M, far, (fingers, 2)).tolist()
        if on_grid:
            places = [grid.place(grid.nearest(x_m, y_m)[0]) for x_m, y_m in places]
        made.append([(x_m, y_m, amplitude) for x_m, y_m in places])
    return made


def bank_for(folder: Path, scenes: list[list[Point]]) -> Path:
    """A bank of the simulated board with just the cells that these scenes need."""
    board = load_board(find_board("simulated"))
    pitch_m = board.bank.pitch_mm * 1e-3
    grid = Grid.of(board.plate, pitch_m)
    cells = np.zeros(grid.cells, bool)
    for x_m, y_m, _ in (point for scene in scenes for point in scene):
        cells[list(grid.corners(x_m, y_m)[0])] = True
    build_bank(BankRequest(board, folder / "bank", pitch_m, cells))
    return folder / "bank"


def compared(composer: Composer, reference: PlainC, scene: list[Point], turns: int = TURNS, *others: Composer) -> list[float]:
    """Shortest times of the product, of the reference and of the product with other banks, in us."""
    ways = [partial(taken_ns, composer), reference.compose, *(partial(taken_ns, other) for other in others)]
    best = [float("inf")] * len(ways)
    for _ in range(turns):
        best = [min(least, way(scene)) for least, way in zip(best, ways, strict=True)]
    return [least * 1e-3 for least in best]


def taken_ns(composer: Composer, scene: list[Point]) -> int:
    """Time of one composition."""
    begin = time.perf_counter_ns()
    composer.compose(scene)
    return time.perf_counter_ns() - begin


def main() -> None:
    """Print the table."""
    board = load_board(find_board("simulated"))
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
    kinds = [("off grid", False, 1.0), ("on grid", True, 1.0), ("off grid, amplitude 0.5", False, 0.5)]
    rows = [(name, fingers, scenes_of(grid, fingers, on, amplitude)) for name, on, amplitude in kinds for fingers in FINGERS]
    print(f"kernel: {'compiled' if kernel.COMPILED else 'NumPy'}; us a composition")
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        bank = stack.enter_context(Bank.open(bank_for(folder, [scene for *_, some in rows for scene in some])))
        build_bank(BankRequest(board, folder / "compact", compact_pitch_m(board), compact=True))
        composer = Composer(bank, board.idle_word)
        compact = Composer(stack.enter_context(Bank.open(folder / "compact")), board.idle_word)
        for *_, some in rows:
            for scene in some:
                composer.compose(scene)
                compact.compose(scene)
        reference = PlainC(folder, bank, board.idle_word)
        for name, fingers, some in rows:
            times = [compared(composer, reference, scene, TURNS, compact) for scene in some]
            ours, plain, small = (statistics.median(column) for column in zip(*times, strict=True))
            beside = f", plain C {plain:6.1f}: {ours / plain:.2f}" if some[0][0][2] == 1 else ""
            print(f"{fingers:3} fingers {name:24} {ours:7.1f}, compact bank {small:7.1f}: {small / ours:.2f}{beside}")


if __name__ == "__main__":
    main()
