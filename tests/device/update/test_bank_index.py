"""Index of a bank: what is missing of a file follows from it, and nothing damaged is taken for one."""

import contextlib
import io
import random
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.update.download.bank_index import (
    GAP_BYTES,
    PIECE_BYTES_MAX,
    BankIndex,
    found_pieces,
    missing_ranges,
    read_index,
    write_index,
)
from controller.errors import UpdateError

PIECES = st.lists(st.tuples(st.integers(0, 50), st.integers(0, 300)), max_size=30)  # gap before each, length


def laid_out(gaps_and_lengths):
    pieces, end = [], 0
    for gap, length in gaps_and_lengths:
        pieces.append((end + gap, length))
        end += gap + length
    return pieces, end


@settings(max_examples=40)
@given(PIECES, st.integers(0, 100), st.integers())
def test_an_index_covers_its_file_and_survives_being_written(tmp_path_factory, gaps_and_lengths, tail, seed):
    pieces, end = laid_out(gaps_and_lengths)
    file = tmp_path_factory.mktemp("bank") / "bank"
    file.write_bytes(random.Random(seed).randbytes(end + tail))
    data = write_index(file, pieces)
    index = read_index(data, "index")
    assert index.to_bytes() == data
    assert index.size_bytes == end + tail
    with file.open("rb") as opened:
        assert list(found_pieces(opened, index)) == list(index)
    starts = {piece.offset for piece in index}
    assert {offset for offset, length in pieces if length} <= starts


@settings(max_examples=40)
@given(PIECES, PIECES, st.integers())
def test_what_is_known_and_what_is_fetched_make_the_file(tmp_path_factory, shared, own, seed):
    """Pieces shared with an old file, in another order and at other places; ranges fetched for the rest."""
    rng = random.Random(seed)
    parts = [rng.randbytes(length) for _, length in shared]
    news = [rng.randbytes(length * 100) for _, length in own]
    mixed = [*parts, *news]
    rng.shuffle(mixed)
    folder = tmp_path_factory.mktemp("banks")
    old, new = folder / "old", folder / "new"
    indexes = {}
    for file, pieces in ((old, parts), (new, mixed)):
        file.write_bytes(b"".join(pieces))
        ends = [sum(map(len, pieces[: number + 1])) for number in range(len(pieces))]
        indexes[file] = read_index(
            write_index(file, [(end - len(data), len(data)) for end, data in zip(ends, pieces, strict=True)]), str(file)
        )
    with old.open("rb") as opened:
        known = {piece.digest: piece for piece in found_pieces(opened, indexes[old])}
    assert all(piece.digest in known for piece in indexes[old])
    wanted, held = new.read_bytes(), old.read_bytes()
    built = bytearray(len(wanted))
    for piece in indexes[new]:
        if piece.digest in known:
            at = known[piece.digest].offset
            built[piece.offset : piece.offset + piece.length] = held[at : at + piece.length]
    ranges = missing_ranges(indexes[new], known)
    for start, stop in ranges:
        built[start:stop] = wanted[start:stop]
    assert built == wanted
    assert all(after[0] - before[1] >= GAP_BYTES for before, after in pairwise(ranges))


def test_one_changed_piece_is_one_range(tmp_path):
    file = tmp_path / "bank"
    data = bytearray(random.Random(1).randbytes(400_000))
    file.write_bytes(data)
    cut = [(at, 4000) for at in range(0, 400_000, 4000)]
    old = read_index(write_index(file, cut), "old")
    data[200_001] ^= 1
    data[204_001] ^= 1
    data[300_001] ^= 1
    file.write_bytes(data)
    new = read_index(write_index(file, cut), "new")
    known = {piece.digest for piece in old}
    assert missing_ranges(new, known) == [(200_000, 208_000), (300_000, 304_000)]
    assert old.runs == ((100, 4000),)
    assert len(old.to_bytes()) == 28 + 800


def test_long_stretches_are_cut(tmp_path):
    file = tmp_path / "bank"
    file.write_bytes(bytes(3 * PIECE_BYTES_MAX + 1))
    assert read_index(write_index(file, []), "index").runs == ((3, PIECE_BYTES_MAX), (1, 1))


@each_row("pieces", [[(0, 11)], [(5, 2), (6, 1)], [(-1, 2)], [(3, -1)], [(11, 0)]])
def test_pieces_that_are_none_are_refused(tmp_path, pieces):
    file = tmp_path / "bank"
    file.write_bytes(bytes(10))
    with pytest.raises(UpdateError, match="lies over another, or outside of the file"):
        write_index(file, pieces)


@given(st.binary(max_size=200))
def test_any_bytes_are_an_index_or_refused(data):
    for given_bytes in (data, b"HPNLIDX1" + data):
        with contextlib.suppress(UpdateError):
            assert read_index(given_bytes, "file").to_bytes() == given_bytes


def test_a_damaged_index_is_refused():
    good = BankIndex(((2, 100), (1, 7)), bytes(range(24))).to_bytes()
    assert read_index(good, "file").size_bytes == 207
    for length in range(len(good)):
        with pytest.raises(UpdateError, match=r"^file: "):
            read_index(good[:length], "file")
    for index in (BankIndex(((0, 4),), b""), BankIndex(((1, 0),), bytes(8)), BankIndex(((1, PIECE_BYTES_MAX + 1),), bytes(8))):
        with pytest.raises(UpdateError, match="impossible length"):
            read_index(index.to_bytes(), "file")
    huge = BankIndex(((2**32 - 1, 1),) * 1000, bytes(80))
    with pytest.raises(UpdateError, match="contradict"):
        read_index(huge.to_bytes(), "file")


def test_a_file_that_ends_early_gives_the_pieces_before(tmp_path):
    index = BankIndex(((4, 10),), bytes(32))
    assert [piece.offset for piece in found_pieces(io.BytesIO(bytes(25)), index)] == [0, 10]
