"""Random-constrained scripts: arming, short waveforms, and then anything, with triggers as near to its effect as can be."""

import random

import numpy as np
from pin_script import BIT_TICKS, BUILD_HASH, FRAME_TICKS, IDLE_WORD, JUDGED_TICKS, SLOTS, Script

from controller.device.fpga import frames
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import PLAY_LANDING, READ_MEMORY, READ_QUEUE, READ_SLOT_CRC, Control, Kind, Register, Start
from controller.workshop.gateware.gateware import Permit

SEEDS = [1000 * block + number for block in range(6) for number in range(12)]  # of those that are compared
SEEDS += [23, 42, 35]  # which exceed the duty, twice, and the edges of all channels, as few do
LENGTHS = (1, 2, 3, 5, 8, 30)
BIT_PERIODS = (BIT_TICKS << 16, BIT_TICKS << 16, 7 << 16, 11 << 16, (6 << 16) + 21845, (7 << 16) + 65535)
SLOW = (110 << 16, 120 << 16, (104 << 16) + 7)  # a chunk arrives faster than that plays
WEIGHTS = {"play": 34, "load": 8, "store": 10, "swap": 6, "live": 4, "trigger": 20, "wait": 10, "stop": 5, "disarm": 3, "arm": 4}
WEIGHTS |= {"permit": 2, "clear": 3, "read": 8, "write": 4, "limits": 1, "damaged": 4, "burst": 4, "silence": 1, "echo": 1}
WEIGHTS |= {"command": 3, "glitch": 2, "period": 2, "count": 8, "uart": 12, "noise": 2}
CONTROLS = {"stop": Control.STOP, "disarm": Control.DISARM, "clear": Control.CLEAR, "command": Control.TRIGGER}
MOVING = (Kind.LIVE, Kind.COUNTER, Kind.LINK_COUNTER, Kind.TIME_LOW, Kind.TIME_HIGH)
REGISTERS = list(Register)
COUNTERS = [register for register in REGISTERS if register.kind in MOVING]
LIMITS = {
    Register.PULSE_TICKS: (4, 6, 7),
    Register.CHANNEL_EDGES: (20, 100, 100_000),
    Register.TOTAL_EDGES: (200, 3000, 4_000_000),
    Register.EMISSION_TICKS: (29, 190, 120_000, 120_000),
    Register.DUTY_SHARE: (0, 20_000, 65_536),
    Register.DUTY_TICKS: (0, 150, 400_000),
    Register.RAMP_SAMPLES: (1, 9, 40),
    Register.HEARTBEAT_TICKS: (6 * FRAME_TICKS, 60 * FRAME_TICKS, 60 * FRAME_TICKS),
    Register.CHANNEL_MASK: (0xFFFFFFFF, 0xFF00FF0F),
    Register.IDLE_WORD: (IDLE_WORD, 0, 0xFFFFFFFF),
}


def random_words(rng, length):
    return np.array([rng.getrandbits(32) for _ in range(length)], np.uint32)


def one_of(rng, registers):
    """One of them, for one number of `rng` however many there are: with a register more the rest of a script stays as it is."""
    return registers[int(rng.random() * len(registers))]


def random_script(seed, actions=25):
    rng = random.Random(seed)
    run = Script()
    run.bit_period = rng.choice(BIT_PERIODS)
    run.settings(bit_period=run.bit_period)
    run.send(frames.pack_write, Register.HEARTBEAT_TICKS, rng.choice([FRAME_TICKS + 60, 6 * FRAME_TICKS] + [60 * FRAME_TICKS] * 6))
    if rng.random() < 0.3:
        set_limits(run, rng)
    run.arm()
    for slot in range(2):
        run.upload(slot, random_words(rng, rng.choice(LENGTHS)))
    for _ in range(actions):
        run.slack_ticks = rng.choice([0, 0, 1, 300])
        if rng.random() < 0.3:  # in the middle of the frame that follows
            run.trigger(run.tick + rng.randrange(FRAME_TICKS + 10))
        act(run, rng, rng.choices(list(WEIGHTS), list(WEIGHTS.values()))[0])
        run.wait(rng.choice([0, 0, 0, 1, 7]))
        if rng.random() < 0.4:  # chip select rose a few ticks ago, and its frame is carried out now
            run.trigger()
            run.wait(rng.randrange(12))
        if rng.random() < 0.15:  # back to work, whatever the state
            run.control(Control.CLEAR)
            run.arm()
    run.wait(300)
    ending = rng.randrange(4)
    if ending == 0:
        too_many_edges(run, rng)
    elif ending == 1:
        run.permit(False, which=rng.choice(list(Permit)))
    read_all(run)
    return run


