"""The tables of board.toml that describe the panel itself: plate, actuators, driver stages, waveform, bank and limits."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Any, Literal, Self

import msgspec
from msgspec import Meta

from controller.device.board.layers import MOST_SHEAR, MOST_SHEAR_LEFT_OUT, PlateLayer, laminate, softest
from controller.device.board.records import LONGEST_PLATE_MM, NotNegative, PlaceMm, Positive, Record, Share, SizeMm, left_out

CHANNELS = 32  # of one FPGA
FPGAS_MAX = 4
EDGE_WINDOW_S = 0.25  # over which the FPGA counts the edges of a stage

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


class Actuator(Record, frozen=True):
    """A square piezo patch and the output that drives it.

    Attributes:
    channel: Output of the FPGA, and bit of a drive word; of the second FPGA (`link.fpga`) from 32 on, and so on.
    x_mm, y_mm: Centre of the patch.
    size_mm: Edge length of the patch.
    idle: Level, 0 or 1, at which its output rests while the panel is armed.
    """

    channel: Annotated[int, Meta(ge=0, lt=CHANNELS * FPGAS_MAX)]
    x_mm: PlaceMm
    y_mm: PlaceMm
    size_mm: SizeMm
    idle: Annotated[int, Meta(ge=0, le=1)]


class Driver(Record, frozen=True):
    """The push-pull stage of one channel, with the series R and L into the piezo's C (paper, fig. 4).

    All but the supply may be left out where [parts] says what the patches are.

    Attributes:
    supply_v: Supply of the stages.
    resistance_ohm: Series resistance.
    inductance_h: Series inductance.
    capacitance_f: Capacitance of a patch.
    moment_n_per_v: Bending moment per length of a patch's edge, per volt.
    """

    supply_v: Annotated[float, Meta(gt=0, le=60)]
    resistance_ohm: Annotated[float, Meta(ge=1, le=1e6)] = msgspec.field(default_factory=left_out)
    inductance_h: Annotated[float, Meta(ge=1e-9, le=1)] = msgspec.field(default_factory=left_out)
    capacitance_f: Annotated[float, Meta(ge=1e-12, le=1e-6)] = msgspec.field(default_factory=left_out)
    moment_n_per_v: Annotated[float, Meta(ge=1e-6, le=1)] = msgspec.field(default_factory=left_out)


class Waveform(Record, frozen=True):
    """The waveform of one emission.

    Attributes:
    band_low_hz: Lower edge of the band.
    band_high_hz: Upper edge of the band, below half of `bit_clock_hz`.
    duration_ms: T, the length of one emission: 1 to 1000 samples of `bit_clock_hz`.
    bit_clock_hz: Drive words a second.
    slope: Power of the frequency with which the gain of the band's filter goes: -1 is felt 16 % more with 18 % fewer edges, 1 makes
        a smaller spot, 0 is the paper's.
    drift_percent: Drive words are made from the mean response of plates whose frequencies are this much higher and lower: for
        panels without a temperature sensor.
    """

    band_low_hz: Positive
    band_high_hz: Positive
    duration_ms: Annotated[float, Meta(gt=0, le=10)]
    bit_clock_hz: Annotated[float, Meta(ge=100e3, le=2e6)]
    slope: Annotated[float, Meta(ge=-2, le=2)] = 0.0
    drift_percent: Annotated[float, Meta(ge=0, le=2)] = 0.0

    def __post_init__(self) -> None:
        if self.band_high_hz <= self.band_low_hz:
            raise ValueError(f"band_high_hz = {self.band_high_hz} is not above band_low_hz = {self.band_low_hz}")
        if self.band_high_hz >= self.bit_clock_hz / 2:
            raise ValueError(f"band_high_hz = {self.band_high_hz} is not below half of bit_clock_hz = {self.bit_clock_hz}")
        if not 1 <= round(self.duration_ms * 1e-3 * self.bit_clock_hz) <= 1000:
            raise ValueError(f"duration_ms = {self.duration_ms} is not 1 to 1000 samples of bit_clock_hz = {self.bit_clock_hz}")

    @property
    def samples(self) -> int:
        """Drive words in one emission."""
        return round(self.duration_ms * 1e-3 * self.bit_clock_hz)

    @property
    def band_hz(self) -> tuple[float, float]:
        """Both edges of the band."""
        return self.band_low_hz, self.band_high_hz

    @property
    def middle_hz(self) -> float:
        """Middle of the band."""
        return (self.band_low_hz + self.band_high_hz) / 2

    @property
    def bit_period_s(self) -> float:
        """Time for which one drive word is output, in s."""
        return 1 / self.bit_clock_hz

    @property
    def duration_s(self) -> float:
        """T: one emission, in s."""
        return self.samples / self.bit_clock_hz


class AssumedFinger(Record, frozen=True):
    """The finger for which drive words are made: a load at the focus.

    Attributes:
    mass_mg: Mass of the pulp that moves with the plate.
    damping_n_s_m: Damping to the rest of the finger.
    stiffness_n_m: Stiffness to the rest of the finger.
    receptance: How the plate yields to it: `point`, as it does there by the plate model; `plate`, as an endless plate does.
    """

    mass_mg: Annotated[float, Meta(gt=0, le=1e6)] = 70.0
    damping_n_s_m: Annotated[float, Meta(ge=0, le=1e4)] = 0.0
    stiffness_n_m: Annotated[float, Meta(ge=0, le=1e9)] = 0.0
    receptance: Literal["point", "plate"] = "point"


class BankSettings(Record, frozen=True):
    """How the board's bank of precomputed waveforms is built and used.

    Attributes:
    pitch_mm: Distance of the bank's cells.
    snap_mm: A single finger at most this far from a cell's centre plays that cell without interpolation.
    coarse: Build the bank even if `pitch_mm` is above half a wavelength, where only fingers near cells are served; for tests.
    """

    pitch_mm: Annotated[float, Meta(ge=0.5, le=50)]
    snap_mm: NotNegative
    coarse: bool = False


class Compose(Record, frozen=True):
    """How waveforms for places between cells come about: as `bank` says, or as `bank build` chooses for the scene.

    Attributes:
    method: `bank`: `bank.pitch_mm` and `bank.snap_mm` as they are; `auto`: the smallest bank that keeps the bounds; `compact`: a
        twenty-fifth of the size. Banks of more than a quarter of the memory become compact.
    max_error: Bound of the amplitude that a finger loses, at the worst sampled place of the scene, alone.
    max_time_us: Bound of the host's time for the words of the largest emission that the scene can ask for, with the compiled kernel
        on the machine of the benchmark; of several FPGAs for the words of each.
    max_bank_mb: Bound of the size of the bank, in MB of 10^6 bytes; without it there is none.
    memory_mb: Memory of the machine that plays, in MB of 10^6 bytes; without it, that of the machine that asks.
    """

    method: Literal["bank", "auto", "compact"] = "bank"
    max_error: Annotated[float, Meta(gt=0, le=1)] = 0.1
    max_time_us: Annotated[float, Meta(gt=0, le=10e3)] = 500.0
    max_bank_mb: Annotated[float, Meta(gt=0, le=100e3)] | None = None
    memory_mb: Annotated[float, Meta(gt=0, le=10e6)] | None = None


class Limits(Record, frozen=True):
    """Limits of what the panel plays, and the resistor ratings they follow from. The FPGA enforces those of time and edges.

    Attributes:
    heartbeat_timeout_ms: The FPGA switches its outputs off when the host was silent for this long.
    ramp_ms: Time in which outputs ramp up on arming and down on disarming.
    max_duty: Largest share of time with emissions.
    duty_budget_ms: Emission time that may run ahead of `max_duty`.
    longest_emission_ms: Longest single emission.
    hv_settle_us: From switching the supply on (hv_enable) to the first edge of a ramp.
    min_pulse_us: Shortest pulse of an output; at most one sample of the waveform.
    max_channel_edge_rate_hz: Edges a second of one channel that the FPGA allows.
    max_total_edge_rate_hz: Edges a second of all channels together that the FPGA allows; protects the supply.
    max_edge_rate_hz: Largest edge rate of a channel within any waveform of the bank; a bank with more is not built.
    resistor_rating_w: Power rating of a stage's resistor.
    derating: Share of that rating that may be used.
    """

    heartbeat_timeout_ms: Annotated[float, Meta(ge=1, le=250)]
    ramp_ms: Annotated[float, Meta(gt=0, le=100)]
    max_duty: Share
    duty_budget_ms: Annotated[float, Meta(ge=20, le=1000)]
    longest_emission_ms: Annotated[float, Meta(gt=0, le=10)]
    hv_settle_us: Annotated[float, Meta(ge=1, le=100e3)]
    min_pulse_us: Annotated[float, Meta(ge=0.4, le=10)]
    max_channel_edge_rate_hz: Annotated[float, Meta(gt=0, le=500e3)]
    max_total_edge_rate_hz: Annotated[float, Meta(gt=0, le=16e6)]
    max_edge_rate_hz: Positive
    resistor_rating_w: Annotated[float, Meta(gt=0, le=100)]
    derating: Share

    @property
    def arming_s(self) -> float:
        """From ARM to the idle levels, in s."""
        return self.hv_settle_us * 1e-6 + self.ramp_ms * 1e-3
