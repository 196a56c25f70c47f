"""When things are played: trains to one clock of the FPGA whatever the host does, and as many emissions as can be had.

The loop is the product's own on virtual time, the FPGA its gateware model. Spacings are taken from the captured pins.
"""

import random
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
from loop_parts import context_of, playback_of
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.fpga.frames import FRAME_BYTES, UPLOAD_BYTES, ReadyFrames
from controller.device.kernel import pack_loads
from controller.device.loop.context import LoopContext
from controller.device.loop.playing.host_timing import HANDOVER_S, PULSE_LEAD_S
from controller.device.loop.playing.occupancy import MARGIN_S
from controller.device.loop.playing.records import ENDLESS, Accepted, Batch
from controller.device.loop.wiring import assemble
from controller.device.scene.emission import Emission
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.waveforms.selection import Selection
from controller.errors import BankError, ConfigError
from controller.workshop.gateware.simulated_link import open_simulated

PLATE = 'shape = "plate"'


def region(name, shape, effect):
    return f'[[regions]]\nname = "{name}"\n{shape}\neffects = [{{ {effect} }}]\n'


def train(rate_hz, duration_ms=1000.0):
    return region("all", PLATE, f'effect = "train", rate_hz = {rate_hz:.1f}, duration_ms = {duration_ms}')


class LateClock(VirtualClock):
    """Virtual time on a busy machine: the loop wakes up late, by up to some time, at random."""

    def __init__(self, most_s):
        super().__init__()
        self._most_s = most_s
        self._random = random.Random(4)

    def wait(self, selector, until_s):
        super().wait(selector, until_s)
        self._now_s += self._random.uniform(0, self._most_s)


class Ran:
    """What a run did: counters, and the ticks of the starts of all emissions."""

    def __init__(self, board, link, counters, played):
        self.counters = counters
        self.played = played
        self.starts = link.take_capture().focus_ticks.astype(np.int64) - 1000 * board.bit_ticks

    def spacings(self):
        return np.diff(self.starts)


@pytest.fixture
def run(board, bank_file, tmp_path, evemu_text):
    def run_it(reports, scene_text, clock=None, on=board, slow_s=0.0):
        """`slow_s`: from the decision for an upload to its first bit on the wire."""
        clock = clock or VirtualClock()
        (tmp_path / "s.toml").write_text(scene_text)
        recording = Recording(evemu_text(*reports))
        link = open_simulated(on, clock.now_s)
        session = open_session(link, on, clock.now_s)
        exchange, played = link.exchange, []

        def slow(sent, lengths, received):
            clock._now_s += slow_s if sum(lengths) > UPLOAD_BYTES else 0.0
            exchange(sent, lengths, received)

        link.exchange = slow
        with Bank.open(bank_file, on) as bank:
            source = tracked(RecordingSource(recording, recording.axes(on), 0.1), on)
            assembly = assemble(
                LoopContext(on, clock, session, source), load_scene(tmp_path / "s.toml", on), bank, played=played.append
            )
            assembly.loop.run()
        link.close()
        return Ran(on, link, assembly.counters, played)

    return run_it


def sliding(end_s, speed_m_s=0.1, slot=0, y_mm=54.0, from_s=0.0, step_s=0.01):
    """Reports of a finger that slides to and fro."""
    count = round((end_s - from_s) / step_s)
    way_mm = [(k * step_s * speed_m_s * 1e3) % 300 for k in range(count)]
    return [(from_s + k * step_s, {slot: (30 + (w if w < 150 else 300 - w), y_mm)}) for k, w in enumerate(way_mm)] + [
        (end_s, {slot: None})
    ]


def merged(*ways):
    at = {}
    for way in ways:
        for time_s, slots in way:
            at.setdefault(round(time_s, 6), {}).update(slots)
    return sorted(at.items())


LOWER = 'shape = "rectangle"\nx_mm = 0.0\ny_mm = 0.0\nwidth_mm = 210.0\nheight_mm = 75.0'
FINE = region("all", PLATE, 'effect = "texture", spacing_mm = 0.5')
TICKS = 80_000_000  # a second


def rate_hz(starts):
    return (len(starts) - 1) / np.diff(starts).sum() * TICKS


def pulses(done):
    """Starts of the emissions in which a train's pulse takes part."""
    assert len(done.played) == len(done.starts)
    return np.array(
        [start for start, played in zip(done.starts, done.played, strict=True) if any(e.period_s for e in played.emissions)]
    )


