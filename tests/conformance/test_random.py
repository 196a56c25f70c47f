"""Random-constrained scripts: the model and the compiled Verilog answer alike and move their pins at the same ticks.

`pytest -m slow tests/conformance` goes through 100,000 frames of them.
"""

from collections import Counter
from functools import cache

import pytest
import random_script as scripts
from pin_script import MODEL, Script, assert_same, perform_on_both
from random_script import MOVING, SEEDS, random_script
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import Fault, FrameType, Kind, Register, Result, State
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.gateware import Permit

SLOW_FRAMES = 100_000
LONG = {register for register in Register if register.kind is Kind.TIME_HIGH}  # they move after 2**32 ticks
NEVER = Fault.SHORT_PULSE | Fault.LONG_EMISSION  # what would cause them is refused before: tests/rtl/tb_stage_limits.py


def frames_of(script):
    return sum(method == "exchange" for method, _ in script.steps)


@cache
def by_model(seed):
    """A random script, and what comes of it on the model."""
    script = random_script(seed)
    return script, script.perform(MODEL)


def compare(script, rtl, seed):
    try:
        assert_same(*perform_on_both(script, rtl))
    except AssertionError as error:
        raise AssertionError(f"random_script({seed}): {error}") from None


@each_row("seed", SEEDS)
def test_random_scripts_give_the_same_on_both(rtl, seed):
    script, expected = by_model(seed)
    assert_same(expected, script.perform(rtl))


@pytest.mark.slow
def test_a_hundred_thousand_random_frames_give_the_same_on_both(rtl):
    done, seed = 0, 10_000
    while done < SLOW_FRAMES:
        script = random_script(seed)
        compare(script, rtl, seed)
        done += frames_of(script)
        seed += 1


@pytest.mark.gateware  # with those that perform them on the Verilog too
def test_the_random_scripts_meet_every_result_every_fault_and_every_state():
    results, states, faults, emissions = Counter(), State(0), Fault(0), 0
    for seed in SEEDS:
        _, (answers, capture) = by_model(seed)
        for answer in answers:
            if len(answer) >= FRAME_BYTES:
                status = parse_status(answer)
                results[status.result] += 1
                states |= status.state
                faults |= status.faults
        emissions += capture.focus_ticks.size
    assert set(results) == set(Result), f"never met: {set(Result) - set(results)}"
    assert states == ~State(0), f"never met: {~states}"
    assert faults == ~NEVER, f"never met: {~faults}"
    assert emissions > 200


def values_read(script, answers):
    """{register: values} of every READ of a register by SPI that was answered with its value."""
    values = {register: set() for register in Register}
    sent = [arguments[2] for method, arguments in script.steps if method == "exchange"]
    for frame, answer in zip(sent, answers[1:], strict=False):
        if len(frame) == FRAME_BYTES <= len(answer) and frame[2] == FrameType.READ:
            status, address = parse_status(answer), int.from_bytes(frame[6:8], "little")
            if status.result is Result.OK and address < len(Register):
                values[Register(address)].add(status.data)
    return values


@pytest.mark.gateware
def test_the_random_scripts_move_every_register_that_can_move():
    """What nothing moves is compared at its value after reset only: give `random_script` what moves it."""
    values = {register: set() for register in Register}
    for seed in SEEDS:
        script, (answers, _) = by_model(seed)
        for register, read in values_read(script, answers).items():
            values[register] |= read
    assert all(values.values()), "each is read"
    still = [
        register.name for register in Register if register.kind in MOVING and register not in LONG and len(values[register]) < 2
    ]
    assert not still


@each_row("late", ["trigger", "exchange", "permit"])
def test_one_tick_of_difference_fails(rtl, late):
    run = Script()
    run.settings()
    run.arm()
    run.upload(0, [1, 2, 3])
    run.send(frames.pack_play, Play(0))
    run.trigger(run.tick + 100)
    run.wait(200)
    run.permit(False, which=Permit.RUN)
    run.wait(20)
    right = run.perform(MODEL)
    assert_same(right, run.perform(rtl))
    with pytest.raises(AssertionError):
        assert_same(right, run.perform(rtl, late))
    with pytest.raises(AssertionError):
        assert_same(run.perform(MODEL, late), run.perform(rtl))


def test_scripts_are_the_same_every_time_and_with_a_register_more_but_for_which_is_read(monkeypatch):
    kept = [random_script(seed).steps for seed in range(12)]
    assert [random_script(seed).steps for seed in range(12)] == kept
    for name in ("REGISTERS", "COUNTERS"):
        monkeypatch.setattr(scripts, name, [Register.IDENTITY, *getattr(scripts, name)])
    more = [random_script(seed).steps for seed in range(12)]
    assert more != kept
    assert [[(method, ticks) for method, (ticks, *_) in steps] for steps in more] == [
        [(method, ticks) for method, (ticks, *_) in steps] for steps in kept
    ]
