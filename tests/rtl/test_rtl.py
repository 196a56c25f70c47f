"""Runs every bench of benches.py, then judges what they covered."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from benches import BENCHES, RUNS, SLOW_RUNS, make_variables
from verilog_coverage import MODULES, line_counts, load_waivers, read, readable, table, together, too_little, uncovered, waive

from controller.device.bank.grid import Grid
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest

PITCH_M = 5e-3
pytestmark = pytest.mark.gateware


@pytest.fixture(scope="session")
def one_entry_bank(board, tmp_path_factory):
    """A bank of the simulated board with one cell, whose entry the end-to-end bench plays."""
    cells = np.zeros(Grid.of(board.plate, PITCH_M).cells, bool)
    cells[len(cells) // 3] = True
    path = tmp_path_factory.mktemp("bank") / "one.bank"
    build_bank(BankRequest(board, path, PITCH_M, cells))
    return path


@pytest.fixture(scope="session")
def performed(request, simulator, one_entry_bank, tmp_path_factory):
    """The benches that are asked for, each in a process, as many at a time as there are cores: {bench: (folder, its future)}."""
    asked_for = [item for item in request.session.items if getattr(item, "originalname", "") == "test_bench"]
    folders = {run: tmp_path_factory.mktemp(run) for run in (item.callspec.params["run"] for item in asked_for)}
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        yield {run: (folder, pool.submit(perform, run, simulator, folder, one_entry_bank)) for run, folder in folders.items()}
        pool.shutdown(cancel_futures=True)


def perform(run, simulator, folder, bank, **variables):
    """One bench: its exit code and all that it said."""
    variables |= {"HAPTIC_PANEL_TEST_BANK": str(bank), "MAKEFLAGS": make_variables(run)}
    command = [sys.executable, Path(__file__).with_name("benches.py"), run, simulator, folder]
    path = os.pathsep.join(sys.path)  # as pytest's: the benches import what stands beside them
    environment = os.environ | variables | {"PYTHONPATH": path}
    return subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def passes(done):
    assert done.returncode == 0, done.stdout


@pytest.mark.slow
def test_the_core_does_what_the_model_does_through_a_thousand_random_frames(simulator, one_entry_bank, tmp_path):
    passes(perform("haptic_core", simulator, tmp_path, one_entry_bank, HAPTIC_PANEL_RANDOM_FRAMES="1000"))


@pytest.mark.parametrize("run", [*RUNS, *(pytest.param(run, marks=pytest.mark.slow) for run in SLOW_RUNS)])
def test_bench(run, performed, simulator, verilog_coverage):
    folder, future = performed[run]
    passes(future.result())
    if simulator == "verilator" and run in BENCHES:
        verilog_coverage[run] = read(folder / "coverage.dat")


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
