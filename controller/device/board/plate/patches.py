"""What the piezo patches weigh and how much they stiffen the plate: the table [patches] of board.toml."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Literal, NamedTuple, Self

import msgspec
from msgspec import Meta

from controller.device.board.panel import Actuator
from controller.device.board.plate.plate import Plate
from controller.device.board.records import PlaceMm, Record, left_out

TOUCHING_MM = 1e-6  # patches may share an edge: neither place nor size is a binary fraction
ONE_DISC = 1.5  # actuators whose centres are this many sizes apart, along x and y, are sectors of one disc


class Patch(NamedTuple):
    """A patch on the plate: its centre, and its diameter or the length of its edges."""

    x_mm: float
    y_mm: float
    size_mm: float


class Patches(Record, frozen=True):
    """Mass and stiffness that the patches add to the plate. `driver.moment_n_per_v` is then the moment on plate and patch together.

    Both may be left out where [parts] says what the patches are.

    Attributes:
    mass_kg_m2: Mass of a patch per area, brass, ceramic and glue.
    stiffness_ratio: Bending stiffness of plate and patch together over that of the plate; about a common neutral axis where they
        stick together.
    shape: Shape of a patch.
    size_mm: Diameter of a disc, edge length of a square; left out: `size_mm` of the actuators, which must then be alike.
    centres_mm: Centres [x, y]. Left out: of squares those of the actuators; of discs the middles of the actuators that are cut from
        one.
    """

    mass_kg_m2: Annotated[float, Meta(ge=0, le=100)] = msgspec.field(default_factory=left_out)
    stiffness_ratio: Annotated[float, Meta(ge=0.1, le=1000)] = msgspec.field(default_factory=left_out)
    shape: Literal["disc", "square"] = "square"
    size_mm: Annotated[float, Meta(ge=0.5, le=500)] | None = None
    centres_mm: Annotated[tuple[tuple[PlaceMm, PlaceMm], ...], Meta(max_length=256)] = ()

    def on(self, plate: Plate, actuators: Sequence[Actuator]) -> tuple[Patch, ...]:
        """The patches of a board; raises ValueError if one is off the plate or on another, or if their size is not known."""
        sizes = {actuator.size_mm for actuator in actuators}
        if self.size_mm is None and len(sizes) > 1:
            raise ValueError("patches.size_mm is missing: the actuators are not all of one size")
        size_mm = min(sizes) if self.size_mm is None else self.size_mm
        centres = self.centres_mm
        if not centres:
            centres = tuple((a.x_mm, a.y_mm) for a in actuators) if self.shape == "square" else _middles(actuators)
        for index, (x_mm, y_mm) in enumerate(centres):
            for axis, value, extent in (("x", x_mm, plate.length_mm), ("y", y_mm, plate.width_mm)):
                if not size_mm / 2 - TOUCHING_MM <= value <= extent - size_mm / 2 + TOUCHING_MM:
                    raise ValueError(f"patches: the one at {axis} = {value:g} mm is off the plate (0 to {extent:g} mm)")
            for other_x_mm, other_y_mm in centres[:index]:
                dx, dy = abs(x_mm - other_x_mm), abs(y_mm - other_y_mm)
                apart = max(dx, dy) if self.shape == "square" else (dx**2 + dy**2) ** 0.5
                if apart < size_mm - TOUCHING_MM:
                    raise ValueError(f"patches: that at {x_mm:g}, {y_mm:g} mm lies on that at {other_x_mm:g}, {other_y_mm:g} mm")
        return tuple(Patch(x_mm, y_mm, size_mm) for x_mm, y_mm in centres)

    def with_places(self, plate: Plate, actuators: Sequence[Actuator]) -> Self:
        """The same with size and centres, whatever actuators a board has; raises ValueError as `on`."""
        places = self.on(plate, actuators)
        centres_mm = tuple((patch.x_mm, patch.y_mm) for patch in places)
        return msgspec.structs.replace(self, size_mm=places[0].size_mm, centres_mm=centres_mm)


def discs(actuators: Sequence[Actuator]) -> list[list[Actuator]]:
    """Groups of actuators that are near each other: the sectors of one disc."""
    left, found = list(actuators), []
    while left:
        group = [left.pop(0)]
        for member in group:  # grows
            near = [a for a in left if max(abs(a.x_mm - member.x_mm), abs(a.y_mm - member.y_mm)) <= ONE_DISC * member.size_mm]
            group += near
            left = [a for a in left if a not in near]
        found.append(group)
    return found


def _middles(actuators: Sequence[Actuator]) -> tuple[tuple[float, float], ...]:
    """Middles of the discs that actuators are cut from."""
    groups = discs(actuators)
    return tuple((sum(a.x_mm for a in group) / len(group), sum(a.y_mm for a in group) / len(group)) for group in groups)
