"""Piezo discs, and what follows from them on a plate: moment, capacitance, mass, stiffness, and the stage's R and L.

A disc is cut into sectors, one actuator each, and glued to the plate by its brass. By classical laminate theory its ceramic, of
modulus Y and piezo constant d31, pulls d31 Y / (1 - nu) per volt and length at its height above the laminate's neutral axis. A disc
of bending stiffness Dc in a plate of stiffness D and Poisson's ratio nu passes 2 D / ((1 + nu) Dc + (1 - nu) D) of that moment on
to the bare plate (Eshelby's inclusion in bending). Glue and cut electrodes take the rest: `bond`, fitted to the paper's 7.68 um.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Final

from msgspec import Meta

from controller.device.board.panel import Waveform
from controller.device.board.plate.layers import Laminate, PlateLayer, laminate
from controller.device.board.plate.plate import Plate
from controller.device.board.records import Record, as_record, read_tables
from controller.device.board.relations.bending_waves import bending_stiffness

CATALOGUE: Final = Path(__file__).with_name("discs.toml")
QUALITY: Final = 0.92  # of a stage's L and C with its R, as of the paper's: sqrt(L / C) / R
E12: Final = (1.0, 1.2, 1.5, 1.8, 2.2, 2.7, 3.3, 3.9, 4.7, 5.6, 6.8, 8.2)  # IEC 60063
E24: Final = tuple(sorted((*E12, 1.1, 1.3, 1.6, 2.0, 2.4, 3.0, 3.6, 4.3, 5.1, 6.2, 7.5, 9.1)))
GLUE: Final = {"young_modulus_pa": 3e9, "poisson_ratio": 0.35, "density_kg_m3": 1200.0}  # cured epoxy
BRASS: Final = {"young_modulus_pa": 100e9, "poisson_ratio": 0.35, "density_kg_m3": 8500.0}

PartMm = Annotated[float, Meta(ge=0.5, le=500)]
FoilMm = Annotated[float, Meta(ge=0.01, le=5)]


class Disc(Record, frozen=True):
    """A piezo diaphragm: a disc of ceramic on one of brass.

    Attributes:
    brass_mm: Diameter of the brass.
    brass_thickness_mm: Thickness of the brass.
    ceramic_mm: Diameter of the ceramic.
    ceramic_thickness_mm: Thickness of the ceramic.
    capacitance_f: Capacitance of the whole disc.
    piezo_constant_m_per_v: d31 of the ceramic, positive.
    ceramic_modulus_pa: Young's modulus of the ceramic at constant field.
    ceramic_poisson_ratio: Poisson's ratio of the ceramic.
    ceramic_density_kg_m3: Density of the ceramic.
    """

    brass_mm: PartMm
    brass_thickness_mm: FoilMm
    ceramic_mm: PartMm
    ceramic_thickness_mm: FoilMm
    capacitance_f: Annotated[float, Meta(ge=1e-12, le=1e-5)]
    piezo_constant_m_per_v: Annotated[float, Meta(ge=1e-12, le=2e-9)] = 171e-12  # PZT-5A, as the three below
    ceramic_modulus_pa: Annotated[float, Meta(ge=1e9, le=1e12)] = 61e9
    ceramic_poisson_ratio: Annotated[float, Meta(ge=0, lt=0.5)] = 0.31
    ceramic_density_kg_m3: Annotated[float, Meta(ge=100, le=25e3)] = 7750.0

    def __post_init__(self) -> None:
        if self.ceramic_mm > self.brass_mm:
            raise ValueError(
                f"ceramic_mm = {self.ceramic_mm:g} is above brass_mm = {self.brass_mm:g}: the ceramic lies on the brass"
            )


class Parts(Record, frozen=True):
    """What the actuators are made of: keys of [driver] and [patches] that are left out follow from it; those given win.

    Attributes:
    disc: The piezo disc: a name of the catalogue (discs.toml), or a table of its data.
    sectors: Actuators that a disc is cut into.
    glue_mm: Thickness of the glue between disc and plate.
    bond: Share of the moment by laminate theory that glue and cut electrodes leave; 0.67 fits the paper's panel.
    """

    disc: str | Disc
    sectors: Annotated[int, Meta(ge=1, le=32)] = 4
    glue_mm: Annotated[float, Meta(ge=0, le=1)] = 0.03
    bond: Annotated[float, Meta(gt=0, le=1)] = 0.67

    def __post_init__(self) -> None:
        if isinstance(self.disc, str) and self.disc not in catalogue():
            raise ValueError(
                f"disc = {self.disc!r} is not in the catalogue: one of {', '.join(catalogue())}, or a table of its data"
            )

    @property
    def data(self) -> Disc:
        """Data of the disc."""
        return catalogue()[self.disc] if isinstance(self.disc, str) else self.disc

    @property
    def called(self) -> str:
        """Name of the disc, for messages."""
        return f"disc {self.disc}" if isinstance(self.disc, str) else "parts.disc"

    @property
    def size_mm(self) -> float:
        """Edge length of the square as large as a sector of the ceramic."""
        return self.data.ceramic_mm * math.sqrt(math.pi / 4 / self.sectors)

    def capacitance_f(self, size_mm: float) -> float:
        """Capacitance of a square patch of the disc's ceramic."""
        return self.data.capacitance_f * size_mm**2 / (math.pi / 4 * self.data.ceramic_mm**2)

    def on(self, plate: Plate) -> OnPlate:
        """What a disc of these parts is on a plate."""
        disc, glass = self.data, plate.layers or (_layer(plate.thickness_mm, _material(plate)),)
        glue = (_layer(self.glue_mm, GLUE),) if self.glue_mm else ()
        ceramic = {
            "young_modulus_pa": disc.ceramic_modulus_pa,
            "poisson_ratio": disc.ceramic_poisson_ratio,
            "density_kg_m3": disc.ceramic_density_kg_m3,
        }
        added = (*glue, _layer(disc.brass_thickness_mm, BRASS), _layer(disc.ceramic_thickness_mm, ceramic))
        return OnPlate(
            self, plate, laminate((*glass, *added)), sum(layer.density_kg_m3 * layer.thickness_mm * 1e-3 for layer in added)
        )


