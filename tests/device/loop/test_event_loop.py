"""The loop from touch to pins: what it plays, when, what it leaves out, and how it ends.

Recording, scene, bank, session, link and gateware model are the product's own; time is virtual, so
every run gives the same ticks.
"""

import gc
import itertools
import os
import re
import selectors
import shutil
import signal
from itertools import pairwise
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from controller.clocks import NEVER, MonotonicClock, VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.panel_state import PanelState
from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.registers import State
from controller.device.loop import context as loop_context
from controller.device.loop import dispatcher
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.dispatcher import PREFETCH_SLACK_S
from controller.device.loop.playing.occupancy import Repetition
from controller.device.loop.preparation import PreparedScene
from controller.device.loop.rings.trace_ring import StartRecord, TurnRecord, records_of
from controller.device.loop.watched_files import WatchedFiles
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.waveforms.selection import Selection
from controller.errors import LinkError, TouchError
from controller.metrics import Counters
from controller.workshop.gateware.simulated_link import SimulatedLink, open_simulated
from controller.workshop.simulation import simulated_run
from controller.workshop.simulation.focus_evaluation import foci_meant


def region(name, shape, effect):
    return f'[[regions]]\nname = "{name}"\n{shape}\neffects = [{{ {effect} }}]\n'


PLATE = 'shape = "plate"'
CLICK = region("all", PLATE, 'effect = "click"')
TEXTURE = region("all", PLATE, 'effect = "texture", spacing_mm = 5.0')
TRAIN = region("all", PLATE, 'effect = "train", rate_hz = 50.0, duration_ms = 400.0')
BUTTON = region("button", 'shape = "rectangle"\nx_mm = 100.0\ny_mm = 70.0\nwidth_mm = 10.0\nheight_mm = 10.0', 'effect = "click"')
SPOT = region("spot", 'shape = "circle"\nx_mm = 60.0\ny_mm = 54.0\nradius_mm = 3.0', 'effect = "always", rate_hz = 20.0')
PERIOD_TICKS = 4_000_000  # of SPOT, at 80 MHz


def nearby(end_s):
    """Reports of one touch that meets no region, at the end: without any touch, fixed emitters would not be played."""
    return [(0.0, {}), (end_s, {9: (200.0, 140.0)}), (end_s + 0.001, {9: None})]


UPLOAD_BYTES = 4096 + 4 * FRAME_BYTES  # STORE, NOP while the slot is checked, PLAY, NOP
RESIDENT_BYTES = 2 * FRAME_BYTES
T_S = 2e-3


@pytest.fixture
def cell(bank_file):
    """A cell in the middle, and its place in mm."""
    with Bank.open(bank_file) as bank:
        number, _ = bank.grid.nearest(0.105, 0.074)
        x_m, y_m = bank.grid.points()[number]
        return number, (x_m * 1e3, y_m * 1e3)


def entry(bank_file, cell):
    with Bank.open(bank_file) as bank:
        return np.frombuffer(bytes(bank.drive.words(cell)), "<u4")


def words_before(run, focus_tick):
    """The 1000 words on the pins up to a focus tick."""
    capture, bit_ticks = run.capture, run.board.bit_ticks
    sampled = focus_tick - bit_ticks * np.arange(1000, 0, -1)
    return capture.words[np.searchsorted(capture.ticks.astype(np.int64), sampled, side="right") - 1]


def starts_ms(run):
    return (run.capture.focus_ticks.astype(np.int64) - 1000 * run.board.bit_ticks) / run.board.link.clock_hz * 1e3


def test_a_click_on_a_cell_puts_the_banks_entry_on_the_pins_bit_by_bit(perform, bank_file, cell):
    number, place = cell
    run = perform([(0.0, {0: place}), (0.1, {0: None})], CLICK)
    assert run.capture.focus_ticks.size == run.counters.emissions == run.counters.uploads == 1
    assert np.array_equal(words_before(run, int(run.capture.focus_ticks[0])), entry(bank_file, number))
    assert run.counters.skipped.compositions == 1
    assert not run.response_mapped


class OwnTime(MonotonicClock):
    """Real time as far as this process had the processor: what a busy machine took from it in one piece has not passed."""

    MOST_S = 1e-3  # between two looks at the clock

    def __init__(self):
        self._seen_s = super().now_s()
        self._taken_s = 0.0

    def now_s(self):
        real_s = super().now_s()
        self._taken_s += max(real_s - self._seen_s - self.MOST_S, 0.0)
        self._seen_s = real_s
        return real_s - self._taken_s

    def wait(self, selector, until_s):
        self.now_s()
        until_s += self._taken_s
        super().wait(selector, until_s)
        self._seen_s = min(super().now_s(), max(until_s, self._seen_s))  # it was to be asleep until then, not longer


def test_real_time_plays_the_same_as_virtual_time(perform, cell, monkeypatch):
    """Stalls have tests of their own, below; here what the machine takes is no time of the loop's."""
    monkeypatch.setattr(simulated_run, "MonotonicClock", OwnTime)
    reports = [
        (0.0, {0: cell[1]}),
        (0.1, {1: (150.0, 94.0)}),
        (0.2, {0: None, 1: None}),
        (0.3, {0: (60.0, 54.0)}),
        (0.4, {0: None}),
    ]
    real, virtual = (perform(reports, CLICK, real_time=real_time) for real_time in (True, False))
    assert real.counters.uploads == virtual.counters.uploads == 3
    for one, other in zip(real.capture.focus_ticks.tolist(), virtual.capture.focus_ticks.tolist(), strict=True):
        assert np.array_equal(words_before(real, one), words_before(virtual, other))
    apart_s = [np.diff([played.trigger_s for played in run.played]) for run in (real, virtual)]
    assert apart_s[0] == pytest.approx(apart_s[1], abs=20e-3), "and real time has passed in between"


def test_outputs_are_off_at_the_end_and_were_never_on_without_the_high_voltage_enable(perform, cell):
    run = perform([(0.0, {0: cell[1]}), (0.1, {0: None})], CLICK)
    assert run.capture.hv[-1] == 0
    assert run.capture.words[-1] == 0
    assert not run.capture.words[run.capture.hv == 0].any()


def test_without_touch_only_heartbeats_are_sent(perform):
    short = perform([(0.0, {}), (1.0, {})], CLICK)
    long = perform([(0.0, {}), (11.0, {})], CLICK)
    assert long.capture.focus_ticks.size == 0
    assert long.link.bytes_sent - short.link.bytes_sent == FRAME_BYTES * (long.counters.heartbeats - short.counters.heartbeats)
    assert long.counters.heartbeats - short.counters.heartbeats == pytest.approx(10 / (0.1 / 3), abs=1)


