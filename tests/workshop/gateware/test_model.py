"""The gateware model alone: each result and register, and all READs; tests/conformance compares it with the Verilog."""

import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from model_host import (
    ARMED,
    BIT_TICKS,
    HASH,
    HEARTBEAT_TICKS,
    IDLE,
    PARAMETERS,
    SLOTS,
    SLOWEST_BIT_TICKS,
    WORDS,
    Host,
    T,
)
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import (
    PLAY_LANDING,
    READ_MEMORY,
    READ_QUEUE,
    READ_SLOT_CRC,
    Control,
    Kind,
    Register,
    Result,
    State,
)
from controller.workshop.gateware.model.model import GatewareModel


def short(kind, argument=0, *words):
    return lambda b, o, s: frames.pack_short(b, o, kind, s, argument, *words)


@each_row(
    ("expected", "pack", "arguments"),
    [
        (Result.OK, frames.pack_nop, ()),
        (Result.OK, frames.pack_test, (bytes(20),)),
        (Result.UNKNOWN_TYPE, short(7), ()),
        (Result.UNKNOWN_TYPE, short(255), ()),
        (Result.UNKNOWN_REGISTER, frames.pack_read, (len(Register),)),
        (Result.UNKNOWN_REGISTER, frames.pack_read, (0x0300,)),
        (Result.UNKNOWN_REGISTER, frames.pack_read, (0x7FFF,)),
        (Result.UNKNOWN_REGISTER, frames.pack_write, (len(Register), 0)),
        (Result.UNKNOWN_REGISTER, frames.pack_write, (READ_MEMORY, 0)),
        (Result.BAD_VALUE, frames.pack_write, (Register.CONTROL, 0)),
        (Result.BAD_VALUE, frames.pack_write, (Register.CONTROL, 7)),
        (Result.BAD_VALUE, frames.pack_write, (Register.CONTROL, 0x10001)),
        (Result.BAD_SLOT, frames.pack_store, (SLOTS, 30, 0)),
        (Result.BAD_VALUE, frames.pack_store, (0, 1001, 0)),
        (Result.BAD_VALUE, frames.pack_store, (0, 0, 0)),
        (Result.INCOMPLETE, frames.pack_store, (0, 30, 0)),
        (Result.BAD_CHUNK, frames.pack_load, (8, memoryview(bytes(20)))),
        (Result.OK, frames.pack_load, (7, memoryview(bytes(20)))),
        (Result.BAD_SLOT, frames.pack_play, (Play(SLOTS),)),
        (Result.BAD_SLOT, frames.pack_play, (Play(PLAY_LANDING - 1),)),
        (Result.NOT_ARMED, frames.pack_play, (Play(0),)),
        (Result.NOT_ARMED, frames.pack_play, (Play(PLAY_LANDING),)),
        (Result.BAD_SLOT, frames.pack_read, (READ_SLOT_CRC + SLOTS,)),
        (Result.EMPTY_SLOT, frames.pack_read, (READ_SLOT_CRC,)),
        (Result.BAD_SLOT, frames.pack_read, (READ_MEMORY + 1024 * SLOTS,)),
        (Result.BAD_RANGE, frames.pack_read, (READ_MEMORY,)),
        (Result.BAD_RANGE, frames.pack_read, (READ_QUEUE,)),
        (Result.LOCKED, frames.pack_control, (Control.ARM,)),
        (Result.OK, frames.pack_control, (Control.DISARM,)),
        (Result.OK, frames.pack_control, (Control.CLEAR,)),
        (Result.OK, frames.pack_control, (Control.STOP,)),
        (Result.OK, frames.pack_control, (Control.TRIGGER,)),
        (Result.OK, frames.pack_unlock, (HASH,)),
        (Result.BAD_KEY, frames.pack_unlock, (HASH ^ 1,)),
        (Result.BAD_KEY, short(2, Register.CONTROL, Control.UNLOCK, 0x4C4E5049, 2, HASH), ()),
        (Result.BAD_KEY, short(2, Register.CONTROL, Control.UNLOCK, 0x4C4E5048, 1, HASH), ()),
        (Result.OK, short(2, Register.CONTROL, Control.UNLOCK, 0x4C4E5048, 2, HASH), ()),
    ],
)
def test_says_in_the_next_answer_what_became_of_a_frame(host, expected, pack, arguments):
    assert host.result(pack, *arguments) is expected


