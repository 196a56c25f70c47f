"""After the first call nothing is taken from the allocator that it would have to ask the kernel for."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from controller.device.bank.grid import Grid
from controller.device.kernel import COMPILED

SOURCE = Path(__file__).with_name("large_allocations.c")
GRID = Grid(2.5e-3, 9, 8, 5e-3, 6e-3)
SCRIPT = Path(__file__).with_name("compose_and_count.py")


@pytest.fixture(scope="module")
def counter(tmp_path_factory):
    library = tmp_path_factory.mktemp("allocations") / "large_allocations.so"
    subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-O1", "-o", library, SOURCE], check=True)
    return library


@pytest.mark.skipif(not COMPILED, reason="NumPy takes memory for each step")
def test_composing_takes_no_block_over_512_bytes(counter, tmp_path, make_bank):
    make_bank(tmp_path / "bank", GRID, samples=1000, responses=None, seed=3)
    environment = os.environ | {"LD_PRELOAD": str(counter), "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, SCRIPT, str(counter), str(tmp_path / "bank")]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    counts = json.loads(run.stdout)
    assert counts["packbits"][0] >= 1, "a block is noticed"
    assert counts["composing"] == [0, 0]