def test_a_touch_outside_every_region_looks_up_no_waveform(perform, bank_file, cell):
    run = perform([(0.0, {0: (20.0, 20.0)}), (0.1, {0: (30.0, 30.0)}), (0.2, {0: None})], BUTTON)
    assert run.counters.skipped.outside_region == 2
    assert run.lookups == 0
    assert run.capture.focus_ticks.size == 0


def test_a_finger_at_rest_is_uploaded_once_and_then_triggered_from_its_slot(perform, cell):
    run = perform([(0.0, {0: cell[1]}), (0.5, {0: None})], TRAIN)
    assert run.counters.uploads == 1
    assert run.counters.resident == run.counters.skipped.uploads == 19
    silent = perform([(0.0, {}), (0.5, {})], TRAIN)
    played_bytes = (
        run.link.bytes_sent - silent.link.bytes_sent - FRAME_BYTES * (run.counters.heartbeats - silent.counters.heartbeats)
    )
    assert played_bytes == UPLOAD_BYTES + 19 * RESIDENT_BYTES
    assert np.diff(starts_ms(run))[1:] == pytest.approx(20, abs=1e-3)  # the first one waits for its upload
    wire = run.counters.upload_latency.wire, run.counters.resident_latency.wire
    assert [stage.count for stage in wire] == [1, 19]
    sent = [stage.worst_ns * run.board.link.sck_hz / 8e9 for stage in wire]
    select = 2 * 10 * run.board.link.sck_hz / run.board.link.clock_hz / 8  # 10 ticks before and after each frame, in bytes
    assert sent == pytest.approx([UPLOAD_BYTES + 12 * select, RESIDENT_BYTES + 2 * select], rel=1e-3)


def test_time_spent_in_a_simulated_link_is_not_host_latency(perform, cell, monkeypatch):
    ages_ns = itertools.count(step=10**12)
    monkeypatch.setattr(SimulatedLink, "blocked_ns", property(lambda _: next(ages_ns), lambda *_: None), raising=False)
    run = perform([(0.0, {0: cell[1]}), (0.1, {0: None})], CLICK)
    assert run.counters.upload_latency.host.count == 1
    assert run.counters.upload_latency.host.worst_ns == 0


def test_the_least_recently_played_waveform_gives_up_its_slot(perform):
    places = [20.0, 50.0, 80.0, 110.0, 20.0, 140.0, 20.0]  # four slots: the fifth place takes that of the second
    reports = [report for k, x in enumerate(places) for report in ((0.1 * k, {0: (x, 54.0)}), (0.1 * k + 0.05, {0: None}))]
    run = perform(reports, CLICK)
    assert (run.counters.uploads, run.counters.resident) == (5, 2)


def test_a_train_ends_when_the_finger_is_lifted(perform, cell):
    run = perform([(0.0, {0: cell[1]}), (0.061, {0: None}), (0.5, {})], TRAIN)
    assert run.capture.focus_ticks.size == 4, "that it is lifted is known when it has not come back: one and a half reports later"


def test_two_fingers_due_at_once_are_one_emission_with_two_foci(perform, board, bank_file):
    run = perform([(0.0, {0: (60.0, 54.0), 1: (150.0, 94.0)}), (0.1, {0: None, 1: None})], CLICK)
    assert run.capture.focus_ticks.size == 1
    assert {(round(e.x_m * 1e3), round(e.y_m * 1e3)) for e in run.played[0].emissions} == {(60, 54), (150, 94)}
    with Bank.open(bank_file, board) as bank:
        selection = Selection(bank, board.bank.snap_mm * 1e-3, board.idle_word)
        words = selection.waveform(selection.key([(0.06, 0.054, 1.0), (0.15, 0.094, 1.0)]))
        assert np.array_equal(words_before(run, int(run.capture.focus_ticks[0])), np.frombuffer(words, "<u4"))


def test_emissions_due_while_the_plate_is_busy_are_composed_when_it_is_free(perform):
    reports = [
        (0.0, {0: (60.0, 54.0)}),
        (0.0005, {1: (150.0, 94.0)}),
        (0.001, {2: (100.0, 104.0)}),
        (0.1, {0: None, 1: None, 2: None}),
    ]
    run = perform(reports, CLICK)
    assert [len(played.emissions) for played in run.played] == [1, 2]
    assert np.diff(starts_ms(run)) >= T_S * 1e3


def test_the_wait_for_the_plate_is_recorded_in_ns(perform, board, cell):
    slow = msgspec.structs.replace(board, limits=msgspec.structs.replace(board.limits, max_duty=0.1))
    other = (cell[1][0] + 40, cell[1][1])
    run = perform([(0.0, {0: cell[1]}), (0.011, {1: other}), (0.1, {0: None, 1: None})], CLICK, on=slow)
    first, second = (played.trigger_s for played in run.played)
    asked_s = run.start_s + 0.011 + UPLOAD_BYTES * 8 / board.link.sck_hz
    assert run.counters.upload_latency.wait.worst_ns == pytest.approx((second - asked_s) * 1e9, rel=0.01)
    assert second - first == pytest.approx(20e-3, rel=0.01)


def test_of_one_finger_only_the_newest_emission_waits(perform):
    reports = [(0.0005 * k, {0: (60.0 + 6 * k, 54.0)}) for k in range(8)]
    run = perform([*reports, (0.1, {0: None})], TEXTURE)
    assert run.counters.skipped.merged > 0
    assert run.counters.emissions + run.counters.skipped.merged == 7
    assert run.played[-1].emissions[0].x_m >= 0.102, "the newest, or where the finger will be when it is played"


def test_emissions_never_overlap_and_keep_the_duty_limit(perform, board):
    half = msgspec.structs.replace(board, limits=msgspec.structs.replace(board.limits, max_duty=0.5))
    reports = [(0.001 * k, {0: (20.0 + 5.5 * k, 54.0)}) for k in range(30)]
    for on, period_ms in ((board, 2.0), (half, 4.0)):
        run = perform([*reports, (0.1, {0: None})], TEXTURE, on=on)
        assert run.capture.focus_ticks.size == run.counters.emissions > 3
        assert np.diff(starts_ms(run)).min() >= period_ms


def test_a_spot_is_handed_to_the_fpga_which_repeats_it_without_the_host(perform):
    short, long = (perform(nearby(end_s), SPOT) for end_s in (1.0, 3.0))
    assert long.counters.emissions == 1
    assert long.capture.focus_ticks.size - short.capture.focus_ticks.size == 40
    assert np.unique(np.diff(long.capture.focus_ticks.astype(np.int64))).tolist() == [PERIOD_TICKS]
    assert long.link.bytes_sent - short.link.bytes_sent == FRAME_BYTES * (long.counters.heartbeats - short.counters.heartbeats)