RANGES = {
    Register.IDLE_WORD: (0, 0xFFFFFFFF),
    Register.CHANNEL_MASK: (0, 0xFFFFFFFF),
    Register.BIT_PERIOD: (BIT_TICKS << 16, SLOWEST_BIT_TICKS << 16),
    Register.RAMP_SAMPLES: (1, 262143),
    Register.HEARTBEAT_TICKS: (1, HEARTBEAT_TICKS),
    Register.PULSE_TICKS: (PARAMETERS.pulse_ticks_min, 40),  # 40: a drive word after reset
    Register.CHANNEL_EDGES: (0, PARAMETERS.channel_edges_max),
    Register.TOTAL_EDGES: (0, PARAMETERS.total_edges_max),
    Register.EMISSION_TICKS: (0, PARAMETERS.emission_ticks_max),
    Register.DUTY_SHARE: (0, PARAMETERS.duty_share_max),
    Register.DUTY_TICKS: (0, PARAMETERS.duty_ticks_max),
}


def range_of(register):
    """As the table above has it; of a setting that is not in it yet, by its record."""
    most = register.used_bits if register.high is None else register.high
    bounds = (bound if isinstance(bound, int) else getattr(PARAMETERS, bound.lower()) for bound in (register.low, most))
    return RANGES.get(register) or tuple(bounds)


@each_row("register", [register for register in Register if register.access == "RW"])
def test_a_setting_takes_what_lies_in_its_range_and_keeps_its_value_otherwise(register):
    low, high = range_of(register)
    for value in (low, high):
        host = Host()
        assert host.write(register, value) is Result.OK
        assert host.read(register) == value
    for value in (low - 1, high + 1, 0xFFFFFFFF):
        host = Host()
        before = host.read(register)
        if not low <= value <= high and 0 <= value < 1 << 32:
            assert host.write(register, value) is Result.BAD_VALUE, value
            assert host.read(register) == before


def test_pulse_and_bit_period_keep_each_other_apart(host):
    assert host.write(Register.PULSE_TICKS, 40) is Result.OK
    assert host.write(Register.BIT_PERIOD, (40 << 16) - 1) is Result.BAD_VALUE
    assert host.write(Register.BIT_PERIOD, 40 << 16) is Result.OK
    assert host.write(Register.BIT_PERIOD, (41 << 16) + 65535) is Result.OK
    assert host.write(Register.PULSE_TICKS, 42) is Result.BAD_VALUE
    assert host.write(Register.PULSE_TICKS, 41) is Result.OK


@each_row("register", [register for register in Register if register.access == "RO"])
def test_what_is_read_only_is_not_written(host, register):
    assert host.result(frames.pack_write, register, 0) is Result.READ_ONLY


@each_row("register", [register for register in Register if isinstance(register.reset, int)])
def test_registers_hold_after_reset_what_their_record_says(register):
    if register.kind in (Kind.BUILT_IN, Kind.COMMAND):
        assert register.reset == 0, "it says nothing"
        return
    host = Host(permits=())
    if register is Register.SEQUENCE_GAPS:
        host.sequence = 0
    assert host.read(register) == register.reset


def test_says_what_it_is_and_what_it_can_do(host):
    assert host.read(Register.IDENTITY) == int.from_bytes(b"HPNL", "little")
    assert host.read(Register.BUILD_HASH) == HASH
    assert host.read(Register.BOARD).to_bytes(4, "little") == b"SIM "
    assert host.read(Register.CLOCK_HZ) == PARAMETERS.clock_hz
    assert host.read(Register.GEOMETRY) == SLOTS | 1000 << 8 | 32 << 24
    assert host.read(Register.PARAMETERS) == 8 | 8 << 8 | 3 << 16
    assert host.read(Register.EDGE_WINDOW_TICKS) == PARAMETERS.edge_window_ticks
    assert host.read(Register.CONTROL) == 0
    for register, reset in (
        ("BIT_PERIOD", 40 << 16),
        ("PULSE_TICKS", 8),
        ("HEARTBEAT_TICKS", HEARTBEAT_TICKS),
        ("DUTY_SHARE", 65536),
    ):
        assert host.read(Register[register]) == reset


