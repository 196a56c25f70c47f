"""Where discs go: evenly along the edge of the glass, out of the way of a screen, without mirror symmetry.

Where they stand changes little of a focus, and nothing is lost near the edge (controller/workshop/physics/README.md); of a
mirrored pair some modes would be driven twice and others not at all.
"""

from __future__ import annotations

import math
from typing import Any, Final

from controller.device.board.plate.parts import Parts
from controller.errors import ConfigError

Place = tuple[float, float]  # x and y in mm

SECTORS: Final = ((-1, -1), (1, -1), (-1, 1), (1, 1))
STARTS: Final = tuple(step / 20 for step in range(20))  # of the first disc, in distances between discs
APART_MM: Final = 1.0  # between the rims of two discs
CUT_MM: Final = 0.4  # between two quadrants


def actuators_around(length_mm: float, width_mm: float, parts: Parts, discs: int, rim_mm: float) -> list[dict[str, Any]]:
    """Tables of `actuators`: quadrants of discs, half of each disc's idling high.

    `rim_mm` is from the edge of the glass to the rim of a disc. Raises ConfigError if that many discs do not fit.
    """
    disc = parts.data
    centres = centres_around(length_mm, width_mm, disc.brass_mm, discs, rim_mm)
    off_mm = disc.ceramic_mm / 4
    size_mm = math.floor(100 * min(parts.size_mm, 2 * off_mm - CUT_MM)) / 100
    return [
        {
            "channel": 4 * index + sector,
            "x_mm": round(x_mm + right * off_mm, 2),
            "y_mm": round(y_mm + up * off_mm, 2),
            "size_mm": size_mm,
            "idle": int(right == up),
        }
        for index, (x_mm, y_mm) in enumerate(centres)
        for sector, (right, up) in enumerate(SECTORS)
    ]


def centres_around(length_mm: float, width_mm: float, disc_mm: float, discs: int, rim_mm: float) -> list[Place]:
    """Centres of discs, evenly along a rectangle inside the edge; of several starts the one that is least its own mirror image.

    Raises ConfigError if that many discs do not fit.
    """
    inset_mm = rim_mm + disc_mm / 2
    along_mm, across_mm = length_mm - 2 * inset_mm, width_mm - 2 * inset_mm
    if along_mm > 0 and across_mm > 0:
        starts = [_from(start, along_mm, across_mm, discs) for start in STARTS]
        apart = [centres for centres in starts if _nearest(centres) >= disc_mm + APART_MM]
        if apart:
            best = max(apart, key=lambda centres: _unlike(centres, along_mm, across_mm))
            return [(round(inset_mm + x_mm, 2), round(inset_mm + y_mm, 2)) for x_mm, y_mm in best]
    raise ConfigError(
        f"{discs} discs of {disc_mm:g} mm do not fit along the edge of {length_mm:g} × {width_mm:g} mm of glass, {rim_mm:g} mm from"
        " it: take fewer or smaller discs"
    )


def _from(start: float, along_mm: float, across_mm: float, discs: int) -> list[Place]:
    apart_mm = 2 * (along_mm + across_mm) / discs
    return [_at((start + index) * apart_mm, along_mm, across_mm) for index in range(discs)]


def _nearest(centres: list[Place]) -> float:
    """Distance of the two that are nearest to each other."""
    return min((math.dist(a, b) for index, a in enumerate(centres) for b in centres[:index]), default=math.inf)


def _unlike(centres: list[Place], along_mm: float, across_mm: float) -> float:
    """Distance of the disc that is nearest to a mirror image of one, in either middle line."""
    images = [image for x, y in centres for image in ((along_mm - x, y), (x, across_mm - y))]
    return min(math.dist(a, b) for a in centres for b in images)


def _at(way_mm: float, along_mm: float, across_mm: float) -> Place:
    """Place on a rectangle, so far from its corner at the origin, first along x."""
    if way_mm <= along_mm:
        return way_mm, 0.0
    if way_mm <= along_mm + across_mm:
        return along_mm, way_mm - along_mm
    if way_mm <= 2 * along_mm + across_mm:
        return 2 * along_mm + across_mm - way_mm, across_mm
    return 0.0, 2 * (along_mm + across_mm) - way_mm