def test_a_finger_is_played_between_repetitions_of_a_spot_whose_phase_is_kept(perform):
    run = perform([(0.0, {}), (0.212, {0: (150.0, 94.0)}), (0.4, {0: None}), (1.0, {})], SPOT + CLICK)
    assert all(len(meant) == 1 for _, meant in foci_meant(run))
    emitters = [tick for tick, meant in foci_meant(run) if meant[0].finger is None]
    fingers = [tick for tick, meant in foci_meant(run) if meant[0].finger is not None]
    assert len(fingers) == 1
    pulse = np.diff(emitters)
    assert pulse == pytest.approx(PERIOD_TICKS, abs=1_600)  # 20 µs: the loop's own turn of the hand-over
    assert run.counters.uploads == 2
    assert run.counters.resident == 1


def test_a_spot_as_fast_as_the_plate_allows_gives_way_to_a_finger(perform):
    fast = SPOT.replace("rate_hz = 20.0", "rate_hz = 500.0")
    taps = [(0.2, {0: (150.0, 94.0)}), (0.3, {0: None}), (0.4, {0: (150.0, 94.0)}), (0.5, {0: None}), (0.6, {})]
    run = perform([(0.0, {}), *taps], fast + CLICK)
    emitter, *others = (words_before(run, tick) for tick in run.capture.focus_ticks.tolist())
    assert run.counters.resident > 0
    assert sum(not np.array_equal(emitter, words) for words in others) == 2
    assert np.diff(starts_ms(run)).min() == pytest.approx(T_S * 1e3)


def test_a_finger_due_with_a_spot_is_composed_with_it(perform):
    first = perform(nearby(1.0), SPOT)
    next_start_s = starts_ms(first)[4] * 1e-3 - first.start_s + first.link.time_s(0)
    run = perform([(0.0, {}), (next_start_s - 0.0005, {0: (150.0, 94.0)}), (0.9, {0: None}), (1.0, {})], SPOT + CLICK)
    ((together, meant),) = [(tick, meant) for tick, meant in foci_meant(run) if len(meant) == 2]
    assert {emission.region for emission in meant} == {"spot", "all"}
    next_spot = run.capture.focus_ticks[run.capture.focus_ticks > together][0]
    assert next_spot - together == pytest.approx(PERIOD_TICKS, abs=400_000)  # 5 ms: its pulse is not made up for


def test_a_bad_entry_is_left_out_counted_and_the_loop_goes_on(perform, bank_file, cell, tmp_path):
    number, place = cell
    damaged = tmp_path / "damaged.bank"
    content = bytearray(bank_file.read_bytes())
    with Bank.open(bank_file) as bank:
        at = content.index(bank.drive.frames(number)[0])
    content[at + 100] ^= 1
    damaged.write_bytes(content)
    other = (place[0] + 20, place[1])
    reports = [(0.0, {0: place}), (0.1, {0: None}), (0.2, {0: other}), (0.3, {0: None})]
    run = perform(reports, CLICK, bank=damaged)
    assert run.counters.skipped.bad_entries == 1
    assert run.capture.focus_ticks.size == 1


@pytest.mark.parametrize("how", ["written over", "one bit"])
def test_a_bank_that_is_changed_in_place_never_plays_wrong_bits(board, bank_file, tmp_path, evemu_text, how):
    """Entries used before the change and after it, alone and composed; `cp` over the file, which the host has mapped."""
    own, other = tmp_path / "own.bank", tmp_path / "other.bank"
    content = bytearray(bank_file.read_bytes())
    own.write_bytes(content)
    with Bank.open(bank_file, board) as bank:
        one, two = ([float(at) * 1e3 for at in bank.grid.points()[cell]] for cell in (130, 46))
        entries = {cell: np.frombuffer(bytes(bank.drive.words(cell)), "<u4") for cell in (130, 46)}
        selection = Selection(bank, board.bank.snap_mm * 1e-3, board.idle_word)
        points = [(x_mm * 1e-3, y_mm * 1e-3, 1.0) for x_mm, y_mm in (one, two)]
        both = np.frombuffer(bytes(selection.waveform(selection.key(points))), "<u4")
        for name in ("drive", "response"):
            section = bank.sections[name]
            changed = np.frombuffer(content, np.uint8, section.size, section.offset)
            if how == "written over":
                changed ^= 1
            else:
                changed[50 :: section.stride] ^= 1
    other.write_bytes(content)
    taps = [{0: one}, {0: two}, {0: one, 1: two}, {0: one}]  # then two slots are left, and the change comes at 1 s
    reports = [report for k, slots in enumerate(taps * 2) for report in ((0.2 * k, slots), (0.2 * k + 0.1, dict.fromkeys(slots)))]

    class Change(VirtualClock):
        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            if self._now_s > 0.85 and own.read_bytes() != content:
                shutil.copyfile(other, own)

    two_slots = with_slots(board, 2)
    with Bank.open(own, board) as bank:
        link, counters, loop = loop_of(two_slots, bank, tmp_path, Change(), reports, evemu_text, CLICK)
        loop.run()
        link.close()
    capture = link.take_capture()
    right = [entries[130], entries[46], both]
    ran = SimpleNamespace(capture=capture, board=board)
    for tick in capture.focus_ticks.tolist():
        assert any(np.array_equal(words_before(ran, tick), words) for words in right), "other words than those of the bank"
    assert counters.uploads >= 3, "before it was changed"
    assert counters.skipped.bad_entries + counters.foci == counters.due == 10
    assert counters.skipped.bad_entries == 3, "the second place, and both together; what is resident is still good"
    assert counters.skipped.refused == 0
    assert "is damaged" in counters.bad_entry or "changed in place" in counters.bad_entry


def test_a_replay_in_virtual_time_is_the_same_every_time(perform):
    reports = [(0.004 * k, {0: (20.0 + 3 * k, 54.0), 1: (180.0 - 2 * k, 30.0 + k)}) for k in range(40)]
    first, second = (perform(reports, SPOT + TEXTURE) for _ in range(2))
    for field in ("ticks", "words", "hv", "focus_ticks"):
        assert np.array_equal(getattr(first.capture, field), getattr(second.capture, field))


class StallingClock(VirtualClock):
    """Virtual time in which the process is stopped once for a while, as by SIGSTOP."""

    def __init__(self, stalls):
        super().__init__()
        self.stalls = stalls  # (from, for) in s

    def wait(self, selector, until_s):
        super().wait(selector, until_s)
        while self.stalls and self._now_s >= self.stalls[0][0]:
            self._now_s += self.stalls.pop(0)[1]


def with_slots(board, slots):
    return msgspec.structs.replace(board, link=msgspec.structs.replace(board.link, slots=slots))


