"""Runs every bench tb_<module>.py against fpga_rtl/<module>.v, from a random initial state."""

from pathlib import Path

import numpy as np
import panel
import pytest
from cocotb_tools.runner import get_runner

from controller.bank.grid import Grid
from controller.offline.bank_builder import build_bank

RTL = Path(__file__).parent.parent.parent / "fpga_rtl"
BUILT_IN = {  # of register_file: limits that no others could be taken for
    "CLOCK_HZ": 20_000_050,
    "SLOTS": 3,
    "BUILD_HASH": 0x600DF00D,
    "BOARD": 0x204D4953,
    "EDGE_WINDOW_TICKS": 123_456,
    "HEARTBEAT_TICKS_MAX": 60_000,
    "PULSE_TICKS_MIN": 6,
    "CHANNEL_EDGES_MAX": 1234,
    "TOTAL_EDGES_MAX": 9999,
    "EMISSION_TICKS_MAX": 200_000,
    "DUTY_SHARE_MAX": 30_000,
    "DUTY_TICKS_MAX": 1_000_000,
}
BENCHES = {  # by module, and behind a hyphen which of several ways to build it
    "haptic_core": panel.PARAMETERS,
    "crc32": {},
    "crc32_word": {},
    "spi_peripheral": {},
    "status_encoder": {},
    "frame_decoder": {},
    "register_file": BUILT_IN,
    "register_file-slow": BUILT_IN | {"CLOCK_HZ": 1_000_000, "PULSE_TICKS_MIN": 4},  # fewer than four clocks a bit at 2 MHz
    "waveform_buffer": {"SLOTS": 2, "BUFFER_BITS": 2},
    "waveform_buffer-fewest": {"SLOTS": 1, "BUFFER_BITS": 1},
    "waveform_buffer-most": {"SLOTS": 16, "BUFFER_BITS": 5},
    "play_check": {},
    "play_queue": {},
    "idle_ramp": {},
    "waveform_player": {},
    "output_gate": {"ALIVE_HALF_TICKS": 7},
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


@pytest.mark.parametrize("bench", BENCHES)
def test_bench(bench, simulator, one_entry_bank, tmp_path, monkeypatch):
    module = bench.partition("-")[0]
    monkeypatch.setenv("HAPTIC_PANEL_TEST_BANK", str(one_entry_bank))
    runner = get_runner(simulator)
    verilator = simulator == "verilator"
    runner.build(
        sources=sorted(RTL.glob("*.v")),
        includes=[RTL],
        hdl_toplevel=module,
        parameters=BENCHES[bench],
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
