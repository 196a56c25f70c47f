import errno
import os
import struct
import zlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tables import each_row

from controller.device.bank.bank_file import map_bytes
from controller.device.bank.file_format import PAGE
from controller.device.bank.grid import Grid
from controller.device.bank.packing import drive_words
from controller.device.bank.reader import Bank
from controller.device.kernel import unpack_loads
from controller.errors import BankError

IDLE_WORD = 0x69969669
CELLS = [True, False, True, True, False, True]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "bank"


def flip(path, offset, mask=1):
    with path.open("r+b") as file:
        byte = os.pread(file.fileno(), 1, offset)[0]
        os.pwrite(file.fileno(), bytes([byte ^ mask]), offset)


def test_hands_out_the_words_and_responses_of_the_cells_it_has(path, make_bank, board):
    responses = make_bank(path, cells=CELLS)
    with Bank.open(path, board) as bank:
        assert bank.cells.tolist() == CELLS
        for cell, response in responses.items():
            assert bank.drive.words(cell).tobytes() == drive_words(response, IDLE_WORD).tobytes()
            levels, scale_m_per_v = bank.responses.response(cell)
            assert np.abs(levels * np.float64(scale_m_per_v) - response).max() <= 0.501 * scale_m_per_v
        for missing in (1, 4, -1, 6, -6):
            with pytest.raises(BankError, match="no entry for cell"):
                bank.drive.words(missing)
            with pytest.raises(BankError, match="no entry for cell"):
                bank.responses.response(missing)


def test_frames_are_the_mapped_file_itself_and_cannot_be_written(path, make_bank):
    make_bank(path)
    with Bank.open(path) as bank:
        first, again = (np.frombuffer(bank.drive.frames(2)[0], np.uint8) for _ in range(2))
        assert np.shares_memory(first, again)  # no copy
        assert bank.drive.frames(2)[0].readonly
        assert bank.drive.words(2).readonly
        assert not bank.responses.response(2)[0].flags.writeable


def test_sections_that_are_not_needed_are_never_mapped(path, make_bank):
    make_bank(path)
    with Bank.open(path) as bank:
        assert bank.counters.mapped_bytes == {}
        bank.drive.words(0)
        assert bank.counters.mapped_bytes == {"drive": 6 * PAGE}
        assert Path("/proc/self/maps").read_text().count(str(path)) == 1
        bank.responses.response(0)
        assert bank.counters.mapped_bytes == {"drive": 6 * PAGE, "response": 6 * 448}
        assert Path("/proc/self/maps").read_text().count(str(path)) == 2


def test_an_entry_s_checksum_is_computed_on_its_first_use_only(path, make_bank):
    make_bank(path)
    with Bank.open(path) as bank:
        for _ in range(3):
            bank.drive.frames(1), bank.drive.frames(2), bank.responses.response(1)
        assert (bank.counters.lookups, bank.counters.drive_checked, bank.counters.response_checked) == (6, 2, 1)
        assert bank.counters.bad == 0


@pytest.mark.parametrize("section", ["drive", "response"])
def test_a_damaged_entry_is_refused_and_counted_and_the_others_still_serve(path, make_bank, section):
    make_bank(path)
    with Bank.open(path) as bank:
        damaged, sound = bank.sections[section], {"drive": "response", "response": "drive"}[section]
    flip(path, damaged.offset + 3 * damaged.stride + damaged.row_bytes - 1, 0x80)
    with Bank.open(path) as bank:
        use = {"drive": bank.drive.frames, "response": bank.responses.response}
        for count in (1, 2):
            with pytest.raises(
                BankError, match=rf"{section} of entry 3 \(cell 3\) is damaged; rebuild it: haptic-panel bank build"
            ):
                use[section](3)
            assert bank.counters.bad == count
        use[section](2)
        use[sound](3)


def test_responses_around_a_cell_are_read_ahead_when_it_is_first_used(path, make_bank, monkeypatch):
    grid = Grid(5e-3, 9, 7, 5e-3, 6e-3)
    cells = [number % 9 != 3 for number in range(63)]  # a column is missing
    make_bank(path, grid, cells)
    asked = []
    monkeypatch.setattr(os, "posix_fadvise", lambda *given: asked.append(given[1:]))
    with Bank.open(path) as bank:
        bank.drive.frames(40)
        assert asked == []
        section, entry_of = bank.sections["response"], bank.file.tables.entries

        def span(first, last):
            offset = section.offset + entry_of[first] * section.stride
            return offset, (entry_of[last] + 1 - entry_of[first]) * section.stride, os.POSIX_FADV_WILLNEED

        for cell, rows in (
            (40, [(20, 24), (29, 33), (38, 42), (47, 51), (56, 60)]),  # 5 x 5 around column 4, row 4
            (0, [(0, 2), (9, 11), (18, 20)]),
            (62, [(42, 44), (51, 53), (60, 62)]),
        ):
            asked.clear()
            bank.responses.response(cell)
            assert asked == [span(*row) for row in rows]
            asked.clear()
            bank.responses.response(cell)
            assert asked == []
    bank.responses.response(20)  # closed: the number of its file may be another's by now
    assert asked == []


