"""Work in forked processes: its results, its errors, and that nothing is left of them."""

import multiprocessing
import os

import pytest

from controller.errors import ConfigError
from controller.workshop.benchmark.processes import in_processes


def test_results_come_in_order_from_other_processes_and_none_is_left_behind():
    table = {number: number**2 for number in range(20)}
    found = list(in_processes(lambda number: (table[number], os.getpid()), range(20), 2))
    assert [square for square, _ in found] == list(table.values())
    assert os.getpid() not in {process for _, process in found}
    assert list(in_processes(lambda _: os.getpid(), range(3), 1)) == [os.getpid()] * 3
    unfinished = in_processes(lambda number: number, range(1000), 2)
    assert next(unfinished) == 0
    assert multiprocessing.active_children()
    unfinished.close()
    assert not multiprocessing.active_children()


def test_an_error_in_a_process_is_raised_here():
    def fail(number):
        raise ConfigError(f"piece {number}")

    with pytest.raises(ConfigError, match="piece 0"):
        list(in_processes(fail, range(4), 2))
    assert not multiprocessing.active_children()
