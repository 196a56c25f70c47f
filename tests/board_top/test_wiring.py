"""boards/ulx3s/wiring.svg: drawn from the board's own tables, and these are those that the compiled top is driven by."""

import re

from compiled_top import BOARD, channel_pins, pin, signal_pins, wires

from controller.benchmark import wiring_diagram
from controller.benchmark.power_stage import parameters

OF_README = {"SCK": "SCK", "chip select": "CS", "MOSI": "MOSI", "MISO": "MISO"}


def test_the_picture_is_of_these_wires():
    text = (BOARD / "wiring.svg").read_text()
    assert f"wires {wiring_diagram.digest()}" in text
    drawn = re.findall(r"<text[^>]*>([^<]+)</text>", text)
    for wire in wiring_diagram.wires():
        assert f"Pi {wire.end}" in drawn or wire.end in drawn, wire
    assert drawn.count("3.3 kΩ") == 34


def test_each_pin_has_the_signal_that_the_readme_and_the_verilog_give_it():
    told = {f"channel {channel}": bit for channel, bit in enumerate(channel_pins())} | signal_pins()
    drawn = {OF_README.get(found.signal, found.signal): pin(found.name) for found in wiring_diagram.pins()}
    assert drawn == {name: bit for name, bit in told.items() if name in drawn}
    assert set(told) - set(drawn) == {"UART"} & set(told)
    assert len(drawn) == 32 + 13


def test_each_line_of_the_host_goes_where_the_readme_says():
    drawn = {wire.end.partition(",")[0]: pin(wire.pin.name) for wire in wiring_diagram.wires() if wire.kind == "host"}
    assert drawn == wires()
    text = (BOARD / "README.md").read_text()
    for wire in wiring_diagram.wires():
        if wire.kind == "host":
            assert re.search(rf"\b{re.search('pin ([0-9]+)', wire.end)[1]}\b", text)


def test_whatever_switches_60_v_has_a_pull_down_and_so_have_the_permits():
    for wire in wiring_diagram.wires():
        if wire.kind in ("stage", "safety") or wire.pin.signal == "run permit":
            assert wire.pull_down_ohm in (parameters()["pull_down_ohm"], 10e3), wire


def test_a_pin_that_moves_makes_the_picture_out_of_date(tmp_path, monkeypatch):
    before = wiring_diagram.digest()
    for name in ("pins.lpf", "board.toml"):
        (tmp_path / name).write_text((BOARD / name).read_text().replace("J1_5+ channel 0", "J1_5+ channel 9"))
    (tmp_path / "board.toml").write_text(
        (BOARD / "board.toml").read_text().replace("../simulated", str(BOARD.parent / "simulated"))
    )
    monkeypatch.setattr(wiring_diagram, "FOLDER", tmp_path)
    assert wiring_diagram.digest() != before
