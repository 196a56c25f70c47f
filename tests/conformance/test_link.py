"""A line that damages frames in every way a line can: nothing of it is accepted, and every good frame behind it is.

Damage is done to the pins of the compiled Verilog, tick by tick. `pytest -m slow tests/conformance/test_link.py` takes
a million damaged frames. A damaged frame that passes needs 32 bits of CRC to agree by chance: see fpga_rtl/README.md.
"""

from collections import Counter

import numpy as np
import pytest
from pin_script import BUILD_HASH, open_gateware

from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import Control, Register, Result
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.pin_timing import READY_TICKS

QUICK, SLOW = 3_000, 1_000_000
CS, SCK, MOSI = 1, 2, 4
LEAD, LAG, REST = 5, 3, 8  # ticks from chip select to the first bit, from the last to its rise, and between frames
PER_BIT = 2
REFUSED = {Result.BAD_SYNC, Result.BAD_LENGTH, Result.BAD_CRC}


def bits_of(frame):
    return np.unpackbits(np.frombuffer(frame, np.uint8))


def clocked(bits):
    """SCK and MOSI for these bits in mode 0: a tick low, a tick high."""
    wave = np.repeat(bits.astype(np.uint8) * MOSI, PER_BIT)
    wave[PER_BIT - 1 :: PER_BIT] |= SCK
    return wave


def framed(wave):
    quiet = np.full(LEAD, wave[0] & MOSI if wave.size else 0, np.uint8)
    return np.concatenate([quiet, wave, np.zeros(LAG, np.uint8), np.full(REST, CS, np.uint8)])


def flip(rng, bits):
    return flipped(bits, rng.choice(bits.size, rng.integers(1, 9), replace=False))


def burst(rng, bits):
    length = int(rng.integers(2, 97))
    start = int(rng.integers(0, bits.size - length))
    pattern = rng.integers(0, 2, length)
    pattern[[0, -1]] = 1
    return flipped(bits, start + np.flatnonzero(pattern))


def flipped(bits, where):
    bits = bits.copy()
    bits[where] ^= 1
    return bits


def dropped_bits(rng, bits):
    return np.delete(bits, rng.choice(bits.size, rng.integers(1, 9), replace=False))


def added_bits(rng, bits):
    count = int(rng.integers(1, 9))
    return np.insert(bits, rng.integers(0, bits.size + 1, count), rng.integers(0, 2, count))


def dropped_bytes(rng, bits):
    whole = bits.reshape(-1, 8)
    return np.delete(whole, rng.choice(len(whole), rng.integers(1, 5), replace=False), axis=0).ravel()


def added_bytes(rng, bits):
    whole = bits.reshape(-1, 8)
    count = int(rng.integers(1, 5))
    return np.insert(whole, rng.integers(0, len(whole) + 1, count), rng.integers(0, 2, (count, 8)), axis=0).ravel()


def cut(rng, bits):
    return bits[: rng.integers(0, bits.size)]


def least_significant_first(rng, bits):
    return bits.reshape(-1, 8)[:, ::-1].ravel()


def inverted(rng, bits):
    return bits ^ 1


def stuck(rng, bits):
    return np.full_like(bits, rng.integers(0, 2))


def two_in_one(rng, bits):
    return np.concatenate([bits, bits])


def wave_of_bits(damage):
    def wave(rng, bits):
        changed = damage(rng, bits)
        return None if np.array_equal(changed, bits) else framed(clocked(changed))

    return wave


def late_data(rng, bits):
    """Mode 1: data change with the rise of SCK, so each rise finds the bit before."""
    return framed(clocked(np.concatenate([[0], bits[:-1]])))


def early_data(rng, bits):
    """Mode 2: data have changed by the rise of SCK, so each rise finds the bit behind."""
    return framed(clocked(np.concatenate([bits[1:], [0]])))


def select_glitch(rng, bits):
    """Chip select comes off for one to six ticks in the middle."""
    wave = framed(clocked(bits))
    start = int(rng.integers(LEAD + 2, wave.size - REST - LAG - 8))
    wave[start : start + int(rng.integers(1, 7))] |= CS
    return wave