@each_row("register", sorted(set(RANGES) - {Register.BIT_PERIOD}), ids=lambda register: register.name)
def test_settings_of_the_stages_stay_as_they_are_while_armed(armed, register):
    before = armed.read(register)
    assert armed.write(register, before) is Result.ARMED
    assert armed.read(register) == before


def test_the_bit_clock_may_change_between_emissions_but_not_under_what_plays_or_waits(armed):
    assert armed.write(Register.BIT_PERIOD, 11 << 16) is Result.OK
    armed.play()
    assert armed.write(Register.BIT_PERIOD, 12 << 16) is Result.BUSY
    armed.trigger()
    armed.model.advance(armed.tick + 100)
    armed.pins_after(400)
    assert armed.write(Register.BIT_PERIOD, 12 << 16) is Result.OK
    armed.play(emissions=0, period_ticks=50_000)
    armed.trigger()
    assert armed.write(Register.BIT_PERIOD, 13 << 16) is Result.BUSY, "a repetition in its pause counts as playing"
    armed.control(Control.STOP)
    assert armed.write(Register.BIT_PERIOD, 13 << 16) is Result.OK


def test_refuses_while_armed_what_would_surprise(armed):
    assert armed.unlock_and_arm() is Result.ARMED
    assert armed.result(frames.pack_play, Play(1)) is Result.EMPTY_SLOT
    for count in (0, 2, 65535):
        for period_ticks in (T - 1, T + 1, T + BIT_TICKS - 1):
            assert armed.result(frames.pack_play, Play(0, emissions=count, period_ticks=period_ticks)) is Result.BAD_PERIOD
        for period_ticks in (T, T + BIT_TICKS):
            assert armed.result(frames.pack_play, Play(0, emissions=count, period_ticks=period_ticks)) is Result.OK
    assert armed.result(frames.pack_play, Play(0, emissions=1, period_ticks=0)) is Result.OK, "what is played once has no period"
    assert armed.status().state & State.ARMED, "and nothing of it disarms"


@each_row(
    ("named", "expected"),
    [
        ({"first": 29}, Result.OK),
        ({"first": 30}, Result.BAD_RANGE),
        ({"first": 65535}, Result.BAD_RANGE),
        ({"length": 30}, Result.OK),
        ({"length": 31}, Result.BAD_RANGE),
        ({"first": 10, "length": 20}, Result.OK),
        ({"first": 10, "length": 21}, Result.BAD_RANGE),
        ({"first": 1, "length": 65535}, Result.BAD_RANGE),
        ({"start": 3}, Result.BAD_VALUE),
        ({"start": 255}, Result.BAD_VALUE),
        ({"inverted": 2}, Result.BAD_VALUE),
        ({"inverted": 255}, Result.BAD_VALUE),
        ({"mask": 0}, Result.OK),
        ({"emissions": 65535, "period_ticks": 0xFFFFFFFF}, Result.OK),
        ({"when_ticks": 0xFFFFFFFF}, Result.OK),
    ],
)
def test_refuses_a_play_whose_fields_cannot_be_meant(named, expected):
    host = Host().arm()  # its own for each row: a play stays queued
    host.store(0)
    assert host.result(frames.pack_play, Play(0, **named)) is expected
    assert host.status().queued == (expected is Result.OK)


def test_a_play_longer_than_an_emission_may_be_is_refused(host):
    host.arm(EMISSION_TICKS=20 * BIT_TICKS).store(0)
    assert host.result(frames.pack_play, Play(0)) is Result.TOO_LONG
    assert host.result(frames.pack_play, Play(0, length=21)) is Result.TOO_LONG
    assert host.result(frames.pack_play, Play(0, length=20)) is Result.OK


