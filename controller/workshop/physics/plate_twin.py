"""The plate twin: displacement of the plate, computed from the recorded pin changes of the FPGA.

Its only input is pin changes with their ticks, not banks, frames or waveforms. Each change is a step of
voltage on some channels, and the response to a step is a sum of exponentials (`step_response`), so the
state at any tick is an exact superposition, starting at 0 V and at rest at tick 0: it includes the arming
ramp and the decay of earlier emissions.

Pin changes are divided into groups at focus ticks and wherever nothing changes for 16 bit periods. The
state that a group adds depends only on its words and their spacing, so equal groups are computed once.
"""

from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Complex, Floats, Reals, blocks
from controller.device.bank.packing import as_words, channel_bits
from controller.device.board.board import Board
from controller.device.fpga.capture import Capture
from controller.workshop.physics.field import Field, FocusScale
from controller.workshop.physics.focusing import balanced_weights, focus
from controller.workshop.physics.memory import TABLE_BYTES
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.loaded_responses import words_source
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.physics.responses.step_response import StepResponse, channel_forces
from controller.workshop.physics.word_capture import volts_above_idle

Point = tuple[float, float]

GAP_BITS = 16
MAX_GROUP_BITS = 1024
POLES_AT_ONCE = 512  # 25 MB of exponentials


class GroupState(NamedTuple):
    """What a group of steps adds by the tick of its last step: amplitudes of poles, (pole,) and (2, channel) of the drivers."""

    plate: Complex
    driver: Complex


@dataclass
class Work:
    """How many groups were computed and how many were known already."""

    groups_computed: int = 0
    groups_reused: int = 0


