"""Every command and every misfortune in every state, at many ticks: the model and the compiled Verilog do the same."""

import itertools

import pytest
from pin_script import BUILD_HASH, FRAME_TICKS, JUDGED_TICKS, RAMP_TICKS, Script, assert_same

from controller.fpga import frames
from controller.fpga.model import GatewareModel
from controller.fpga.registers import Control, Register

WORDS = [0x1111 * number for number in range(1, 9)]
EMISSION_TICKS = 32
OFFSETS = (0, 1, 2, 3, 4, 5, 6, 7, 8, 31, 32, 33, 34, 35, 36, 37, 38)
STATES = ("off", "ramp up", "armed", "pending", "playing", "pause of a repetition", "endless", "ramp down", "faulted")
EVENTS = ("disarm", "stop", "clear", "arm", "play", "swap", "damaged", "permit lost", "timeout", "trigger")


def script_of(state, event, offset):
    """The event takes effect `offset` ticks after the state has begun, or as near to that as the link allows."""
    run = Script()
    run.settings()
    run.send(frames.pack_write, Register.HEARTBEAT_TICKS, 2 * FRAME_TICKS + 400)
    if state == "off":
        begun = run.upload(0, WORDS) + JUDGED_TICKS
    elif state == "ramp up":
        begun = run.send(frames.pack_arm, BUILD_HASH) + JUDGED_TICKS
    else:
        run.arm()
        begun = prepare(run, state)
    after = max(begun + offset, run.tick)
    happen(run, event, after)
    run.wait(4 * FRAME_TICKS if event == "timeout" else 2 * RAMP_TICKS + 300)
    for _ in range(2):
        run.status()
    run.trigger()
    run.wait(200)
    return run


def prepare(run, state):
    run.upload(0, WORDS)
    if state == "armed":
        return run.tick
    if state == "ramp down":
        return run.control(Control.DISARM) + JUDGED_TICKS
    if state == "faulted":
        run.permit(False)
        run.wait(5)
        run.permit(True)
        return run.tick
    count, period = {"pause of a repetition": (3, 3 * FRAME_TICKS), "endless": (0, EMISSION_TICKS)}.get(state, (1, 0))
    run.send(frames.pack_play, 0, count=count, period_ticks=period)
    run.wait(4)
    return run.tick if state == "pending" else run.trigger()


def happen(run, event, tick):
    commands = {"disarm": Control.DISARM, "stop": Control.STOP, "clear": Control.CLEAR}
    if event == "permit lost":
        run.permit(False, tick)
        run.permit(True, tick + 3)
    elif event == "trigger":
        run.trigger(tick)
    elif event != "timeout":
        run.tick = tick
        if event in commands:
            run.control(commands[event])
        elif event == "arm":
            run.send(frames.pack_arm, BUILD_HASH)
        elif event == "play":
            run.send(frames.pack_play, 0)
            run.trigger()
            run.wait(4)
        elif event == "swap":
            run.upload(0, WORDS[:5])
        else:
            run.exchange(bytes(32))


@pytest.mark.parametrize("state", STATES)
def test_every_event_does_the_same_in_every_state(rtl, state):
    for event, offset in itertools.product(EVENTS, OFFSETS):
        try:
            run = script_of(state, event, offset)
            assert_same(run.perform(GatewareModel), run.perform(rtl))
        except AssertionError as error:
            raise AssertionError(f"{event} {offset} ticks after {state}: {error}") from error
