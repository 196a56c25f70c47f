"""What a compact bank of a board is made of: pulses and stencils, learned from responses at some places; then rows of all cells."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from controller.arrays import Bools, Reals, blocks
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.kernel import compact_twin
from controller.errors import ConfigError
from controller.workshop.bank_builder.compact.of_band import of_band, without
from controller.workshop.bank_builder.compact.pulses import Pulses, in_band_pulses, rest_pulses
from controller.workshop.bank_builder.compact.rounding import rounded
from controller.workshop.bank_builder.compact.stencils import CompactStencil, stencil
from controller.workshop.physics.responses.response_source import ResponseSource

PLACES: Final = 48  # from whose responses pulses are learned
SEED: Final = 1
ACROSS: Final = 5  # cells of a stencil
STEPS: Final = 8  # of a pitch, between which shares are linear
REST_ACROSS: Final = 5
REST_STEPS: Final = 8
BLOCK: Final = 16  # weights that have a scale in common
REST_BLOCK: Final = 32
REST_PITCH: Final = 1.85  # of the grid of the rest, in pitches
FITTED_AT: Final = ((0.25, 0.25), (0.75, 0.75))  # of a pitch, beside each cell: where sums of cells meet responses
BEYOND_BAND: Final = 0.1  # of the band's width, above and below
CELLS_AT_ONCE: Final = 128
COLUMNS_AT_ONCE: Final = 512
PITCHES: Final = (0.45, 0.485, 0.51)  # of the shortest wave; the middle one where none is asked for
WORSE_THAN_EXPECTED: Final = 8.0  # a place at a side of the plate, as far as was seen


@dataclass(frozen=True, eq=False)
class CompactDesign:
    """Pulses and stencils in the band, and of the rest beside it."""

    grid: Grid
    rest_grid: Grid
    pulses: Pulses
    rest_pulses: Pulses
    stencil: CompactStencil
    rest_stencil: CompactStencil
    of_band: compact_twin.OfBand
    samples: int

    @classmethod
    def of(cls, board: Board, source: ResponseSource, grids: Sequence[Grid]) -> list[Self]:
        """Designs for some grids; ConfigError if the plate or the bit clock is too small for them."""
        waveform, plate = board.waveform, board.plate
        rest_grids = [_rest_grid(board, grid) for grid in grids]
        random = np.random.default_rng(SEED)
        points_m = random.uniform((0, 0), (plate.length_m, plate.width_m), (PLACES, 2))
        rows = waveform.samples + math.ceil(waveform.samples / REST_SAMPLES)
        responses = source.entry_responses(points_m, out=np.empty((PLACES, rows, board.channels), np.float32)).astype(np.float64)
        in_band = responses[:, : waveform.samples]
        made = of_band(waveform, in_band, responses[:, waveform.samples :])
        rest = without(made, responses, waveform.samples)
        beyond_hz = BEYOND_BAND * (waveform.band_high_hz - waveform.band_low_hz)
        power, hz = _spectrum(in_band, waveform.bit_period_s)
        inside = (hz > waveform.band_low_hz - beyond_hz) & (hz < waveform.band_high_hz + beyond_hz)
        rest_power, rest_hz = _spectrum(rest, waveform.bit_period_s * REST_SAMPLES)
        below = (rest_hz > 0) & (rest_hz < waveform.band_low_hz + beyond_hz)
        pulses = in_band_pulses(waveform, in_band), rest_pulses(waveform, rest)
        return [
            cls(
                grid,
                rest_grid,
                *pulses,
                stencil(plate, grid.pitch_m, ACROSS, STEPS, power[inside], hz[inside]),
                stencil(plate, rest_grid.pitch_m, REST_ACROSS, REST_STEPS, rest_power[below], rest_hz[below]),
                made,
                waveform.samples,
            )
            for grid, rest_grid in zip(grids, rest_grids, strict=True)
        ]

    @property
    def layers(self) -> tuple[compact_twin.PulseLayer, compact_twin.PulseLayer]:
        """Numbers of the band, and of the rest."""
        made = []
        for pulses, own, block in ((self.pulses, self.stencil, BLOCK), (self.rest_pulses, self.rest_stencil, REST_BLOCK)):
            made.append(
                compact_twin.PulseLayer(own.across, own.steps, pulses.weights, min(block, pulses.weights), pulses.taps.shape[1])
            )
        return made[0], made[1]

    @property
    def row_bytes(self) -> int:
        """Bytes of a cell."""
        layer = self.layers[0]
        return compact_twin.row_bytes(layer.weights, layer.block_rows)

    @property
    def tables_bytes(self) -> int:
        """Bytes of `tables`."""
        outputs = len(self.pulses.first), len(self.rest_pulses.first)
        return compact_twin.tables_bytes(self.layers, outputs, self.rest_grid.cells)

    @property
    def parameters(self) -> dict[str, Any]:
        """Build parameters of a bank that is made of this."""
        return {"compact": {"row_bytes": self.row_bytes, "tables_bytes": self.tables_bytes}}

    @property
    def expected_loss(self) -> float:
        """Share of the amplitude that a lone finger may lose at the worst place."""
        return WORSE_THAN_EXPECTED * (self.pulses.error + self.stencil.error[1]) / 2

    @property
    def working_bytes(self) -> float:
        """Memory that `rows` takes: weights, what they are solved from, their errors and numbers, in float32 and bytes."""
        return self.grid.cells * self.pulses.weights * CHANNELS * 25.0

    def rows(
        self, source: ResponseSource, there: Bools, use: Callable[[int, Reals], None]
    ) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
        """Bytes of the cells that are `there` (cell, byte), and m per V of a level; `use` is called with cells and responses."""

        def responses(points_m: Reals, cells: list[int]) -> Reals:
            found = source.drive_order_responses(points_m)
            for cell, response in zip(cells, found, strict=True):
                if cell >= 0:
                    use(cell, response)
            return found

        weights = _fitted(self.grid, self.stencil, self.pulses, there, responses)
        return rounded(weights, self.grid.nx, self.layers[0].block_rows, self.stencil, self.pulses.together)

    def rest_rows(self, source: ResponseSource) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
        """As `rows`, of the rest beside the band."""
        count = self.samples + math.ceil(self.samples / REST_SAMPLES)

        def responses(points_m: Reals, cells: list[int]) -> Reals:
            found = source.entry_responses(points_m, out=np.empty((len(cells), count, CHANNELS), np.float32))
            return without(self.of_band, found, self.samples)

        everywhere = np.ones(self.rest_grid.cells, bool)
        weights = _fitted(self.rest_grid, self.rest_stencil, self.rest_pulses, everywhere, responses)
        return rounded(weights, self.rest_grid.nx, self.layers[1].block_rows, self.rest_stencil, self.rest_pulses.together)

    def tables(self, rest_rows: NDArray[np.uint8], rest_scales: NDArray[np.float32]) -> bytes:
        """What all cells have in common, and the rest beside the band (`compact_twin.CompactTables`)."""
        grid = self.rest_grid
        head = compact_twin.HEAD.pack(
            *self.layers[0], *self.layers[1], *self.pulses.odd, grid.nx, grid.ny, grid.pitch_m, grid.x0_m, grid.y0_m
        )
        head += compact_twin.OF_BAND.pack(*self.of_band)
        parts: list[NDArray[Any]] = []
        for pulses, own in ((self.pulses, self.stencil), (self.rest_pulses, self.rest_stencil)):
            parts += [own.table.astype("<i2"), np.column_stack([pulses.first, pulses.taps]).astype("<i2")]
        made = bytearray(head.ljust(compact_twin.TABLES_AT, b"\0"))
        for part in (*parts, rest_scales.astype("<f4"), rest_rows):
            made += part.tobytes()
            made += bytes(-len(made) % compact_twin.LINE)
        return bytes(made)


def _fitted(
    grid: Grid,
    own: CompactStencil,
    pulses: Pulses,
    there: Bools,
    responses: Callable[[Reals, list[int]], Reals],
) -> NDArray[np.float32]:
    """Weights of all cells, (cell, weight, 32), whose sums between cells are next to the responses: least squares.

    `responses` gives those at places, of which some are beside a cell, the others beside none (-1). Cells that are not `there`
    weigh nothing.
    """
    places, shares, beside = [], [], []
    for cell in np.flatnonzero(there).tolist():
        iy, ix = divmod(cell, grid.nx)
        for number, at in enumerate(FITTED_AT):
            steps = round((ix + at[0]) * own.steps), round((iy + at[1]) * own.steps)
            cells, of_cells = own.met_by(grid, steps)
            if ix + 1 < grid.nx and iy + 1 < grid.ny and there[cells].all():
                places.append([grid.x0_m + steps[0] / own.steps * grid.pitch_m, grid.y0_m + steps[1] / own.steps * grid.pitch_m])
                shares.append(sparse.csr_array((of_cells, ([0] * len(cells), cells)), shape=(1, grid.cells)))
                beside.append(-1 if number else cell)
    found = np.zeros((grid.cells, pulses.weights * CHANNELS), np.float32)
    if not places:
        return found.reshape(grid.cells, pulses.weights, CHANNELS)
    met = sparse.vstack(shares, format="csr")
    for some in blocks(len(places), CELLS_AT_ONCE):
        weights = np.matmul(pulses.analysis, responses(np.array(places[some]), beside[some]))
        found += met[some].T.astype(np.float32) @ weights.reshape(len(weights), -1)
    ridge = own.let_through * len(FITTED_AT) * sparse.eye_array(grid.cells)
    solve = splu((met.T @ met + ridge).tocsc()).solve
    for columns in blocks(found.shape[1], COLUMNS_AT_ONCE):
        found[:, columns] = solve(found[:, columns].astype(np.float64))
    return found.reshape(grid.cells, pulses.weights, CHANNELS)


def compact_pitch_m(board: Board, share: float = PITCHES[1]) -> float:
    """A pitch for a compact bank, to a tenth of a millimetre on the paper's plate."""
    return float(f"{share * bending_wavelength_m(board.plate, board.waveform.band_high_hz):.2g}")


