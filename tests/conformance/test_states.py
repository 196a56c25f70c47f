"""Every command and every misfortune in every state, at many ticks: the model and the compiled Verilog do the same."""

import itertools
import zlib

import pytest
from pin_script import (
    BIT_TICKS,
    BUILD_HASH,
    FRAME_TICKS,
    JUDGED_TICKS,
    MODEL,
    RAMP_TICKS,
    Script,
    assert_same,
    give,
    open_gateware,
    perform_on_both,
)
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import READ_MEMORY, READ_QUEUE, Control, Fault, Register, Start, State
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.gateware import Permit

WORDS = [0x1111 * number for number in range(1, 9)]
LONG = bytes(range(250)) * 16  # of 1000 words, whose check lasts longer than a frame
EMISSION_TICKS = len(WORDS) * BIT_TICKS
DELAY_TICKS = FRAME_TICKS + 60
OFFSETS = (0, 1, 9)
MORE_OFFSETS = tuple(sorted(set(range(41)) - set(OFFSETS)))  # in the slow form
STATES = (
    "off",
    "unlocked",
    "ramp up",
    "armed",
    "checking",
    "pending",
    "full queue",
    "scheduled",
    "delayed",
    "playing",
    "pause of a repetition",
    "endless",
    "stopping",
    "ramp down",
    "faulted",
)
EVENTS = (
    "disarm",
    "stop",
    "clear",
    "arm",
    "trigger by command",
    "play",
    "play now",
    "play at a time",
    "play a part",
    "swap",
    "read memory",
    "read queue",
    "bit period",
    "damaged",
    "run lost",
    "too hot",
    "timeout",
    "trigger",
    "glitch",
)
COMMANDS = {"disarm": Control.DISARM, "stop": Control.STOP, "clear": Control.CLEAR, "trigger by command": Control.TRIGGER}
PLAYS = {
    "play": {},
    "play now": {"start": Start.NOW},
    "play a part": {
        "start": Start.NOW,
        "first": 2,
        "length": 3,
        "mask": 0xFFFF,
        "inverted": True,
        "emissions": 2,
        "period_ticks": 40,
    },
}
READS = {"read memory": READ_MEMORY + 3, "read queue": READ_QUEUE + 1}
BY_FRAME = set(EVENTS) - {"run lost", "too hot", "timeout", "trigger", "glitch"}
PINS = {"run lost": Permit.RUN, "too hot": Permit.TEMPERATURE}


def begin(state, lead=0):
    """A panel in a state, and the tick at which that begins; see `prepare`."""
    run = Script()
    run.settings()
    run.send(frames.pack_write, Register.HEARTBEAT_TICKS, 2 * FRAME_TICKS + 400)
    if state in {"off", "unlocked"}:
        begun = run.upload(0, WORDS) + JUDGED_TICKS
        if state == "unlocked":
            begun = run.send(frames.pack_unlock, BUILD_HASH) + JUDGED_TICKS
    elif state == "ramp up":
        run.send(frames.pack_unlock, BUILD_HASH)
        begun = run.control(Control.ARM) + JUDGED_TICKS
    elif state == "checking":
        run.upload(0, WORDS)
        for chunk in range(8):
            run.send(frames.pack_load, chunk, memoryview(LONG[500 * chunk : 500 * chunk + 500]))
        run.arm()
        begun = run.send(frames.pack_store, 1, 1000, zlib.crc32(LONG)) + JUDGED_TICKS
    else:
        run.arm()
        begun = prepare(run, state, lead)
    return run, begun


def script_of(state, event, offset):
    """The event takes effect `offset` ticks after the state has begun, or as near to that as the link allows."""
    run, begun = begin(state, FRAME_TICKS + JUDGED_TICKS if event in BY_FRAME else 0)
    happen(run, event, max(begun + offset, run.tick))
    run.wait(4 * FRAME_TICKS if event == "timeout" else 2 * RAMP_TICKS + 300)
    for _ in range(2):
        run.status()
    run.trigger()
    run.wait(200)
    for register in (Register.FAULT_COUNT, Register.TRIGGERS_IGNORED, Register.PLAYS_MISSED):
        run.send(frames.pack_read, register)
    run.status()
    return run


