"""What amplitudes a bank foresees: kept in its header, so that a device can say them without a look at any response."""

from typing import Final

import numpy as np

from controller.arrays import Floats, Reals
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.physics.responses.response_source import ResponseSource

PLACES: Final = 64  # at which a bank is asked, a few a block
QUANTILES: Final = (0.025, 0.5, 0.975)


def foreseen_um(responses: Reals, supply_v: float) -> Floats:
    """Amplitude in um that drive words from band-limited responses, (place, sample, 32) in m per V, have by these: (place,)."""
    found: Floats = 0.5e6 * supply_v * np.abs(responses).sum(axis=(1, 2), dtype=np.float64)
    return found


def said_amplitude(board: Board, source: ResponseSource, points_m: Floats, of_plain: dict[str, float] | None) -> list[float]:
    """Build parameter `amplitude_um`: low, middle and high over some of a bank's cells that are off the rim, or all if none is.

    None of a bank for loaded plates. `of_plain` is `amplitude_of_plain` of the bank.
    """
    if board.finger is not None:
        return []
    rim_m = bending_wavelength_m(board.plate, board.waveform.middle_hz) / 2  # where nothing is said (`Expectation.says`)
    far_m = np.array([board.plate.length_m, board.plate.width_m]) - rim_m
    inside = ((points_m >= rim_m) & (points_m <= far_m)).all(axis=1)
    points_m = points_m[inside] if inside.any() else points_m
    some = points_m[np.random.default_rng(1).permutation(len(points_m))[:PLACES]]
    found = [foreseen_um(source.drive_order_responses(place[None]), board.driver.supply_v)[0] for place in some]
    factor = 1.0 if of_plain is None else of_plain["median"]
    return over_places(np.array(found) * factor)


def over_places(amplitudes_um: Floats) -> list[float]:
    """`QUANTILES` over places, four digits of each: another place is beyond them as probably as they say (Weibull, 1939)."""
    return [float(f"{value:.4g}") for value in np.quantile(amplitudes_um, QUANTILES, method="weibull")]
