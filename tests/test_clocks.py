"""Two clocks: that mypy finds where their times are mixed."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROGRAM = """\
from controller.clocks import FpgaTime
from controller.device.fpga.clock_estimate import ClockEstimate
from controller.device.loop.scheduler import Scheduler

def mixed(estimate: ClockEstimate, scheduler: Scheduler, now_s: float, fpga_s: FpgaTime) -> None:
"""
RIGHT = [
    "estimate.host_s(fpga_s) - now_s",
    "estimate.fpga_s(now_s) < fpga_s + 1e-3",
    "scheduler.advance(fpga_s - 1e-3)",
    "scheduler.advance(now_s + estimate.offset_s)",
    "fpga_s - estimate.offset_s < now_s",
    "max(fpga_s - fpga_s, 1e-3)",
]
WRONG = [
    "estimate.host_s(now_s)",
    "estimate.fpga_s(fpga_s)",
    "now_s - estimate.offset_s",
    "fpga_s + estimate.offset_s",
    "now_s < fpga_s",
    "fpga_s + fpga_s",
    "now_s - fpga_s",
    "scheduler.advance(now_s)",
    "max(now_s, fpga_s) + 1.0",
]


@pytest.fixture(scope="module")
def wrong_lines(tmp_path_factory):
    """Lines of RIGHT and WRONG that mypy refuses."""
    program = tmp_path_factory.mktemp("mixed") / "mixed.py"
    program.write_text(PROGRAM + "".join(f"    {line}\n" for line in (*RIGHT, *WRONG)))
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--cache-dir",
        f"{sys.prefix}/mypy_cache",
        "--follow-imports=silent",
        "--no-error-summary",
        str(program),
    ]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert not said.stderr
    numbers = {int(line.split(":")[1]) - PROGRAM.count("\n") for line in said.stdout.splitlines() if ": error: " in line}
    return {(*RIGHT, *WRONG)[number - 1] for number in numbers}


@pytest.mark.kernel
def test_host_time_and_fpga_time_that_are_mixed_are_type_errors(wrong_lines):
    assert wrong_lines == set(WRONG)
