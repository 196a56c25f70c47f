"""A day of simulated time in fast forward, every counter of the FPGA wrapping around meanwhile; touches faster than emissions."""

import msgspec
import numpy as np
import pytest

from controller.device.bank.reader import Bank
from controller.device.fpga.registers import Register
from controller.device.scene.scene import load_scene
from controller.device.touch.recordings.recording import Recording
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.simulation.simulated_run import Hardware, play

DAY_S = 86_400.0
WRAPS = {
    Register.TRIGGERS: 1 << 32,
    Register.EMISSIONS: 1 << 32,
    Register.TRIGGERS_IGNORED: 1 << 16,
    Register.PLAYS_MISSED: 1 << 32,
}
SCENE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
PLACES = [(50.0, 50.0), (105.0, 74.0), (160.0, 100.0)]


def worn(*reported, **named):
    """A gateware that has counted nearly as far as it can."""
    model = GatewareModel(*reported, **named)
    telemetry = model._core._telemetry
    for register, wrap in WRAPS.items():
        telemetry.counts[register] = wrap - 3
    for link in telemetry.links:
        for register in link.counts:
            link.counts[register] = (1 << 32) - 2
    return model


def taps(times_s):
    """Reports of a finger that comes down at each time and stays for 30 ms."""
    reports = []
    for number, time_s in enumerate(times_s):
        reports += [
            (time_s, {0: PLACES[number % len(PLACES)]}),
            (time_s + 0.01, {0: PLACES[number % len(PLACES)]}),
            (time_s + 0.03, {0: None}),
        ]
    return reports


def run(board, bank_file, tmp_path, reports, evemu_text, gateware=worn, **keys):
    on = msgspec.structs.replace(board, **keys)
    (tmp_path / "scene.toml").write_text(SCENE)
    with Bank.open(bank_file, on) as bank:
        return play(
            on,
            load_scene(tmp_path / "scene.toml", on),
            bank,
            Recording(evemu_text(*reports)),
            real_time=False,
            hardware=Hardware(gateware),
        )


APART_S = 55.03  # a recording has no longer pauses; the low half of the FPGA's clock wraps within it


@pytest.mark.parametrize("count", [12, pytest.param(round(DAY_S / APART_S) + 1, marks=pytest.mark.stress)], ids=["minutes", "day"])
def test_a_day_passes_all_counters_wrap_and_every_touch_is_felt_as_soon_as_the_first(board, bank_file, tmp_path, evemu_text, count):
    """Outputs are off between touches, so a day is short; each touch arms the FPGA and is felt a ramp later.

    A microsecond is 1e-11 of a day: time in 64-bit floats is known to 1e-11 s there, the FPGA's to a tick, 12.5 ns.
    """
    assert APART_S * board.link.clock_hz > 2**32
    times_s = np.arange(count) * APART_S
    played = run(board, bank_file, tmp_path, taps(times_s), evemu_text, idle_disarm_s=2.0)
    assert played.counters.foci == len(played.capture.focus_ticks) == count
    assert played.counters.skipped.emissions == 0
    late_s = played.capture.focus_ticks.astype(float) / board.link.clock_hz - played.start_s - times_s
    assert late_s.min() > board.waveform.duration_s
    assert late_s[1:].max() - late_s[1:].min() < 1e-3, (
        "the last touch of the day waits as long as the first that finds the panel idle"
    )
    assert late_s.max() < 0.05
    counts = played.link.gateware._core._telemetry.counts
    assert counts[Register.EMISSIONS] == WRAPS[Register.EMISSIONS] - 3 + count, "beyond its 32 bits, and nobody minds"


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.stress) for seed in range(1, 40))])
def test_touches_faster_than_emissions_are_merged_and_none_is_felt_twice(board, bank_file, tmp_path, evemu_text, seed):
    """Taps of a millisecond every two, for a plate that takes two for an emission and more for an upload."""
    random = np.random.default_rng([7, seed])
    period_s = random.uniform(0.4e-3, 2e-3)
    reports, time_s = [], 0.1
    for number in range(200):
        down = number % 2 == 0
        x_mm, y_mm = random.uniform([12, 12], [198, 136])
        reports.append((time_s, {0: (round(x_mm, 1), round(y_mm, 1)) if down else None}))
        time_s += period_s
    played = run(board, bank_file, tmp_path, reports, evemu_text)
    counters = played.counters
    assert counters.due == counters.foci + counters.skipped.emissions
    assert len(played.capture.focus_ticks) == len(played.played) == counters.emissions
    felt = [(e.owner, e.time_s) for some in played.played for e in some.emissions]
    assert len(set(felt)) == len(felt) == counters.foci
    apart = np.diff(played.capture.focus_ticks.astype(np.int64))
    assert (apart >= board.emission_ticks).all(), "the plate plays one waveform at a time"
    assert counters.foci > 10
