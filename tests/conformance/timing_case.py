"""Performs a timing table: its set-up and its inputs as a script of the pins, and what a capture then shows."""

import zlib

import numpy as np
from pin_script import IDLE_WORD, Script

from controller.device.fpga import frames
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import Control, Register, Start
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS
from controller.workshop.gateware.timing_table import IDLE, drive_words

SETTLED_TICKS = 20  # between the set-up and the first thing that a table does
AFTER_TICKS = 100  # for which nothing else may happen
LEVELS = {"channel": "words", "hv_enable": "hv"}  # signal: attribute of the capture
ORDER = {"permit": 0, "temperature": 0, "trigger": 1, "frame": 2}  # of what happens in one tick


def script_of(case, origin=None):
    """The script, and the tick that the table calls 0: as early as may be, or that given."""
    run = Script()
    run.settings(bit_period=round(case.bit_ticks * 65536))
    for name, value in case.settings.items():
        run.send(frames.pack_write, Register[name], value)
    if case.setup == "armed":
        run.arm()
    for slot, words in case.slots.items():
        run.upload(slot, words)
    for play in case.plays:
        run.exchange(packed(run, f"PLAY {play}", 0))
    run.wait(SETTLED_TICKS)
    if origin is None:
        first = next((change for change in case.inputs if change.signal == "frame"), None)
        origin = run.tick + (max(0, duration(packed(run, first.value, 0)) - first.tick) if first else 0)
    for change in sorted(case.inputs, key=lambda change: (change.tick, ORDER[change.signal])):
        perform(run, change, origin, origin + change.tick)
    run.tick = max(run.tick, origin + case.last_tick + AFTER_TICKS)
    return run, origin


def perform(run, change, origin, tick):
    if change.signal == "trigger":
        assert run.trigger(tick, int(change.value or TRIGGER_HIGH_TICKS)) == tick, (
            f"the trigger cannot rise again at tick {tick - origin} of the table"
        )
    elif change.signal == "frame":
        frame = packed(run, change.value, origin)
        assert tick - duration(frame) >= run.tick, f"{change.value} cannot end at tick {tick - origin} of the table"
        run.tick = tick - duration(frame)
        assert run.exchange(frame) == tick
    else:
        run.permit(change.value == "1", tick, Permit.RUN if change.signal == "permit" else Permit.TEMPERATURE)


def duration(frame):
    """Ticks from the fall of chip select to its rise, as short as may be."""
    ruler = Script()
    begun = ruler.tick
    return ruler.exchange(frame) - begun


def packed(run, text, origin):
    """The frame that a table names: a kind with the arguments of the function that packs it, a command, or words to LOAD."""
    kind, *words = text.split()
    if kind in Control.__members__:
        return run.packed(frames.pack_control, Control[kind])
    if kind == "LOAD":
        run.loaded = np.array(drive_words(" ".join(words)), "<u4")
        return run.packed(frames.pack_load, 0, memoryview(run.loaded).cast("B"))
    arguments = {name: value_of(value, origin) for name, value in (word.split("=") for word in words)}
    if kind == "PLAY":
        return run.packed(frames.pack_play, Play(**arguments))
    if kind == "STORE":
        arguments |= {"length_words": len(run.loaded), "crc": zlib.crc32(run.loaded)}
    return run.packed(getattr(frames, f"pack_{kind.lower()}"), **arguments)


def value_of(text, origin):
    """A number, a start by its name, or `@tick`: a tick of the table by the FPGA's clock."""
    if text in Start.__members__:
        return Start[text]
    return origin + int(text[1:]) if text.startswith("@") else int(text, 0)


def expected(case):
    """Changes that the table foresees, as of `seen`."""
    return sorted((change.tick, change.signal, number(change.value)) for change in case.outputs)


def number(value):
    return IDLE_WORD if value == IDLE else int(value or "1", 0)


def seen(capture, origin):
    """(tick, signal, value) of every change of every pin from the table's tick 0 on."""
    changes = [(int(tick) - origin, "focus", 1) for tick in capture.focus_ticks if tick >= origin]
    for signal, attribute in LEVELS.items():
        before = 0
        for tick, level in zip(capture.ticks.tolist(), getattr(capture, attribute).tolist(), strict=True):
            if level != before and tick >= origin:
                changes.append((tick - origin, signal, level))
            before = level
    return sorted(changes)
