"""Production tolerances: how each property of a panel varies from plate to plate."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Final

import msgspec
import numpy as np
from msgspec import Meta

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.board.plate.patches import discs
from controller.device.board.plate.plate import Plate
from controller.device.board.records import Record
from controller.device.board.relations.panel import PLACES
from controller.errors import ConfigError

SHIPPED: Final = Path(__file__).with_name("tolerances.toml")
CUT: Final = 3.0  # sigma: what lies beyond is sorted out
COEFFICIENT_PER_K: Final = -2e-4  # of a board without [temperature]: relative change of the frequencies of glass

Width = Annotated[float, Meta(gt=0, le=50)]


class Spread(Record, frozen=True):
    """How a property varies about its nominal value: uniform or normal; one of both is given.

    Attributes:
    half_width: Uniform, at most so far from the nominal value.
    sigma: Standard deviation of a normal distribution, cut at three of it.
    """

    half_width: Width | None = None
    sigma: Annotated[float, Meta(gt=0, le=16)] | None = None

    def __post_init__(self) -> None:
        if (self.half_width is None) == (self.sigma is None):
            raise ValueError("give half_width, for a uniform distribution, or sigma, for a normal one")

    def draw(self, random: np.random.Generator, count: int) -> Floats:
        """Deviations from the nominal value, (count,)."""
        if self.half_width is not None:
            return random.uniform(-self.half_width, self.half_width, count)
        assert self.sigma is not None
        deviations = random.standard_normal(count)
        while (beyond := np.abs(deviations) > CUT).any():
            deviations[beyond] = random.standard_normal(np.count_nonzero(beyond))
        return self.sigma * deviations


class Tolerances(Record, frozen=True):
    """What varies; left out: it does not. Of each plate, but where it says of each disc or channel.

    Attributes:
    thickness_percent, young_modulus_percent, density_percent: Of the plate, all its layers alike.
    length_mm, width_mm: Of the plate, at its far ends.
    decay_time_percent: Of the decay time of all modes.
    foam_stiffness_percent: Of the foam under the edges.
    patch_mm: Place of each disc with all its patches, along x and along y.
    gain_percent: Moment of each patch.
    capacitance_percent: Capacitance of the patches of each disc.
    supply_percent: Supply of the stages.
    temperature_k: Of the plate, from that of the bank; moves its frequencies by `temperature.coefficient_per_k`.
    dead_probability: Probability that a channel does nothing.
    """

    thickness_percent: Spread | None = None
    young_modulus_percent: Spread | None = None
    density_percent: Spread | None = None
    length_mm: Spread | None = None
    width_mm: Spread | None = None
    decay_time_percent: Spread | None = None
    foam_stiffness_percent: Spread | None = None
    patch_mm: Spread | None = None
    gain_percent: Spread | None = None
    capacitance_percent: Spread | None = None
    supply_percent: Spread | None = None
    temperature_k: Spread | None = None
    dead_probability: Annotated[float, Meta(ge=0, lt=1)] = 0.0

    def given(self, board: Board) -> list[str]:
        """Names of those that vary on a board, in their order."""
        names = [name for name in self.__struct_fields__ if getattr(self, name)]
        return [name for name in names if name != "foam_stiffness_percent" or board.plate.foam is not None]


@dataclass(frozen=True, eq=False)
class DrawnPlate:
    """One panel as production has made it."""

    board: Board  # plate, patches and supply that are there; what the host plays is not changed by them
    gain: Floats  # (32,): of each channel's moment, over the board's; 0: it does nothing
    capacitance: Floats  # (32,): of each channel, over the board's


def draw(board: Board, tolerances: Tolerances, seed: int, number: int, alone: str | None = None) -> DrawnPlate:
    """Plate `number` of a seed; with `alone`, only that tolerance varies, as it does on the same plate with all of them.

    Raises ConfigError if a patch comes to lie off the plate, or on another.
    """
    groups = discs(board.actuators)
    given = tolerances.given(board)

    def drawn(name: str, count: int = 1) -> Floats:
        if name not in given or alone not in (None, name):
            return np.zeros(count)
        random = np.random.default_rng([seed, number, tolerances.__struct_fields__.index(name)])
        if name == "dead_probability":
            return (random.uniform(size=count) < tolerances.dead_probability).astype(np.float64)
        spread: Spread = getattr(tolerances, name)
        return spread.draw(random, count)

    def factor(name: str) -> float:
        return 1 + 0.01 * float(drawn(name)[0])

    shifts_mm = drawn("patch_mm", 2 * len(groups)).reshape(-1, 2)
    capacitance = np.ones(CHANNELS)
    actuators = []
    for disc, (dx_mm, dy_mm), change in zip(groups, shifts_mm.tolist(), drawn("capacitance_percent", len(groups)), strict=True):
        for patch in disc:
            actuators.append(msgspec.structs.replace(patch, x_mm=patch.x_mm + dx_mm, y_mm=patch.y_mm + dy_mm))
            capacitance[patch.channel] = 1 + 0.01 * change
    real = msgspec.structs.replace(
        board,
        plate=_plate(board, factor, lambda name: float(drawn(name)[0])),
        actuators=tuple(actuators),
        driver=msgspec.structs.replace(board.driver, supply_v=board.driver.supply_v * factor("supply_percent")),
    )
    if refused := [said for relation in PLACES for said in relation.broken(real)]:
        raise ConfigError(f"plate {number}: {refused[0]}: a smaller patch_mm, length_mm or width_mm keeps all patches on the plate")
    gain = (1 + 0.01 * drawn("gain_percent", CHANNELS)) * (1 - drawn("dead_probability", CHANNELS))
    return DrawnPlate(real, gain, capacitance)


def _plate(board: Board, factor: Callable[[str], float], by: Callable[[str], float]) -> Plate:
    """The board's plate with what was drawn of it: factors of percents, and differences."""
    plate = board.plate
    coefficient_per_k = board.temperature.coefficient_per_k if board.temperature else COEFFICIENT_PER_K
    material = {
        "thickness_mm": factor("thickness_percent"),
        "young_modulus_pa": factor("young_modulus_percent") * (1 + coefficient_per_k * by("temperature_k")) ** 2,
        "density_kg_m3": factor("density_percent"),
    }

    def changed(record: Any) -> Any:
        return msgspec.structs.replace(record, **{name: getattr(record, name) * share for name, share in material.items()})

    foam = plate.foam
    if foam is not None:
        foam = msgspec.structs.replace(foam, stiffness_n_m3=foam.stiffness_n_m3 * factor("foam_stiffness_percent"))
    slower = factor("decay_time_percent")
    damping = plate.damping
    if damping is not None:
        times = tuple(msgspec.structs.replace(at, decay_time_ms=at.decay_time_ms * slower) for at in damping.decay_times)
        damping = msgspec.structs.replace(damping, decay_times=times)
    drawn: Plate = msgspec.structs.replace(
        changed(msgspec.structs.replace(plate, layers=())),
        length_mm=plate.length_mm + by("length_mm"),
        width_mm=plate.width_mm + by("width_mm"),
        decay_time_ms=plate.decay_time_ms * slower,
        layers=tuple(map(changed, plate.layers)),
        foam=foam,
        damping=damping,
    )
    return drawn
