"""Numbers from which `haptic-panel design` computes; a board has all of them but the last three."""

from collections.abc import Mapping
from typing import Annotated, Any, Final

import msgspec
from msgspec import Meta

from controller.device.board.board import Board
from controller.device.board.plate.parts import Parts
from controller.device.board.plate.plate import OF_LAYERS, Plate
from controller.device.board.records import Record, as_record
from controller.errors import ConfigError
from controller.workshop.physics.design.from_parts import from_parts
from controller.workshop.physics.felt import LIGHT_TOUCH

MOST_STEPS = 1000
PLATE: Final = ("length_mm", "width_mm", *OF_LAYERS)


class DesignInputs(Record, frozen=True):
    """Numbers of a design; in wider ranges than a board.toml may have, from a watch to the floor of a hall.

    Attributes:
    length_mm: Extent of the plate along x.
    width_mm: Extent of the plate along y.
    thickness_mm: Thickness of the plate.
    young_modulus_pa: Young's modulus of the plate.
    poisson_ratio: Poisson's ratio of the plate.
    density_kg_m3: Density of the plate.
    decay_time_ms: tau, in which a free vibration falls to 1/e.
    band_low_hz: Lower edge of the band.
    band_high_hz: Upper edge of the band.
    duration_ms: T, length of an emission.
    bit_clock_hz: Drive words a second.
    supply_v: Supply of the driver stages.
    resistance_ohm: Series resistance of a stage.
    inductance_h: Series inductance of a stage.
    capacitance_f: Capacitance of a patch.
    moment_n_per_v: Bending moment per length of a patch's edge, per volt.
    channels: Q, number of patches, each with its driver.
    size_mm: Edge length of a patch.
    period_ms: Tr, from emission to emission (default: T).
    finger_mg: M, mass that a finger adds to the plate at the focus (default: 70, of a light touch; 140: 1 N).
    amplitude_um: A, displacement for energy and power (default: what patches and drivers can reach).
    """

    length_mm: Annotated[float, Meta(ge=5, le=20e3)]
    width_mm: Annotated[float, Meta(ge=5, le=20e3)]
    thickness_mm: Annotated[float, Meta(ge=0.02, le=200)]
    young_modulus_pa: Annotated[float, Meta(ge=1e8, le=2e12)]
    poisson_ratio: Annotated[float, Meta(ge=0, lt=0.5)]
    density_kg_m3: Annotated[float, Meta(ge=10, le=30e3)]
    decay_time_ms: Annotated[float, Meta(ge=0.01, le=100e3)]
    band_low_hz: Annotated[float, Meta(ge=1, le=10e6)]
    band_high_hz: Annotated[float, Meta(ge=1, le=10e6)]
    duration_ms: Annotated[float, Meta(ge=1e-3, le=10e3)]
    bit_clock_hz: Annotated[float, Meta(ge=10, le=1e9)]
    supply_v: Annotated[float, Meta(gt=0, le=1e4)]
    resistance_ohm: Annotated[float, Meta(ge=1e-3, le=1e9)]
    inductance_h: Annotated[float, Meta(ge=1e-12, le=1e3)]
    capacitance_f: Annotated[float, Meta(ge=1e-15, le=1)]
    moment_n_per_v: Annotated[float, Meta(gt=0, le=1e3)]
    channels: Annotated[int, Meta(ge=1, le=100_000)]
    size_mm: Annotated[float, Meta(ge=0.01, le=20e3)]
    period_ms: Annotated[float, Meta(gt=0, le=1e6)]
    finger_mg: Annotated[float, Meta(ge=0, le=1e9)]
    amplitude_um: Annotated[float, Meta(gt=0, le=1e6)] | None = None

    def __post_init__(self) -> None:
        if self.band_high_hz <= self.band_low_hz:
            raise ValueError(f"band_high_hz = {self.band_high_hz:g} is not above band_low_hz = {self.band_low_hz:g}")
        if self.band_high_hz >= self.bit_clock_hz / 2:
            raise ValueError(f"band_high_hz = {self.band_high_hz:g} is not below half of bit_clock_hz = {self.bit_clock_hz:g}")
        if self.period_ms < self.duration_ms:
            raise ValueError(f"period_ms = {self.period_ms:g} is below duration_ms = {self.duration_ms:g}: emissions would overlap")
        if self.size_mm > min(self.length_mm, self.width_mm):
            raise ValueError(
                f"size_mm = {self.size_mm:g} of a patch is above the plate's {min(self.length_mm, self.width_mm):g} mm"
            )


NUMBERS = tuple(DesignInputs.__struct_fields__)


def inputs_of(board: Board, changes: Mapping[str, float], parts: Parts | None = None) -> DesignInputs:
    """Numbers of a board, but for `changes` and what follows from them: see `from_parts`.

    `parts` are others than the board's. Raises ConfigError, naming the number that is not possible, and what is.
    """
    own: dict[str, float] = {}
    for table in (board.plate, board.driver, board.waveform):
        own |= {name: getattr(table, name) for name in NUMBERS if hasattr(table, name)}
    sizes = sorted(actuator.size_mm for actuator in board.actuators)
    own |= {"channels": len(sizes), "size_mm": sizes[len(sizes) // 2], "finger_mg": LIGHT_TOUCH.mass_kg * 1e6}
    given = _record({**own, **changes})
    plate, middle_hz = plate_of(board.plate, msgspec.structs.asdict(given)), (given.band_low_hz + given.band_high_hz) / 2
    return _record({**own, **changes, **from_parts(board, own, plate, middle_hz, changes, parts)})


def plate_of(plate: Plate, numbers: Mapping[str, Any]) -> Plate:
    """A plate with other numbers; one of another material or thickness has no layers.

    Raises ConfigError if the board's edges do not go with its size.
    """
    changed = {name: value for name, value in numbers.items() if name in PLATE and value != getattr(plate, name)}
    if changed.keys() & set(OF_LAYERS):
        changed |= {name: numbers[name] for name in OF_LAYERS} | {"layers": ()}
    try:
        return msgspec.structs.replace(plate, **changed) if changed else plate
    except ValueError as error:
        raise ConfigError(f"the board's plate.{error}") from error


def _record(numbers: dict[str, float]) -> DesignInputs:
    numbers.setdefault("period_ms", numbers["duration_ms"])
    if float(numbers["channels"]).is_integer():
        numbers["channels"] = int(numbers["channels"])
    return as_record("", numbers, DesignInputs)


def sweep(text: str) -> tuple[str, list[float]]:
    """Name and values of `NAME=FROM:TO:STEP`, both ends included; raises ConfigError: saying what is wrong with it."""
    name, _, numbers = text.partition("=")
    if name not in NUMBERS:
        raise ConfigError(f"--sweep {text}: {name!r} is no number of a design: one of {', '.join(NUMBERS)}")
    try:
        first, last, step = (float(number) for number in numbers.split(":"))
        count = (last - first) / step + 1 + 1e-9
    except (ValueError, ZeroDivisionError) as error:
        raise ConfigError(f"--sweep {text}: give it as {name}=FROM:TO:STEP, three numbers, the step not 0") from error
    if not 1 <= count < MOST_STEPS + 1:  # NaN and infinities too
        raise ConfigError(f"--sweep {text}: that is not 1 to {MOST_STEPS} steps from {first:g} to {last:g}")
    return name, [float(f"{first + index * step:.12g}") for index in range(int(count))]