def loop_of(board, bank, tmp_path, clock, reports, evemu_text, scene_text=TRAIN, believed=None, **more):
    """A loop on the simulated board, which may be another one than the loop believes."""
    (tmp_path / "s.toml").write_text(scene_text)
    scene = load_scene(tmp_path / "s.toml", board)
    link = open_simulated(board, clock.now_s)
    recording = Recording(evemu_text(*reports))
    source = tracked(RecordingSource(recording, recording.axes(board), 0.1), board)
    context = LoopContext(believed or board, clock, open_session(link, board, clock.now_s), source)
    assembly = assemble(context, scene, bank, **more)
    return link, assembly.counters, assembly.loop


def test_after_a_stall_the_fpga_is_off_and_the_loop_arms_again(board, bank_file, tmp_path, cell, evemu_text):
    reports = [(0.0, {0: cell[1]}), (0.5, {0: None}), (1.0, {0: cell[1]}), (1.5, {0: None})]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, StallingClock([(0.25, 0.4)]), reports, evemu_text)
        loop.run()
        link.close()
    capture = link.take_capture()
    off = np.flatnonzero(np.diff(capture.hv.astype(int)) == -1) + 1
    assert counters.host_silent == 1
    assert len(off) == 2
    silent_s = capture.ticks[off[0]] / board.link.clock_hz - 0.25
    assert 0 < silent_s <= 0.1, "the heartbeat timeout"
    assert (capture.focus_ticks > 1.1 * board.link.clock_hz).sum() == 20, "the second touch is played in full"
    assert counters.uploads == 2, "what the slots hold is not trusted any more"


def test_what_waited_before_a_stall_is_not_played_after_it(board, bank_file, tmp_path, evemu_text):
    reports = [(0.005 * k, {k: (40.0 + 30 * k, 54.0)}) for k in range(3)]
    with Bank.open(bank_file, board) as bank:
        clock = StallingClock([(0.115, 0.4)])
        rare = msgspec.structs.replace(board, limits=msgspec.structs.replace(board.limits, max_duty=0.1))
        link, counters, loop = loop_of(board, bank, tmp_path, clock, [*reports, (0.9, {})], evemu_text, CLICK, rare)
        loop.run()
        link.close()
    assert counters.host_silent == 1
    assert link.take_capture().focus_ticks.size == 1


def test_a_spot_goes_on_after_a_stall(board, bank_file, tmp_path, evemu_text):
    with Bank.open(bank_file, board) as bank:
        clock = StallingClock([(0.25, 0.4)])
        link, _, loop = loop_of(board, bank, tmp_path, clock, [(0.0, {}), (1.4, {})], evemu_text, SPOT)
        loop.run()
        link.close()
    assert (link.take_capture().focus_ticks > 0.7 * board.link.clock_hz).sum() == pytest.approx(16, abs=1)


def test_pulses_of_spots_that_a_short_stall_missed_are_not_made_up_for(board, bank_file, tmp_path, evemu_text):
    emitters = [SPOT.replace('"spot"', f'"{rate_hz}"').replace("20.0", f"{rate_hz}.0") for rate_hz in (50, 25)]
    with Bank.open(bank_file, board) as bank:
        clock = StallingClock([(0.25, 0.06)])
        link, counters, loop = loop_of(board, bank, tmp_path, clock, [(0.0, {}), (0.5, {})], evemu_text, "".join(emitters))
        loop.run()
        link.close()
    assert counters.host_silent == 0
    starts = link.take_capture().focus_ticks / board.link.clock_hz
    apart_s = np.diff(starts)[1:]  # the first one waits for its upload
    assert apart_s.max() == pytest.approx(80e-3)
    assert apart_s / 20e-3 == pytest.approx(np.round(apart_s / 20e-3), abs=1e-9), (
        "all others in their pulse; of two due at once one"
    )


def test_a_refused_upload_is_counted_and_costs_no_waveform_that_is_there(board, bank_file, tmp_path, evemu_text):
    places = [20.0, 50.0, 80.0, 110.0, 140.0, 170.0, 20.0]
    reports = [report for k, x in enumerate(places) for report in ((0.1 * k, {0: (x, 54.0)}), (0.1 * k + 0.05, {0: None}))]
    with Bank.open(bank_file, board) as bank:
        five = with_slots(board, board.link.slots + 1)
        link, counters, loop = loop_of(board, bank, tmp_path, VirtualClock(), reports, evemu_text, CLICK, five)
        loop.run()
        link.close()
    assert (counters.skipped.refused, counters.uploads, counters.resident) == (2, 4, 1)
    assert link.take_capture().focus_ticks.size == 5


@pytest.mark.interpreted
def test_an_emission_at_which_the_link_fails_is_counted_and_the_loop_goes_on(board, bank_file, tmp_path, cell, evemu_text):
    reports = [(0.0, {0: cell[1]}), (0.1, {0: None}), (0.5, {0: cell[1]}), (0.6, {0: None})]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, VirtualClock(), reports, evemu_text, CLICK)
        upload = loop._session.upload_and_play

        def failing(*how, **more):
            loop._session.upload_and_play = upload
            raise LinkError("unplugged")

        loop._session.upload_and_play = failing
        loop.run()
        link.close()
    assert (counters.outages, counters.due, counters.foci) == (1, 2, 1)
    assert counters.skipped.outputs_off == counters.skipped.emissions == 1


class Change:
    """A scene that is prepared at 0.25 s."""

    fileno = begin = staticmethod(lambda *_: None)

    def __init__(self, clock, prepared):
        self._clock, self._prepared = clock, [prepared]

    def take(self):
        return self._prepared.pop() if self._prepared and self._clock.now_s() > 0.25 else None


EXPECTED = object()  # what somebody makes of the other bank


def test_after_a_change_of_bank_nothing_of_the_former_is_played(board, bank_file, tmp_path, cell, evemu_text):
    """The same place three times; between the first and the second the bank is changed."""
    clock, taps = VirtualClock(), [(0.2 * k + more_s, {0: at}) for k in range(3) for more_s, at in ((0.0, cell[1]), (0.1, None))]
    with Bank.open(bank_file, board) as bank, Bank.open(shutil.copy(bank_file, tmp_path / "other.bank"), board) as other:
        another = Selection(other, board.bank.snap_mm * 1e-3, board.idle_word)
        (tmp_path / "same.toml").write_text(CLICK)
        change = Change(clock, PreparedScene(0, load_scene(tmp_path / "same.toml", board), another, expected=EXPECTED))
        link, counters, loop = loop_of(board, bank, tmp_path, clock, taps, evemu_text, CLICK, change=change)
        loop.run()
        assert loop.control.emissions.expected is EXPECTED, "what is said of emissions is of the bank that is played"
        link.close()
        assert loop._playback.sender.selection is another
    assert (counters.uploads, counters.resident) == (2, 1)
    assert (counters.scenes_loaded, counters.scenes_refused, counters.reloads) == (1, 0, 1)