@each_row(
    ("damage", "reason"),
    [
        (lambda frame: b"\0" + frame[1:], Result.BAD_SYNC),
        (lambda frame: frame[:1], Result.BAD_LENGTH),
        (lambda frame: frame[:-1], Result.BAD_LENGTH),
        (lambda frame: frame + b"\0", Result.BAD_LENGTH),
        (lambda frame: frame[:7], Result.BAD_LENGTH),
        (lambda frame: frame[:4] + b"\x14" + frame[5:32], Result.BAD_LENGTH),  # a whole frame of protocol 1
        (lambda frame: frame[:20] + b"\x55" + frame[21:], Result.BAD_CRC),
    ],
)
def test_a_damaged_frame_changes_nothing_but_the_error_counter(damage, reason):
    host = Host()
    host.exchange(damage(host.packed(frames.pack_write, Register.IDLE_WORD, 5)))
    host.sequence -= 1
    status = host.status()
    assert (status.result, status.sequence) == (reason, 0)
    assert not status.state & State.HEARTBEAT, "a refused frame is no sign of life"
    assert host.read(Register.IDLE_WORD) == 0
    assert host.read(Register.FRAME_ERRORS) == 1
    assert host.read(Register.SEQUENCE_GAPS) == 0


def test_a_gap_in_the_numbers_of_accepted_frames_is_counted(host):
    for _ in range(300):
        host.status()
    assert host.read(Register.SEQUENCE_GAPS) == 0, "255 is followed by 0"
    host.sequence += 3
    host.status()
    assert host.read(Register.SEQUENCE_GAPS) == 1
    host.sequence -= 1  # the same number again
    assert host.read(Register.SEQUENCE_GAPS) == 1, "as of the frame before"
    assert host.read(Register.SEQUENCE_GAPS) == 2


def test_a_select_without_bytes_is_nothing(host):
    host.exchange(b"")
    assert host.status().result is Result.OK
    assert host.read(Register.FRAME_ERRORS) == 0


def test_a_burst_of_frames_without_pause_is_carried_out_one_by_one(host):
    host.ticks_per_byte = 24
    for number in range(50):
        host.send(frames.pack_write, Register.IDLE_WORD, number)
    assert host.read(Register.IDLE_WORD) == 49
    assert host.read(Register.FRAME_ERRORS) == host.read(Register.SEQUENCE_GAPS) == 0


@given(st.binary(min_size=20, max_size=500).filter(lambda payload: len(payload) % 4 == 0))
@settings(max_examples=40)
def test_a_test_frame_comes_back_two_bytes_later_behind_the_status(payload):
    host = Host()
    sent = host.packed(frames.pack_test, payload)
    answer = host.exchange(sent)
    assert answer[FRAME_BYTES:] == sent[FRAME_BYTES - 2 : -2]
    assert host.status().result is Result.OK


def test_an_echo_shows_what_arrived_even_of_a_frame_that_is_refused(host):
    sent = bytearray(host.packed(frames.pack_test, bytes(range(100))))
    sent[60] ^= 8
    assert host.exchange(bytes(sent))[FRAME_BYTES:] == sent[FRAME_BYTES - 2 : -2]
    assert host.status().result is Result.BAD_CRC


def test_only_a_test_is_echoed(host):
    sent = host.packed(frames.pack_load, 0, memoryview(bytes(range(100))))
    assert not any(host.exchange(sent)[FRAME_BYTES:])


def test_a_chunk_counts_only_whole_and_undamaged(armed):
    chunk = memoryview(bytes(80))
    crc = zlib.crc32(chunk)
    armed.send(frames.pack_load, 0, chunk)
    assert armed.status().chunks == 1
    assert armed.result(frames.pack_store, 1, 21, 0) is Result.INCOMPLETE
    armed.exchange(armed.packed(frames.pack_load, 0, chunk)[:-1])
    assert armed.status().chunks == 0
    assert armed.result(frames.pack_store, 1, 20, crc) is Result.INCOMPLETE
    armed.send(frames.pack_load, 0, chunk)
    assert armed.result(frames.pack_store, 1, 20, crc) is Result.OK
    assert armed.status().chunks == 0
    assert armed.result(frames.pack_store, 1, 20, crc) is Result.INCOMPLETE, "what was stored is not there twice"
    assert armed.read(Register.SLOTS_LOADED) == 0b11


