"""The C twin does the loop's work: every upload of some rounds of recordings, byte for byte."""

import pytest

from controller.device.bank.reader import Bank
from controller.device.touch import prediction
from tests.workshop.benchmark.host_latency import play
from tests.workshop.benchmark.twin import PLAIN, VECTORS_128

EMISSIONS = 700


@pytest.mark.slow
def test_the_twin_gives_the_bytes_that_the_loop_sends(board, bank_file, tmp_path):
    with Bank.open(bank_file, board) as bank:
        counters, twin = play(board, bank, EMISSIONS, tmp_path)
    assert twin.checked == counters.uploads > EMISSIONS / 2
    assert twin.composed > 50
    assert twin.played == counters.resident > 20
    for flags in (PLAIN, VECTORS_128):
        again = twin.replay(flags)
        assert (again["uploads"].count, again["resident"].count) == (twin.checked, twin.played)


def test_a_loop_that_predicts_otherwise_is_distinguished(board, bank_file, tmp_path, monkeypatch):
    monkeypatch.setattr(prediction, "ALPHA", 0.99 * prediction.ALPHA)
    with Bank.open(bank_file, board) as bank, pytest.raises(AssertionError, match=" differ"):
        play(board, bank, EMISSIONS, tmp_path)