def test_a_train_of_a_moving_finger_keeps_its_spacing_to_one_clock(run):
    done = run(sliding(1.1), train(50))
    assert done.counters.uploads == 50, "each pulse at another place"
    assert np.unique(done.spacings()).tolist() == [TICKS // 50]


@pytest.mark.parametrize("late_s", [0.0, 0.1e-3])
def test_each_pulse_of_a_rhythm_starts_at_its_own_time_to_one_clock(run, late_s):
    times_ms = np.array([40.0, 60.0, 107.3, 130.01, 330.0, 343.7, 360.0])
    levels = [1.0, 0.5, 0.25, 1.0, 0.3, 0.75, 0.5]
    rhythm = f'when = "press", pulses = {[[float(at), level] for at, level in zip(times_ms, levels, strict=True)]}'
    done = run(sliding(0.5), region("all", PLATE, rhythm), LateClock(late_s))
    assert done.counters.late == 0
    assert [emission.amplitude for played in done.played for emission in played.emissions] == levels
    assert np.abs(np.diff(done.starts) - np.diff(times_ms) * 1e-3 * TICKS).max() <= 1


def test_a_train_that_begins_beside_a_rhythm_neither_shifts_it_nor_is_shifted(run):
    """Their least and only distance from pulse to pulse is the same, 20 ms; the train begins 5 ms after a pulse of the rhythm."""
    rhythm = region(
        "left", LOWER, f'when = "press", pulses = {[[0.0, 1.0], [20.0, 1.0], *[[50.0 + 31 * k, 1.0] for k in range(12)]]}'
    )
    other = 'shape = "rectangle"\nx_mm = 0.0\ny_mm = 80.0\nwidth_mm = 210.0\nheight_mm = 60.0'
    fingers = merged(sliding(0.5), sliding(0.5, slot=1, y_mm=110.0, from_s=0.075))
    done = run(fingers, rhythm + region("right", other, 'effect = "train", rate_hz = 50.0, duration_ms = 300.0'))
    starts = {"left": [], "right": []}
    for start, played in zip(done.starts.tolist(), done.played, strict=True):
        for emission in played.emissions:
            starts[emission.region].append(start)
    wanted = np.array([0.0, 20.0, *[50.0 + 31 * k for k in range(12)]]) * 1e-3 * TICKS
    late = np.array(starts["left"]) - starts["left"][0] - wanted
    assert len(starts["left"]) == 14
    assert np.median(np.abs(late)) <= 1
    assert np.abs(late).max() < 5e-3 * TICKS, "a pulse that the other's is in the way of waits for it, and the next is at its time"
    assert len(starts["right"]) == 15


def test_a_rhythm_as_dense_as_a_board_allows_is_played_whole_and_a_denser_one_is_refused(run, board):
    narrow = msgspec.structs.replace(board, limits=msgspec.structs.replace(board.limits, max_duty=0.3, duty_budget_ms=20.0))
    moving = sliding(0.5)

    def rhythm(gap_ms):
        return region("all", PLATE, f'when = "press", pulses = {[[60 + gap_ms * k, 1.0] for k in range(30)]}')

    done = run(moving, rhythm(6.8), on=narrow)
    assert (done.counters.emissions, done.counters.outages) == (30, 0)
    with pytest.raises(
        ConfigError, match=r"pulses\[1\], at 66.6 ms, is 6.6 ms after the one before: .* at least 6.667 ms apart, to fit"
    ):
        run(moving, rhythm(6.6), on=narrow)
    many = f'{{ effect = "train", rate_hz = 10.0 }}, {{ when = "press", pulses = {[[6.8 * k, 1.0] for k in range(30)]} }}'
    two = f'[[regions]]\nname = "all"\n{PLATE}\neffects = [{many}]\n'
    with pytest.raises(
        ConfigError, match=r"effects: the trains that begin with when = 'press' are 157.059 emissions a second together"
    ):
        run(moving, two, on=narrow)


@pytest.mark.parametrize("late_s", [0.1e-3, 0.95 * (PULSE_LEAD_S - HANDOVER_S)])
def test_a_late_wake_up_does_not_shift_a_pulse(run, late_s):
    done = run(sliding(1.1), train(50), LateClock(late_s))
    assert done.counters.uploads == 50
    assert np.unique(done.spacings()).tolist() == [TICKS // 50]


def test_a_wake_up_later_than_the_lead_shifts_the_pulse(run):
    done = run(sliding(1.1), train(50), LateClock(2e-3))
    assert np.unique(done.spacings()).size > 1


TAPS = [report for k in range(5) for report in ((0.2 * k, {0: (30.0 + 30 * k, 54.0)}), (0.2 * k + 0.1, {0: None}))]


@each_row("slow_s", [0.0, 0.75 * HANDOVER_S, 0.15e-3])
def test_a_host_within_the_handover_time_starts_each_pulse_to_the_clock(run, slow_s):
    done = run(TAPS, train(50, 80.0), slow_s=slow_s)
    assert done.counters.late == 0
    assert done.counters.scheduled == done.counters.emissions == 20
    assert done.counters.skipped.refused == 0


@pytest.mark.parametrize("late_s", [0.0, 1e-3])
def test_the_age_of_a_report_when_read_is_recorded(run, late_s):
    """Of those of which an emission came in the same turn."""

    class Late(VirtualClock):
        def wait(self, selector, until_s):
            super().wait(selector, until_s)
            self._now_s += late_s

    report_latency = run(TAPS, region("all", PLATE, 'effect = "click"'), Late()).counters.report_latency
    assert 0 < report_latency.count <= 5
    assert report_latency.percentiles_ns([0.01])[0] == pytest.approx(late_s * 1e9, rel=0.01, abs=10)
    assert report_latency.worst_ns == pytest.approx(late_s * 1e9, abs=10)


def test_a_pulse_that_comes_too_late_for_its_time_is_played_at_once_and_counted(run):
    done = run(TAPS, train(50, 80.0), slow_s=2.0 * HANDOVER_S)
    assert done.counters.late == 1, "the first of the first touch, which is wanted as soon as can be: then the host is known"
    assert (done.counters.emissions, done.counters.scheduled) == (20, 19)
    assert done.counters.uploads == 4, "of five places: what came too late is not sent again"
    assert done.counters.skipped.refused == 0
    assert len(done.starts) == 20


@each_row("rate", [50, 100])
@each_row("late_s", [0.0, 0.45e-3])
def test_emissions_of_another_finger_do_not_shift_a_pulse(run, rate, late_s):
    scene = region("lower", LOWER, f'effect = "train", rate_hz = {rate}.0, duration_ms = 1000.0') + region(
        "upper", PLATE, 'effect = "texture", spacing_mm = 1.0'
    )
    other = sliding(1.05, slot=1, y_mm=110.0, from_s=0.003, speed_m_s=0.3, step_s=0.007)
    done = run(merged(sliding(1.1), other), scene, LateClock(late_s))
    train_of_one = pulses(done)
    assert len(train_of_one) == rate
    assert np.unique(np.diff(train_of_one)).tolist() == [TICKS // rate]
    assert len(done.starts) > rate + 100, "and the other finger feels its own"
    assert any(len(played.emissions) == 2 for played in done.played), "what would be in the way of a pulse is played with it"


def test_trains_of_two_fingers_each_keep_their_own_spacing(run):
    done = run(merged(sliding(1.1), sliding(1.0, slot=1, y_mm=100.0, from_s=0.013, speed_m_s=0.2)), train(50))
    for finger in (0, 1):
        own = [s for s, played in zip(done.starts, done.played, strict=True) if played.emissions[0].finger == finger]
        assert len(own) >= 49
        assert np.unique(np.diff(own)).tolist() == [TICKS // 50]


def test_pulses_that_are_played_together_begin_with_the_earliest(run):
    """None is late: of 50 and 49.9 pulses a second some are so near each other that a loop which wakes up late finds both."""
    upper = 'shape = "rectangle"\nx_mm = 0.0\ny_mm = 75.0\nwidth_mm = 210.0\nheight_mm = 73.0'
    trains = [
        region(name, shape, f'effect = "train", rate_hz = {rate}, duration_ms = 900.0')
        for name, shape, rate in (("lower", LOWER, 50.0), ("upper", upper, 49.9))
    ]
    done = run(
        [(0.0, {0: (60.0, 40.0), 1: (120.0, 110.0)}), (1.0, {0: None, 1: None})],
        "".join(trains),
        LateClock(0.95 * (PULSE_LEAD_S - HANDOVER_S)),
    )
    due_s = [[e.time_s for e in played.emissions if e.pulse] for played in done.played]
    apart = [
        (played, times_s)
        for played, times_s in zip(done.played, due_s, strict=True)
        if max(times_s, default=0) > min(times_s, default=0)
    ]
    assert apart
    for played, times_s in apart:
        assert played.at_ticks / TICKS == pytest.approx(min(times_s), abs=1e-6)


def test_an_emission_longer_than_the_gaps_of_a_fast_train_is_still_played(run):
    """Too near the train's finger to be played together with it."""
    scene = region("left", 'shape = "rectangle"\nx_mm = 0.0\ny_mm = 0.0\nwidth_mm = 105.0\nheight_mm = 148.0',
                   'effect = "train", rate_hz = 400.0, duration_ms = 1000.0')  # fmt: skip
    scene += region("right", PLATE, 'effect = "click"')
    taps = [report for k in range(4) for report in ((0.2 * k + 0.1, {1: (108.0, 74.0)}), (0.2 * k + 0.15, {1: None}))]
    done = run(merged([(0.0, {0: (102.0, 74.0)}), (1.1, {0: None})], taps), scene)
    clicks = [(p.trigger_s, e.time_s) for p in done.played for e in p.emissions if e.finger != 0]
    assert len(clicks) == 4
    assert max(trigger_s - time_s for trigger_s, time_s in clicks) < 25e-3


def test_a_finger_at_rest_gets_495_emissions_a_second_from_one_upload(run):
    done = run([(0.0, {0: (105.0, 74.0)}), (1.1, {0: None})], train(500))
    assert done.counters.uploads == 1
    assert done.counters.resident > 480
    assert rate_hz(done.starts[1:]) >= 495  # the first comes before the panel has confirmed the contact


@each_row("fingers", [1, 4])
@each_row("sck_hz", [25_000_000, 8_000_000])
def test_uploads_reach_nine_tenths_of_what_wire_and_plate_allow(run, board, fingers, sck_hz):
    on = msgspec.structs.replace(board, link=msgspec.structs.replace(board.link, sck_hz=sck_hz))
    ways = [sliding(1.0, speed_m_s=1.0, step_s=0.001, slot=k, y_mm=20 + 25.0 * k) for k in range(fingers)]
    done = run(merged(*ways), FINE, on=on)
    wire_hz = sck_hz / 8 / (UPLOAD_BYTES + 4 * FRAME_BYTES)
    plate_hz = 1 / board.waveform.duration_s
    uploads_hz = rate_hz(done.starts) * done.counters.uploads / done.counters.emissions
    assert uploads_hz >= 0.9 * min(wire_hz, plate_hz)


T_S, DUTY = 2e-3, 0.1


@pytest.fixture
def by_hand(board, bank_file):
    """A playback with its clock; the emissions that it starts, and the times at which it asks for a finger, are reported."""
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    session.arm()
    clock._now_s += 0.02
    done = SimpleNamespace(clock=clock, session=session, played=[], asked_s=[], place=None)

    def where(_, at_s):
        done.asked_s.append(at_s)
        return done.place

    with Bank.open(bank_file, board) as bank:
        context, selection = context_of(board, clock, session, where), Selection(bank, 1e-3, board.idle_word)
        done.playback = playback_of(context, selection, slots=4, duty=DUTY, command_s=23e-6, played=done.played.append)
        done.counters = context.counters
        yield done


def focus(x_m, finger=None, **more):
    return Batch([Emission(0.0, x_m, 0.05, finger, "")], **more)


@pytest.mark.parametrize("at_s", [None, 0.0], ids=["by the pin", "at a time"])
def test_a_play_that_ends_a_repetition_starts_after_its_last_emission_at_the_finger(by_hand, at_s):
    """The finger is asked for at T after the start that the repetition leaves, not at T after the command's arrival."""
    playback, clock = by_hand.playback, by_hand.clock
    playback.prepare(focus(0.05, repetitions=ENDLESS, period_s=0.025), 0)
    clock._now_s += 0.053  # its third emission sounds
    third_s = playback.occupancy.next_repetition_s(clock.now_s()) - 0.025
    playback.prepare(focus(0.1, finger=0, at_s=at_s), 0)
    last_start_s = playback.occupancy.last_start_s if playback.accepted is None else playback.accepted.start_s
    assert last_start_s == pytest.approx(third_s + T_S / DUTY, abs=2 * MARGIN_S)
    assert by_hand.asked_s[-1] == pytest.approx(last_start_s + T_S, abs=2 * MARGIN_S)
    assert not playback.occupancy.repeating


def test_the_duration_of_an_emission_before_a_pulse_is_reserved(by_hand):
    """That emission waits for the plate and for its upload; the plate is busy for longer than an upload takes."""
    playback, clock = by_hand.playback, by_hand.clock

    def free_after_next_s():
        return playback.occupancy.free_after_next_s(clock.now_s(), 1.4e-3, 1.6e-3)

    assert free_after_next_s() == pytest.approx(clock.now_s() + 1.4e-3 + T_S / DUTY + 2 * MARGIN_S)
    playback.prepare(focus(0.05), 0)
    (first,) = by_hand.played
    assert free_after_next_s() == pytest.approx(first.trigger_s + 2 * T_S / DUTY + 3 * MARGIN_S)


@pytest.mark.parametrize("at_s", [None, 0.0], ids=["by the pin", "at a time"])
def test_after_a_fault_nothing_waits_for_former_plays(by_hand, at_s):
    """Nor for a time of the FPGA that it may never reach: a reset has set its clock to 0."""
    playback, clock = by_hand.playback, by_hand.clock
    playback.prepare(focus(0.05), 0)
    playback.reset()
    asked_s = clock.now_s()
    playback.prepare(focus(0.1, at_s=at_s), 0)
    assert playback.accepted is None
    assert asked_s + 1.4e-3 <= playback.occupancy.last_start_s < asked_s + 3e-3


@pytest.mark.interpreted
def test_a_finger_is_played_at_its_last_place_if_the_bank_lacks_the_predicted_one(by_hand, monkeypatch):
    by_hand.place = (0.15, 0.05)
    waveform = Selection.waveform

    def damaged(selection, key):
        if key == selection.key(((*by_hand.place, 1.0),)):
            raise BankError("damaged")
        return waveform(selection, key)

    monkeypatch.setattr(Selection, "waveform", damaged)
    assert isinstance(by_hand.playback.prepare(focus(0.05, finger=0), 0), Accepted)
    assert [emission.x_m for played in by_hand.played for emission in played.emissions] == [0.05]
    assert by_hand.counters.skipped.bad_entries == 0


@pytest.mark.interpreted
def test_a_prefetched_waveform_damaged_in_its_slot_is_sent_again(by_hand, monkeypatch):
    playback, clock, places_m = by_hand.playback, by_hand.clock, (0.05, 0.08, 0.11)
    waveform = Selection.waveform

    def with_a_wrong_crc(selection, key):
        page = bytearray(UPLOAD_BYTES)
        pack_loads(page, 0, waveform(selection, key))
        return ReadyFrames(memoryview(page), 1)

    for place_m in places_m:
        if place_m == places_m[-1]:
            monkeypatch.setattr(Selection, "waveform", with_a_wrong_crc)
        sent = playback.sender.prefetch(0, place_m, 0.05, 1.0)
        monkeypatch.undo()
        clock._now_s += 0.03
        assert isinstance(playback.prepare(focus(place_m, finger=0), 0), Accepted)
    assert sent, "what it was sent for came true twice"
    assert (by_hand.counters.uploads, by_hand.counters.resident) == (3, 0)
    assert by_hand.counters.prefetch_wasted == 1


def test_no_prefetch_while_predictions_fail(by_hand):
    for _ in range(5):
        by_hand.playback.sender.prefetch(0, 0.05, 0.05, 1.0)
        by_hand.clock._now_s += 0.03
        by_hand.playback.prepare(focus(0.15, finger=0), 0)
    assert by_hand.counters.prefetched == 0


def test_plays_started_by_the_fpga_occupy_the_plate_as_long(by_hand):
    by_hand.playback.prepare(focus(0.05, at_s=0.0), 0)
    by_hand.playback.prepare(focus(0.1), 0)
    (first,) = by_hand.played
    assert by_hand.playback.accepted.start_s == pytest.approx(first.trigger_s + T_S / DUTY, abs=2 * MARGIN_S)


def test_a_longer_play_occupies_the_plate_for_longer(by_hand):
    by_hand.playback.occupancy.set_time_scale(1.1)
    for x_m in (0.05, 0.1):
        by_hand.playback.prepare(focus(x_m), 0)
    (first,) = by_hand.played
    assert by_hand.playback.accepted.start_s == pytest.approx(first.trigger_s + 1.1 * T_S / DUTY, abs=2 * MARGIN_S)


def test_reuse_of_a_waveform_for_a_nearby_place_is_counted(by_hand):
    for x_m in (0.0550, 0.0553, 0.0553, 0.0650):
        by_hand.playback.prepare(focus(x_m), 0)
        by_hand.clock._now_s += 0.03
        by_hand.playback.trigger()
    assert (by_hand.counters.uploads, by_hand.counters.resident, by_hand.counters.near) == (2, 2, 2)