def compact_grid(board: Board, pitch_m: float) -> Grid:
    """The grid of a compact bank, whose outermost cells are half a pitch from the sides at least."""
    inner = Grid.of(board.plate, pitch_m)
    sides_m = board.plate.length_m, board.plate.width_m
    nx, ny = (math.floor(side_m / pitch_m + 1e-9) for side_m in sides_m)
    x0_m, y0_m = ((side_m - (count - 1) * pitch_m) / 2 for side_m, count in zip(sides_m, (nx, ny), strict=True))
    return replace(inner, nx=nx, ny=ny, x0_m=x0_m, y0_m=y0_m)


def _rest_grid(board: Board, grid: Grid) -> Grid:
    """The grid of the rest; ConfigError if a stencil is larger than a grid."""
    rest = compact_grid(board, REST_PITCH * grid.pitch_m)
    if min(grid.nx, grid.ny) < ACROSS or min(rest.nx, rest.ny) < REST_ACROSS:
        raise ConfigError(
            f"board {board.name!r}: {grid.nx} x {grid.ny} cells of {1e3 * grid.pitch_m:g} mm are too few for a compact bank:"
            " build a plain one"
        )
    return rest


def _spectrum(responses: Reals, period_s: float) -> tuple[Reals, Reals]:
    """Power of all responses together at each frequency in Hz."""
    power: Reals = (np.abs(np.fft.rfft(responses, axis=1)) ** 2).sum(axis=(0, 2))
    return power, np.fft.rfftfreq(responses.shape[1], period_s)