def too_many_edges(run, rng):
    """An emission that a limit cuts off, whose channels are read before CLEAR."""
    for command in (Control.STOP, Control.DISARM):
        run.control(command)
    run.wait(1500)
    run.control(Control.CLEAR)
    run.send(frames.pack_write, Register.CHANNEL_EDGES, 20)
    run.arm()
    run.upload(0, random_words(rng, 100))
    run.send(frames.pack_play, Play(0, start=Start.NOW))
    run.wait(2000)


def read_all(run):
    """Every register, in the order of the addresses, so that the high half of a time comes behind its low half."""
    for register in Register:
        run.send(frames.pack_read, register)
    run.status()
    run.status()


def random_play(run, rng):
    """A play of anything; nearly always one that can be accepted."""
    length = rng.choice(LENGTHS)
    sounding = length * run.bit_period >> 16
    start = rng.choice([Start.TRIGGER, Start.TRIGGER, Start.TRIGGER, Start.NOW, Start.TIME])
    when = rng.choice([0, 0, 0, 1, 2, 17, 200])
    if start is Start.TIME:  # carried out a frame and a few ticks from now
        when = run.tick + FRAME_TICKS + run.slack_ticks + JUDGED_TICKS + rng.choice([26, 27, 28, 29, 30, 200, 900, 900, 2500, 5000])
    return {
        "first": rng.choice([0, 0, 0, 0, 1, 29, 30]),
        "length": rng.choice([0, 0, length, length, 1]),
        "emissions": rng.choice([0, 1, 1, 1, 2, 3]),
        "period_ticks": sounding + rng.choice([-1, 0, 0, run.bit_period >> 16, (run.bit_period >> 16) - 1, 17, 150]),
        "start": start,
        "when_ticks": when,
        "mask": rng.choice([0xFFFFFFFF, 0xFFFFFFFF, 0x0F0F0F0F, 0]),
        "inverted": rng.random() < 0.2,
    }


def set_limits(run, rng):
    for register, values in LIMITS.items():
        if rng.random() < 0.3:
            run.send(frames.pack_write, register, rng.choice(values))


def act(run, rng, action):
    slot, length = rng.randrange(SLOTS + 1) if rng.random() < 0.1 else rng.randrange(2), rng.choice(LENGTHS)
    if action == "play":
        for _ in range(rng.choice([1, 1, 1, 2, 9])):
            run.send(frames.pack_play, Play(slot, **random_play(run, rng)))
    elif action == "load":
        run.send(frames.pack_load, rng.choices([0, 7, 8], [9, 1, 1])[0], memoryview(random_words(rng, length).tobytes()))
    elif action == "store":
        run.send(frames.pack_store, slot, rng.choice([length, length, 0, 1001]), 0)
    elif action == "swap":
        run.upload(slot, random_words(rng, length))
    elif action == "live":
        play_live(run, rng)
    elif action == "trigger":
        for _ in range(rng.randrange(1, 4)):
            sounding = length * run.bit_period >> 16
            run.tick = run.trigger() + max(rng.choice([8, 9, sounding + 1, sounding, sounding + 9]), 8)
    elif action == "glitch":
        run.trigger(high_ticks=rng.randrange(1, 5))
        run.wait(8)
    elif action == "wait":
        run.wait(rng.randrange(1, 200))
    elif action == "silence":
        run.wait(rng.choice([7, 61]) * FRAME_TICKS)
    elif action == "count":
        count(run, rng, one_of(rng, COUNTERS))
    elif action == "uart":
        by_uart(run, rng, slot, length)
    elif action == "noise":
        run.uart(rng.randbytes(rng.randrange(1, 20)), bytes(rng.randrange(3)))
    elif action == "read":
        read(run, rng, slot)
    elif action == "write":
        register, value = rng.choice([0, 8, 9, 11, 13, 14, 50]), rng.choice([0, 1, 3, 4, 6, 0x10000, IDLE_WORD])
        run.send(frames.pack_write, register, value)
    elif action == "period":
        period = rng.choice([*BIT_PERIODS, (5 << 16) + 65535, (120 << 16) + 1])
        run.send(frames.pack_write, Register.BIT_PERIOD, period)
    elif action == "limits":
        run.control(Control.DISARM)
        run.wait(1500)
        set_limits(run, rng)
        run.arm()
    elif action == "permit":
        which = rng.choice(list(Permit))
        run.permit(False, which=which)
        if rng.random() < 0.4:
            run.control(Control.CLEAR)
            run.arm()
        run.wait(rng.randrange(1, 6))
        run.permit(True, which=which)
    elif action == "burst":
        for _ in range(rng.randrange(2, 8)):
            run.send(rng.choice([frames.pack_nop, lambda *a: frames.pack_read(*a, Register.FRAME_ERRORS)]))
    elif action == "echo":
        run.send(frames.pack_test, rng.randbytes(4 * rng.randrange(4, 30)))
    elif action == "damaged":
        damaged(run, rng)
    elif action == "arm":
        if rng.random() < 0.8:
            run.send(frames.pack_unlock, BUILD_HASH ^ (rng.random() < 0.2))
        run.control(Control.ARM)
    else:
        run.control(CONTROLS[action])


