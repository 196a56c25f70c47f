"""The table [plate] of board.toml: size, material or layers, support and damping."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Any, Literal, Self

import msgspec
from msgspec import Meta

from controller.device.board.plate.layers import MOST_SHEAR, MOST_SHEAR_LEFT_OUT, PlateLayer, laminate, softest
from controller.device.board.records import LONGEST_PLATE_MM, Record, left_out

OF_LAYERS = ("thickness_mm", "young_modulus_pa", "poisson_ratio", "density_kg_m3")  # keys of a plate that follow from its layers

OF_FOAM = 'an edge is "foam", so give [plate.foam] with stiffness_n_m3 and width_mm'

Support = Literal["simply_supported", "clamped", "free", "foam"]


class Edges(Record, frozen=True):
    """How each side of the plate is supported.

    Attributes:
    x0: The side at x = 0.
    x1: The side at the far end of x.
    y0: The side at y = 0.
    y1: The side at the far end of y.
    """

    x0: Support
    x1: Support
    y0: Support
    y1: Support


class Foam(Record, frozen=True):
    """The foam strip under each edge that is "foam".

    Attributes:
    stiffness_n_m3: Young's modulus over thickness: the force per area, per displacement.
    width_mm: From the plate's edge inwards.
    dashpot_pa_s_m: Wave impedance of the foam, the root of density times Young's modulus: damping above the frequency at which the
        foam is a quarter of a wave thick, added to the plate's own. 1.15e4 is soft foam (0.3 MPa, 400 kg/m³): 1 ms on the paper's
        plate.
    """

    stiffness_n_m3: Annotated[float, Meta(ge=1e5, le=1e11)]
    width_mm: Annotated[float, Meta(ge=0.5, le=500)]
    dashpot_pa_s_m: Annotated[float, Meta(ge=0, le=1e7)] = 0.0


PlateMm = Annotated[float, Meta(ge=20, le=LONGEST_PLATE_MM)]


class DecayAt(Record, frozen=True):
    """Decay at one frequency; between two of them, straight in the logarithms of both; beyond the first and the last, as there.

    Attributes:
    frequency_hz: Frequency; they rise from one to the next.
    decay_time_ms: Time in which a free vibration of that frequency falls to 1/e.
    """

    frequency_hz: Annotated[float, Meta(gt=0, le=10e6)]
    decay_time_ms: Annotated[float, Meta(ge=0.1, le=10e3)]


class Damping(Record, frozen=True):
    """Damping that is not the same for all modes.

    Attributes:
    loss_factor: Of the plate's material: it adds half of it times the angular frequency to each mode's rate of decay.
    decay_times: Decay over frequency, as measured; it takes the place of `plate.decay_time_ms`.
    """

    loss_factor: Annotated[float, Meta(ge=0, le=0.5)] = 0.0
    decay_times: tuple[DecayAt, ...] = ()

    def __post_init__(self) -> None:
        for index, (one, other) in enumerate(pairwise(self.decay_times)):
            if other.frequency_hz <= one.frequency_hz:
                before, after = one.frequency_hz, other.frequency_hz
                raise ValueError(f"decay_times[{index + 1}].frequency_hz = {after:g} is not above the one before, {before:g}")


class Plate(Record, frozen=True, kw_only=True):
    """The plate: size, material and support; its origin is a corner, x runs along the length.

    Attributes:
    length_mm: Extent along x.
    width_mm: Extent along y.
    thickness_mm: Thickness. This key and the three of the material are required, unless there are layers, from which they follow.
    young_modulus_pa: Young's modulus.
    poisson_ratio: Poisson's ratio.
    density_kg_m3: Density.
    edges: How the edge is supported, all around; or for each side, { x0 = …, x1 = …, y0 = …, y1 = … }: at x = 0, at the far end of
        x, at y = 0, at the far end of y.
    foam: Required if an edge is "foam".
    decay_time_ms: Time in which a free vibration falls to 1/e, of all modes; what `damping` and `foam` take comes beside it.
    theory: Plate theory that the model uses: mindlin counts shear and rotary inertia, which lower frequencies by 0.6 % at 20 kHz
        and by 2.2 % at 70 kHz in 0.5 mm of glass.
    layers: Layers that the plate is made of, in place of thickness and material.
    damping: Left out: `decay_time_ms` for all modes.
    """

    length_mm: PlateMm
    width_mm: PlateMm
    thickness_mm: Annotated[float, Meta(ge=0.05, le=20)] = msgspec.field(default_factory=float)
    young_modulus_pa: Annotated[float, Meta(ge=1e9, le=1e12)] = msgspec.field(default_factory=float)
    poisson_ratio: Annotated[float, Meta(ge=0, lt=0.5)] = msgspec.field(default_factory=left_out)
    density_kg_m3: Annotated[float, Meta(ge=100, le=25e3)] = msgspec.field(default_factory=float)
    edges: Support | Edges
    decay_time_ms: Annotated[float, Meta(ge=0.1, le=10e3)]
    theory: Literal["kirchhoff", "mindlin"] = "kirchhoff"
    foam: Foam | None = None
    layers: tuple[PlateLayer, ...] = ()
    damping: Damping | None = None

    @classmethod
    def also_required(cls, table: dict[str, Any]) -> dict[str, str]:
        """Keys that others make required: thickness and material without layers; foam under an edge of foam."""
        edges = table.get("edges")
        foam = edges == "foam" or (isinstance(edges, dict) and "foam" in edges.values())
        return dict.fromkeys(() if table.get("layers") else OF_LAYERS, "") | ({"foam": OF_FOAM} if foam else {})

    def __post_init__(self) -> None:
        self._take_layers()
        sides = self.sides
        if self.foam is None:
            if "foam" in (sides.x0, sides.x1, sides.y0, sides.y1):
                raise ValueError(f"foam is missing: {OF_FOAM}")
            return
        for key, ends in (("length_mm", (sides.x0, sides.x1)), ("width_mm", (sides.y0, sides.y1))):
            extent_mm = getattr(self, key)
            if self.foam.width_mm * ends.count("foam") >= extent_mm:
                raise ValueError(f"foam.width_mm = {self.foam.width_mm:g} leaves nothing of {key} = {extent_mm:g} free")

    def _take_layers(self) -> None:
        """Set thickness and material to those of the layers together; or see that they are given.

        Raises ValueError if one of both is missing, if they contradict each other, or if the layers would slide on each other.
        """
        left_out = [key for key in OF_LAYERS if not getattr(self, key) >= 0 or (key != "poisson_ratio" and not getattr(self, key))]
        if not self.layers:
            if left_out:
                raise ValueError(f"Object missing required field `{left_out[0]}`")  # msgspec's words, which `explain` knows
            return
        whole = laminate(self.layers)
        soft, shear = softest(self.layers), whole.shear_flexibility
        modulus_pa = self.layers[soft].young_modulus_pa
        named = f"layers[{soft}].young_modulus_pa = {modulus_pa:g} is soft: {shear:.3g} times a solid plate's shear"
        if shear > MOST_SHEAR:
            raise ValueError(
                f"{named}, and above {MOST_SHEAR:g} the other layers slide on it, which is not modelled;"
                " give only layers that stick to each other, or measure the plate's responses"
            )
        if shear > MOST_SHEAR_LEFT_OUT and self.theory == "kirchhoff":
            raise ValueError(f'{named}, which theory = "kirchhoff" leaves out; set theory = "mindlin"')
        for key, of_layers in zip(OF_LAYERS, (whole.thickness_m * 1e3, *whole[1:4]), strict=True):
            if key in left_out:
                msgspec.structs.force_setattr(self, key, of_layers)
            elif abs(getattr(self, key) - of_layers) > 1e-9 * abs(of_layers):
                raise ValueError(f"{key} = {getattr(self, key):g} beside layers, which make it {of_layers:.6g}: leave it out")

    def with_stiffness(self, ratio: float) -> Self:
        """The same plate with all Young's moduli times `ratio`: what a temperature does to its frequencies."""
        layers = tuple(msgspec.structs.replace(layer, young_modulus_pa=layer.young_modulus_pa * ratio) for layer in self.layers)
        return msgspec.structs.replace(self, young_modulus_pa=self.young_modulus_pa * ratio, layers=layers)

    @property
    def sides(self) -> Edges:
        """How each side is supported."""
        return self.edges if isinstance(self.edges, Edges) else Edges(x0=self.edges, x1=self.edges, y0=self.edges, y1=self.edges)

    @property
    def length_m(self) -> float:
        """Extent along x in m."""
        return self.length_mm * 1e-3

    @property
    def width_m(self) -> float:
        """Extent along y in m."""
        return self.width_mm * 1e-3

    @property
    def thickness_m(self) -> float:
        """Thickness in m."""
        return self.thickness_mm * 1e-3

    @property
    def decay_time_s(self) -> float:
        """Time in which a free vibration falls to 1/e, in s."""
        return self.decay_time_ms * 1e-3
