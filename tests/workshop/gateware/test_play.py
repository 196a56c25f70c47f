"""Plays of the gateware model: words, starts, queue, delays, repetitions, and plays during an upload."""

from dataclasses import replace

import numpy as np
import pytest
from model_host import (
    ARMED,
    BIT_TICKS,
    COMMAND_TICKS,
    FETCHED_TICKS,
    IDLE,
    LATENCY,
    NOW_TICKS,
    PARAMETERS,
    SLOWEST_BIT_TICKS,
    WORDS,
    Host,
    T,
    word_at,
    words_from,
)
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import (
    PLAY_LANDING,
    READ_MEMORY,
    READ_QUEUE,
    TIME_LEAD_TICKS,
    Control,
    Fault,
    Register,
    Result,
    Start,
    State,
)

GAP_TICKS = BIT_TICKS + 2  # between the end of a scheduled play and the next: the idle word, and time to fetch
LEAD_TICKS = TIME_LEAD_TICKS - 2  # from the tick in which a scheduled play is carried out: its time is that of two ticks before


def test_an_emission_is_the_words_stored_each_held_one_bit_and_then_the_idle_word(armed):
    armed.play()
    assert armed.status().state == ARMED | State.PENDING | State.WAITING
    start = armed.trigger()
    capture = armed.pins_after(1000)
    assert capture.ticks.tolist() == [start + BIT_TICKS * n for n in range(31)]
    assert capture.words.tolist() == [*WORDS.tolist(), IDLE]
    assert capture.focus_ticks.tolist() == [start + T]
    assert armed.status().emissions == 1


def test_captures_taken_at_any_time_add_up_to_the_same(armed):
    armed.play(emissions=3, period_ticks=T)
    start = armed.trigger()
    parts = [armed.pins_after(ticks) for ticks in (1, 1, 6, 137, 0, 300, 453, 200)]
    expected = np.append(np.tile(WORDS, 3), np.uint32(IDLE))
    assert np.array_equal(np.concatenate([part.words for part in parts]), expected)
    assert np.array_equal(np.concatenate([part.ticks for part in parts]), start + BIT_TICKS * np.arange(91))
    assert np.concatenate([part.focus_ticks for part in parts]).tolist() == [start + T, start + 2 * T, start + 3 * T]