class PlateTwin:
    """A simulated plate behind the pins of an FPGA, or of several.

    Modes above `highest_hz` are left out, `mode_cut_hz` by default; `modes` take the place of those of the board's plate. Of the
    `remembered` groups (0.1 MB each) the one not used for longest goes first.
    """

    def __init__(self, board: Board, highest_hz: float | None = None, remembered: int = 256, modes: Modes | None = None) -> None:
        self.board = board
        self.modes = modes_of(board, highest_hz) if modes is None else modes
        self.step = StepResponse.of(self.modes, DriverResponse.of(board.driver))
        self.forces = channel_forces(board, self.modes)
        self.scale = FocusScale.of(board)  # where foci are measured
        self.work = Work()  # counters
        self._remembered = remembered
        self._group_states: OrderedDict[bytes, GroupState] = OrderedDict()
        self._table: Floats | None = None
        self._exact: dict[tuple[Point, ...], Floats] = {}
        self._pole_forces = np.ascontiguousarray(self.forces[self.step.mode_of_pole])

    @cached_property
    def responses(self) -> ResponseModel:
        """Responses of the same plate, which its own way from pins to displacement does not use."""
        return ResponseModel(self.board, modes=self.modes)

    @cached_property
    def words_source(self) -> ResponseSource:
        """The responses that drive words are made from: under the board's finger, if it has one."""
        return words_source(self.board, self.responses, self.modes)

    def fields(self, capture: Capture, clock_hz: float) -> Iterator[Field]:
        """Displacement of the plate at every focus tick, relative to rest at the board's idle word.

        The capture is from tick 0 on, everything low before its first change. Fields come in the order of `focus_ticks`; a step at
        the focus tick itself counts as after it.
        """
        ticks = capture.ticks.astype(np.int64)
        words = np.zeros((len(ticks) + 1, *capture.words.shape[1:]), np.uint32)  # step i goes from words[i] to words[i + 1]
        np.copyto(words[1:], capture.words, where=capture.hv != 0)
        focus_ticks = capture.focus_ticks.astype(np.int64)
        bit_ticks = clock_hz * self.board.waveform.bit_period_s
        cuts = _cuts(ticks, focus_ticks, bit_ticks)
        idle = self._volts(as_words(self.board.idle_word, words))[0]
        plate, driver = np.zeros(self.step.poles.size, np.complex128), np.zeros((2, self.board.channels), np.complex128)
        now = group = 0
        early, early_driver, early_end = 0, driver, 0  # tick and state of the drivers after the first `early_end` steps
        around_ticks = self.scale.around_s[-1] * clock_hz
        for focus_tick in focus_ticks.tolist():
            if now <= focus_tick - around_ticks and group:
                early, early_driver, early_end = now, driver, cuts[group]
            end = int(np.searchsorted(ticks, focus_tick, side="left"))
            while group + 1 < len(cuts) and cuts[group + 1] <= end:
                first, after = cuts[group], cuts[group + 1]
                state = self._group_state(ticks[first:after], words[first : after + 1], bit_ticks)
                passed = (int(ticks[after - 1]) - now) / clock_hz
                plate = plate * np.exp(self.step.poles * passed) + state.plate
                driver = driver * np.exp(self.step.driver_poles * passed)[:, None] + state.driver
                now = int(ticks[after - 1])
                group += 1
                if now <= focus_tick - around_ticks:
                    early, early_driver, early_end = now, driver, after
            passed = (focus_tick - now) / clock_hz
            settling = driver * np.exp(self.step.driver_poles * passed)[:, None]
            near, beyond = np.searchsorted(ticks, [focus_tick - around_ticks, focus_tick + around_ticks]).tolist()
            ago_s = np.maximum(focus_tick - around_ticks - np.append(early, ticks[early_end:near]), 0) / clock_hz
            forgot = np.exp(np.outer(self.step.driver_poles, ago_s))
            at_first = forgot[:, :1] * early_driver + forgot[:, 1:] @ np.diff(self._volts(words[early_end : near + 1]), axis=0)
            yield Field(
                modes=self.modes,
                step=self.step,
                pole_amplitudes=plate * np.exp(self.step.poles * passed),
                driver_amplitudes=self.step.driver_residues * (self.forces @ settling.T),
                level=self.step.static * (self.forces @ (self._volts(words[end : end + 1])[0] - idle)),
                near_s=(ticks[near:beyond] - focus_tick) / clock_hz,
                near_force=self.forces @ np.diff(self._volts(words[near : beyond + 1]), axis=0).T,
                early_driver_amplitudes=self.step.driver_residues * (self.forces @ at_first.T),
                scale=self.scale,
            )

    def reference_amplitude(self, x_m: float, y_m: float) -> float:
        """A_ref in m: amplitude at (x_m, y_m) of one emission of the sign of that point's band-limited response, in float64."""
        return float(self.exact_amplitudes(((x_m, y_m),))[0])

    def exact_amplitudes(self, points_m: tuple[Point, ...]) -> Floats:
        """What amplitude 1 means at each of `points_m` when all are composed together, in m: (point,).

        For one point its `reference_amplitude`. For several, the same share for all of what each gets alone in the band: that of
        the sign of the sum of their responses with `balanced_weights`, whose whole displacements are weighed as the responses are.
        """
        if points_m not in self._exact:
            places = np.array(points_m)
            in_band = self.words_source.drive_order_responses(places, dtype=np.float64)
            whole = self.responses.responses(places)[:, ::-1]
            weights, sizes = balanced_weights(in_band), np.abs(in_band).sum(axis=(1, 2))
            reached, most = np.abs(self._amplitudes_of(in_band, weights, whole)), np.abs(weights) @ sizes
            self._exact[points_m] = sizes * (np.abs(weights) @ reached / most if most else 0.0)
            for index, point in enumerate(points_m):  # computing the responses takes the time, so keep each point alone too
                alone = slice(index, index + 1)
                self._exact.setdefault((point,), np.abs(self._amplitudes_of(in_band[alone], np.ones(1), whole[alone])))
        return self._exact[points_m]

    def _amplitudes_of(self, in_band: Reals, weights: Floats, whole: Reals) -> Floats:
        """Displacement at each point by the words that weighted responses give, from rest at the idle word."""
        words = focus(in_band, weights.tolist(), self.board.idle_word)
        reached = whole.reshape(len(whole), -1) @ volts_above_idle(self.board, words).ravel()
        return reached.astype(np.float64, copy=False)

    def _group_state(self, ticks: NDArray[np.int64], words: NDArray[np.uint32], bit_ticks: float) -> GroupState:
        """State that a group adds; `words` has one more than `ticks`, the one before the first step."""
        key = (ticks - ticks[0]).tobytes() + words.tobytes()
        known = self._group_states.get(key)
        if known is not None:
            self._group_states.move_to_end(key)
            self.work.groups_reused += 1
            return known
        self.work.groups_computed += 1
        state = self._superpose((ticks[-1] - ticks) / bit_ticks, np.diff(self._volts(words), axis=0))
        self._group_states[key] = state
        if len(self._group_states) > self._remembered:
            self._group_states.popitem(last=False)
        return state

    def _superpose(self, ago_bits: Floats, steps: Floats) -> GroupState:
        """Sum the steps of a group, each as old as `ago_bits` bit periods at the group's last step."""
        period = self.board.waveform.bit_period_s
        whole = np.rint(ago_bits).astype(np.int64)
        count = self.step.poles.size
        if np.array_equal(whole, ago_bits) and whole[0] < MAX_GROUP_BITS:
            spread = np.zeros((int(whole[0]) + 1, self.board.channels))
            spread[whole] = steps
            table = self._decay_table()
            if table is not None:
                summed = (table[:, : len(spread)] @ spread).reshape(2, count, self.board.channels)
                rung = np.einsum("pq,rpq->rp", self._pole_forces, summed)
            else:
                rung = self._rung(np.arange(float(len(spread))) * period, spread)
        else:
            rung = self._rung(ago_bits * period, steps)
        plate = (rung[0] + 1j * rung[1]) * self.step.residues
        return GroupState(plate, np.exp(np.outer(self.step.driver_poles, ago_bits * period)) @ steps)

    def _volts(self, words: NDArray[np.uint32]) -> Floats:
        """Voltage of each channel's stage: (word, channel)."""
        return channel_bits(words).astype(np.float64) * self.board.driver.supply_v

    def _rung(self, ago_s: Floats, steps: Floats) -> Floats:
        """Sum of steps of voltage, (step, channel), each as old as `ago_s`, over channels: real and imaginary part of each pole."""
        rung = np.empty((2, self.step.poles.size))
        for some in blocks(self.step.poles.size, POLES_AT_ONCE):
            decay = np.exp(np.outer(self.step.poles[some], ago_s))
            for part, of_poles in zip(rung, (decay.real, decay.imag), strict=True):
                part[some] = np.einsum("pq,pq->p", self._pole_forces[some], of_poles @ steps)
        return rung

    def _decay_table(self) -> Floats | None:
        """exp(pole * n bit periods), real parts above imaginary parts, (2 * pole, n); None if it would be too large."""
        count = self.step.poles.size
        if self._table is None and 16.0 * count * MAX_GROUP_BITS <= TABLE_BYTES:
            times = np.arange(MAX_GROUP_BITS) * self.board.waveform.bit_period_s
            table = np.empty((2 * count, MAX_GROUP_BITS))
            for some in blocks(count, POLES_AT_ONCE):
                decay = np.exp(np.outer(self.step.poles[some], times))
                table[:count][some], table[count:][some] = decay.real, decay.imag
            self._table = table
        return self._table


def _cuts(ticks: NDArray[np.int64], focus_ticks: NDArray[np.int64], bit_ticks: float) -> list[int]:
    """First changes of the groups, and the number of changes."""
    quiet = np.flatnonzero(np.diff(ticks) >= GAP_BITS * bit_ticks) + 1
    wanted = {0, len(ticks), *quiet.tolist(), *np.searchsorted(ticks, focus_ticks, side="left").tolist()}
    cuts: list[int] = []
    for cut in sorted(wanted):
        while cuts and ticks[cut - 1] - ticks[cuts[-1]] >= MAX_GROUP_BITS * bit_ticks:
            cuts.append(int(np.searchsorted(ticks, ticks[cuts[-1]] + MAX_GROUP_BITS * bit_ticks, side="left")))
        cuts.append(int(cut))
    return cuts
