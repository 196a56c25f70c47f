"""boards/ulx3s/wiring.svg: what pins.lpf, board.toml and the netlists say, and these are what the compiled top is driven by."""

import re
from dataclasses import dataclass

from compiled_top import BOARD, channel_pins, pin, signal_pins, wires

from controller.device.board.board import load_board
from controller.workshop.benchmark.stage.stage_circuit import parameters

OF_README = {"SCK": "SCK", "chip select": "CS", "MOSI": "MOSI", "MISO": "MISO"}
# Of the 40-pin header of every Raspberry Pi
PI_PINS = {
    "GPIO8": 24,
    "GPIO9": 21,
    "GPIO10": 19,
    "GPIO11": 23,
    "GPIO22": 15,
    "GPIO23": 16,
    "GPIO24": 18,
    "GPIO25": 22,
    "GPIO27": 13,
}
SPI_LINES = {"SCK": "GPIO11", "chip select": "GPIO8", "MOSI": "GPIO10", "MISO": "GPIO9"}  # spidev0.0


@dataclass(frozen=True)
class Pin:
    """One pin of a header: its name on the board (GP0), header (J1) and contact (5+), and the signal on it."""

    name: str
    header: str
    contact: str
    signal: str


@dataclass(frozen=True)
class Wire:
    """One wire from a pin of the FPGA: the other end, what kind it is, and the resistor to ground on it in ohm, if any."""

    pin: Pin
    end: str
    kind: str
    pull_down_ohm: float | None = None


def header_pins() -> list[Pin]:
    """Pins of both headers that have a signal, in the order of pins.lpf."""
    row = re.compile(r'^LOCATE COMP "(g[pn])\[(\d+)\]" .*; # (J\d)_(\d+[+-]) (.*)$', re.MULTILINE)
    found = [
        Pin(f"{side.upper()}{number}", header, contact, text.partition(":")[0])
        for side, number, header, contact, text in row.findall((BOARD / "pins.lpf").read_text())
    ]
    return [pin for pin in found if pin.signal != "not used"]


def expected_wires() -> list[Wire]:
    """What is connected to each of these pins."""
    link, part = load_board(BOARD / "board.toml").link, parameters()
    lines = SPI_LINES | {"trigger": link.trigger_line, "configured": link.configured_line, "run permit": link.permit_line}
    made = []
    for each in header_pins():
        if channel := re.fullmatch(r"channel (\d+)", each.signal):
            made.append(Wire(each, f"stage {channel[1]}", "stage", part["pull_down_ohm"]))
        elif each.signal in ("hv_enable", "hv_alive"):
            made.append(
                Wire(
                    each,
                    f"{'switch' if each.signal == 'hv_enable' else 'charge pump'} of the 60 V supply",
                    "safety",
                    part["supply_pull_down_ohm"],
                )
            )
        elif each.signal == "temperature good":
            made.append(Wire(each, "3.3 V by the switch that opens when hot", "safety", 10e3))
        elif each.signal in lines:
            line = str(lines[each.signal])
            made.append(Wire(each, f"{line}, pin {PI_PINS[line]}", "host", 10e3 if each.signal == "run permit" else None))
        else:
            made.append(Wire(each, "test point", "plain"))
    return made


def drawn_texts():
    """(y, text) of all texts of the drawing."""
    found = re.findall(r'<text[^>]* y="([0-9.]+)"[^>]*>([^<]+)</text>', (BOARD / "wiring.svg").read_text())
    return [(float(y), text) for y, text in found]


def test_the_drawing_has_a_line_for_each_wire_and_no_other():
    """Contact, pin, signal, other end, and the resistor a little below."""
    texts = drawn_texts()
    lines = [
        {text for y, text in texts if abs(y - at) < 1} | {text for y, text in texts if 4 < y - at < 6}
        for at, name in texts
        if re.fullmatch(r"G[PN]\d+", name)
    ]
    assert lines == [
        {wire.pin.contact, wire.pin.name, wire.pin.signal, f"Pi {wire.end}" if wire.kind == "host" else wire.end}
        | ({f"{wire.pull_down_ohm / 1e3:g} kΩ"} if wire.pull_down_ohm else set())
        for wire in sorted(expected_wires(), key=lambda wire: wire.pin.header)
    ]


def test_each_pin_has_the_signal_that_the_readme_and_the_verilog_give_it():
    expected = {f"channel {channel}": bit for channel, bit in enumerate(channel_pins())} | signal_pins()
    found = {OF_README.get(each.signal, each.signal): pin(each.name) for each in header_pins()}
    assert found == {name: bit for name, bit in expected.items() if name in found}
    assert set(expected) - set(found) == {"UART"} & set(expected)
    assert len(found) == 32 + 13


def test_each_line_of_the_host_goes_where_the_readme_says():
    of_host = [wire for wire in expected_wires() if wire.kind == "host"]
    assert {wire.end.partition(",")[0]: pin(wire.pin.name) for wire in of_host} == wires()
    text = (BOARD / "README.md").read_text()
    for wire in of_host:
        assert re.search(rf"\b{re.search('pin ([0-9]+)', wire.end)[1]}\b", text)


def test_whatever_switches_60_v_has_a_pull_down_and_so_have_the_permits():
    for wire in expected_wires():
        if wire.kind in ("stage", "safety") or wire.pin.signal == "run permit":
            assert wire.pull_down_ohm in (parameters()["pull_down_ohm"], 10e3), wire
