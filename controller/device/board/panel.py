"""The tables of board.toml that describe the panel on its plate: actuators, driver stages, waveform, bank and limits."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from controller.device.board.records import NotNegative, PlaceMm, Positive, Record, Share, SizeMm, left_out

CHANNELS = 32  # of one FPGA
FPGAS_MAX = 4
EDGE_WINDOW_S = 0.25  # over which the FPGA counts the edges of a stage


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