def test_frames_are_checked_in_advance_without_mapping_them(path, make_bank):
    make_bank(path, cells=CELLS)
    with Bank.open(path) as bank:
        bank.drive.check_frames([0, 2, 5])
        assert (bank.counters.drive_checked, bank.counters.mapped_bytes) == (3, {})
        for cell in (0, 2, 3, 5):
            bank.drive.frames(cell)
        assert bank.counters.drive_checked == 4, "cell 3 on its first use"
        section = bank.sections["drive"]
    with pytest.raises(ValueError, match="closed"):
        bank.drive.check_frames([0])
    flip(path, section.offset + 2 * section.stride + 8)
    with Bank.open(path) as bank:
        bank.drive.check_frames([0, 2])
        for check in (lambda: bank.drive.check_frames([5, 3]), lambda: bank.drive.frames(3)):
            with pytest.raises(BankError, match=r"drive of entry 2 \(cell 3\) is damaged; rebuild it: haptic-panel bank build"):
                check()


def test_a_bank_that_is_cut_off_or_unreadable_while_it_is_checked_is_refused(path, make_bank, monkeypatch):
    make_bank(path, responses=dict.fromkeys(range(6), np.ones((9, 32))))  # a row that is missing must not pass as the one before
    with Bank.open(path) as bank:
        section = bank.sections["drive"]
        with path.open("r+b") as file:
            file.truncate(section.offset + 4 * section.stride + 20)
        with pytest.raises(BankError, match=r"drive of entry 4 \(cell 4\) is damaged"):
            bank.drive.check_frames(range(6))

        def broken(*_):
            raise OSError(errno.EIO, os.strerror(errno.EIO))

        monkeypatch.setattr(os, "preadv", broken)
        with pytest.raises(BankError, match=r"bank: cannot be read \(Input/output error\); rebuild it: haptic-panel bank build"):
            bank.drive.check_frames([0])


def test_a_file_system_that_cannot_read_ahead_is_read_all_the_same(path, make_bank, monkeypatch):
    def cannot(*_):
        raise OSError(errno.EINVAL, os.strerror(errno.EINVAL))

    make_bank(path)
    monkeypatch.setattr(os, "posix_fadvise", cannot)
    with Bank.open(path) as bank:
        assert bank.responses.response(0)[0].shape == (9, 32)


def test_the_bank_of_another_board_is_refused_with_both_digests(path, make_bank, board):
    make_bank(path, digest=bytes(range(32)))
    Bank.open(path).close()  # without a board there is nothing to compare
    with pytest.raises(BankError) as refused:
        Bank.open(path, board)
    assert refused.value.exit_code == 78
    for part in (str(path), "0001020304050607", board.digest().hex()[:16], "haptic-panel bank build --board simulated"):
        assert part in str(refused.value)


@each_row(
    ("damage", "reason"),
    [
        (lambda data: data[:0], "is empty"),
        (lambda data: b"\x7fELF" + data[4:], "is not a bank"),
        (lambda data: data[:5], "is truncated"),
        (lambda data: data[:2000], "is truncated"),
        (lambda data: data[:4096], "is truncated"),
        (lambda data: data[:-1], "is truncated"),
        (lambda data: data + b"\0", "has grown"),
        (lambda data: data[:8] + b"\x01" + data[9:], "format version 1; this program reads version 9"),
        (lambda data: data[:12] + b"\x01" + data[13:], "header of 4097 bytes"),
        (lambda data: data[:30] + b"!" + data[31:], "CRC-32 of the header"),
        (lambda data: data[:4096] + b"\x07" + data[4097:], "CRC-32 of section 'index'"),
        (lambda data: data[:8192] + b"\x07" + data[8193:], "CRC-32 of section 'checksums'"),
        (lambda data: data[:12288] + b"\x07" + data[12289:], "CRC-32 of section 'scale'"),
    ],
    afresh=[path],
)
def test_refuses_a_damaged_file_with_the_reason_and_how_to_rebuild(path, make_bank, board, damage, reason):
    make_bank(path)
    path.write_bytes(damage(path.read_bytes()))
    open_files = len(list(Path("/proc/self/fd").iterdir()))
    advice = "$" if reason == "is not a bank" else ".*haptic-panel bank build --board simulated"
    with pytest.raises(BankError, match=rf"{path}.*{reason}[^;]*{advice}"):
        Bank.open(path, board)
    assert len(list(Path("/proc/self/fd").iterdir())) == open_files