def clock_glitch(rng, bits):
    """One pulse of SCK too many."""
    wave = framed(clocked(bits))
    place = LEAD + PER_BIT * int(rng.integers(0, bits.size))  # a tick with SCK low
    return np.insert(wave, place + 1, [wave[place] | SCK, wave[place]])


DAMAGE = [wave_of_bits(damage) for damage in (flip, burst, dropped_bits, added_bits, dropped_bytes, added_bytes, cut)]
DAMAGE += [wave_of_bits(damage) for damage in (least_significant_first, inverted, stuck, two_in_one)]
DAMAGE += [late_data, early_data, select_glitch, clock_glitch]


class Line:
    """A gateware whose link's pins are driven tick by tick."""

    def __init__(self, back_end):
        self._gateware = open_gateware(back_end)
        self._gateware.advance(READY_TICKS)
        self._frame = bytearray(FRAME_BYTES)

    def good(self, sequence):
        """One proper frame; the status that came back."""
        frames.pack_nop(self._frame, 0, sequence)
        wave = framed(clocked(bits_of(self._frame)))
        miso = self._gateware.wave(wave)
        before_rise = LEAD + PER_BIT * np.arange(8 * FRAME_BYTES) + PER_BIT - 2
        return parse_status(np.packbits(miso[before_rise]).tobytes())

    def damaged(self, wave):
        self._gateware.wave(wave)


def random_frame(rng, buffer):
    """Something that would be noticed, had it been accepted: its number is none that good frames have."""
    sequence = 128 + int(rng.integers(0, 128))
    pack = [
        lambda: frames.pack_write(buffer, 0, sequence, Register.IDLE_WORD, int(rng.integers(0, 2**32))),
        lambda: frames.pack_unlock(buffer, 0, sequence, BUILD_HASH),
        lambda: frames.pack_control(buffer, 0, sequence, Control.TRIGGER),
        lambda: frames.pack_nop(buffer, 0, sequence),
        lambda: frames.pack_play(buffer, 0, sequence, Play(int(rng.integers(0, 4)), period_ticks=int(rng.integers(0, 2**32)))),
    ]
    pack[int(rng.integers(0, len(pack)))]()
    return bytes(buffer)


def damage_line(rtl, count, seed):
    """Damaged frames and a good one behind each; how often each kind of damage was done, and each result given."""
    rng = np.random.default_rng(seed)
    line, buffer = Line(rtl), bytearray(FRAME_BYTES)
    kinds, results = Counter(), Counter()
    line.good(127)
    last = 127
    for number in range(count):
        damage = DAMAGE[number % len(DAMAGE)]
        wave = damage(rng, bits_of(random_frame(rng, buffer)))
        if wave is None:  # by chance what was there before
            continue
        line.damaged(wave)
        status = line.good(number & 0x7F)
        assert status.sequence == last, f"damaged frame {number} of seed {seed} was accepted, or the good one before it was not"
        results[status.result] += 1
        kinds[damage] += 1
        last = number & 0x7F
    return kinds, results


def test_nothing_damaged_is_accepted_and_everything_good_is(rtl):
    kinds, results = damage_line(rtl, QUICK, 1)
    assert len(kinds) == len(DAMAGE)
    assert set(results) <= REFUSED | {Result.OK}  # OK: not a single bit was clocked in, so there was no frame
    assert set(results) >= REFUSED
    assert results[Result.OK] < 0.01 * QUICK


@pytest.mark.slow
def test_of_a_million_damaged_frames_none_is_accepted(rtl):
    kinds, _ = damage_line(rtl, SLOW, 2)
    assert sum(kinds.values()) > 0.99 * SLOW


def test_a_good_frame_in_the_place_of_a_damaged_one_is_noticed(rtl):
    line, buffer = Line(rtl), bytearray(FRAME_BYTES)
    line.good(1)
    frames.pack_nop(buffer, 0, 200)
    line.damaged(framed(clocked(bits_of(buffer))))
    assert line.good(2).sequence == 200