def prepare(run, state, lead):
    """Bring an armed panel into a state; the tick at which it begins, less `lead`.

    A trigger comes `lead` ticks after the panel is ready for it: a frame sent meanwhile is carried out in what it starts.
    """
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
    if state == "scheduled":
        at = run.tick + 3 * FRAME_TICKS
        run.send(frames.pack_play, Play(0, start=Start.TIME, when_ticks=at))
        return at - FRAME_TICKS - JUDGED_TICKS - 9 if lead else at - 9  # it begins a few ticks before its time
    if state == "full queue":
        for first in range(8):
            run.send(frames.pack_play, Play(0, first=first))
        return run.trigger(run.tick + 5 + lead) - lead
    count, period = {"pause of a repetition": (3, 3 * FRAME_TICKS), "endless": (0, EMISSION_TICKS)}.get(state, (1, 0))
    delay = DELAY_TICKS if state == "delayed" else 0
    run.send(frames.pack_play, Play(0, emissions=count, period_ticks=period, when_ticks=delay))
    run.wait(5)
    if state == "pending":
        return run.tick
    if state == "stopping":
        run.trigger(run.tick + FRAME_TICKS - 20)
        return run.control(Control.DISARM) + JUDGED_TICKS
    return run.trigger(run.tick + lead) - lead


def happen(run, event, tick):
    if event in PINS:
        run.permit(False, tick, PINS[event])
        run.permit(True, tick + 3, PINS[event])
    elif event == "trigger":
        run.trigger(tick)
    elif event == "glitch":
        run.trigger(tick, high_ticks=2)
    elif event != "timeout":
        run.tick = tick
        if event in COMMANDS:
            run.control(COMMANDS[event])
        elif event == "arm":
            run.send(frames.pack_unlock, BUILD_HASH)
            run.control(Control.ARM)
        elif event in PLAYS:
            run.send(frames.pack_play, Play(0, **PLAYS[event]))
            run.trigger(run.tick + 5)
        elif event == "play at a time":
            run.send(frames.pack_play, Play(0, start=Start.TIME, when_ticks=run.tick + FRAME_TICKS + JUDGED_TICKS + 40))
        elif event in READS:
            run.send(frames.pack_read, READS[event])
        elif event == "bit period":
            run.send(frames.pack_write, Register.BIT_PERIOD, (5 << 16) + 4321)
        elif event == "swap":
            run.upload(0, WORDS[:5])
        else:
            run.exchange(bytes(FRAME_BYTES))


@pytest.mark.parametrize(
    ("state", "offsets"),
    [pytest.param(state, OFFSETS, id=state) for state in STATES]
    + [pytest.param(state, MORE_OFFSETS, id=f"{state}, more", marks=pytest.mark.slow) for state in STATES],
)
def test_every_event_does_the_same_in_every_state(rtl, state, offsets):
    for event, offset in itertools.product(EVENTS, offsets):
        try:
            run = script_of(state, event, offset)
            assert_same(*perform_on_both(run, rtl))
        except AssertionError as error:
            raise AssertionError(f"{event} {offset} ticks after {state}: {error}") from error


WANTED = {
    "off": State.RUN_PERMIT,
    "ramp up": State.RAMPING | State.HV_ENABLE,
    "armed": State.ARMED,
    "checking": State.ARMED | State.CHECKING,
    "pending": State.PENDING | State.WAITING,
    "full queue": State.PENDING | State.PLAYING,
    "scheduled": State.PENDING,
    "delayed": State.DELAYED,
    "playing": State.PLAYING,
    "pause of a repetition": State.REPEATING,
    "endless": State.REPEATING | State.PLAYING,
    "stopping": State.PLAYING | State.RAMPING,
    "ramp down": State.RAMPING | State.HV_ENABLE,
}


@each_row("state", WANTED)
def test_the_states_are_met(state):
    run, begun = begin(state)
    gateware = open_gateware(MODEL)
    for method, arguments in run.steps:
        if method == "exchange":
            gateware.exchange(*arguments, memoryview(bytearray(len(arguments[2]))))
        else:
            give(gateware, method, *arguments)
    seen = []
    for offset in range(45):
        gateware.advance(begun + offset)
        seen.append(gateware.status().state)
    assert any(found & WANTED[state] == WANTED[state] for found in seen), set(seen)


def test_the_faults_and_misses_of_the_events_are_met():
    faults, missed = Fault(0), 0
    for state, event, offset in itertools.product(("playing", "scheduled"), EVENTS, (0, 33)):
        answers, _ = script_of(state, event, offset).perform(MODEL)
        statuses = [parse_status(answer) for answer in answers if len(answer) >= FRAME_BYTES]
        faults |= statuses[-1].faults
        missed += statuses[-1].data
    assert faults == Fault.NO_PERMIT | Fault.OVER_TEMPERATURE | Fault.HOST_SILENT
    assert missed