def test_heartbeats_continue_during_a_ramp_longer_than_their_timeout(perform, board, cell):
    limits = msgspec.structs.replace(board.limits, heartbeat_timeout_ms=20.0, ramp_ms=100.0)
    run = perform([(0.0, {0: cell[1]}), (0.1, {0: None})], CLICK, on=msgspec.structs.replace(board, limits=limits))
    assert run.counters.host_silent == 0
    assert run.capture.focus_ticks.size == 1


def test_outputs_are_off_when_the_panel_is_lost(board, bank_file, tmp_path, evemu_text):
    class PanelLost(VirtualClock):
        lost = False

        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            if self._now_s > 0.2 and not self.lost:
                self.lost = True
                raise TouchError("the panel is gone")

    with Bank.open(bank_file, board) as bank:
        link, _, loop = loop_of(board, bank, tmp_path, PanelLost(), [(0.0, {}), (0.5, {})], evemu_text, SPOT)
        with pytest.raises(TouchError, match="the panel is gone"):
            loop.run()
        assert not link.gateware.status().state & (State.HV_ENABLE | State.RAMPING)
        sent = link.bytes_sent
        loop._session.off()
        assert link.bytes_sent == sent, "a status has said that they are off"
        link.close()


def test_the_last_emission_of_a_replay_plays_to_its_end(perform, cell):
    assert perform([(0.0, {0: cell[1]}), (0.003, {0: None})], CLICK).capture.focus_ticks.size == 1


def test_a_finished_run_gives_back_signals_and_garbage_collection(perform, cell):
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.getsignal(number) for number in numbers]
    perform([(0.0, {0: cell[1]}), (0.1, {0: None})], CLICK)
    assert [signal.getsignal(number) for number in numbers] == before
    assert signal.set_wakeup_fd(-1) == -1
    assert gc.isenabled()


def test_virtual_time_never_goes_back():
    clock = VirtualClock()
    with selectors.DefaultSelector() as selector:
        clock.wait(selector, 1.0)
        clock.wait(selector, 0.5)
    assert clock.now_s() == 1.0


@pytest.mark.parametrize("tap", [False, True])
def test_a_host_that_stalls_repeatedly_arms_later_each_time_and_never_gives_up(board, bank_file, tmp_path, cell, evemu_text, tap):
    """The process is stopped for 0.4 s whenever its outputs have been on for 50 ms, until 60 s; a touch after that is felt."""
    states = []

    class SlowHost(VirtualClock):
        on_since_s = None

        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            on = loop.outputs.on
            self.on_since_s = (self.on_since_s or self._now_s) if on else None
            if on and 0.15 < self._now_s < 60.0 and self._now_s >= self.on_since_s + 0.05:
                self._now_s += 0.4

    def note(now_s):
        outputs = loop.outputs
        if not states or states[-1][1:] != (outputs.on, outputs.state, outputs.cause):
            states.append((now_s, outputs.on, outputs.state, outputs.cause))

    still = [(5.0 * k, {}) for k in range(1, 15)]
    reports = [
        (0.0, {0: cell[1]} if tap else {}),
        (0.05, {0: None} if tap else {}),
        *still,
        (75.0, {0: cell[1]}),
        (75.1, {0: None}),
    ]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, SlowHost(), reports, evemu_text, CLICK, watch=Watch(note))
        loop.run()
        link.close()
    assert counters.emissions == 1 + tap, "the last touch is felt"
    assert counters.outages == 0
    on_again_s = [at_s for at_s, on, *_ in states if on][1:]
    lost_s = [at_s for at_s, on, state, cause in states if "in a row" in cause]
    paused_s = [round(next(on_s for on_s in on_again_s if on_s > at_s) - at_s, 1) for at_s in lost_s]
    assert paused_s[:7] == pytest.approx([0.5, 1.0, 2.0, 4.0, 8.0, 8.0, 8.0], abs=0.1)
    assert counters.stall_pauses == len(lost_s) == counters.host_silent - 1
    assert {state for _, on, state, cause in states if "in a row" in cause} == {PanelState.FAULTED}
    assert re.search(r"no valid frame.*\(3 times in a row: .*; armed again after 1 s\)", states[lost_at(states, 1)][3])
    capture = link.take_capture()
    seconds = capture.ticks / board.link.clock_hz
    for from_s in lost_s:
        until_s = next(at_s for at_s, _, state, _ in states if at_s > from_s and state is PanelState.RAMPING)
        assert not capture.hv[(seconds > from_s) & (seconds < until_s)].any(), "off meanwhile"


def lost_at(states, number):
    """Index of the state of the pause of this number."""
    return [index for index, (*_, cause) in enumerate(states) if "in a row" in cause][number]


def test_a_stall_now_and_then_is_not_in_a_row_with_the_one_before(board, bank_file, tmp_path, evemu_text):
    stalls = [(1.0 + 12.0 * k, 0.25) for k in range(5)]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, StallingClock(stalls), [(0.0, {}), (60.0, {})], evemu_text, CLICK)
        loop.run()
        link.close()
    assert (counters.host_silent, counters.stall_pauses) == (5, 0)
    assert counters.outputs_off_s < 0.5, "armed again at once each time"


@pytest.mark.parametrize("scene_text", [SPOT, CLICK], ids=["spot", "click"])
def test_stalls_with_emissions_between_them_are_not_in_a_row(board, bank_file, tmp_path, cell, evemu_text, scene_text):
    stalls = [(0.25 + 0.5 * k, 0.25) for k in range(6)]
    taps = [report for k in range(7) for report in ((0.5 * k, {0: cell[1]}), (0.5 * k + 0.05, {0: None}))]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, StallingClock(stalls), taps, evemu_text, scene_text)
        loop.run()
        link.close()
    assert (counters.host_silent, counters.stall_pauses) == (6, 0)


def test_a_lost_run_permit_is_waited_for_with_its_cause_and_outputs_off(board, bank_file, tmp_path, cell, evemu_text):
    class PermitLost(VirtualClock):
        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            if self._now_s > 0.2:
                link.gateware.permit(round(self._now_s * board.link.clock_hz), level=self._now_s > 0.7)

    reports = [(0.0, {0: cell[1]}), (0.5, {0: None}), (1.0, {0: cell[1]}), (1.1, {0: None})]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, PermitLost(), reports, evemu_text)
        loop.run()
        link.close()
    capture = link.take_capture()
    seconds = capture.ticks / board.link.clock_hz
    without = (seconds > 0.25) & (seconds < 0.7)
    assert not capture.hv[without].any()
    assert not capture.words[without].any()
    assert counters.outages == 1
    assert "run permit was lost" in counters.outage
    assert (capture.focus_ticks > 1.0 * board.link.clock_hz).any(), "given back, the panel plays again"


