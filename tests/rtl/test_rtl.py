"""Runs every bench tb_<module>.py against fpga_rtl/<module>.v, from a random initial state."""

from pathlib import Path

import numpy as np
import panel
import pytest
from cocotb_tools.runner import get_runner

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
    "stage_limits": {"WINDOW_TICKS": 200},
}
PITCH_M = 5e-3
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
def test_bench(module, simulator, one_entry_bank, tmp_path, monkeypatch):
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
        build_args=["-Wall", "--x-initial", "unique"] if verilator else ["-g2005"],
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