class OnPlate:
    """A disc glued to a plate."""

    def __init__(self, parts: Parts, plate: Plate, whole: Laminate, mass_kg_m2: float) -> None:
        disc, stiffness = parts.data, bending_stiffness(plate)
        together = whole.young_modulus_pa * whole.thickness_m**3 / (12 * (1 - whole.poisson_ratio**2))
        lever_m = whole.thickness_m - disc.ceramic_thickness_mm * 1e-3 / 2 - whole.axis_m
        pull = disc.piezo_constant_m_per_v * disc.ceramic_modulus_pa / (1 - disc.ceramic_poisson_ratio)
        passed = 2 * stiffness / ((1 + plate.poisson_ratio) * together + (1 - plate.poisson_ratio) * stiffness)
        self.passed = passed  # share of its moment that the bare plate feels; and of a plate's curvature that it takes part in
        self.face_m = whole.thickness_m - whole.axis_m  # height of the ceramic's face above the neutral axis of both
        self.mass_kg_m2 = mass_kg_m2  # what it adds to the plate, per area
        self.stiffness_ratio = together / stiffness  # bending stiffness of plate and disc together, over the plate's
        # Bending moment per length of edge and volt on plate and disc together
        self.disc_moment_n_per_v = parts.bond * pull * lever_m
        self.moment_n_per_v = self.disc_moment_n_per_v * passed  # the same as the bare plate feels it


def inductance_h(of_f: float, middle_hz: float) -> float:
    """Inductance that resonates with a patch in the middle of the band, as the paper's stage does."""
    return 1 / ((2 * math.pi * middle_hz) ** 2 * of_f)


def resistance_ohm(of_h: float, of_f: float) -> float:
    """Resistance with which L and C have the paper's quality, flat over the band."""
    return math.sqrt(of_h / of_f) / QUALITY


def made(value: float, series: tuple[float, ...]) -> float:
    """Nearest value of a series of preferred numbers, by ratio."""
    decade = 10.0 ** math.floor(math.log10(value))
    return float(
        f"{min((step * decade * ten for step in series for ten in (1, 10)), key=lambda one: abs(math.log(one / value))):.3g}"
    )


def followed(
    parts: Parts, plate: Plate, waveform: Waveform, driver: dict[str, Any], patches: dict[str, Any] | None = None
) -> dict[str, dict[str, Any]]:
    """Tables [driver] and [patches] with what was left out of them, from the parts; R and L as they are made.

    With [patches], whose stiffness the model then has, the moment is that on plate and disc together.
    """
    on = parts.on(plate)
    found = {
        "moment_n_per_v": _rounded(on.moment_n_per_v if patches is None else on.disc_moment_n_per_v),
        "capacitance_f": _rounded(parts.data.capacitance_f / parts.sectors),
    } | _given(driver)
    found.setdefault("inductance_h", made(inductance_h(found["capacitance_f"], waveform.middle_hz), E12))
    found.setdefault("resistance_ohm", made(resistance_ohm(found["inductance_h"], found["capacitance_f"]), E24))
    added = {"mass_kg_m2": _rounded(on.mass_kg_m2), "stiffness_ratio": _rounded(on.stiffness_ratio)}
    return {"driver": found, "patches": added | _given(patches or {})}


def _rounded(value: float) -> float:
    """The same on every computer: a board's digest, which its bank holds, depends on it."""
    return float(f"{value:.6g}")


def _given(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if value == value}  # noqa: PLR0124 - all but NaN


@cache
def catalogue() -> dict[str, Disc]:
    """Discs by name."""
    return {name: as_record(f"{CATALOGUE}: {name}.", table, Disc) for name, table in read_tables(CATALOGUE).items()}


def _material(plate: Plate) -> dict[str, float]:
    return {name: getattr(plate, name) for name in GLUE}


def _layer(thickness_mm: float, material: Mapping[str, Any]) -> PlateLayer:
    return PlateLayer(thickness_mm=thickness_mm, **material)
