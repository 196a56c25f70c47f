"""Drive words of one focus for more contrast or less sound: relaxed, rounded in time order, improved bit by bit.

What is maximised is, each term relative to the sign of the band-limited response of the same point (the plain waveform):

    a amplitude - contrast * (mean square field outside the focus) - silence * (audible energy) - calm * (edges)

Amplitude and field are those of all modes, so frequencies outside the band help too, as far as silence lets them. `a` is found for
each cell so that the amplitude becomes the plain one's: an entry that kicks harder than what is composed beside it would be felt.
The aim "loud" is for banks that play cells alone: there it becomes a fifth more. So is "felt": its amplitude is not that at T
but what a light touch feels (`felt_form`), by its derivative at the bits of the turn before.

1. Relaxation: accelerated projected gradient steps on levels between 0 and 1 (Beck and Teboulle, FISTA, with restarts).
2. Rounding: sample by sample in time order, channel by channel; what one bit's rounding costs, the next ones make up for.
3. Descent: in the same order, at each sample the bits that gain most are flipped, until none gains.

All products are exact (`exact.py`), so a point's words do not depend on the machine or on what is computed with it.
"""

import math
from collections.abc import Sequence
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controller.arrays import Floats, Indices, blocks
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.kernel import Point
from controller.workshop.bank_builder.methods.aims import DescentAim
from controller.workshop.bank_builder.methods.audible_form import AudibleForm
from controller.workshop.bank_builder.methods.descent_cells import Cells, amplitudes, edges, own_edges
from controller.workshop.bank_builder.methods.design import Place, WaveformDesign
from controller.workshop.bank_builder.methods.felt_form import FeltForm
from controller.workshop.bank_builder.methods.field_form import FieldForm
from controller.workshop.bank_builder.methods.measured_plate import MeasuredPlate
from controller.workshop.bank_builder.methods.prediction import FocusPrediction
from controller.workshop.bank_builder.methods.settling import settle
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import idle_levels

LEVELS = 64  # to which relaxed levels are rounded before they become bits
STEPS_BEFORE_WEIGHING = 5  # relaxation steps between two corrections of the weight of the amplitude
SAMPLES_AT_ONCE = 20  # after which the audible spectrum is brought up to date
LEAST_SHARE, MOST_SHARE = 0.8, 1.25  # of the plain amplitude; what is beyond was no good start (points that hardly move)
CALMER = 4.0  # an entry that switches too often is improved again, edges costing this many times as much
CALMING_PASSES = 4
CELLS_AT_ONCE = 32  # at most, and as many as fit into
WORKING_BYTES = 120e6  # of levels, gradients and modal forces


