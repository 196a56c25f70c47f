"""Runs every bench of benches.py, then judges what they covered."""

import numpy as np
import pytest
from benches import BENCHES, RUNS, SLOW_RUNS, make_variables
from verilog_coverage import MODULES, line_counts, load_waivers, read, readable, table, together, too_little, uncovered, waive

from controller.device.bank.grid import Grid
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest

PITCH_M = 5e-3


@pytest.fixture(scope="session")
def one_entry_bank(board, tmp_path_factory):
    """A bank of the simulated board with one cell, whose entry the end-to-end bench plays."""
    cells = np.zeros(Grid.of(board.plate, PITCH_M).cells, bool)
    cells[len(cells) // 3] = True
    path = tmp_path_factory.mktemp("bank") / "one.bank"
    build_bank(BankRequest(board, path, PITCH_M, cells))
    return path


@pytest.fixture
def perform(simulator, one_entry_bank, tmp_path, monkeypatch):
    """One bench; it must pass."""

    def run_bench(run, **variables):
        variables |= {"HAPTIC_PANEL_TEST_BANK": str(one_entry_bank), "MAKEFLAGS": make_variables(run)}
        for name, value in variables.items():
            monkeypatch.setenv(name, value)
        (RUNS | SLOW_RUNS)[run](simulator=simulator, folder=tmp_path)

    return run_bench


@pytest.mark.slow
def test_the_core_does_what_the_model_does_through_a_thousand_random_frames(perform):
    perform("haptic_core", HAPTIC_PANEL_RANDOM_FRAMES="1000")


@pytest.mark.parametrize("run", [*RUNS, *(pytest.param(run, marks=pytest.mark.slow) for run in SLOW_RUNS)])
def test_bench(run, perform, simulator, verilog_coverage, tmp_path):
    perform(run)
    if simulator == "verilator" and run in BENCHES:
        verilog_coverage[run] = read(tmp_path / "coverage.dat")


@pytest.fixture
def all_benches(simulator, verilog_coverage):
    """What happened in each bench, once all have run."""
    if simulator != "verilator":
        pytest.skip("coverage is Verilator's")
    if set(verilog_coverage) != set(BENCHES):
        pytest.skip(f"coverage is evaluated after all {len(BENCHES)} benches, not {len(verilog_coverage)}")
    return verilog_coverage


def evaluated(benches):
    """Rows of the table, modules with too little, lines without cover and bad waivers of these benches."""
    hits = together(benches.values())
    counts, wrong = waive(line_counts(hits), load_waivers())
    rows = table(hits, counts, MODULES)
    return rows, too_little(rows), uncovered(counts), wrong


def test_the_benches_perform_the_lines_of_every_module(all_benches):
    rows, modules, lines, wrong = evaluated(all_benches)
    assert not modules, "\n".join([*readable(rows), *lines])
    assert not wrong


def test_a_bench_left_out_is_missed(all_benches):
    """The core's bench performs nearly everything; without it each module has its own."""
    modules = {module: bench for module, bench in all_benches.items() if module != "haptic_core"}
    assert "haptic_core" in evaluated(modules)[1]
    for module in ("spi_peripheral", "output_gate"):
        assert module not in evaluated(modules)[1]
        assert module in evaluated({name: bench for name, bench in modules.items() if name != module})[1]
