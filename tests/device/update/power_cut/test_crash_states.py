"""Which states a log has, against all that a disk may do with the same writes."""

import itertools
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).parent))

from crash_states import BLOCK_BYTES, PIECE_BYTES, crash_states
from recording_disk import FLUSH, HEADER, MARK, WRITE, read_log

BLOCKS = 4


def write(number, value):
    return (WRITE, number * BLOCK_BYTES, bytes([value]) * BLOCK_BYTES)


def mark(name):
    return (MARK, 0, name.encode())


FLUSHED = (FLUSH, 0, b"")

logs = st.lists(
    st.one_of(
        st.builds(write, st.integers(0, BLOCKS - 1), st.integers(1, 3)),
        st.just(FLUSHED),
        st.sampled_from(("a", "b")).map(mark),
    ),
    max_size=9,
)


def contents(entries, **how):
    """(first byte of each block, last mark) of each state."""
    found = []
    for state in crash_states(entries, BLOCKS * BLOCK_BYTES, "begin", **how):
        image = bytearray(BLOCKS * BLOCK_BYTES)
        state.write_to(image)
        found.append((tuple(image[::BLOCK_BYTES]), state.marks[-1]))
    return found


def possible(entries):
    """What a disk may hold at any time, by trying everything."""
    safe, since, last, found = [0] * BLOCKS, [], None, set()
    for kind, offset, data in entries:
        if kind == MARK:
            last = data.decode()
        elif kind == WRITE:
            since.append((offset // BLOCK_BYTES, data[0]))
        for kept in itertools.product((False, True), repeat=len(since)):
            blocks = list(safe)
            for (number, value), keep in zip(since, kept, strict=True):
                blocks[number] = value if keep else blocks[number]
            found.add((tuple(blocks), last))
        if kind == FLUSH:
            for number, value in since:
                safe[number] = value
            since = []
    return found


def prefixes(entries):
    """The states of a disk that keeps everything, in order."""
    blocks, last, found = [0] * BLOCKS, None, set()
    for kind, offset, data in entries:
        if kind == MARK:
            last = data.decode()
        elif kind == WRITE:
            blocks[offset // BLOCK_BYTES] = data[0]
        found.add((tuple(blocks), last))
    return found


@given(logs)
def test_every_state_is_possible_and_comes_once_and_no_prefix_is_left_out(entries):
    entries = [mark("begin"), *entries]
    found = contents(entries, subsets=3)
    assert len(found) == len(set(found))
    assert prefixes(entries) <= set(found) <= possible(entries)


def test_subsets_come_to_all_states_in_the_end():
    entries = [mark("begin"), write(0, 1), write(1, 1), write(0, 2), FLUSHED, write(2, 1), write(3, 1)]
    assert set(contents(entries, subsets=400)) == possible(entries)


def test_what_is_said_must_hold_without_what_was_not_flushed():
    entries = [mark("begin"), write(0, 1), FLUSHED, write(0, 2), mark("said")]
    assert {blocks[0] for blocks, last in contents(entries, subsets=0) if last == "said"} == {1, 2}


def test_nothing_before_the_first_mark_is_a_state():
    assert contents([write(0, 1), FLUSHED, mark("begin"), write(1, 1)]) == [((1, 0, 0, 0), "begin"), ((1, 1, 0, 0), "begin")]


def test_the_same_seed_gives_the_same_states():
    entries = [mark("begin"), *(write(number % BLOCKS, number) for number in range(1, 40)), FLUSHED]
    assert contents(entries, seed=1) == contents(entries, seed=1) != contents(entries, seed=2)


def test_a_long_write_is_torn():
    blocks = 3 * PIECE_BYTES // BLOCK_BYTES
    entries = [mark("begin"), (WRITE, 0, b"\1" * 3 * PIECE_BYTES)]
    states = crash_states(entries, blocks * BLOCK_BYTES, "begin", subsets=0)
    assert [bytes(state.content).count(1) for state in states] == [0, PIECE_BYTES, 2 * PIECE_BYTES, 3 * PIECE_BYTES]


def test_a_write_of_parts_of_blocks_is_refused():
    with pytest.raises(ValueError, match="not in whole blocks"):
        contents([mark("begin"), (WRITE, 512, b"1" * 512)])


def test_a_log_is_read_as_it_was_written(tmp_path):
    entries = [mark("begin"), write(2, 7), FLUSHED]
    (tmp_path / "log").write_bytes(b"".join(HEADER.pack(kind, offset, len(data)) + data for kind, offset, data in entries))
    assert read_log(tmp_path / "log") == entries