def play_live(run, rng):
    """What is still arriving, at a rate that just may do, with as much of it as there is by then."""
    run.control(Control.STOP)
    chunks = rng.randrange(1, 4)
    words = random_words(rng, 125 * chunks)
    loads = [memoryview(words[125 * chunk : 125 * (chunk + 1)].tobytes()) for chunk in range(chunks)]
    run.wait(600)
    if rng.random() < 0.8:
        run.send(frames.pack_write, Register.BIT_PERIOD, rng.choice(SLOW))
    run.slack_ticks = 0
    run.send(frames.pack_load, 0, loads[0])
    start = rng.choice([Start.TRIGGER, Start.NOW])
    run.send(
        frames.pack_play,
        Play(PLAY_LANDING, first=rng.choice([0] * 9 + [1]), length=rng.choice([125 * chunks, 130, 60]), start=start),
    )
    if start is Start.TRIGGER:
        run.trigger()
        run.wait(4)
    for chunk in range(1, chunks):
        run.send(frames.pack_load, rng.choice([chunk] * 9 + [0]), loads[chunk])
    if rng.random() < 0.6:
        run.send(frames.pack_store, 0, 125 * chunks, 0)
    if rng.random() < 0.6:
        run.wait(125 * 120 * chunks)
        run.store(1, words)
    run.send(frames.pack_write, Register.BIT_PERIOD, run.bit_period)


def count(run, rng, register):
    """Read a counter, in a frame whose own number may skip."""
    run.sequence += rng.choice([0, 0, 0, 1, 2, 254, 255])
    run.send(frames.pack_read, register)


def by_uart(run, rng, slot, length):
    """A frame over the UART, or two, while the script goes on."""
    pack, *arguments = rng.choice(
        [
            (frames.pack_nop,),
            (frames.pack_read, one_of(rng, COUNTERS)),
            (frames.pack_read, Register.SEQUENCE_GAPS),
            (frames.pack_unlock, BUILD_HASH),
            (frames.pack_control, rng.choice([Control.ARM, Control.STOP, Control.CLEAR, Control.TRIGGER])),
            (frames.pack_write, rng.choice([9, 11, 13, 50]), rng.choice([4, 0x10000, 7 << 16])),
            (frames.pack_load, rng.randrange(3), memoryview(random_words(rng, length).tobytes())),
            (frames.pack_store, slot, length, 0),
            (frames.pack_test, rng.randbytes(40)),
        ]
    )
    plays = rng.random() < 0.3
    run.uart_sequence += rng.choice([0, 0, 0, 1, 250])
    if plays:
        pack, arguments = frames.pack_play, [Play(slot, **random_play(run, rng))]
    wire = bytearray(run.uart_frame(pack, *arguments))
    if rng.random() < 0.15:
        wire[rng.randrange(len(wire))] ^= 1 << rng.randrange(8)
    run.uart(bytes(wire))
    if rng.random() < 0.2:
        run.uart(run.uart_frame(frames.pack_unlock, BUILD_HASH), run.uart_frame(frames.pack_control, Control.ARM))


def read(run, rng, slot):
    """A register, a word of memory, a CRC, a word of the queue, or nothing there is."""
    addresses = [one_of(rng, REGISTERS), rng.randrange(60), READ_SLOT_CRC + slot]
    addresses += [READ_MEMORY + 1024 * slot + rng.randrange(3), READ_QUEUE + rng.randrange(20), rng.randrange(0x10000)]
    run.send(frames.pack_read, rng.choice(addresses))


def damaged(run, rng):
    """A frame with a bit turned, cut off, too long, or of an unknown type."""
    frame = bytearray(run.packed(frames.pack_load, 0, memoryview(random_words(rng, 8).tobytes())))
    kind = rng.randrange(5)
    if kind == 4:
        frame[rng.randrange(2)] ^= 1 << rng.randrange(8)
    elif kind == 0:
        frame[rng.randrange(len(frame))] ^= 1 << rng.randrange(8)
    elif kind == 1:
        frame = frame[: rng.randrange(len(frame))]
    elif kind == 2:
        frame += rng.randbytes(rng.choice([1, 4, 600]))
    else:
        frame = run.packed(lambda b, o, s: frames.pack_short(b, o, 7, s, 0))
    run.exchange(frame)
