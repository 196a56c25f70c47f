"""Captures of the model's output pins."""

import tracemalloc

import numpy as np
from alone import alone
from hypothesis import given
from hypothesis import strategies as st

from controller.workshop.gateware.model.pins import Pins

HALF_TICKS = 7
END = 400


class Unlimited:
    """Limits that nothing exceeds."""

    def show(self, ticks, words):
        pass


def alive_of(changes, takes):
    """Changes of `hv_alive_o` over all captures; `changes` are ticks at which the enable turns over, `takes` ends of captures."""
    pins = Pins(Unlimited(), HALF_TICKS)
    found, level = [], 0
    for tick in sorted({*changes, *takes, END}):
        if tick in changes:
            level = 1 - level
            pins.put_word(tick, 0, hv=level)
        if tick in takes or tick == END:
            found += pins.take(tick).alive_ticks.tolist()
    return found


def alive_reference(changes):
    """The same, tick by tick: high as the enable goes on, over after each half period, low when it goes off."""
    found, on, alive, left = [], False, False, 0
    for tick in range(END + 1):
        before = alive
        if tick in changes:
            on = not on
            alive, left = on, HALF_TICKS
        elif on:
            left -= 1
            if left == 0:
                alive, left = not alive, HALF_TICKS
        if alive != before:
            found.append(tick)
    return found


@given(st.sets(st.integers(1, END - 1), max_size=6), st.sets(st.integers(1, END - 1), max_size=12))
def test_the_pulses_that_say_alive_are_the_same_however_captures_cut_them(changes, takes):
    assert alive_of(changes, takes) == alive_reference(changes)


def test_a_capture_costs_what_happened_since_the_last_one_however_long_the_outputs_are_on():
    pins = Pins(Unlimited(), HALF_TICKS)
    pins.put_word(1, 0, hv=1)
    for second in range(1, 60):
        pins.take(second * 1_000_000)

    def take():
        tracemalloc.start()
        return pins.take(59_000_000 + 10 * HALF_TICKS).alive_ticks, tracemalloc.get_traced_memory()[1]

    taken, peak_bytes = alone(take)
    assert taken.size == 10
    assert np.all(np.diff(taken) == HALF_TICKS)
    assert peak_bytes < 100_000