@each_row("bit_period", [BIT_TICKS << 16, (10 << 16) + 1, (12 << 16) + 21845, (199 << 16) + 65535])
def test_word_n_comes_as_many_whole_ticks_after_the_first_as_n_bit_periods_hold(bit_period):
    host = Host().arm(BIT_PERIOD=bit_period)
    words = np.arange(1, 1001, dtype=np.uint32)
    host.store(0, words)
    host.pins_after(0)
    host.play()
    start = host.trigger()
    capture = host.pins_after(250_000)
    assert capture.words.tolist() == [*words.tolist(), IDLE]
    assert capture.ticks.tolist() == [start + n * bit_period // 65536 for n in range(1001)]
    assert capture.focus_ticks.tolist() == [start + 1000 * bit_period // 65536]


@pytest.mark.parametrize(
    ("named", "expected"),
    [
        ({"first": 10}, range(11, 31)),
        ({"length": 10}, range(1, 11)),
        ({"first": 10, "length": 5}, range(11, 16)),
        ({"first": 29, "length": 1}, range(30, 31)),
    ],
)
def test_a_part_of_a_waveform_is_played_alone(armed, named, expected):
    armed.play(**named)
    start = armed.trigger()
    capture = armed.pins_after(1000)
    assert capture.words.tolist() == [*expected, IDLE]
    assert capture.focus_ticks.tolist() == [start + BIT_TICKS * len(expected)]


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("mask", [0xFFFFFFFF, 0x0000000C, 0])
def test_channels_outside_the_mask_keep_their_idle_level_and_polarity_turns_only_those_inside(armed, mask, inverted):
    armed.play(mask=mask, inverted=inverted)
    start = armed.trigger()
    capture = armed.pins_after(1000)
    assert mask or not capture.ticks.size
    played = words_from(capture, start, 30) if mask else [IDLE] * 30
    for word, seen in zip(WORDS.tolist(), played, strict=False):
        assert seen == (word ^ (0xFFFFFFFF if inverted else 0)) & mask | IDLE & ~mask
    assert armed.status().emissions == 1


def test_channels_that_may_not_move_stay_low_whatever_is_asked(host):
    host.arm(CHANNEL_MASK=0x6).store(0)
    for inverted in (False, True):
        host.pins_after(0)
        host.play(inverted=inverted)
        start = host.trigger()
        capture = host.pins_after(1000)
        assert set(capture.words.tolist()) <= {0, 2, 4, 6}
        assert word_at(capture, start + 2 * BIT_TICKS) == (3 ^ 0xFF * inverted) & 6
        assert capture.words[-1] == IDLE & 6


def test_each_trigger_starts_one_play_or_is_counted_as_ignored(armed):
    armed.trigger()
    armed.play()
    armed.trigger()
    armed.tick += 50
    armed.trigger()
    armed.pins_after(400)
    armed.trigger()
    armed.pins_after(400)
    status = armed.status()
    assert (status.trigger_count, status.emissions, status.ignored) == (4, 1, 3)
    assert armed.read(Register.TRIGGERS_IGNORED) == 3
    assert armed.read(Register.TRIGGERS) == 4


@pytest.mark.parametrize(("high_ticks", "seen"), [(1, False), (2, False), (3, True), (4, True)])
def test_a_glitch_on_the_trigger_is_not_even_counted(armed, high_ticks, seen):
    armed.play()
    start = armed.trigger(high_ticks)
    capture = armed.pins_after(1000)
    assert capture.ticks.size == (31 if seen else 0)
    assert not seen or capture.ticks[0] == start
    assert armed.status().trigger_count == seen
    assert armed.read(Register.TRIGGERS_IGNORED) == 0


@pytest.mark.parametrize(("after", "starts"), [(FETCHED_TICKS - 1, False), (FETCHED_TICKS, True)])
def test_a_play_is_there_for_a_trigger_once_it_has_been_fetched(armed, after, starts):
    armed.send(frames.pack_play, Play(0))
    armed.tick += after
    armed.trigger()
    assert bool(armed.pins_after(1000).ticks.size) is starts
    assert armed.read(Register.TRIGGERS_IGNORED) == (not starts)


def test_a_trigger_by_command_does_what_the_pin_does(armed):
    armed.play()
    armed.send(frames.pack_control, Control.TRIGGER)
    carried_out = armed.tick
    capture = armed.pins_after(1000)
    assert capture.ticks[0] == carried_out + COMMAND_TICKS
    assert capture.words[0] == 1
    armed.send(frames.pack_control, Control.TRIGGER)
    status = armed.status()
    assert (status.result, status.trigger_count, status.ignored) == (Result.OK, 2, 1)


def test_a_play_without_a_wait_begins_by_itself(armed):
    carried_out = armed.play(start=Start.NOW)
    capture = armed.pins_after(1000)
    assert capture.ticks.tolist()[0] == carried_out + NOW_TICKS
    assert capture.words.tolist() == [*WORDS.tolist(), IDLE]
    assert armed.read(Register.TRIGGERS) == 0


def test_plays_without_a_wait_follow_each_other_with_the_idle_word_between(armed):
    armed.play(start=Start.TRIGGER)
    for first in (10, 20, 25):
        armed.play(start=Start.NOW, first=first)
    assert armed.status().queued == 4
    start = armed.trigger()
    capture = armed.pins_after(2000)
    assert armed.status().emissions == 4
    assert capture.focus_ticks.tolist() == [start + T, start + T + 210, start + T + 320, start + T + 380]
    assert np.flatnonzero(capture.words == IDLE).size == 4
    assert min(np.diff(capture.ticks)) == max(np.diff(capture.ticks)) == BIT_TICKS, "the idle word is held for a bit period too"


def test_a_play_without_a_wait_comes_after_the_last_of_a_counted_repetition(armed):
    armed.play(emissions=2, period_ticks=3000)
    armed.play(start=Start.NOW, first=20)
    start = armed.trigger()
    capture = armed.pins_after(5000)
    assert capture.focus_ticks.tolist() == [start + T, start + 3000 + T, start + 3000 + T + BIT_TICKS + 100]


def test_a_scheduled_play_has_its_first_word_on_the_pins_at_its_time(armed):
    for lead in (5000, 5001, 5002, 9999):
        at = armed.tick + lead
        armed.play(start=Start.TIME, when_ticks=at)
        capture = armed.pins_after(10_500)
        assert capture.ticks.tolist() == [at + BIT_TICKS * n for n in range(31)]
    assert armed.read(Register.PLAYS_MISSED) == armed.read(Register.TRIGGERS) == 0
    assert armed.read_time(Register.EMISSION_TIME_LOW) == at


@pytest.mark.parametrize(
    ("lead", "expected"), [(LEAD_TICKS, Result.OK), (LEAD_TICKS - 1, Result.TOO_LATE), (-(10**9), Result.TOO_LATE)]
)
def test_a_time_that_is_too_near_or_past_is_refused_and_any_accepted_one_is_kept(armed, lead, expected):
    carried_out = armed.tick + 5 + 36 * 48 + 4
    at = max(carried_out + lead, 0)
    armed.send(frames.pack_play, Play(0, start=Start.TIME, when_ticks=at))
    assert armed.tick == carried_out
    assert armed.status().result is expected
    assert armed.pins_after(1000).ticks[:1].tolist() == [at] * (expected is Result.OK)
    assert armed.read(Register.PLAYS_MISSED) == 0


@pytest.mark.parametrize(
    ("gap", "expected"), [(T + GAP_TICKS, Result.OK), (T + GAP_TICKS - 1, Result.OVERLAP), (-5000, Result.OVERLAP)]
)
def test_a_play_scheduled_into_the_one_before_is_refused_and_any_accepted_one_is_played(armed, gap, expected):
    first = armed.tick + 20_000
    armed.play(start=Start.TIME, when_ticks=first)
    assert armed.result(frames.pack_play, Play(0, start=Start.TIME, when_ticks=first + gap)) is expected
    capture = armed.pins_after(25_000)
    assert capture.focus_ticks.tolist() == [first + T, first + T + gap][: 1 + (expected is Result.OK)]
    assert armed.read(Register.PLAYS_MISSED) == 0


def test_what_is_scheduled_behind_a_repetition_waits_for_its_last_emission(armed):
    first = armed.tick + 20_000
    armed.play(start=Start.TIME, when_ticks=first, emissions=3, period_ticks=1000)
    late = first + 2000 + T + GAP_TICKS
    assert armed.result(frames.pack_play, Play(0, start=Start.TIME, when_ticks=late - 1)) is Result.OVERLAP
    assert armed.result(frames.pack_play, Play(0, start=Start.TIME, when_ticks=late)) is Result.OK
    assert armed.pins_after(25_000).focus_ticks.tolist() == [first + T, first + 1000 + T, first + 2000 + T, late + T]


@each_row("length", [1, 2, 30])
def test_scheduled_plays_as_dense_as_they_are_accepted_are_all_played(length):
    """At the slowest clock, where a word is shorter than the ten ticks in which the next play is fetched."""
    slow = replace(PARAMETERS, clock_hz=8_000_000, pulse_ticks_min=4)
    host = Host(slow).arm(BIT_PERIOD=4 << 16)
    host.store(0)
    apart = 4 * length + 4 + 2
    first = host.tick + 80_000
    for number in range(8):
        at = first + number * apart
        if number:
            assert host.result(frames.pack_play, Play(0, length=length, start=Start.TIME, when_ticks=at - 1)) is Result.OVERLAP
        host.play(length=length, start=Start.TIME, when_ticks=at)
    host.pins_after(80_000)
    assert host.read(Register.PLAYS_MISSED) == 0
    assert host.status().emissions == 8


def test_a_stop_makes_room_in_the_schedule(armed):
    at = armed.tick + 30_000
    armed.play(start=Start.TIME, when_ticks=at + 20_000)
    assert armed.result(frames.pack_play, Play(0, start=Start.TIME, when_ticks=at)) is Result.OVERLAP
    armed.control(Control.STOP)
    armed.play(start=Start.TIME, when_ticks=at)
    assert armed.pins_after(60_000).focus_ticks.tolist() == [at + T]


def test_a_scheduled_play_whose_time_finds_the_plate_busy_is_missed_and_counted(armed):
    armed.play(start=Start.NOW)
    emission = armed.model.status().timestamp_ticks
    at = armed.tick + 10_000
    armed.play(start=Start.TIME, when_ticks=at)
    armed.play(start=Start.TRIGGER)
    assert emission < at
    armed.pins_after(0)
    armed.send(frames.pack_control, Control.STOP)
    armed.play(start=Start.TRIGGER)
    at = armed.tick + 10_000
    armed.play(start=Start.TIME, when_ticks=at)
    armed.tick = at - LATENCY - T  # this emission and its idle word end a bit period too late
    armed.trigger()
    capture = armed.pins_after(2000)
    assert capture.focus_ticks.tolist() == [at]
    assert armed.read(Register.PLAYS_MISSED) == 1
    assert armed.status().queued == 0


def test_a_delay_is_counted_from_the_trigger_and_the_play_is_no_longer_in_the_queue(armed):
    armed.play(when_ticks=5000)
    armed.play(first=20)
    start = armed.trigger() + 5000
    status = armed.status()
    assert (status.queued, State.DELAYED in status.state, State.WAITING in status.state) == (1, True, False)
    armed.trigger()  # of no use to the next one: the first has not sounded
    capture = armed.pins_after(5000)
    assert capture.ticks[0] == start
    assert capture.focus_ticks.tolist() == [start + T]
    assert armed.read(Register.TRIGGERS_IGNORED) == 1
    second = armed.trigger()
    assert armed.pins_after(1000).ticks[0] == second


def test_a_delay_is_also_kept_by_what_begins_by_itself_and_ended_by_a_stop(armed):
    carried_out = armed.play(start=Start.NOW, when_ticks=9000)
    assert armed.pins_after(9000).ticks[0] == carried_out + NOW_TICKS + 9000
    armed.play(when_ticks=9000)
    armed.trigger()
    armed.control(Control.STOP)
    assert State.DELAYED not in armed.status().state
    assert armed.pins_after(20_000).ticks.size == 0


def test_a_repetition_is_delayed_once(armed):
    armed.play(when_ticks=700, emissions=3, period_ticks=2000)
    start = armed.trigger() + 700
    assert armed.pins_after(10_000).focus_ticks.tolist() == [start + T, start + 2000 + T, start + 4000 + T]


def test_the_queue_holds_eight_and_says_when_it_is_full(armed):
    for first in range(8):
        armed.play(first=first)
    assert armed.result(frames.pack_play, Play(0)) is Result.QUEUE_FULL
    assert armed.status().queued == armed.read(Register.QUEUE) == 8
    seen = []
    for _ in range(8):
        start = armed.trigger()
        seen.append(word_at(armed.pins_after(1000), start))
    assert seen == list(range(1, 9)), "in the order in which they came, the refused one not among them"
    assert armed.status().state == ARMED
    armed.play()


def test_what_waits_in_the_queue_is_read_back(armed):
    armed.play(first=3, length=4, emissions=2, period_ticks=50, when_ticks=6, mask=7, inverted=True)
    armed.play(start=Start.NOW)
    words = [armed.read(READ_QUEUE + word) for word in range(6)]
    assert words == [3 | 4 << 16, 2 | 1 << 24, 50, 7, 6, 0]
    assert armed.read(READ_QUEUE + 8 + 1) == 1 | Start.NOW << 16
    for address in (READ_QUEUE + 6, READ_QUEUE + 7, READ_QUEUE + 16):
        assert armed.result(frames.pack_read, address) is Result.BAD_RANGE
    armed.trigger()
    assert armed.result(frames.pack_read, READ_QUEUE + 8) is Result.BAD_RANGE, "what has begun waits no more"


def test_a_pending_play_waits_while_another_sounds_and_replaces_it_in_its_pause(armed):
    armed.store(1, WORDS + 100)
    armed.play(emissions=0, period_ticks=1_000_000)
    armed.tick = armed.trigger() + 100
    armed.model.advance(armed.tick)
    assert State.PLAYING | State.REPEATING in armed.model.status().state
    armed.play(1)
    second = armed.trigger()
    capture = armed.pins_after(2_000)
    assert word_at(capture, second) == 101
    status = armed.status()
    assert (State.REPEATING in status.state, status.emissions) == (False, 2)


def test_a_counted_repetition_plays_exactly_its_count_exactly_a_period_apart(armed):
    armed.play(emissions=3, period_ticks=777)
    start = armed.trigger()
    capture = armed.pins_after(5000)
    assert capture.focus_ticks.tolist() == [start + T + 777 * n for n in range(3)]
    assert np.flatnonzero(capture.words == 1).size == 3


def test_an_endless_repetition_goes_on_until_stop_lets_the_last_emission_end(armed):
    armed.play(emissions=0, period_ticks=T + BIT_TICKS)
    start = armed.trigger()
    for _ in range(10):
        assert armed.status().state & State.REPEATING
        armed.pins_after(5000)
    armed.send(frames.pack_control, Control.STOP)
    stopped = armed.tick
    before = armed.status()
    assert State.REPEATING not in before.state
    capture = armed.pins_after(2000)
    last = int(capture.focus_ticks[-1])
    assert 0 < last - stopped <= T + LATENCY
    assert (last - start - T) % (T + BIT_TICKS) == 0
    assert word_at(capture, armed.tick) == IDLE


def test_stop_drops_everything_that_waits(armed):
    for start in (Start.TRIGGER, Start.NOW, Start.TRIGGER):
        armed.play(start=start)
    armed.send(frames.pack_control, Control.STOP)
    assert armed.status().queued == 0
    armed.trigger()
    assert armed.pins_after(1000).words.size == 0


def test_a_slot_is_replaced_while_it_plays_and_the_emission_stays_what_it_was(armed):
    armed.store(0, np.arange(1, 126))
    armed.pins_after(0)
    armed.play(emissions=0, period_ticks=2000)
    armed.trigger()
    armed.store(0, WORDS + 1000)
    assert State.LANDING_BUSY in armed.status().state
    assert armed.result(frames.pack_load, 0, memoryview(bytes(40))) is Result.BUSY
    assert armed.result(frames.pack_store, 1, 10, 0) is Result.INCOMPLETE
    armed.send(frames.pack_control, Control.STOP)
    armed.play()
    capture = armed.pins_after(8000)
    assert set(capture.words.tolist()) <= {*range(1, 126), IDLE}
    assert State.LANDING_BUSY not in armed.status().state
    start = armed.trigger()
    assert word_at(armed.pins_after(100), start) == 1001


def test_a_play_keeps_the_waveform_it_was_accepted_with(armed):
    armed.play()
    armed.store(0, WORDS + 1000)
    armed.play()
    first = armed.trigger()
    assert word_at(armed.pins_after(1000), first) == 1
    second = armed.trigger()
    assert word_at(armed.pins_after(1000), second) == 1001


def test_knows_when_it_has_next_something_to_do(armed):
    armed.send(frames.pack_play, Play(0, emissions=2, period_ticks=900))
    assert armed.model.next_change() == armed.tick  # carrying out the frame
    armed.tick += FETCHED_TICKS
    start = armed.trigger()
    armed.model.advance(start)
    changes = []
    for _ in range(3):
        changes.append(armed.model.next_change())
        armed.model.advance(changes[-1] + 1)
    state = start - 4  # of the player, before its way to the pins
    assert changes == [state + T - 1, state + T + 3, state + 899]


CHUNK = np.arange(1, 126, dtype=np.uint32)
CHUNK_TICKS = 125 * SLOWEST_BIT_TICKS  # 25,000: a LOAD of a whole chunk takes 24,586 at a quarter of a bit a tick


@pytest.fixture
def live():
    """Armed at the slowest bit clock, for which this link is just fast enough, with the first chunk loaded."""
    host = Host().arm(BIT_PERIOD=SLOWEST_BIT_TICKS << 16)
    host.load(CHUNK)
    host.pins_after(0)
    return host


def test_what_is_still_arriving_plays_and_the_rest_comes_meanwhile(live):
    live.send(frames.pack_play, Play(PLAY_LANDING, length=375))
    live.tick += FETCHED_TICKS
    start = live.trigger()
    live.load(CHUNK + 1000, 1)
    live.load(CHUNK + 2000, 2)
    live.tick = max(live.tick, start + 3 * CHUNK_TICKS)
    capture = live.pins_after(5000)
    expected = [*CHUNK.tolist(), *(CHUNK + 1000).tolist(), *(CHUNK + 2000).tolist(), IDLE]
    assert capture.words.tolist() == expected
    assert capture.ticks.tolist() == [start + SLOWEST_BIT_TICKS * n for n in range(376)]
    status = live.status()
    assert (status.faults, status.emissions, status.chunks) == (Fault(0), 1, 0b111)
    live.send(frames.pack_store, 0, 375, 0)
    assert live.status().result is Result.OK, "and then it can be kept"
    assert live.read(READ_MEMORY + 374) == 2125


def test_no_word_plays_that_did_not_come_in_an_accepted_frame(live):
    live.send(frames.pack_play, Play(PLAY_LANDING, length=250))
    live.tick += FETCHED_TICKS
    start = live.trigger()
    damaged = bytearray(live.packed(frames.pack_load, 1, memoryview((CHUNK + 1000).tobytes())))
    damaged[-1] ^= 1
    live.exchange(bytes(damaged))
    live.tick = max(live.tick, start + 2 * CHUNK_TICKS)
    capture = live.pins_after(100)
    first_missing = start + CHUNK_TICKS
    assert set(capture.words[:-1].tolist()) == set(CHUNK.tolist())
    assert (capture.words[-1], capture.hv[-1]) == (0, 0)
    assert first_missing - 4 <= capture.ticks[-1] <= first_missing, "before that word would have come to the pins"
    assert capture.focus_ticks.size == 0
    status = live.status()
    assert (status.faults, status.emissions) == (Fault.UNDERRUN, 0)
    assert live.read(Register.UNDERRUNS) == 1
    assert live.unlock_and_arm() is Result.FAULTED


@pytest.mark.parametrize(
    ("slack", "expected"), [(SLOWEST_BIT_TICKS * 125 - 24581 - 1, Result.OK), (SLOWEST_BIT_TICKS * 125 - 24581, Result.LINK_SLOW)]
)
def test_a_link_must_bring_words_as_fast_as_they_play(slack, expected):
    host = Host().arm(BIT_PERIOD=SLOWEST_BIT_TICKS << 16)
    frame = host.packed(frames.pack_load, 0, memoryview(CHUNK.tobytes()))
    release = host.tick + 24581 + slack
    host.model.exchange(host.tick, release, frame, memoryview(bytearray(len(frame))))
    host.tick = release + 4
    assert host.result(frames.pack_play, Play(PLAY_LANDING)) is expected


def test_refuses_to_play_what_is_not_arriving_or_from_its_middle(live):
    for named in ({"first": 1}, {"length": 1001}, {"first": 65535, "length": 1}):
        assert live.result(frames.pack_play, Play(PLAY_LANDING, **named)) is Result.BAD_RANGE
    live.store(0, CHUNK)  # gives the landing buffer away
    assert live.result(frames.pack_play, Play(PLAY_LANDING)) is Result.INCOMPLETE
    live.load(CHUNK, 1)
    assert live.result(frames.pack_play, Play(PLAY_LANDING)) is Result.INCOMPLETE, "its first chunk has to be there"
    live.load(CHUNK, 0)
    live.play(0)
    assert live.result(frames.pack_play, Play(PLAY_LANDING)) is Result.BUSY, "nothing may wait before it"


def test_what_plays_while_it_arrives_is_neither_overwritten_nor_stored(live):
    live.play(PLAY_LANDING, length=125)
    assert live.result(frames.pack_load, 0, memoryview(bytes(500))) is Result.BUSY
    assert live.result(frames.pack_store, 0, 125, 0) is Result.BUSY
    start = live.trigger()
    assert live.result(frames.pack_load, 0, memoryview(bytes(500))) is Result.BUSY
    assert live.result(frames.pack_load, 1, memoryview(bytes(500))) is Result.OK
    live.tick = max(live.tick, start + CHUNK_TICKS)
    assert live.pins_after(1000).words.tolist() == [*CHUNK.tolist(), IDLE]
    assert live.result(frames.pack_load, 0, memoryview(bytes(500))) is Result.OK


def test_a_chunk_of_fewer_words_ends_what_can_be_played_of_it(live):
    live.load(CHUNK[:100])  # 400 bytes: in time as well
    live.send(frames.pack_play, Play(PLAY_LANDING, length=101))
    live.tick += FETCHED_TICKS
    start = live.trigger()
    live.pins_after(CHUNK_TICKS)
    status = live.status()
    assert status.faults is Fault.UNDERRUN or status.result is Result.LINK_SLOW
    assert live.read_time(Register.FAULT_TIME_LOW) in range(start + 100 * SLOWEST_BIT_TICKS - 6, start + 100 * SLOWEST_BIT_TICKS)
