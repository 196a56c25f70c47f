"""Runs every bench tb_<module>.py against fpga_rtl/<module>.v, from a random initial state; then judges what they covered."""

from pathlib import Path

import numpy as np
import panel
import pytest
from cocotb_tools.runner import get_runner
from verilog_coverage import MODULES, line_counts, load_waivers, read, readable, table, together, too_little, uncovered, waive

from controller.bank.grid import Grid
from controller.offline.bank_builder import build_bank

RTL = Path(__file__).parent.parent.parent / "fpga_rtl"
BENCHES = {
    "haptic_core": panel.PARAMETERS,
    "crc32": {},
    "spi_peripheral": {},
    "status_encoder": {},
    "frame_decoder": {},
    "register_file": panel.PARAMETERS,
    "waveform_buffer": {"SLOTS": 2, "BUFFER_BITS": 2},
    "idle_ramp": {},
    "waveform_player": {},
    "output_gate": {"ALIVE_HALF_TICKS": 7},
}
PITCH_M = 5e-3
VERILATOR_ARGUMENTS = ["-Wall", "--x-initial", "unique", "--coverage-line", "--coverage-toggle"]  # --coverage crashes
SEED = 2015  # of the random numbers in benches and of the initial state


@pytest.fixture(scope="session")
def one_entry_bank(board, tmp_path_factory):
    """A bank of the simulated board with one cell, whose entry the end-to-end bench plays."""
    cells = np.zeros(Grid.of(board.plate, PITCH_M).cells, bool)
    cells[len(cells) // 3] = True
    path = tmp_path_factory.mktemp("bank") / "one.bank"
    build_bank(board, path, PITCH_M, cells, measure_sgemm=False)
    return path


@pytest.mark.parametrize("module", BENCHES)
def test_bench(module, simulator, one_entry_bank, verilog_coverage, tmp_path, monkeypatch):
    monkeypatch.setenv("HAPTIC_PANEL_TEST_BANK", str(one_entry_bank))
    runner = get_runner(simulator)
    verilator = simulator == "verilator"
    runner.build(
        sources=sorted(RTL.glob("*.v")),
        includes=[RTL],
        hdl_toplevel=module,
        parameters=BENCHES[module],
        timescale=("1ns", "1ps"),
        build_dir=tmp_path,
        build_args=VERILATOR_ARGUMENTS if verilator else ["-g2005"],
        log_file=tmp_path / "build.log",
    )
    runner.test(
        hdl_toplevel=module,
        test_module=f"tb_{module}",
        build_dir=tmp_path,
        test_dir=tmp_path,
        seed=SEED,
        plusargs=["+verilator+rand+reset+2", f"+verilator+seed+{SEED}"] if verilator else [],
    )
    if verilator:
        verilog_coverage[module] = read(tmp_path / "coverage.dat")


@pytest.fixture
def all_benches(simulator, verilog_coverage):
    """What happened in each bench, once all have run."""
    if simulator != "verilator":
        pytest.skip("coverage is Verilator's")
    if set(verilog_coverage) != set(BENCHES):
        pytest.skip(f"coverage is judged after all {len(BENCHES)} benches, not {len(verilog_coverage)}")
    return verilog_coverage


def judged(benches):
    """Rows of the table, modules with too little, lines without cover and bad waivers of these benches."""
    hits = together(benches.values())
    counts, wrong = waive(line_counts(hits), load_waivers())
    rows = table(hits, counts, MODULES)
    return rows, too_little(rows), uncovered(counts), wrong


def test_the_benches_perform_the_lines_of_every_module(all_benches):
    rows, modules, lines, wrong = judged(all_benches)
    assert not modules, "\n".join([*readable(rows), *lines])
    assert not wrong


def test_a_bench_left_out_is_missed(all_benches):
    """The core's bench performs nearly everything; without it each module has its own."""
    modules = {module: bench for module, bench in all_benches.items() if module != "haptic_core"}
    assert "haptic_core" in judged(modules)[1]
    for module in ("spi_peripheral", "output_gate"):
        assert module not in judged(modules)[1]
        assert module in judged({name: bench for name, bench in modules.items() if name != module})[1]
