"""Points to drive words: the compiled kernel and its twin give the same bits, and refuse the same buffers."""

import math

import numpy as np
import pytest
from compiled_kernels import COMPILED, needs_compiled
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device import kernel
from controller.device.kernel import words_twin

each = each_row("one", [words_twin, *COMPILED])

PITCH_M = 2.5e-3


def buffers(
    random,
    samples,
    nx,
    ny,
    idle_word,
    block,
    *,
    missing=0.0,
    largest=127,
    quiet=0.0,
    scale_decades=0.0,
    equaliser=0.2,
    band_lost=0.4,
):
    """Words, room and a bank of random responses, as `compose` takes them."""
    there = random.random(nx * ny) >= missing
    entries = np.where(there, np.cumsum(there) - 1, -1).astype(np.int32)
    count = max(int(there.sum()), 1)
    values = (samples + -(-samples // kernel.REST_SAMPLES)) * 32
    stride = -(-values // 64) * 64
    levels = random.integers(-largest, largest + 1, (count, stride), endpoint=False).astype(np.int8)
    levels[random.random(levels.shape) < quiet] = 0
    scales = (10 ** random.uniform(-11 - scale_decades, -11, count)).astype(np.float32)
    plan = kernel.PLAN.pack(samples, stride, nx, ny, count, idle_word, block, PITCH_M, 5e-3, 6e-3, equaliser, band_lost)
    room = bytearray(random.bytes(kernel.room_bytes(samples)))
    return [bytearray(4 * samples), room, plan, entries.tobytes(), scales.tobytes(), bytearray(b"\1" * count), levels.tobytes()]


def compose_with(one, given_buffers, points):
    words, room, *rest = given_buffers
    return one.compose(words, room, kernel.BankBuffers(*rest), points)


def outcome(one, given_buffers, points):
    """What an implementation answers, and the words."""
    words, room, *rest = given_buffers
    words, room = bytearray(words), bytearray(room)
    try:
        answer = one.compose(words, room, kernel.BankBuffers(*rest), points)
    except ValueError:
        return ValueError
    return answer, bytes(words)


amplitudes = st.one_of(st.just(1.0), st.floats(0.25, 1), st.floats(1e-6, 1))
places = st.tuples(st.floats(0, 20e-3), st.floats(0, 20e-3), amplitudes)
on_cells = st.tuples(st.integers(-1, 5), st.integers(-1, 5), amplitudes).map(
    lambda n: (5e-3 + n[0] * PITCH_M, 6e-3 + n[1] * PITCH_M, n[2])
)


@needs_compiled
@settings(max_examples=300, deadline=None)
@given(
    seed=st.integers(0, 1 << 32),
    samples=st.one_of(st.integers(1, 120), st.sampled_from([999, 1000, 1001])),
    size=st.tuples(st.integers(1, 5), st.integers(1, 5)),
    idle_word=st.one_of(st.sampled_from([0, 0x69969669, 0xFFFFFFFF]), st.integers(0, 0xFFFFFFFF)),
    block=st.integers(1, 32).map(lambda eights: 8 * eights),
    bank=st.fixed_dictionaries(
        {
            "missing": st.sampled_from([0.0, 0.0, 0.2]),
            "largest": st.sampled_from([0, 1, 20, 127, 128]),
            "quiet": st.sampled_from([0.0, 0.5, 0.99, 1.0]),
            "scale_decades": st.sampled_from([0.0, 1.0, 20.0]),
            "equaliser": st.sampled_from([0.0, 0.1, 0.199, 0.5]),
            "band_lost": st.sampled_from([0.0, 0.366, 1.0]),
        }
    ),
    points=st.one_of(
        st.lists(st.one_of(places, on_cells), min_size=1, max_size=10),
        st.lists(st.one_of(places, on_cells).map(lambda point: (*point[:2], 1.0)), min_size=1, max_size=10),
        places.flatmap(lambda point: st.lists(st.just(point), min_size=1, max_size=10)),
        places.flatmap(
            lambda point: st.lists(
                st.tuples(st.floats(-2e-3, 2e-3).map(lambda by_m: point[0] + by_m), st.just(point[1]), amplitudes),
                min_size=2,
                max_size=10,
            )
        ),
    ),
)
def test_the_compiled_kernel_gives_the_bits_of_its_twin(seed, samples, size, idle_word, block, bank, points):
    random = np.random.default_rng(seed)
    made = buffers(random, samples, *size, idle_word, block, **bank)
    for compiled in COMPILED:
        assert outcome(compiled, made, points) == outcome(words_twin, made, points)


@needs_compiled
@settings(max_examples=100, deadline=None)
@given(st.data())
def test_it_refuses_what_its_twin_refuses(data):
    """Numbers of the plan, lengths and points that do not go together: the same answer, and nothing beyond a buffer."""
    numbers = [40, 50 * 32, 3, 3, 9, 0x69969669, 48]
    at = data.draw(st.integers(0, 6))
    numbers[at] = data.draw(st.one_of(st.integers(-(1 << 63), (1 << 63) - 1), st.integers(numbers[at] - 40, numbers[at] + 40)))
    floats = [data.draw(st.sampled_from([PITCH_M, PITCH_M, PITCH_M, 0.0, -1.0, math.nan, math.inf, 1e-310])), 5e-3, 6e-3]
    floats.append(data.draw(st.sampled_from([0.2, 0.2, 0.2, 0.5, 0.51, -0.1, math.nan, math.inf])))
    floats.append(data.draw(st.sampled_from([0.4, 0.4, 0.4, 1.0, 1.01, -0.1, math.nan])))
    made = buffers(np.random.default_rng(1), 40, 3, 3, 0, 48)
    made[2] = kernel.PLAN.pack(*numbers, *floats)
    for index in (0, 1, 3, 4, 5, 6):
        if data.draw(st.integers(0, 9)) == 0:
            made[index] = bytes(made[index][: data.draw(st.integers(0, len(made[index])))])
    coordinate = st.one_of(st.floats(0, 20e-3), st.floats())
    points = data.draw(st.lists(st.tuples(coordinate, coordinate, st.one_of(st.floats(0.1, 1), st.floats())), max_size=12))
    for compiled in COMPILED:
        assert outcome(compiled, made, points) == outcome(words_twin, made, points)


@each
def test_a_cell_without_a_good_response_is_named_and_nothing_written(one):
    made = buffers(np.random.default_rng(0), 40, 3, 2, 0, 48)
    made[5][4] = 0
    assert compose_with(one, made, [(5e-3, 6e-3, 1.0), (8e-3, 8e-3, 1.0)]) == 4
    assert not any(made[0])
    made[5][4] = 1
    assert compose_with(one, made, [(5e-3, 6e-3, 1.0), (8e-3, 8e-3, 1.0)]) == -1
    assert any(made[0])


@each
@each_row("samples", [0, -1, 2001, 1 << 40])
def test_lengths_that_cannot_be_composed_are_refused(one, samples):
    made = buffers(np.random.default_rng(0), 40, 3, 2, 0, 48)
    made[2] = kernel.PLAN.pack(samples, 1 << 30, 3, 2, 6, 0, 48, PITCH_M, 5e-3, 6e-3, 0.0, 0.0)
    with pytest.raises(ValueError, match="samples to compose"):
        compose_with(one, made, [(5e-3, 6e-3, 1.0)])
    with pytest.raises(ValueError, match="samples to compose"):
        kernel.room_bytes(samples)


@each
@each_row("which", range(7))
def test_a_buffer_that_is_too_short_is_refused(one, which):
    made = buffers(np.random.default_rng(0), 40, 3, 2, 0, 48)
    made[which] = bytearray(made[which])[: 49 * 32 + 5 * 50 * 32 if which == 6 else -1]
    with pytest.raises(ValueError, match=r"fit|room|plan"):
        compose_with(one, made, [(5e-3, 6e-3, 1.0), (5e-3 + 2 * PITCH_M, 6e-3 + PITCH_M, 1.0)])


@each
@each_row("scale", [math.nan, math.inf, -1e-11])
def test_a_scale_that_cannot_be_is_refused(one, scale):
    made = buffers(np.random.default_rng(0), 40, 3, 2, 0, 48)
    made[4] = np.full(6, scale, np.float32).tobytes()
    with pytest.raises(ValueError, match="scale of response 0"):
        compose_with(one, made, [(6e-3, 7e-3, 1.0)])


@each
def test_a_plan_is_read_only_and_what_is_filled_is_not(one):
    made = buffers(np.random.default_rng(0), 40, 3, 2, 0, 48)
    for which in (0, 1):
        wrong = [bytes(some) if index == which else some for index, some in enumerate(made)]
        with pytest.raises((BufferError, TypeError, ValueError)):
            compose_with(one, wrong, [(5e-3, 6e-3, 1.0)])


@each
def test_polarities_that_other_words_have_are_taken_and_those_chosen_are_given(one):
    rng = np.random.default_rng(5)
    given_buffers = buffers(rng, 200, 4, 4, 0x69969669, 48)
    points = [(6e-3, 7e-3, 1.0), (9e-3, 12e-3, 0.6), (12e-3, 8e-3, 1.0)]
    chosen = bytearray(kernel.MAX_FOCI)
    words, room, *rest = given_buffers
    assert one.compose(words, room, kernel.BankBuffers(*rest), points, chosen) == -1
    plain = bytes(words)
    assert compose_with(one, given_buffers, points) == -1
    assert bytes(words) == plain
    assert sorted(set(chosen[:3])) in ([1], [1, 255])
    assert not any(chosen[3:])
    turned = bytearray(bytes(256 - sign if sign else 0 for sign in chosen[:1]) + chosen[1:])
    kept = bytes(turned)
    assert one.compose(words, room, kernel.BankBuffers(*rest), points, turned) == -1
    assert bytes(turned) == kept
    assert bytes(words) != plain
    twin = bytearray(len(words))
    assert words_twin.compose(twin, room, kernel.BankBuffers(*rest), points, bytearray(kept)) == -1
    assert bytes(words) == bytes(twin)
    with pytest.raises(ValueError, match="9 polarities, not 10"):
        one.compose(words, room, kernel.BankBuffers(*rest), points, bytearray(9))