def test_touches_while_the_outputs_are_off_are_counted_one_by_one(board, bank_file, tmp_path, cell, evemu_text):
    class PermitLost(VirtualClock):
        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            if self._now_s > 0.2:
                link.gateware.permit(max(round(self._now_s * board.link.clock_hz), link.gateware.now), level=False)

    taps = [report for k in range(3) for report in ((0.3 + 0.1 * k, {0: cell[1]}), (0.35 + 0.1 * k, {0: None}))]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, PermitLost(), [(0.0, {}), *taps, (0.8, {})], evemu_text, CLICK)
        loop.run()
        link.close()
    assert (counters.due, counters.foci) == (3, 0)
    assert counters.skipped.outputs_off == counters.skipped.emissions == 3


def test_a_repetition_lost_with_the_fpga_no_longer_causes_ghosts(board, bank_file, tmp_path, cell, evemu_text):
    """A fixed emitter whose shadows touch: a contact beside it is a suspect; one that comes while the outputs are off is not."""

    class PermitLost(VirtualClock):
        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            if self._now_s > 0.2:
                link.gateware.permit(max(round(self._now_s * board.link.clock_hz), link.gateware.now), level=False)

    haunted = msgspec.structs.replace(board, touch=msgspec.structs.replace(board.touch, ghost_ms=30.0))
    reports = [(0.0, {}), (0.4, {0: cell[1]}), (0.5, {0: None}), (0.6, {})]
    with Bank.open(bank_file, haunted) as bank:
        scene_text = SPOT.replace("20.0", "40.0")
        link, counters, loop = loop_of(haunted, bank, tmp_path, PermitLost(), reports, evemu_text, scene_text)
        loop.run()
        link.close()
    assert counters.outages == 1
    assert loop._source.tracking.held_back == 0


class At(VirtualClock):
    """Virtual time at some times of which something is done, once."""

    def __init__(self, *what):
        super().__init__()
        self.what = list(what)

    def wait(self, selector, until_s):
        super().wait(selector, min(until_s, self.what[0][0]) if self.what else until_s)
        while self.what and self._now_s >= self.what[0][0]:
            self.what.pop(0)[1]()


@pytest.mark.interpreted
@pytest.mark.parametrize("ticket", [0, 7], ids=["SIGHUP", "a command"])
def test_a_refused_scene_changes_nothing_and_is_reported(board, bank_file, tmp_path, cell, evemu_text, ticket):
    reported = []
    commands = SimpleNamespace(
        fileno=lambda: None, next_time_s=lambda: NEVER, serve=lambda *_: None, touches=lambda _: None,
        loaded=lambda *what: reported.append(what), outcome=lambda *_: None,
    )  # fmt: skip
    clock, taps = At(), [(0.2 * k + more_s, {0: at}) for k in range(2) for more_s, at in ((0.0, cell[1]), (0.1, None))]
    with Bank.open(bank_file, board) as bank:
        change = Change(clock, PreparedScene(ticket, None, None, "bad.toml"))
        link, counters, loop = loop_of(
            board, bank, tmp_path, clock, taps, evemu_text, CLICK, change=change, commands=commands if ticket else None
        )
        clock.what.append((0.9, loop.stop))
        loop.run()
        link.close()
    assert (counters.scenes_loaded, counters.scenes_refused, counters.scene_refused) == (0, 1, "bad.toml")
    assert (counters.reloads, counters.reload_refused, counters.foci) == ((0, "", 2) if ticket else (1, "bad.toml", 2))
    assert reported == ([(7, "bad.toml")] if ticket else [])


def test_a_spot_of_another_scene_stays_resident_whatever_is_played_between_its_pulses(board, bank_file, tmp_path, evemu_text):
    clock, places = VirtualClock(), [(30.0 + 13.0 * k, 110.0) for k in range(10)]
    taps = [report for k, place in enumerate(places) for report in ((0.6 + 0.04 * k, {0: place}), (0.62 + 0.04 * k, {0: None}))]
    (tmp_path / "other.toml").write_text(SPOT.replace("rate_hz = 20.0", "rate_hz = 2.0") + CLICK)
    change = Change(clock, PreparedScene(0, load_scene(tmp_path / "other.toml", board)))
    with Bank.open(bank_file, board) as bank:
        reports = [(0.0, {}), *taps, (2.2, {})]
        link, counters, loop = loop_of(board, bank, tmp_path, clock, reports, evemu_text, CLICK, change=change)
        loop.run()
        assert not loop.reloading
        change.fileno = lambda: 0
        assert loop.reloading
        link.close()
    assert counters.uploads == len(places) + 1


def test_the_loop_ends_on_request(board, bank_file, tmp_path, cell, evemu_text):
    clock = At((0.3, lambda: loop.stop()))  # noqa: PLW0108 — there is no loop yet
    reports = [(0.0, {0: cell[1]}), (0.1, {0: None}), (0.5, {0: cell[1]}), (0.6, {0: None})]
    with Bank.open(bank_file, board) as bank:
        link, counters, loop = loop_of(board, bank, tmp_path, clock, reports, evemu_text, CLICK)
        loop.run()
        link.close()
    assert counters.emissions == 1
    assert not link.take_capture().hv[-1]


def test_the_scene_is_read_again_once_each_time_it_is_asked_for(board, bank_file, tmp_path, cell, evemu_text):
    asked = []
    change = SimpleNamespace(fileno=lambda: None, take=lambda: None, begin=lambda *what: asked.append((clock.now_s(), *what)))
    clock = At((0.3, lambda: loop.reload()), (0.4, lambda: loop.reload()))  # noqa: PLW0108
    with Bank.open(bank_file, board) as bank:
        reports = [(0.0, {0: cell[1]}), (0.6, {0: None})]
        link, _, loop = loop_of(board, bank, tmp_path, clock, reports, evemu_text, CLICK, change=change)
        loop.run()
        link.close()
    assert asked == [(pytest.approx(0.3, abs=1e-3), None, 0), (pytest.approx(0.4, abs=1e-3), None, 0)]


def test_a_spot_goes_on_after_a_client_has_disarmed_the_panel_and_armed_it_again(board, bank_file, tmp_path, evemu_text):
    clock = At((0.4, lambda: loop.control.switch(on=False)), (0.7, lambda: loop.control.switch(on=True)))
    with Bank.open(bank_file, board) as bank:
        link, _, loop = loop_of(board, bank, tmp_path, clock, [(0.0, {}), (1.4, {})], evemu_text, SPOT)
        loop.run()
        link.close()
    seconds = link.take_capture().focus_ticks / board.link.clock_hz
    assert not ((seconds > 0.45) & (seconds < 0.7)).any()
    assert (seconds > 0.75).sum() >= 13, "20 Hz until 1.5 s"


