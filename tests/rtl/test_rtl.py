"""Runs every bench tb_<module>.py against fpga_rtl/<module>.v, from a random initial state."""

import shutil
from pathlib import Path

import panel
import pytest
from cocotb_tools.runner import get_runner

RTL = Path(__file__).parent.parent.parent / "fpga_rtl"
BENCHES = {
    "haptic_core": panel.PARAMETERS,
}
SEED = 2015  # of the random numbers in benches and of the initial state


@pytest.fixture(scope="session")
def runtime(tmp_path_factory):
    """Where the first build leaves Verilator's own object files for the later ones: most of a build's time."""
    return tmp_path_factory.mktemp("runtime")


@pytest.mark.parametrize("module", BENCHES)
def test_bench(module, simulator, runtime, tmp_path):
    runner = get_runner(simulator)
    verilator = simulator == "verilator"
    for compiled in runtime.iterdir():
        shutil.copy2(compiled, tmp_path)
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
    for compiled in tmp_path.glob("verilated*.o"):
        shutil.copy2(compiled, runtime)
    runner.test(
        hdl_toplevel=module,
        test_module=f"tb_{module}",
        build_dir=tmp_path,
        test_dir=tmp_path,
        seed=SEED,
        plusargs=["+verilator+rand+reset+2", f"+verilator+seed+{SEED}"] if verilator else [],
    )