class Descent:
    """Optimised waveforms for single points at full amplitude."""

    def __init__(self, board: Board, plate: ResponseModel | MeasuredPlate, aim: DescentAim, like: Self | None = None) -> None:
        """`like` has another aim for the same board and plate: what both need is taken from it."""
        self.name = f"descent: {aim.name}"
        self._aim, self._plate = aim, plate
        self._idle_word = board.idle_word
        self._idle = idle_levels(board)
        self._most_edges = math.floor(board.limits.max_edge_rate_hz * board.waveform.duration_s)
        self.field: FieldForm = like.field if like else FieldForm(board, plate)
        self._audible: AudibleForm = like._audible if like else AudibleForm(board, plate, SAMPLES_AT_ONCE)
        self._late = np.ascontiguousarray(self._audible.lags[:0:-1]).reshape(-1, CHANNELS)  # longest lag first
        self._board = board
        cell_bytes = 8.0 * CHANNELS * (3 * plate.modes + 8 * plate.samples)
        self._at_once = max(1, min(CELLS_AT_ONCE, int(WORKING_BYTES / cell_bytes)))

    def design(self, points: Sequence[Point], nulls: Sequence[Place] = ()) -> WaveformDesign:
        """As `DesignMethod.design`, for one point at full amplitude."""
        if len(points) != 1 or points[0][2] != 1 or nulls:
            raise ValueError(f"{self.name} serves one point at full amplitude and has no nulls")
        if not all(map(math.isfinite, points[0])):
            raise ValueError("a point that is not finite")
        place_m = np.array([points[0][:2]])
        words = self.entries(place_m)[0]
        return WaveformDesign(words, FocusPrediction(self._board, self._model()).at_focus(words, place_m), np.zeros(0))

    def entries(self, points_m: ArrayLike, plain: NDArray[np.uint32] | None = None) -> NDArray[np.uint32]:
        """Drive words of each of `points_m`, (point, 2), alone: (point, sample); `plain` are the plain ones, which a model knows.

        Where nothing can be gained (a point that does not move), the amplitude would be another, or edges would be more than the
        board's `limits.max_edge_rate_hz` allows, it is the plain waveform.
        """
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        found = np.empty((len(points), self._plate.samples), np.uint32)
        for some in blocks(len(points), self._at_once):
            found[some] = self._some(points[some], self._plain(points[some]) if plain is None else plain[some].copy())
        return found

    def _plain(self, points_m: Floats) -> NDArray[np.uint32]:
        responses = self._model().drive_order_responses(points_m, dtype=np.float64)
        return np.stack([drive_words(response, self._idle_word) for response in responses])

    def _model(self) -> ResponseModel:
        assert isinstance(self._plate, ResponseModel)  # `BankPlan` refuses the rest
        return self._plate

    def _some(self, points_m: Floats, words: NDArray[np.uint32]) -> NDArray[np.uint32]:
        cells, good = self._cells(points_m, words)
        if good.size:
            levels = self._felt(cells, points_m[good]) if self._aim.felt_turns else self._descended(cells)
            for _ in range(CALMING_PASSES):
                busy = own_edges(levels).max(axis=1) > self._most_edges
                if not busy.any():
                    break
                cells.edge[busy] = np.maximum(cells.edge[busy], cells.least_edge_cost(self._idle)[busy]) * CALMER
                self._pass(cells, levels)
            share = self._amplitude(cells, levels) / cells.amplitude
            fit = (
                (own_edges(levels).max(axis=1) <= self._most_edges)
                & (share >= LEAST_SHARE)
                & (share <= MOST_SHARE * self._aim.share)
            )
            bits = levels.transpose(1, 0, 2)[fit].astype(np.uint8)
            packed = np.packbits(bits, axis=2, bitorder="little").view("<u4")[:, :, 0]
            words[good[fit]] = packed
        return words

    def _descended(self, cells: Cells) -> Floats:
        levels = self._relaxed(cells)
        for _ in range(self._aim.passes + 1):  # the first rounds what is between 0 and 1
            self._pass(cells, levels)
        return levels

    def _felt(self, cells: Cells, points_m: Floats) -> Floats:
        """Levels for the felt amplitude, in turns: it is what its derivative at the last ones says, or more."""
        form, levels = FeltForm(self._board, self._model(), points_m), cells.plain
        worth, plain_m = cells.worth, np.zeros(0)
        for turn in range(self._aim.felt_turns):
            cells.pull, felt_m = form.derivative(levels - self._idle)
            plain_m = plain_m if turn else felt_m
            cells.amplitude, cells.worth = plain_m, worth.copy()
            levels = self._descended(cells)
        return levels

    def _amplitude(self, cells: Cells, levels: Floats) -> Floats:
        """Amplitude of levels, (cell,), in the unit of `cells.amplitude`."""
        if cells.pull is None:
            return amplitudes(cells.shapes, self.field.modal(levels))
        found: Floats = np.sum(cells.pull * (levels - self._idle), axis=(0, 2))
        return found

    def _cells(self, points_m: Floats, words: NDArray[np.uint32]) -> tuple[Cells, Indices]:
        """State of the points at which there is something to optimise, and which they are."""
        plain = np.stack([channel_bits(row) for row in words], axis=1).astype(np.float64)
        shapes = self.field.shapes(points_m)
        places = [self.field.surroundings(point) for point in points_m]
        modal = self.field.modal(plain)
        amplitude = amplitudes(shapes, modal)
        outside = self.field.mean_square(modal, places)
        sound = self._audible.energy(plain - self._idle)
        good = np.flatnonzero((amplitude > 0) & (outside > 0) & (sound > 0))
        aim, switched = self._aim, edges(plain, self._idle).sum(axis=1)
        return Cells(
            plain=np.ascontiguousarray(plain[:, good]),
            shapes=shapes[good],
            places=[places[index] for index in good],
            worth=np.full(good.size, aim.amplitude),
            amplitude=amplitude[good],
            field=aim.contrast / outside[good],
            sound=aim.silence / sound[good],
            edge=aim.calm / np.maximum(switched[good], 1),
        ), good

    def _relaxed(self, cells: Cells) -> Floats:
        """Levels from 0 to 1 in steps of 1 / `LEVELS`, (sample, cell, 32)."""
        share = np.array([place.share for place in cells.places])
        curvature = cells.field * share / 2  # of half the squared modes
        rate = 1 / (curvature * self.field.largest + 2 * cells.sound * self._audible.largest)
        aimed = cells.amplitude * self._aim.share
        levels, ahead = cells.plain, cells.plain
        pull = cells.pull
        if pull is None and not self._aim.contrast:
            pull = self.field.gradient(cells.shapes)
        momentum = np.ones(len(aimed))
        for step in range(1, self._aim.steps + 1):
            ahead = np.rint(ahead * 1024) / 1024
            if pull is None:
                modal = self.field.modal(ahead)
                near, _ = self.field.near(modal, cells.places)
                wanted = (cells.worth / aimed)[:, None] * cells.shapes - curvature[:, None] * (modal - near)
                slope = self.field.gradient(wanted)
            else:
                slope = pull * (cells.worth / aimed)[:, None]
            forces = self._audible.forces(self._audible.spectrum(ahead - self._idle))
            slope -= (2 * cells.sound)[:, None] * self._audible.gradient(forces, 0, len(slope))
            slope *= rate[:, None]
            slope += ahead
            stepped = np.clip(slope, 0, 1, out=slope)
            change = np.rint((stepped - levels) * 1024)
            restart = np.sum(np.rint((ahead - stepped) * 1024) * change, axis=(0, 2)) > 0
            following = (1 + np.sqrt(1 + 4 * momentum**2)) / 2
            push = np.where(restart, 0.0, (momentum - 1) / following)
            ahead = stepped + push[:, None] * (stepped - levels)
            levels, momentum = stepped, np.where(restart, 1.0, following)
            if step % STEPS_BEFORE_WEIGHING == 0 and step < self._aim.steps:
                reached = self._amplitude(cells, np.rint(levels * 1024) / 1024)
                short = aimed / np.maximum(reached, aimed / 2)
                cells.worth *= np.square(np.square(short))  # a power of four by itself need not be the same on all machines
        result: Floats = np.rint(levels * LEVELS) / LEVELS
        return result

    def _pass(self, cells: Cells, levels: Floats) -> None:
        """One pass over all samples in time order: levels between 0 and 1 are rounded, then bits are flipped that gain by it.

        Everything is divided by the cost of half a squared mode, so that the field's part of the gain of a change d of a bit is
        d moves * (target - modal) - d^2 moves^2 / 2. What counts as the focus enters as it is at the beginning: its mean square
        is convex, so that its tangent is below it, and what gains by the tangent gains at least as much. Without a cost of the
        field, only the amplitude is left of its part.
        """
        if self._aim.contrast:
            scale = cells.field * np.array([place.share for place in cells.places]) / 2
            modal = self.field.modal(levels)
            near, _ = self.field.near(modal, cells.places)
            left = np.rint((cells.worth / cells.amplitude / scale)[:, None] * cells.shapes + near - modal)
        else:
            scale = cells.worth / cells.amplitude
            left = cells.shapes.copy()
        sound, edge = (2 * cells.sound / scale)[:, None], (cells.edge / scale)[:, None]
        forces = self._audible.forces(self._audible.spectrum(levels - self._idle))
        own_curvature = sound[:, :, None] * self._audible.lags[0]
        before = np.broadcast_to(self._idle, levels[0].shape)
        samples, count = levels.shape[:2]
        for first in range(0, samples, SAMPLES_AT_ONCE):
            some = min(SAMPLES_AT_ONCE, samples - first)
            heard = self._audible.gradient(forces, first, some)
            changes = np.zeros((count, some, CHANNELS))
            for ahead in range(some):
                sample = first + ahead
                loud = heard[ahead]
                if ahead:
                    loud = loud + changes[:, :ahead].reshape(count, -1) @ self._late[-ahead * CHANNELS :]
                after = levels[sample + 1] if sample + 1 < samples else self._idle
                if cells.pull is None:
                    moves = self.field.moves(sample)
                    slope = left @ moves - sound * loud
                else:
                    slope = cells.pull[sample] - sound * loud
                slope -= edge * (2 - 2 * (before + after))  # edges of a 1 here, less those of a 0
                change = changes[:, ahead]
                curvature = self.field.curvature[sample] + own_curvature if self._aim.contrast else own_curvature
                settle(levels[sample], slope, curvature, change)
                if self._aim.contrast and change.any():
                    left -= change @ moves.T
                before = levels[sample]
            if changes.any():
                forces += self._audible.forces(self._audible.spectrum(np.ascontiguousarray(changes.transpose(1, 0, 2)), first))