def test_each_chunk_of_a_whole_waveform_is_needed_and_reported(host):
    words = np.arange(1000, dtype=np.uint32)
    for chunk in (7, 0, 3, 5, 1, 6, 2):
        host.load(words[125 * chunk : 125 * chunk + 125], chunk)
        assert host.result(frames.pack_store, 0, 1000, 0) is Result.INCOMPLETE
    assert host.status().chunks == 0b11101111
    host.load(words[500:625], 4)
    assert host.result(frames.pack_store, 0, 1000, zlib.crc32(words.tobytes())) is Result.OK


def test_a_slot_whose_memory_has_another_crc_is_reported_and_never_played(armed):
    good = zlib.crc32(WORDS.tobytes())
    armed.upload(1, crc=good ^ 1 << 7)
    assert armed.status().result is Result.OK, "the STORE itself is done: its check follows"
    assert armed.read(Register.SLOTS_LOADED) == 0b01
    assert armed.result(frames.pack_play, Play(1)) is Result.SLOT_DAMAGED
    assert armed.read(READ_SLOT_CRC + 1) == good, "of what is really there"
    armed.upload(1)
    assert armed.read(Register.SLOTS_LOADED) == 0b11
    assert armed.result(frames.pack_play, Play(1)) is Result.OK


def test_a_slot_is_busy_until_it_is_checked_and_others_are_not(armed):
    words = np.arange(1000, dtype=np.uint32)
    armed.ticks_per_byte = 24  # a short frame takes less than the 1005 ticks of the check
    armed.upload(1, words)
    assert armed.result(frames.pack_play, Play(1)) is Result.BUSY
    armed.upload(1, words)
    assert armed.send(frames.pack_play, Play(0)).state & State.CHECKING
    assert armed.status().result is Result.OK, "what another slot holds"
    armed.upload(1, words)
    assert armed.result(frames.pack_read, READ_SLOT_CRC + 1) is Result.BUSY
    armed.upload(1, words)
    assert armed.result(frames.pack_read, READ_MEMORY) is Result.BUSY, "the check has the memory"


@pytest.mark.parametrize(("after", "expected"), [(1004, Result.BUSY), (1005, Result.OK)])
def test_a_check_takes_a_tick_for_each_word_and_five(armed, after, expected):
    armed.upload(1, np.arange(1000))
    armed.tick += after - (5 + 36 * 24 + 4)
    armed.ticks_per_byte = 24
    assert armed.result(frames.pack_play, Play(1)) is expected


def test_a_store_waits_for_the_check_before(armed):
    armed.ticks_per_byte = 24
    words = np.arange(1000)
    for chunk in range(8):
        armed.load(words[125 * chunk : 125 * chunk + 125], chunk)
    armed.send(frames.pack_store, 1, 1000, 0)
    assert armed.result(frames.pack_store, 0, 1, 0) is Result.BUSY, "said before that nothing has arrived"
    assert armed.result(frames.pack_store, 0, 1, 0) is Result.INCOMPLETE


def test_the_memory_of_a_slot_is_read_back_word_by_word(armed):
    assert [armed.read(READ_MEMORY + word) for word in range(30)] == WORDS.tolist()
    assert armed.result(frames.pack_read, READ_MEMORY + 30) is Result.BAD_RANGE
    armed.store(1, np.arange(1000) + 0xFFFFF000)
    assert armed.read(READ_MEMORY + 1024 + 999) == 0xFFFFF3E7
    assert armed.result(frames.pack_read, READ_MEMORY + 1024 + 1000) is Result.BAD_RANGE
    assert armed.read(READ_SLOT_CRC) == zlib.crc32(WORDS.tobytes())