@pytest.mark.interpreted
def test_no_prefetch_delays_a_pulse(board, bank_file, tmp_path, evemu_text, monkeypatch):
    """A finger on a train, and one that moves on a texture."""
    halves = [
        region(name, f'shape = "rectangle"\nx_mm = {x_mm}\ny_mm = 5.0\nwidth_mm = 100.0\nheight_mm = 138.0', effect)
        for name, x_mm, effect in (
            ("left", 5.0, 'effect = "texture", spacing_mm = 5.0'),
            ("right", 105.0, 'effect = "train", rate_hz = 90.0, duration_ms = 900.0'),
        )
    ]
    reports = [(0.007 * k, {0: (10.0 + 0.25 * k, 54.0), 1: (150.0, 94.0)}) for k in range(140)]
    with Bank.open(bank_file, board) as bank:
        clock = VirtualClock()
        reports.append((1.0, {0: None, 1: None}))
        link, counters, loop = loop_of(board, bank, tmp_path, clock, reports, evemu_text, "".join(halves), with_slots(board, 16))
        prefetch, expected, ahead_s, wanted = loop._playback.sender.prefetch, dispatcher.next_focus, [], []

        def noting(*how):
            wanted.append(expected(*how))
            return wanted[-1]

        def sending(*what, **more):
            ahead_s.append(loop._clock_estimate.host_s(loop._scheduler.next_s()) - clock.now_s())
            return prefetch(*what, **more)

        loop._playback.sender.prefetch = sending
        monkeypatch.setattr(dispatcher, "next_focus", noting)
        loop.run()
        link.close()
    assert counters.emissions > 80
    during = [at_s for at_s in ahead_s if at_s < 1.0]  # the train goes on
    assert len(during) > 5
    assert min(during) > loop._timing.lead_s + PREFETCH_SLACK_S
    assert sum(point is not None for point in wanted) > len(ahead_s), "some were held back"


@pytest.mark.interpreted
def test_while_the_panel_listens_the_loop_wakes_for_a_repetition_that_has_yet_to_begin(board, bank_file, tmp_path, evemu_text):
    """Only what has begun can be stopped."""
    with Bank.open(bank_file, board) as bank:
        link, _, loop = loop_of(board, bank, tmp_path, VirtualClock(), [(0.0, {}), (1.0, {})], evemu_text, CLICK)
        loop.outputs = SimpleNamespace(on=True, unwanted=False, next_s=lambda: 10.5)
        loop._source = SimpleNamespace(next_time_s=lambda: None, fileno=lambda: 0)
        loop._dispatcher.quiet_until_s = 10.2
        assert loop._next_s(9.9985) == 10.2
        occupancy = loop._playback.occupancy
        occupancy.repeating = True
        occupancy.last_start_s, occupancy.repetition = 10.1, Repetition(loop._clock_estimate.fpga_s(10.1), 0.025)
        assert loop._next_s(9.9985) == pytest.approx(10.1)
        link.close()


@pytest.mark.interpreted
def test_times_of_touches_are_fpga_time(board, bank_file, tmp_path, cell, evemu_text):
    """Which has run for 100 s when this host begins."""
    with Bank.open(bank_file, board) as bank:
        link, _, loop = loop_of(board, bank, tmp_path, VirtualClock(), [(0.0, {0: cell[1]}), (0.1, {0: None})], evemu_text)
        loop._clock_estimate.offset_s, given = 100.0, []
        loop._scheduler.touch = lambda _, time_s: given.append(time_s)
        loop._read(loop._source.next_time_s())
        link.close()
    assert given == [pytest.approx(100.1)]


@pytest.mark.interpreted
def test_predictions_start_at_the_time_of_the_report(board, bank_file, tmp_path, evemu_text, monkeypatch):
    """Not from when the loop came to read it, a millisecond later."""

    class Late(VirtualClock):
        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            self._now_s += 1e-3

    reports = [(0.01 * k, {0: (30.0 + k, 54.0)}) for k in range(60)]
    with Bank.open(bank_file, board) as bank:
        link, _, loop = loop_of(board, bank, tmp_path, Late(), [*reports, (0.7, {0: None})], evemu_text, TEXTURE)
        expected, asked_s = dispatcher.next_focus, []

        def asking(effects, scene, finger, place, now_s, *more):
            asked_s.append(now_s)
            return expected(effects, scene, finger, place, now_s, *more)

        monkeypatch.setattr(dispatcher, "next_focus", asking)
        loop.run()
        link.close()
    assert len(asked_s) > 20
    assert [at_s * 100 for at_s in asked_s] == pytest.approx([round(at_s * 100) for at_s in asked_s], abs=1e-3)


def test_fixed_emitters_of_the_former_scene_no_longer_cause_ghosts(board, bank_file, tmp_path, cell, evemu_text):
    """Their shadows touch, as above; a contact that comes after the scene was changed is no suspect."""
    haunted, clock = msgspec.structs.replace(board, touch=msgspec.structs.replace(board.touch, ghost_ms=30.0)), VirtualClock()
    (tmp_path / "other.toml").write_text(CLICK)
    change = Change(clock, PreparedScene(0, load_scene(tmp_path / "other.toml", haunted)))
    reports = [(0.0, {}), (0.4, {0: cell[1]}), (0.5, {0: None}), (0.6, {})]
    with Bank.open(bank_file, haunted) as bank:
        scene_text = SPOT.replace("20.0", "40.0")
        link, counters, loop = loop_of(haunted, bank, tmp_path, clock, reports, evemu_text, scene_text, change=change)
        loop.run()
        link.close()
    assert (counters.scenes_loaded, counters.foci) == (1, 2)
    assert loop._source.tracking.held_back == 0


@pytest.mark.interpreted
def test_the_tracker_is_given_the_times_of_each_emission(board, bank_file, tmp_path, cell, evemu_text):
    played, reported = [], []
    taps = [(0.2, {0: cell[1]}), (0.3, {0: None}), (0.5, {0: cell[1]}), (0.6, {0: None})]
    with Bank.open(bank_file, board) as bank:
        link, _, loop = loop_of(board, bank, tmp_path, VirtualClock(), taps, evemu_text, SPOT + CLICK, played=played.append)
        emitted = loop._source.emitted

        def telling(start_s, end_s, period_s=0.0):
            reported.append((start_s, end_s, period_s))
            emitted(start_s, end_s, period_s)

        loop._source.emitted = telling
        loop.run()
        link.close()
    assert {p.count for p in played} == {0, 1}
    sounding = [emission for emission in reported if emission[0] >= played[0].trigger_s - 1e-6 and emission[0] < emission[1]]
    for (start_s, end_s, period_s), p in zip(sounding, played, strict=True):
        assert (start_s, end_s, period_s) == pytest.approx((p.trigger_s, p.trigger_s + T_S, p.period_s), abs=1e-6)


