"""Layers of a plate, and the homogeneous plate that bends and weighs as they do together.

The layers stick to each other and bend about one neutral axis, where stretching is relieved: classical laminate theory. In a wave
the stretch follows the gradient of the deflection, so that the axis is that of the moduli E / (1 - nu^2), the bending stiffness is
their second moment about it, and the moment across the wave gives the effective Poisson's ratio. One layer stands for itself.

Shear is first order: its flexibility is that of the shear stress which bending demands (Whitney, J. Appl. Mech. 40 (1973) 302),
reported in a ratio to that of a solid plate. Where a layer is so soft that the others slide on it, each bends on its own at short
waves, which no single bending stiffness describes: such layers are refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, NamedTuple

from msgspec import Meta

from controller.device.board.records import Record

# Flexibility in shear over a solid plate's. Up to 8 Mindlin's frequencies are right to 0.5 % (kh = 0.4; tests of layers); where
# shear is left out, twice that of a solid plate is 4 to 5 % of the frequency
MOST_SHEAR = 8.0
MOST_SHEAR_LEFT_OUT = 2.0


class PlateLayer(Record, frozen=True):
    """A layer of the plate, from the bottom up; the layers stick to each other.

    Attributes:
    thickness_mm: Thickness.
    young_modulus_pa: Young's modulus at the frequencies of the band: that of glue is 10 to 100 times its static one.
    poisson_ratio: Poisson's ratio.
    density_kg_m3: Density.
    """

    thickness_mm: Annotated[float, Meta(ge=1e-3, le=20)]
    young_modulus_pa: Annotated[float, Meta(ge=1e4, le=1e12)]
    poisson_ratio: Annotated[float, Meta(ge=0, lt=0.5)]
    density_kg_m3: Annotated[float, Meta(ge=100, le=25e3)]


class Laminate(NamedTuple):
    """What layers are together."""

    # thickness_m, young_modulus_pa, poisson_ratio, density_kg_m3: of the homogeneous plate that bends and weighs the same
    thickness_m: float
    young_modulus_pa: float
    poisson_ratio: float
    density_kg_m3: float
    rotation_kg: float  # rotary inertia per area about the neutral axis
    axis_m: float  # height of the neutral axis above the bottom
    shear_flexibility: float  # over that of a solid plate of the same thickness and bending stiffness; 1 for one layer


def laminate(layers: Sequence[PlateLayer]) -> Laminate:
    """What layers, from the bottom up, are together."""
    sections: list[tuple[float, float, PlateLayer]] = []  # from, to in m
    top = 0.0
    for layer in layers:
        sections.append((top, top + layer.thickness_mm * 1e-3, layer))
        top += layer.thickness_mm * 1e-3
    moduli = [layer.young_modulus_pa / (1 - layer.poisson_ratio**2) for layer in layers]
    axis = sum(q * (b**2 - a**2) / 2 for q, (a, b, _) in zip(moduli, sections, strict=True))
    axis /= sum(q * (b - a) for q, (a, b, _) in zip(moduli, sections, strict=True))
    stiffness = across = 0.0
    for q, (a, b, layer) in zip(moduli, sections, strict=True):
        stiffness += q * ((b - axis) ** 3 - (a - axis) ** 3) / 3
        across += layer.poisson_ratio * q * ((b - axis) ** 3 - (a - axis) ** 3) / 3
    poisson = across / stiffness
    mass = sum(layer.density_kg_m3 * (b - a) for a, b, layer in sections)
    return Laminate(
        thickness_m=top,
        young_modulus_pa=12 * stiffness * (1 - poisson**2) / top**3,
        poisson_ratio=poisson,
        density_kg_m3=mass / top,
        rotation_kg=sum(layer.density_kg_m3 * ((b - axis) ** 3 - (a - axis) ** 3) / 3 for a, b, layer in sections),
        axis_m=axis,
        shear_flexibility=_shear(sections, moduli, axis, stiffness) / (top**2 / (5 * stiffness * (1 - poisson))),
    )


def softest(layers: Sequence[PlateLayer]) -> int:
    """Number of the layer with the smallest shear modulus."""
    return min(range(len(layers)), key=lambda index: layers[index].young_modulus_pa / (1 + layers[index].poisson_ratio))


def _shear(sections: Sequence[tuple[float, float, PlateLayer]], moduli: Sequence[float], axis: float, stiffness: float) -> float:
    """Integral of tau^2 / G for a unit shear force per length, in m / N: tau(z) is the moment of the moduli below z, over D."""
    below = found = 0.0
    for q, (a, b, layer) in zip(moduli, sections, strict=True):
        shear_modulus = layer.young_modulus_pa / (2 * (1 + layer.poisson_ratio))
        # tau = (below - q/2 ((z - axis)^2 - (a - axis)^2)) / D is a parabola of z: its square by Gauss with three nodes
        for node, weight in ((-(0.6**0.5), 5 / 18), (0.0, 4 / 9), (0.6**0.5, 5 / 18)):
            z = (a + b) / 2 + node * (b - a) / 2
            tau = (below - q / 2 * ((z - axis) ** 2 - (a - axis) ** 2)) / stiffness
            found += weight * (b - a) * tau**2 / shear_modulus
        below -= q / 2 * ((b - axis) ** 2 - (a - axis) ** 2)
    return found
