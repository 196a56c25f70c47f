"""Timing by hand: every table of fpga_rtl/timing, performed on every back-end; and what no table can say."""

import dataclasses
import re

import pytest
from pin_script import BIT_TICKS, BUILD_HASH, FRAME_TICKS, JUDGED_TICKS, RAMP_TICKS, SETTLE_TICKS, Script, give, open_gateware
from tables import each_row
from timing_case import expected, script_of, seen

from controller.device.board.lookup import data_folder
from controller.device.fpga import frames
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import TRIGGER_LATENCY_TICKS, Control, Register, Result, Start, State
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.timing_diagram import picture_digest
from controller.workshop.gateware.timing_table import Change, load_cases

FOLDER = data_folder("fpga_rtl") / "timing"
CASES = {case.name: case for case in load_cases(FOLDER)}
FIRST_TICKS = 1 + TRIGGER_LATENCY_TICKS  # tick 0 ends with the edge that samples the pin
WORDS = (0x11, 0x22, 0x33)


@each_row("name", CASES)
def test_pins_follow_the_table(back_end, name):
    run, origin = script_of(CASES[name])
    _, capture = run.perform(back_end)
    assert seen(capture, origin) == expected(CASES[name])


def later(changes, index):
    """The same changes, one of them a tick later."""
    change = changes[index]
    value = re.sub(r"@(\d+)", lambda tick: f"@{int(tick[1]) + 1}", change.value)  # a time sent to the FPGA
    return (*changes[:index], Change(change.tick + 1, change.signal, value), *changes[index + 1 :])


@each_row("name", CASES)
def test_one_tick_of_any_output_or_of_some_input_is_seen(back_end, name):
    case = CASES[name]
    run, origin = script_of(case)
    shown = seen(run.perform(back_end)[1], origin)
    for index in range(len(case.outputs)):
        assert shown != expected(dataclasses.replace(case, outputs=later(case.outputs, index)))
    moved = (dataclasses.replace(case, inputs=later(case.inputs, index)) for index in range(len(case.inputs)))
    assert any(seen(script_of(other, origin)[0].perform(back_end)[1], origin) != expected(case) for other in moved)


@each_row("name", CASES)
def test_the_picture_is_that_of_the_table(name):
    """`.venv/bin/python -m controller.generate` draws them."""
    assert picture_digest(FOLDER / f"{name}.svg") == CASES[name].digest


def test_there_is_a_picture_of_every_table_and_no_other():
    assert {path.stem for path in FOLDER.glob("*.svg")} == set(CASES)


def armed(count=1, period_ticks=0):
    run = Script()
    run.settings()
    run.arm()
    run.upload(0, WORDS)
    run.send(frames.pack_play, Play(0, emissions=count, period_ticks=period_ticks))
    run.wait(20)
    return run


def test_latency_is_what_the_host_believes(back_end):
    run = armed()
    start = run.trigger()
    run.wait(50)
    _, capture = run.perform(back_end)
    assert seen(capture, start)[0] == (FIRST_TICKS, "channel", 0x11)


def test_a_stop_ends_an_endless_repetition_with_its_emission(back_end):
    run = armed(count=0, period_ticks=3 * BIT_TICKS)
    start = run.trigger()
    release = run.control(Control.STOP)
    run.wait(100)
    _, capture = run.perform(back_end)
    emissions, rest = divmod(int(capture.ticks[-1]) - start - FIRST_TICKS, 3 * BIT_TICKS)
    assert rest == 0
    assert 0 < start + FIRST_TICKS + 3 * BIT_TICKS * emissions - (release + JUDGED_TICKS) <= 4 * BIT_TICKS
    assert capture.focus_ticks.tolist()[0] == start + FIRST_TICKS + 3 * BIT_TICKS


@each_row(
    ("method", "arguments"),
    [
        ("trigger", (3,)),
        ("trigger", (99,)),
        ("exchange", (3, 2000, bytes(36), memoryview(bytearray(36)))),
        ("exchange", (97, 2000, bytes(36), memoryview(bytearray(36)))),
        ("exchange", (200, 200 + FRAME_TICKS - 1, bytes(36), memoryview(bytearray(36)))),
        ("permit", (90, True, Permit.RUN)),
    ],
)
def test_what_is_past_or_too_fast_for_the_pins_is_refused(back_end, method, arguments):
    gateware = open_at(back_end, 0 if arguments[0] == 3 else 100 + (method == "trigger") * 10)
    with pytest.raises(ValueError, match="tick"):
        give(gateware, method, *arguments)


def open_at(back_end, tick):
    gateware = open_gateware(back_end)
    gateware.advance(tick)
    return gateware


@each_row("how", ["stop", "disarm", "fault"])
def test_what_is_dropped_makes_room_in_the_schedule(back_end, how):
    """A time that an accepted play had taken is free again once that play is dropped."""
    run = Script()
    run.settings()
    run.arm()
    run.upload(0, WORDS)
    play = {"start": Start.TIME, "when_ticks": 40_000}
    run.send(frames.pack_play, Play(0, **play))
    run.send(frames.pack_play, Play(0, **play))
    run.status()
    if how == "fault":
        run.permit(False)
        run.wait(20)
        run.permit(True)
        run.wait(20)
        run.control(Control.CLEAR)
    else:
        run.control(Control[how.upper()])
    if how != "stop":
        run.wait(40 * BIT_TICKS + RAMP_TICKS)
        run.arm()
    run.send(frames.pack_play, Play(0, **play))
    run.status()
    run.wait(40_000)
    answers, capture = run.perform(back_end)
    results = [parse_status(answer).result for answer in answers if len(answer) >= frames.FRAME_BYTES]
    assert Result.OVERLAP in results
    assert results[-1] is Result.OK
    assert capture.focus_ticks.tolist() == [40_000 + len(WORDS) * BIT_TICKS]


def test_the_bit_clock_is_not_changed_while_the_supply_settles(back_end):
    """Nothing sounds yet, but the ramp is about to begin."""
    run = Script()
    run.settings()
    run.send(frames.pack_unlock, BUILD_HASH)
    run.control(Control.ARM)
    run.send(frames.pack_write, Register.BIT_PERIOD, 12 << 16)
    run.status()
    run.wait(SETTLE_TICKS + RAMP_TICKS)
    run.send(frames.pack_write, Register.BIT_PERIOD, 12 << 16)
    run.status()
    statuses = [parse_status(answer) for answer in run.perform(back_end)[0]]
    assert State.RAMPING in statuses[-4].state
    assert [status.result for status in statuses[-3::2]] == [Result.BUSY, Result.OK]