def test_an_index_that_names_an_entry_twice_is_refused(path, make_bank):
    make_bank(path)
    data = bytearray(path.read_bytes())
    data[4096 + 4] = 0  # cell 1 -> entry 0; then make both checksums right
    data[184 + 44 : 184 + 48] = zlib.crc32(data[4096 : 4096 + 24]).to_bytes(4, "little")
    data[4092:4096] = zlib.crc32(data[:4092]).to_bytes(4, "little")
    path.write_bytes(data)
    with pytest.raises(BankError, match="does not name every entry once"):
        Bank.open(path)


def test_a_missing_bank_or_a_folder_is_refused(path, tmp_path):
    for nothing in (path, tmp_path):
        with pytest.raises(BankError, match="cannot be read"):
            Bank.open(nothing)


def test_who_has_the_old_bank_open_keeps_it_when_a_new_one_is_written(path, make_bank):
    old = make_bank(path, seed=1)
    with Bank.open(path) as bank:
        make_bank(path, seed=2)
        assert bank.drive.words(0) == drive_words(old[0], IDLE_WORD).tobytes()


def test_words_stay_when_the_bank_is_closed_but_nothing_more_is_mapped(path, make_bank):
    responses = make_bank(path)
    with Bank.open(path) as bank:
        words = bank.drive.words(0)
    assert words == drive_words(responses[0], IDLE_WORD).tobytes()
    with pytest.raises(ValueError, match="closed"):
        bank.responses.response(0)
    with pytest.raises(ValueError, match="the bank is closed"):
        bank.file.map("drive")


@each_row("granularity", [4096, 16384, 65536], afresh=[path])
def test_sections_are_mapped_on_machines_with_larger_pages(path, granularity):
    data = np.random.default_rng(0).bytes(40 * PAGE)
    path.write_bytes(data)
    with path.open("rb") as file:
        mapped = map_bytes(file.fileno(), 21 * PAGE, 9 * PAGE, granularity)
    assert mapped == data[21 * PAGE : 30 * PAGE]
    assert len(mapped.obj) == 9 * PAGE + 21 * PAGE % granularity  # it begins where such a machine can begin


def test_nothing_is_advised_for_what_cannot_be_read(tmp_path):
    """Followed, the advice would fail, or replace what is another's."""
    with pytest.raises(BankError, match=r"cannot be read \(Is a directory\)$"):
        Bank.open(tmp_path)
    with pytest.raises(BankError, match=r"cannot be read \(No such file or directory\); build it: haptic-panel bank build"):
        Bank.open(tmp_path / "none.bank")


def test_a_name_in_a_bank_that_is_no_name_is_not_shown(path, make_bank):
    make_bank(path, board="x\nhaptic-panel: all is well")
    path.write_bytes(path.read_bytes()[:-1] + b"\1")
    with Bank.open(path) as bank:
        assert bank.rebuild.startswith("haptic-panel bank build --board NAME --out ")


POINTS = ((3, -4, 0), (3, 7, 16))


def test_a_composition_is_read_and_checked_once_and_a_damaged_one_is_taken_out(path, make_bank):
    words = np.arange(9, dtype=np.uint32)
    make_bank(path, compositions={POINTS: words})
    with Bank.open(path) as bank:
        for _ in range(2):
            frames, crc = bank.drive.composed(POINTS)
            unpacked = bytearray(36)
            assert unpack_loads(unpacked, frames) == crc
            assert bytes(unpacked) == words.tobytes()
        assert bank.counters.drive_checked == 1
        at = bank.sections["composed"].offset
        bank.drive.recheck_composed(POINTS)
        bank.drive.recheck_composed(POINTS[:1])  # there is none
        flip(path, at + 12, 1)
        bank.drive.composed(POINTS)  # was found good
        with pytest.raises(BankError, match="composition 0 is damaged; rebuild it: haptic-panel bank build"):
            bank.drive.recheck_composed(POINTS)
        assert not bank.drive.compositions
    with Bank.open(path) as bank, pytest.raises(BankError, match="is damaged"):
        bank.drive.composed(POINTS)


@each_row("steps", [(2, 1, 2, 0, 0, 0, 0, 5), (0,), (11,)], afresh=[path])
def test_a_table_of_compositions_that_cannot_be_is_refused(path, make_bank, monkeypatch, steps):
    packed = struct.Struct("<II30i")
    foreign = SimpleNamespace(pack=lambda *_: packed.pack(1, *steps, *[0] * (31 - len(steps))))
    monkeypatch.setattr("controller.workshop.bank_builder.writer.COMPOSITION", foreign)
    make_bank(path, compositions={POINTS: np.arange(9, dtype=np.uint32)})
    with pytest.raises(BankError, match=rf"composition of {steps[0]} points"):
        Bank.open(path)
