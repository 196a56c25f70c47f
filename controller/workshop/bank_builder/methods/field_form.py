"""The field at T as a function of the drive bits: linear in each mode, quadratic in its mean square outside the focus.

Every bit of a channel and a sample moves each mode by kernel(sample, mode) force(mode, channel). The shapes are taken in a
size at which each has a mean square of a quarter; as they are orthogonal, the mean square over the plate is a quarter of the sum of
squares of the modes. What lies near the focus is subtracted, point by point of the map by which contrast is defined
(`workshop/physics/field.py`).
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.workshop.bank_builder.methods.exact import rounded
from controller.workshop.bank_builder.methods.measured_plate import MeasuredDrive, MeasuredPlate
from controller.workshop.physics.field import FocusScale, map_axis
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import idle_levels

TABLE_BITS = 15  # of kernel and forces
PLACE_BITS = 12  # of mode shapes
STATE_BITS = 28  # of what is summed over samples


class Surroundings(NamedTuple):
    """What counts as the focus at one point: map points near it."""

    # along_x, along_y: (point, factor): factors of the shapes at the map's columns and rows that reach into it; of shapes that
    # are no products, the shapes at each of its points, and 1
    along_x: Floats
    along_y: Floats
    inside: Floats  # (column, row): 1 where a point of the map lies in it, else 0
    share: float  # points of the map for each point outside


class ModalDrive:
    """What bits move each mode, in a unit of this class."""

    def __init__(self, model: ResponseModel, size: Floats) -> None:
        """`size` (mode,): by which shapes are multiplied."""
        kernel = model.modal[:, ::-1].T
        _, exponents = np.frexp(np.abs(kernel).max(axis=0))  # a mode's kernel is brought below 1, its forces are what its bits do
        forces = np.ldexp(model.forces / size[:, None], exponents[:, None])
        forces *= np.ldexp(1.0, TABLE_BITS - int(np.frexp(np.abs(forces).max())[1]))
        self._kernel: Floats = np.ascontiguousarray(np.rint(np.ldexp(kernel, TABLE_BITS - exponents)) * 2.0**-TABLE_BITS)
        self._forces: Floats = np.rint(forces)

    def moves(self, sample: int) -> Floats:
        """What one bit of a sample moves each mode, (mode, 32): whole numbers."""
        return np.rint(self._kernel[sample, :, None] * self._forces)

    def modal(self, deviations: Floats, _first_line: int = 0) -> Floats:
        """Displacement of each mode by levels above idle: (sample, cell, 32) to (cell, mode). A model has no lines."""
        moved = self._kernel.T @ deviations.reshape(len(deviations), -1)
        moved = rounded(moved.reshape(-1, deviations.shape[1], CHANNELS), STATE_BITS, (0, 2))
        moved *= self._forces[:, None]
        return np.ascontiguousarray(moved.sum(axis=2).T)

    def gradient(self, wanted: Floats) -> Floats:
        """Sum over the modes of `wanted`, (cell, mode), times what each bit moves them: (sample, cell, 32)."""
        driven = wanted.T[:, :, None] * self._forces[:, None]
        driven = rounded(driven, 24, (0, 2))
        return (self._kernel @ driven.reshape(len(driven), -1)).reshape(len(self._kernel), -1, CHANNELS)


class FieldForm:
    """The field at T of many emissions at once; an array's axis `cell` counts emissions, each with a focus of its own.

    All displacements are in a unit of this class, from rest at the idle word. "Modes" are cosines where the plate was measured.
    """

    def __init__(self, board: Board, plate: ResponseModel | MeasuredPlate) -> None:
        self._modes = plate.plate_modes if isinstance(plate, ResponseModel) else plate.shapes
        self._size: Floats = 0.5 / np.sqrt(self._modes.mean_square)  # of the shapes: their mean square is then 1/4
        self._samples = plate.samples
        self._drive: ModalDrive | MeasuredDrive = (
            ModalDrive(plate, self._size) if isinstance(plate, ResponseModel) else MeasuredDrive(plate, self._size)
        )
        self._idle = idle_levels(board)
        scale = FocusScale.of(board)
        self._outside_m = scale.outside_m
        self._x_m = map_axis(self._modes.length_m, scale.map_step_m)
        self._y_m = map_axis(self._modes.width_m, scale.map_step_m)
        self.moves, self.gradient = self._drive.moves, self._drive.gradient
        # (sample, 32, 32): products of the moves of two channels' bits of one sample, summed over the modes
        self.curvature = np.stack([table.T @ table for table in map(self.moves, range(self._samples))])
        # Largest eigenvalue of the quadratic form, rounded up: what bits (sample, 32) of norm 1 move, squared
        self.largest = self._largest()

    def shapes(self, points_m: Floats) -> Floats:
        """Mode shapes at points, (point, 2): (point, mode)."""
        shapes = self._modes.shapes(points_m).astype(np.float64, copy=False) * self._size
        return np.rint(np.ldexp(shapes, PLACE_BITS)) * 2.0**-PLACE_BITS

    def surroundings(self, point_m: Floats) -> Surroundings:
        """What counts as the focus at (x, y); nothing, if no point of the map lies outside it."""
        x_m, y_m = (float(value) for value in point_m)
        near = np.hypot((self._x_m - x_m)[:, None], self._y_m - y_m) <= self._outside_m
        if near.all():
            near[:] = False
        share = near.size / np.count_nonzero(~near)
        columns, rows = near.any(axis=1), near.any(axis=0)
        if not near.any():
            return Surroundings(np.zeros((0, 1)), np.zeros((0, 1)), np.zeros((0, 0)), share)
        if (factors := self._modes.factors) is not None:
            along_x, along_y = factors.along_x(self._x_m[columns]), factors.along_y(self._y_m[rows])
            inside = near[np.ix_(columns, rows)].astype(np.float64)
        else:
            column, row = np.nonzero(near)
            along_x = self._modes.shapes(np.column_stack([self._x_m[column], self._y_m[row]])).astype(np.float64, copy=False)
            along_y, inside = np.ones((1, 1)), np.ones((len(column), 1))
        return Surroundings(rounded(along_x, PLACE_BITS), rounded(along_y, PLACE_BITS), inside, share)

    def modal(self, levels: Floats, first_line: int = 0) -> Floats:
        """Displacement of each mode by levels of the channels, 0 to 1 in 2^-10 at most: (sample, cell, 32) to (cell, mode).

        Of a measured plate, by lines from one on.
        """
        return self._drive.modal(levels - self._idle, first_line)

    def near(self, modal: Floats, places: list[Surroundings]) -> tuple[Floats, Floats]:
        """The part of the field that counts as the focus.

        `modal` is (cell, mode); each cell has a place. Returns the field there brought back to the modes (cell, mode), which
        `mean_square` takes off `modal` in its derivative, and the sum of squares over the map's points there (cell,).
        """
        coarse = rounded(modal * self._size, 26, 1)
        back, squares = np.zeros_like(modal), np.zeros(len(modal))
        factors, each = self._modes.factors, np.arange(self._modes.count)
        x_index, y_index = (each, np.zeros_like(each)) if factors is None else (factors.x_index, factors.y_index)
        for cell, place in enumerate(places):
            if not place.inside.size:
                continue
            matrix = np.zeros((place.along_x.shape[1], place.along_y.shape[1]))
            matrix[x_index, y_index] = coarse[cell]
            field = rounded(rounded(place.along_x @ matrix, 26) @ place.along_y.T, 20) * place.inside
            squares[cell] = np.sum(field**2)
            returned = rounded(place.along_x.T @ field, 26) @ place.along_y
            back[cell] = returned[x_index, y_index] * self._size * (4 / self._points)
        return back, squares

    def mean_square(self, modal: Floats, places: list[Surroundings]) -> Floats:
        """Mean square over the map outside the focus, (cell,); derivative by mode: share / 2 times (`modal` less `near`)."""
        _, squares = self.near(modal, places)
        whole = np.sum(rounded(modal, 20, 1) ** 2, axis=1) / 4
        share = np.array([place.share for place in places])
        found: Floats = share * (whole - squares / self._points)
        return found

    @property
    def _points(self) -> int:
        return self._x_m.size * self._y_m.size

    def _largest(self) -> float:
        bits: NDArray[Any] = np.random.default_rng(1).standard_normal((self._samples, 1, CHANNELS))
        size = 0.0
        for _ in range(20):
            bits = self.gradient(self.modal(np.rint(bits * 1024) / 1024 + self._idle))
            size = float(np.sqrt(np.sum(bits**2)))
            bits /= size
            bits *= np.sqrt(bits.size)
        return float(f"{size / np.sqrt(bits.size) * 1.02:.2g}") * 1.05
