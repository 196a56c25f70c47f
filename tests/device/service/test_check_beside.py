"""Responses checked by a process beside the start: what the loop then uses unchecked, and what it still checks itself."""

import os

import pytest

from controller.device.bank.reader import Bank
from controller.device.service.check_beside import check_responses_beside
from controller.errors import BankError


@pytest.fixture
def bank(bank_file, tmp_path, board):
    """A bank whose tenth response is damaged."""
    file = tmp_path / "own.bank"
    whole = bytearray(bank_file.read_bytes())
    with Bank.open(bank_file) as sound:
        section = sound.sections["response"]
    whole[section.offset + 9 * section.stride + 5] ^= 1
    file.write_bytes(whole)
    with Bank.open(file, board) as opened:
        yield opened


def checked_beside(bank, cells):
    """Until the process has ended, which nobody waits for: its end of a pipe is closed then."""
    reads, writes = os.pipe()
    check_responses_beside(bank, cells)
    os.close(writes)
    assert os.read(reads, 1) == b""
    os.close(reads)


def test_what_it_found_good_is_used_without_another_check_and_damage_is_said_once(bank, capfd):
    cells = bank.cells.nonzero()[0].tolist()
    checked_beside(bank, cells[:40])
    assert bank.responses.tables()[2].tolist()[:42] == [1] * 9 + [0] + [1] * 30 + [0, 0]
    assert bank.counters.mapped_bytes == {}, "and nothing of it is in this process's memory"
    said = capfd.readouterr().err
    assert said.count("\n") == 1
    assert f"response of entry 9 (cell {cells[9]}) is damaged" in said
    bank.responses.response(cells[0])
    assert bank.counters.response_checked == 0
    with pytest.raises(BankError, match="response of entry 9"):
        bank.responses.response(cells[9])
    bank.responses.response(cells[40])
    assert bank.counters.response_checked == 2, "the damaged one, and one that was not checked beside"


def test_where_no_process_is_left_each_response_is_checked_when_it_is_used(bank, monkeypatch):
    def none_left():
        raise BlockingIOError

    monkeypatch.setattr(os, "fork", none_left)
    check_responses_beside(bank, [0, 1])
    assert not any(bank.responses.tables()[2])
    bank.responses.response(0)
    assert bank.counters.response_checked == 1