def test_the_memory_that_sounds_cannot_be_read_meanwhile_and_other_memory_can(armed):
    armed.store(1)
    armed.play(0, emissions=0, period_ticks=T)  # always at work
    armed.trigger()
    assert armed.result(frames.pack_read, READ_MEMORY) is Result.BUSY
    assert armed.read(READ_MEMORY + 1024) == 1
    armed.control(Control.STOP)
    assert armed.read(READ_MEMORY) == 1


def test_a_frame_of_another_kind_leaves_the_data_of_the_last_read(host):
    host.read(Register.IDENTITY)
    assert host.write(Register.IDLE_WORD, 3) is Result.OK
    assert host.result(frames.pack_read, len(Register)) is Result.UNKNOWN_REGISTER
    assert host.status().data == int.from_bytes(b"HPNL", "little")


def test_times_are_64_bits_whose_halves_belong_together():
    start = (5 << 32) - 60_000
    host = Host(start=start)
    host.model.advance(start)
    host.model.permit(start, level=False)
    changed = start + 2
    host.tick += 100
    assert host.read_time(Register.INPUT_TIME_LOW) == changed
    host.model.permit(host.tick, level=True)
    host.arm()
    host.store(0)
    host.play()
    host.tick = (5 << 32) - 3 - 4  # the trigger is decided on before the wrap, the first word comes after it
    first_word = host.trigger()
    assert host.status().timestamp_ticks == host.tick - (5 + 36 * 48 + 4) + 2 > 5 << 32
    assert host.read_time(Register.TRIGGER_TIME_LOW) == (5 << 32) - 3
    assert host.read_time(Register.EMISSION_TIME_LOW) == first_word == (5 << 32) + 2
    assert host.read(Register.TRIGGER_TIME_LOW) == (1 << 32) - 3
    assert host.read(Register.EMISSION_TIME_HIGH) == 4, "HIGH is that of the LOW read last, whichever it was"
    lost = host.tick
    host.model.permit(lost, level=False)
    host.tick += 100
    assert host.read_time(Register.FAULT_TIME_LOW) == lost + 2


def test_the_levels_of_the_input_pins_can_be_read(host):
    assert host.read(Register.INPUTS) == 0b011
    end = host.packed(frames.pack_read, Register.INPUTS)
    host.model.permit(host.tick, level=False)
    host.model.trigger(host.tick + 5 + len(end) * 48)  # two ticks later it is seen, and the READ carried out
    host.exchange(end)
    assert host.status().data == 0b110


def test_inputs_in_the_past_are_refused():
    model = GatewareModel(PARAMETERS)
    model.advance(1000)
    with pytest.raises(ValueError, match="TRIGGER for tick 504 is in the past"):
        model.trigger(500)
    with pytest.raises(ValueError, match="PERMIT for tick 501 is in the past"):
        model.permit(500, level=True)
    with pytest.raises(ValueError, match="a frame for tick 900 is in the past"):
        model.exchange(900, 3000, bytes(36), memoryview(bytearray(36)))


def test_what_the_pins_could_not_show_is_refused():
    model = GatewareModel(PARAMETERS)
    for tick, high_ticks, said in ((7, 4, "before tick 8"), (100, 0, "high for 0"), (100, 5, "high for 5")):
        with pytest.raises(ValueError, match=said):
            model.trigger(tick, high_ticks)
    with pytest.raises(ValueError, match="36 bytes need 582 ticks, not 581"):
        model.exchange(100, 681, bytes(36), memoryview(bytearray(36)))


def test_nothing_is_foreseen_of_a_model_at_rest():
    assert GatewareModel(PARAMETERS).next_change() is None


def test_a_status_is_that_of_an_idle_panel_until_something_happens(host):
    for _ in range(2):
        assert host.status().state == State.RUN_PERMIT | State.TEMPERATURE_GOOD, "nobody has armed, so nobody is listened for"
    host.arm()
    assert host.status().state == ARMED
    assert host.model.status().queued == 0
    assert host.pins_after(0).words[-1] == IDLE
