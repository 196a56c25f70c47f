"""Timing by hand: what is done at which tick, and what every back-end then shows at which tick.

In the tables t is the tick of the first input named; `channels` is channel_o, in hexadecimal.
"""

import pytest
from pin_script import BIT_TICKS, FRAME_TICKS, IDLE_WORD, JUDGED_TICKS, Script, open_gateware

from controller.fpga import frames
from controller.fpga.registers import TRIGGER_LATENCY_TICKS, Control, Register

WORDS = (0x11, 0x22, 0x33)
IDLE = f"{IDLE_WORD:X}"

TABLES = {
    "a trigger plays the words, four ticks each, and the focus is at their end": (
        "t   trigger",
        f"""
        t+6   channels 11
        t+10  channels 22
        t+14  channels 33
        t+18  channels {IDLE}
        t+18  focus
        """,
    ),
    "two emissions, a period of 20 ticks apart": (
        "t   trigger twice",
        f"""
        t+6   channels 11
        t+10  channels 22
        t+14  channels 33
        t+18  channels {IDLE}
        t+18  focus
        t+26  channels 11
        t+30  channels 22
        t+34  channels 33
        t+38  channels {IDLE}
        t+38  focus
        """,
    ),
    "the permit lost in the middle of a word: all is low three ticks later, and no focus": (
        "t   trigger; t+9 permit lost",
        """
        t+6   channels 11
        t+10  channels 22
        t+12  channels 0
        t+12  hv off
        """,
    ),
    "the permit lost with the last word's last tick on the pins: the focus is lost as well": (
        "t   trigger; t+14 permit lost",
        """
        t+6   channels 11
        t+10  channels 22
        t+14  channels 33
        t+17  channels 0
        t+17  hv off
        """,
    ),
    "the permit lost a tick later: the emission has ended and counts": (
        "t   trigger; t+15 permit lost",
        """
        t+6   channels 11
        t+10  channels 22
        t+14  channels 33
        t+18  channels 0
        t+18  hv off
        """,
    ),
    "a second trigger while the first emission sounds does nothing": (
        "t   trigger; t+5 trigger",
        f"""
        t+6   channels 11
        t+10  channels 22
        t+14  channels 33
        t+18  channels {IDLE}
        t+18  focus
        """,
    ),
}


def armed(count=1, period_ticks=0):
    run = Script()
    run.settings()
    run.arm()
    run.upload(0, WORDS)
    run.send(frames.pack_play, 0, count=count, period_ticks=period_ticks)
    run.wait(20)
    return run


def seen(capture, since):
    """The table's lines for what a capture shows from a tick on."""
    before = capture.ticks < since
    word, level = (int(values[before][-1]) if before.any() else 0 for values in (capture.words, capture.hv))
    lines = []
    for tick, new_word, new_level in zip(capture.ticks[~before], capture.words[~before], capture.hv[~before], strict=True):
        if new_word != word:
            lines.append((int(tick) - since, f"channels {new_word:X}"))
        if new_level != level:
            lines.append((int(tick) - since, f"hv {'on' if new_level else 'off'}"))
        word, level = new_word, new_level
    lines += [(int(tick) - since, "focus") for tick in capture.focus_ticks if tick >= since]
    return [f"t+{tick:<3} {what}" for tick, what in sorted(lines)]


@pytest.mark.parametrize("name", TABLES)
def test_pins_follow_the_table(back_end, name):
    inputs, table = TABLES[name]
    run = armed(*((2, 20) if "twice" in inputs else ()))
    start = run.trigger()
    for step in inputs.split("; ")[1:]:
        tick = start + int(step.split()[0].removeprefix("t+"))
        if "permit" in step:
            run.permit(False, tick)
        else:
            run.trigger(tick)
    run.wait(100)
    _, capture = run.perform(back_end)
    assert seen(capture, start) == [
        f"{tick:<5} {what}" for tick, what in (line.split(None, 1) for line in table.split("\n") if line.strip())
    ]


def test_latency_is_what_the_host_believes(back_end):
    run = armed()
    start = run.trigger()
    run.wait(50)
    _, capture = run.perform(back_end)
    sampled = start + 1  # tick `start` ends with the edge that samples the pin high
    assert seen(capture, start)[0] == f"t+{sampled + TRIGGER_LATENCY_TICKS - start:<3} channels 11"


def test_a_play_is_there_for_a_trigger_whose_edge_is_seen_after_its_frame_was_carried_out(back_end):
    """Carried out at t + 4; the trigger is seen 2 ticks after its rise, so a rise at t + 3 finds it and at t + 2 does not."""
    for after, plays in ((2, False), (3, True)):
        run = Script()
        run.settings()
        run.arm()
        run.upload(0, WORDS)
        play = run.packed(frames.pack_play, 0)
        release = run.tick + FRAME_TICKS
        run.trigger(release + after)
        assert run.exchange(play) == release
        run.wait(50)
        _, capture = run.perform(back_end)
        assert bool(capture.focus_ticks.size) is plays


def test_the_host_is_silent_one_heartbeat_time_after_its_last_frame(back_end):
    run = Script()
    run.settings()
    run.send(frames.pack_write, Register.HEARTBEAT_TICKS, 2000)
    run.arm()
    release = run.status()
    run.wait(3000)
    _, capture = run.perform(back_end)
    assert (capture.ticks[-1], capture.words[-1], capture.hv[-1]) == (release + JUDGED_TICKS + 1 + 2000 + 1, 0, 0)


def test_a_stop_ends_an_endless_repetition_with_its_emission(back_end):
    run = armed(count=0, period_ticks=3 * BIT_TICKS)
    start = run.trigger()
    release = run.control(Control.STOP)
    run.wait(100)
    _, capture = run.perform(back_end)
    emissions, rest = divmod(int(capture.ticks[-1]) - start - 6, 3 * BIT_TICKS)
    assert rest == 0
    assert 0 < start + 6 + 12 * emissions - (release + JUDGED_TICKS) <= 12 + 4
    assert capture.focus_ticks.tolist()[0] == start + 18


@pytest.mark.parametrize(
    ("method", "arguments"),
    [
        ("trigger", (3,)),
        ("trigger", (99,)),
        ("exchange", (3, 2000, bytes(32), memoryview(bytearray(32)))),
        ("exchange", (97, 2000, bytes(32), memoryview(bytearray(32)))),
        ("exchange", (200, 200 + FRAME_TICKS - 1, bytes(32), memoryview(bytearray(32)))),
        ("permit", (90, True)),
    ],
)
def test_what_is_past_or_too_fast_for_the_pins_is_refused(back_end, method, arguments):
    gateware = open_at(back_end, 0 if arguments[0] == 3 else 100 + (method == "trigger") * 10)
    with pytest.raises(ValueError, match="tick"):
        getattr(gateware, method)(*arguments)


def open_at(back_end, tick):
    gateware = open_gateware(back_end)
    gateware.advance(tick)
    return gateware
