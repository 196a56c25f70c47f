"""Frames: the compiled kernel does what its twin does, to the byte, with whatever lengths and pages."""

from itertools import product
from random import Random

import pytest
from compiled_kernels import COMPILED, needs_compiled
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.kernel import twin

pytestmark = needs_compiled

lengths = st.one_of(st.sampled_from([0, 3, 4, 20, 500, 504, 3996, 4000, 4004]), st.integers(0, 4100))
pages = st.one_of(st.sampled_from([0, 32, 512, 544, 4064, 4096, 4128]), st.integers(0, 4200))
sequences = st.one_of(st.integers(0, 255), st.integers(-(1 << 70), 1 << 70))


def outcome(one, name, room, *arguments):
    """What a function answers, and what it leaves in its room."""
    out = bytearray(room)
    try:
        return getattr(one, name)(out, *arguments), bytes(out)
    except ValueError as error:
        return str(error)


def same(name, room, *arguments):
    expected = outcome(twin, name, room, *arguments)
    for compiled in COMPILED:
        assert outcome(compiled, name, room, *arguments) == expected
    return expected


@given(lengths, sequences, st.sampled_from([0, 0, 0, 1, 600]), st.builds(Random, st.integers(0, 1 << 64)))
def test_words_are_packed_alike(size, sequence, lacking, random):
    same("pack_loads", random.randbytes(4100 - lacking), sequence, random.randbytes(size))


@given(pages, sequences, st.sampled_from([0, 0, 0, 1, 600]), st.builds(Random, st.integers(0, 1 << 64)))
def test_pages_are_numbered_alike_whatever_they_hold(size, sequence, lacking, random):
    same("renumber_loads", random.randbytes(4200 - lacking), sequence, random.randbytes(size))


@given(st.integers(1, 1000), st.sampled_from([None, None, -1, 0, 4]), st.builds(Random, st.integers(0, 1 << 64)))
def test_words_are_taken_out_alike(samples, changed, random):
    words = random.randbytes(4 * samples)
    page = bytearray(twin.load_frames_bytes(4 * samples))
    twin.pack_loads(page, 0, words)
    if changed == 0:
        page[random.randrange(len(page))] ^= 1 << random.randrange(8)
    found = same("unpack_loads", bytes(max(4 * samples + (changed or 0), 0)), page)
    assert changed is not None or found[1] == words


@given(st.integers(-1, 40), st.integers(-1, 12), sequences, st.builds(Random, st.integers(0, 1 << 64)))
def test_short_frames_are_sealed_alike(start, count, sequence, random):
    same("seal_short_frames", random.randbytes(400), start, count, sequence)


@each_row("name", ["pack_loads", "renumber_loads", "unpack_loads", "seal_short_frames", "statuses_good", "compose"])
def test_it_refuses_arguments_of_another_number_or_kind(name):
    for compiled, arguments in product(
        COMPILED, ((), (1,), (None, None), (bytearray(9), None, None), ("", "", ""), (bytearray(9), 1.5, b"", b""), (1,) * 8)
    ):
        with pytest.raises((TypeError, BufferError)):
            getattr(compiled, name)(*arguments)


def test_a_bank_that_is_no_tuple_of_six_buffers_is_refused():
    for compiled, bank in product(COMPILED, (b"", [b""] * 6, (b"",) * 5, (b"",) * 7, (b"", b"", b"", b"", b"", 1))):
        with pytest.raises(TypeError):
            compiled.compose(bytearray(9), bytearray(9), bank, [(0.0, 0.0, 1.0)])