@pytest.mark.interpreted
def test_watched_files_may_appear_change_and_disappear(board, bank_file, tmp_path, cell, evemu_text):
    with Bank.open(bank_file, board) as bank, selectors.DefaultSelector() as selector:
        link, _, loop = loop_of(board, bank, tmp_path, VirtualClock(), [(0.0, {0: cell[1]}), (0.1, {0: None})], evemu_text)
        files, pipes = WatchedFiles(selector), [os.pipe() for _ in range(2)]
        for fileno in (None, pipes[0][0], pipes[0][0], pipes[1][0], None):
            loop._source.fileno = lambda fileno=fileno: fileno
            loop._watch(files)
            assert list(selector.get_map()) == ([] if fileno is None else [fileno])
        for end in itertools.chain(*pipes):
            os.close(end)
        link.close()


def test_fixed_emitters_of_different_rates_each_keep_their_own_pulse(perform):
    other = SPOT.replace('"spot"', '"slow"').replace("x_mm = 60.0", "x_mm = 150.0").replace("rate_hz = 20.0", "rate_hz = 8.0")
    run = perform(nearby(1.0), SPOT + other)
    meant = foci_meant(run)
    for name, period_ticks in (("spot", PERIOD_TICKS), ("slow", 10_000_000)):
        ticks = [tick for tick, emissions in meant if name in {emission.region for emission in emissions}]
        assert np.diff(ticks)[1:] == pytest.approx(period_ticks, abs=400_000)  # 5 ms: an upload while the other one sounds
        assert ticks[-1] - ticks[1] == pytest.approx((len(ticks) - 2) * period_ticks, abs=400_000), "no drift"
    assert any(len(emissions) == 2 for _, emissions in meant), "due at once, they are composed"


def test_late_reading_of_answers_does_not_shift_the_clock_estimate(board, bank_file, tmp_path, cell, evemu_text):
    clock, played = VirtualClock(), []
    with Bank.open(bank_file, board) as bank:
        reports = [(0.0, {0: cell[1]}), (0.3, {0: None})]
        link, counters, loop = loop_of(board, bank, tmp_path, clock, reports, evemu_text, played=played.append)
        exchange = link.gateware.exchange

        def slow(select_tick, release_tick, mosi, miso):
            """Takes half a millisecond of the host's time for each short frame."""
            exchange(select_tick, release_tick, mosi, miso)
            if len(mosi) == FRAME_BYTES:
                clock._now_s += 0.5e-3

        link.gateware.exchange = slow
        loop.run()
        link.close()
    assert counters.scheduled == len(played) > 10
    for start in played:
        assert link.time_s(start.at_ticks) == pytest.approx(start.trigger_s, abs=50e-6)


class Muted:
    """Counts nothing, once it is made."""

    def __init__(self):
        super().__init__()
        object.__setattr__(self, "muted", True)

    def __setattr__(self, name, value):
        if not getattr(self, "muted", False):
            super().__setattr__(name, value)


@pytest.mark.interpreted
def test_counters_decide_nothing(board, bank_file, tmp_path, evemu_text, monkeypatch):
    """Stalls with emissions between them, a fixed emitter, a finger: the pins do the same if nothing is counted."""

    class MutedCounters(Muted, Counters):
        pass

    reports = [(0.005 * k, {0: (20.0 + 0.3 * k, 54.0)}) for k in range(500)]
    captures = []
    for kind in (Counters, MutedCounters):
        monkeypatch.setattr(loop_context, "Counters", kind)
        with Bank.open(bank_file, board) as bank:
            clock = StallingClock([(0.25 + 0.5 * k, 0.25) for k in range(5)])
            link, counters, loop = loop_of(board, bank, tmp_path, clock, reports, evemu_text, SPOT + TEXTURE)
            loop.run()
            link.close()
        assert (counters.host_silent, counters.emissions > 20) == ((5, True) if kind is Counters else (0, False))
        captures.append(link.take_capture())
    for field in ("ticks", "words", "hv", "focus_ticks"):
        assert np.array_equal(getattr(captures[0], field), getattr(captures[1], field))


@pytest.mark.parametrize(
    ("stall_s", "said"), [(0.013, r"a pulse was 1\d\.\d ms late"), (0.08, r"the loop woke \d\d\.\d ms late, and something was due")]
)
def test_a_host_that_stops_in_a_train_leaves_a_trace_of_it(board, bank_file, tmp_path, cell, evemu_text, stall_s, said):
    """After 13 ms the pulse that was missed is played late; after 80 ms it has been replaced by the next."""
    reasons = []
    reports = [(0.0, {0: cell[1]}), (0.5, {0: None})]
    with Bank.open(bank_file, board) as bank:
        link, _, loop = loop_of(board, bank, tmp_path, StallingClock([(0.25, stall_s)]), reports, evemu_text)
        ring = loop._trace
        ring.asked = reasons.append
        loop.run()
        link.close()
    assert any(re.fullmatch(said, reason) for reason in reasons), reasons
    records = list(records_of(ring.bytes, ring.at))
    turns = [record for record in records if isinstance(record, TurnRecord)]
    starts = [record for record in records if isinstance(record, StartRecord)]
    assert len(turns) > len(starts) > 15
    pauses_s = [after.began_s - before.ended_s for before, after in pairwise(turns) if after.due]
    assert max(pauses_s) > stall_s
    assert max(start.late_s for start in starts if start.pulse) == pytest.approx(0.011 if stall_s < 0.02 else 0.0, abs=2e-3)


def test_a_trace_is_asked_for_by_a_signal_but_not_by_a_good_run(board, bank_file, tmp_path, cell, evemu_text):
    reasons = []
    reports = [(0.0, {0: cell[1]}), (0.3, {0: None})]
    with Bank.open(bank_file, board) as bank:
        for number, signals in enumerate(((), (signal.SIGUSR1,))):
            sent = list(signals)
            watch = Watch(lambda now_s, sent=sent: os.kill(os.getpid(), sent.pop()) if sent and now_s > 0.2 else None)
            link, _, loop = loop_of(board, bank, tmp_path, VirtualClock(), reports, evemu_text, watch=watch)
            loop._trace.asked = lambda reason, **_: reasons.append(reason)
            loop.run()
            link.close()
            assert reasons == ["it was asked for (SIGUSR1)"] * number


def test_a_fault_leaves_a_trace(board, bank_file, tmp_path, cell, evemu_text):
    reasons = []
    with Bank.open(bank_file, board) as bank:
        reports = [(0.0, {0: cell[1]}), (0.5, {0: None})]
        link, counters, loop = loop_of(board, bank, tmp_path, StallingClock([(0.25, 0.4)]), reports, evemu_text)
        loop._trace.asked = lambda reason, **_: reasons.append(reason)
        loop.run()
        link.close()
    assert counters.host_silent == 1
    assert any("no valid frame" in reason for reason in reasons), reasons
