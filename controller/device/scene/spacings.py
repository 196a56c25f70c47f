"""Emissions by distance: one every `spacing_mm` travelled, or one per grid line crossed."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from msgspec import Meta

from controller.device.board.records import PlaceM
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.effects.trains import EffectiveAmplitude
from controller.device.scene.layers import Placement
from controller.device.scene.progress import DistanceProgress, GridProgress
from controller.device.scene.shapes import Circle, Polygon, Rectangle


class Spacing(NamedTuple):
    """How an effect repeats in space as a finger moves within its region."""

    spacing_m: Annotated[float, Meta(ge=1e-5, le=1)]  # distance from one emission to the next
    # None: of the finger's path, in any direction; 0: of grid lines at fixed x, 1: at fixed y
    axis: Annotated[int, Meta(ge=0, le=1)] | None
    origin_m: PlaceM  # where one of the grid lines lies
    amplitude: EffectiveAmplitude

    def begin(self, x_m: float, y_m: float) -> DistanceProgress | GridProgress:
        """Progress of a finger whose first report inside the region is at (x_m, y_m)."""
        if self.axis is None:
            return DistanceProgress(self.spacing_m, self.amplitude, x_m, y_m)
        return GridProgress(self.spacing_m, self.amplitude, self.axis, self.origin_m, y_m if self.axis else x_m)

    def placed(self, placement: Placement) -> Spacing:
        """This spacing of a layer, on the plate."""
        x_m, y_m, scale = placement
        return Spacing(self.spacing_m * scale, self.axis, (y_m if self.axis else x_m) + self.origin_m * scale, self.amplitude)


def spacing_of(effect: EffectTable, shape: Rectangle | Circle | Polygon, amplitude: float) -> Spacing:
    """Spacing of an effect with `when = "move"`, in a region of some shape and amplitude."""
    spacing_m = (effect.spacing_mm or 0.0) * 1e-3
    axis = {"x": 0, "y": 1}.get(effect.along or "path")
    origin_m = 0.0 if axis is None else shape.bounds[axis] + (effect.phase or 0.0) * spacing_m
    return Spacing(spacing_m, axis, origin_m, effect.strength * amplitude)
