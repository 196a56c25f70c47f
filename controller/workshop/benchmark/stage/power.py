"""Power figures: edges of each channel and heat in its series resistor, computed from the entries of a bank.

`haptic-panel bank info --power` prints them. Method: write the driver's state as its deviation from the target voltage,
`z = v - target`, and the current i. No source acts on this deviation, so its energy `C z^2 / 2 + L i^2 / 2` is dissipated in R.
An edge of V moves the target and changes this energy by `C V^2 / 2 - s C V z` (s: +1 up, -1 down; z: just before the edge).
Once the piezo is at rest after the last edge, the sum over all edges is exactly the loss: `C V^2 / 2` per edge if edges are
far apart, more if the piezo rings against the next edge, less if the next edge comes before the piezo has moved.
"""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats, blocks
from controller.device.bank.packing import CHANNELS, WORD, channel_bits, framed
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.panel import Driver
from controller.device.board.relations.stage_heat import half_charge_j, worst_edge_j
from controller.workshop.physics.responses.driver import DriverResponse

ENTRIES_PER_BLOCK = 256  # one sample of them stays in the cache


@dataclass(frozen=True)
class Resistor:
    """The series resistor of one channel: its rating, and the share of it (`derating`) permitted continuously."""

    rating_w: float
    derating: float

    @property
    def permitted_w(self) -> float:
        """Continuous power permitted in the resistor."""
        return self.rating_w * self.derating


@dataclass(frozen=True)
class StageLoad:
    """Average limits of duty and edge rates that keep every resistor within `permitted_w`."""

    permitted_w: float
    max_duty: float
    max_channel_edge_rate_hz: float
    max_total_edge_rate_hz: float


def resistor_loss_j(driver: Driver, levels: NDArray[np.integer[Any]], period_s: float) -> Floats:
    """Heat in J (...) in the series resistor until all ringing has ended.

    `levels` (sample, ...) of the stage are 0 and 1, each held for `period_s`. The first has been held since long before, the last
    stays.
    """
    response = DriverResponse.of(driver)
    decay = np.exp(response.poles * period_s)
    # z after a unit step up is Re sum(residues exp(poles t)), -1 at first: over the samples a filter of second order
    late_gain = -(response.residues @ decay[::-1]).real
    once, twice = decay.sum().real, -decay.prod().real
    levels = np.asarray(levels, np.int8)
    shape = levels.shape[1:]
    before, older, work_sum = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    edges = np.zeros(shape, np.int64)
    for steps in np.diff(levels, axis=0):
        edges += steps != 0
        work_sum += steps * before
        after = before - steps
        before = late_gain * steps + once * after + older
        older = twice * after
    return 2 * half_charge_j(driver) * (edges / 2 - work_sum)


def bank_losses(board: Board, bank: Bank, progress: Callable[[int, int], None] | None = None) -> tuple[NDArray[np.int64], Floats]:
    """Count edges and compute the loss of each emission, from the idle word and back to it.

    `progress` is called with the number of entries done and of all entries. Returns (entry, 32) both; 0 for channels without an
    actuator. Raises BankError if an entry is damaged.
    """
    cells, idle = np.flatnonzero(bank.cells).tolist(), board.idle_word
    edges = np.empty((len(cells), CHANNELS), np.int64)
    loss_j = np.empty((len(cells), CHANNELS))
    for some in blocks(len(cells), ENTRIES_PER_BLOCK):
        entries = [framed(idle, np.frombuffer(bank.drive.words(cell), WORD), idle) for cell in cells[some]]
        levels = np.stack([channel_bits(words) for words in entries], axis=1)
        edges[some] = (levels[1:] != levels[:-1]).sum(axis=0)
        loss_j[some] = resistor_loss_j(board.driver, levels, 1 / bank.header.bit_clock_hz)
        if progress:
            progress(some.stop, len(cells))
    driven = np.array([board.channel_mask >> channel & 1 for channel in range(CHANNELS)])
    return edges * driven, loss_j * driven


def stage_limits(driver: Driver, resistor: Resistor, worst_channel_w: float, channels: int) -> StageLoad:
    """Derive limits that keep every resistor within its permitted power.

    The edge rates are limited for the waveform with the highest loss per edge; `worst_channel_w`, the power of the busiest channel
    of the bank at full duty, limits the duty; the total edge rate is that of one channel times `channels`, which share the supply.
    """
    rate_hz = resistor.permitted_w / worst_edge_j(driver)
    return StageLoad(
        permitted_w=resistor.permitted_w,
        max_duty=min(1.0, resistor.permitted_w / worst_channel_w),
        max_channel_edge_rate_hz=rate_hz,
        max_total_edge_rate_hz=channels * rate_hz,
    )


def power_report(board: Board, bank: Bank, progress: Callable[[int, int], None] | None = None) -> dict[str, Any]:
    """Summarise edges, loss and power of a bank's entries, and the limits that follow, ready for JSON.

    `progress` is called with the number of entries done and of all entries. Raises BankError if an entry is damaged.
    """
    resistor = Resistor(board.limits.resistor_rating_w, board.limits.derating)
    edges, loss_j = bank_losses(board, bank, progress)
    duration_s = bank.samples / bank.header.bit_clock_hz
    power_w = loss_j / duration_s
    used = [channel for channel in range(CHANNELS) if board.channel_mask >> channel & 1]
    per_edge_j = loss_j[:, used] / np.maximum(edges[:, used], 1)
    naive_w = edges * (half_charge_j(board.driver) / duration_s)
    limits = stage_limits(board.driver, resistor, float(power_w.max()), len(used))
    return {
        "path": str(bank.path),
        "board": board.name,
        "emissions": len(edges),
        "emission_ms": duration_s * 1e3,
        "edges": {"channel": _spread(edges[:, used]), "all": _spread(edges.sum(axis=1))},
        "edge_rate_hz": {"channel": _spread(edges[:, used] / duration_s), "all": _spread(edges.sum(axis=1) / duration_s)},
        "loss_per_edge_uj": _spread(per_edge_j * 1e6)
        | {"far_apart": half_charge_j(board.driver) * 1e6, "worst_possible": worst_edge_j(board.driver) * 1e6},
        "full_duty_w": {
            "channel": _spread(power_w[:, used]),
            "all": _spread(power_w.sum(axis=1)),
            "all_if_far_apart": _spread(naive_w.sum(axis=1)),
        },
        "max_duty": board.limits.max_duty,
        "max_duty_w": {
            "channel": _spread(power_w[:, used] * board.limits.max_duty),
            "all": _spread(power_w.sum(axis=1) * board.limits.max_duty),
        },
        "resistor": asdict(resistor) | {"holds": float(power_w.max()) * board.limits.max_duty <= resistor.permitted_w},
        "limits": asdict(limits),
        "channels": [
            {"channel": channel, "edges": _spread(edges[:, channel]), "full_duty_w": _spread(power_w[:, channel])}
            for channel in used
        ],
    }


def _spread(values: NDArray[Any]) -> dict[str, float]:
    return {"median": float(np.median(values)), "max": float(values.max())}
