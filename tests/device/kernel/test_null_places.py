"""Words that leave places still: the compiled kernel and its twin give the same bits, and refuse the same buffers."""

import numpy as np
import pytest
from compiled_kernels import COMPILED, needs_compiled
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device import kernel
from controller.device.kernel import null_twin
from tests.device.kernel.test_compose import buffers, compose_with, on_cells, places


def outcome(one, given_buffers, points, nulls):
    words, room, *rest = given_buffers
    words, room = bytearray(words), bytearray(room)
    try:
        answer = one.null_places(words, room, kernel.BankBuffers(*rest), points, nulls)
    except ValueError:
        return ValueError
    return answer, bytes(words)


CASES = dict(  # noqa: C408 (as arguments of `given`)
    seed=st.integers(0, 1 << 32),
    samples=st.one_of(st.integers(1, 120), st.sampled_from([999, 1000])),
    size=st.tuples(st.integers(1, 5), st.integers(1, 5)),
    idle_word=st.one_of(st.sampled_from([0, 0x69969669, 0xFFFFFFFF]), st.integers(0, 0xFFFFFFFF)),
    block=st.integers(1, 32).map(lambda eights: 8 * eights),
    bank=st.fixed_dictionaries(
        {
            "missing": st.sampled_from([0.0, 0.0, 0.2]),
            "largest": st.sampled_from([0, 1, 20, 127, 128]),
            "quiet": st.sampled_from([0.0, 0.5, 0.99, 1.0]),
        }
    ),
    points=st.lists(st.one_of(places, on_cells), min_size=1, max_size=10),
    nulls=st.lists(st.one_of(places, on_cells), min_size=1, max_size=4),
    composed=st.booleans(),
)


@needs_compiled
@settings(max_examples=40, deadline=None)
@given(**CASES)
def test_the_compiled_kernel_gives_the_bits_of_its_twin(seed, samples, size, idle_word, block, bank, points, nulls, composed):
    random = np.random.default_rng(seed)
    given_buffers = buffers(random, samples, *size, idle_word, block, **bank)
    given_buffers[0][:] = random.bytes(4 * samples)
    if composed:
        compose_with(kernel, given_buffers, points)
    for compiled in COMPILED:
        assert outcome(compiled, given_buffers, points, nulls) == outcome(null_twin, given_buffers, points, nulls)


@pytest.mark.slow
@needs_compiled
@settings(max_examples=1500, deadline=None)
@given(**CASES)
def test_the_compiled_kernel_gives_the_bits_of_its_twin_in_many_cases(**case):
    test_the_compiled_kernel_gives_the_bits_of_its_twin.hypothesis.inner_test(**case)


@each_row("one", [null_twin, *COMPILED])
def test_refuses_what_compose_refuses_and_leaves_words_alone_without_a_response(one):
    given_buffers = buffers(np.random.default_rng(1), 100, 3, 3, 0x69969669, 48)
    here, there = (6e-3, 7e-3, 1.0), (9e-3, 10e-3, 1.0)
    before = bytes(given_buffers[0])
    for points, nulls in (
        ([], [here]),
        ([here], []),
        ([here], [there] * 5),
        ([here] * 11, [there]),
        ([here], [(np.nan, 0.0, 1.0)]),
        ([(*here[:2], 0.0)], [there]),
    ):
        assert outcome(one, given_buffers, points, nulls) is ValueError
    short = [*given_buffers]
    short[0] = bytearray(396)
    assert outcome(one, short, [here], [there]) is ValueError
    short = [*given_buffers]
    short[1] = bytearray(kernel.room_bytes(100) - 1)
    assert outcome(one, short, [here], [there]) is ValueError
    given_buffers[5][4] = 0  # the cell in the middle may not be used
    assert outcome(one, given_buffers, [here], [there]) == (4, before)
