"""Random-constrained scripts: the model and the compiled Verilog answer alike and move their pins at the same ticks."""

import random
from collections import Counter

import numpy as np
import pytest
from pin_script import BIT_TICKS, BUILD_HASH, FRAME_TICKS, IDLE_WORD, SLOTS, Script, assert_same

from controller.fpga import frames
from controller.fpga.frames import FRAME_BYTES, parse_status
from controller.fpga.model import GatewareModel
from controller.fpga.registers import Control, Fault, Register, Result, State

SCRIPTS = 300
ACTIONS = 25
LENGTHS = (1, 2, 3, 5, 8, 30)
WEIGHTS = {"play": 30, "load": 10, "store": 14, "swap": 6, "trigger": 20, "wait": 10, "stop": 5, "disarm": 3, "arm": 4}
WEIGHTS |= {"permit": 2, "clear": 3, "read": 4, "write": 3, "damaged": 4, "burst": 4, "silence": 1}
CONTROLS = {"stop": Control.STOP, "disarm": Control.DISARM, "clear": Control.CLEAR}


def random_words(rng, length):
    return np.array([rng.getrandbits(32) for _ in range(length)], np.uint32)


def random_script(seed):
    """Arming, short waveforms, and then anything, with triggers as near to its effect as can be."""
    rng = random.Random(seed)
    run = Script()
    run.settings(bit_ticks=rng.choice([BIT_TICKS, BIT_TICKS, 5, 11]))
    run.send(frames.pack_write, Register.HEARTBEAT_TICKS, rng.choice([FRAME_TICKS + 30, 4 * FRAME_TICKS, 20 * FRAME_TICKS]))
    run.arm()
    for slot in range(2):
        run.upload(slot, random_words(rng, rng.choice(LENGTHS)))
    for _ in range(ACTIONS):
        run.slack_ticks = rng.choice([0, 0, 1, 300])
        if rng.random() < 0.3:  # in the middle of the frame that follows
            run.trigger(run.tick + rng.randrange(FRAME_TICKS + 10))
        act(run, rng, rng.choices(list(WEIGHTS), list(WEIGHTS.values()))[0])
        run.wait(rng.choice([0, 0, 0, 1, 7]))
        if rng.random() < 0.4:  # chip select rose four ticks ago, and its frame is carried out now
            run.trigger()
            run.wait(rng.randrange(8))
        if rng.random() < 0.1:  # back to work, whatever the state
            run.control(Control.CLEAR)
            run.arm()
    run.wait(300)
    run.status()
    run.status()
    return run


def act(run, rng, action):
    slot, length = rng.randrange(SLOTS + 1) if rng.random() < 0.1 else rng.randrange(2), rng.choice(LENGTHS)
    period = length * BIT_TICKS + rng.choice([-1, 0, 0, 1, 2, 7, 150])
    if action == "play":
        run.send(frames.pack_play, slot, count=rng.choice([0, 1, 1, 2, 3]), period_ticks=period)
    elif action == "load":
        run.send(frames.pack_load, rng.choices([0, 7, 8], [9, 1, 1])[0], memoryview(random_words(rng, length).tobytes()))
    elif action == "store":
        run.send(frames.pack_store, slot, rng.choice([length, length, 0, 1001]))
    elif action == "swap":
        run.upload(slot, random_words(rng, length))
    elif action == "trigger":
        for _ in range(rng.randrange(1, 4)):
            run.tick = run.trigger() + max(rng.choice([4, 9, length * BIT_TICKS + 1, length * BIT_TICKS, period]), 4)
    elif action == "wait":
        run.wait(rng.randrange(1, 200))
    elif action == "silence":
        run.wait(21 * FRAME_TICKS)
    elif action == "read":
        run.send(frames.pack_read, rng.randrange(18))
    elif action == "write":
        register, value = rng.choice([0, 6, 7, 9, 10, 16]), rng.choice([0, 1, 3, 4, 6, 0x10000, IDLE_WORD])
        run.send(frames.pack_write, register, value)
    elif action == "permit":
        run.permit(False)
        if rng.random() < 0.4:
            run.control(Control.CLEAR)
            run.send(frames.pack_arm, BUILD_HASH)
        run.wait(rng.randrange(1, 6))
        run.permit(True)
    elif action == "burst":
        for _ in range(rng.randrange(2, 8)):
            run.send(rng.choice([frames.pack_nop, lambda *a: frames.pack_read(*a, 14)]))
    elif action == "damaged":
        damaged(run, rng)
    elif action == "arm":
        wrong = rng.random() < 0.2
        run.send(frames.pack_arm, BUILD_HASH ^ wrong)
    else:
        run.control(CONTROLS[action])


def damaged(run, rng):
    """A frame with a bit turned, cut off, too long, or of an unknown type."""
    frame = bytearray(run.packed(frames.pack_load, 0, memoryview(random_words(rng, 8).tobytes())))
    kind = rng.randrange(4)
    if kind == 0:
        frame[rng.randrange(len(frame))] ^= 1 << rng.randrange(8)
    elif kind == 1:
        frame = frame[: rng.randrange(len(frame))]
    elif kind == 2:
        frame += rng.randbytes(rng.choice([1, 4, 600]))
    else:
        frame = run.packed(lambda b, o, s: frames.pack_short(b, o, 6, s, 0))
    run.exchange(frame)


@pytest.mark.parametrize("block", range(6))
def test_random_scripts_give_the_same_on_both(rtl, block):
    for number in range(SCRIPTS // 6):
        seed = 1000 * block + number
        try:
            run = random_script(seed)
            assert_same(run.perform(GatewareModel), run.perform(rtl))
        except AssertionError as error:
            raise AssertionError(f"script {seed}: {error}") from error


def test_the_random_scripts_meet_every_result_every_fault_and_every_state():
    results, states, faults, emissions = Counter(), State(0), Fault(0), 0
    for seed in range(SCRIPTS // 6):
        answers, capture = random_script(seed).perform(GatewareModel)
        for answer in answers:
            if len(answer) >= FRAME_BYTES:
                status = parse_status(answer)
                results[status.result] += 1
                states |= status.state
                faults |= status.faults
        emissions += capture.focus_ticks.size
    assert set(results) == set(Result), f"never met: {set(Result) - set(results)}"
    assert states == ~State(0)
    assert faults == ~Fault(0)
    assert emissions > 200


@pytest.mark.parametrize("late", ["trigger", "exchange", "permit"])
def test_one_tick_of_difference_fails(rtl, late):
    run = Script()
    run.settings()
    run.arm()
    run.upload(0, [1, 2, 3])
    run.send(frames.pack_play, 0)
    run.trigger(run.tick + 100)
    run.wait(200)
    run.permit(False)
    run.wait(20)
    right = run.perform(GatewareModel)
    assert_same(right, run.perform(rtl))
    with pytest.raises(AssertionError):
        assert_same(right, run.perform(rtl, late))
    with pytest.raises(AssertionError):
        assert_same(run.perform(GatewareModel, late), run.perform(rtl))


def test_scripts_are_the_same_every_time():
    assert random_script(5).steps == random_script(5).steps
