"""What nextpnr placed and routed, as Verilog again: each cell as the data sheets describe it (ECP5: FPGA-DS-02012, TN-02204).

Made of the netlist that nextpnr writes (`--write`), cell by cell and without the vendors' or Yosys' models: what synthesis, mapping
to block and distributed RAM, packing and constant inputs made of the design is all in it. Tables of a Gowin's ALU are apycula's
(doc/alu.md), of which its bitstream is made.
"""

import itertools
import json
import re
from collections import defaultdict

LOW, HIGH = "1'b0", "1'b1"
BITS = "bits"
PORTS = {"output": "output wire", "input": "input wire", "inout": "inout wire"}


def verilog(netlist):
    """Verilog-2005 of a routed netlist (text of its JSON file), with the ports of its top."""
    (top,) = json.loads(netlist)["modules"].values()
    gowin = any(cell["type"] == "rPLL" for cell in top["cells"].values())
    return "\n".join((GowinNetlist if gowin else Netlist)(top).lines())


class Netlist:
    """Nets are named n and their number; an input without a net is high, as in the FPGA."""

    def __init__(self, top):
        self.ports, self.cells = top["ports"], top["cells"]
        self.pads = {}
        for name, port in self.ports.items():
            for index, bit in enumerate(port["bits"]):
                self.pads[bit] = f"{name}[{index}]" if len(port["bits"]) > 1 else name
        self.flip_flops = defaultdict(list)

    @property
    def made(self):
        return {
            "TRELLIS_COMB": self.comb,
            "TRELLIS_FF": self.flip_flop,
            "TRELLIS_RAMW": self.write_side,
            "TRELLIS_IO": self.pad,
            "DP16KD": self.block_ram,
            "DCCA": self.buffer,
            "EHXPLLL": self.pll,
            "OSCG": self.oscillator,
        }

    def lines(self):
        made = self.made
        body = [line for name, cell in self.cells.items() for line in made[cell["type"]](Cell(name, cell))]
        nets = sorted({bit for cell in self.cells.values() for bits in cell["connections"].values() for bit in bits})
        assert all(isinstance(net, int) for net in nets), "constants are cells in a routed netlist"
        heads = [
            f"    {PORTS[port['direction']]} {f'[{len(port[BITS]) - 1}:0] ' * (len(port[BITS]) > 1)}{name}"
            for name, port in self.ports.items()
        ]
        stored = {q for members in self.flip_flops.values() for q, _, _ in members}
        yield "module top (\n" + ",\n".join(heads) + "\n);"
        for net in nets:
            yield f"{'reg' if f'n{net}' in stored else 'wire'} n{net};"
        yield from body
        yield from self.registers()
        yield "endmodule"

    def comb(self, cell):
        """Look-up table, with the multiplexer behind it; half of a carry pair; or 16 bits of RAM."""
        mode, select = cell.text("MODE") or "LOGIC", ["D", "C", "B", "A"]
        if mode == "RAMW_BLOCK":
            return
        if mode == "DPRAM":
            memory = cell.own("memory")
            yield f"reg [15:0] {memory} = 16'd0;"
            assert cell.text("WCKMUX") == "WCK"
            assert set(cell.text("INITVAL")) == {"0"}
            yield f"assign {cell.out('F')} = {memory}[{cell.bus(['A', 'C', 'B', 'D'])}];"  # in the order of the write side
            write = f"{memory}[{cell.bus(['WAD3', 'WAD2', 'WAD1', 'WAD0'])}] <= {cell.pin('WD')}"
            yield f"always @(posedge {cell.pin('WCK')}) if ({cell.pin('WRE')}) {write};"
            return
        table = function(cell.text("INITVAL"), [cell.pin(name) for name in select])
        if mode == "CCU2":
            four, two = cell.own("four"), cell.own("two")
            injected = cell.text("CCU2_INJECT1") == "YES"
            yield f"wire {four} = {table};"
            of_two = function(cell.text("INITVAL")[-4:], [cell.pin("B"), cell.pin("A")])
            carry = cell.pin("FCI")
            yield f"wire {two} = {LOW if injected else of_two};"
            if cell.net("F"):
                yield f"assign {cell.out('F')} = {four} ^ {LOW if injected else carry};"
            if cell.net("FCO"):
                yield f"assign {cell.out('FCO')} = {four} ? {carry} : {two};"
            return
        assert mode == "LOGIC", mode
        if cell.net("F"):
            yield f"assign {cell.out('F')} = {table};"
        if cell.net("OFX"):
            high, low = ("F1", "F") if cell.net("F1") else ("FXB", "FXA")
            yield f"assign {cell.out('OFX')} = {cell.pin('M')} ? {cell.pin(high)} : {cell.pin(low)};"

    def flip_flop(self, cell):
        """Collected by what they share: see `registers`."""
        assert cell.text("GSR") == "DISABLED"
        assert cell.text("LSRMODE") in {"", "LSR"}
        reset = cell.pin("LSR") if cell.net("LSR") else None  # nextpnr turns it off where there is none
        assert reset is None or cell.text("SRMODE") in {"LSR_OVER_CE", "ASYNC"}
        edge = "negedge" if cell.text("CLKMUX") == "INV" else "posedge"
        enable = None if cell.text("CEMUX") == "1" else cell.pin("CE")
        data = cell.pin("DI" if cell.text("SD") == "1" else "M")
        key = (f"{edge} {cell.raw('CLK')}", enable, reset, reset is not None and cell.text("SRMODE") == "ASYNC")
        self.flip_flops[key].append((cell.out("Q"), data, "1'b1" if cell.text("REGSET") == "SET" else "1'b0"))
        return ()

    def registers(self):
        """All flip-flops; after configuration each has the value of its reset."""
        for (edge, enable, reset, at_once), members in self.flip_flops.items():
            yield "initial begin " + " ".join(f"{q} = {value};" for q, _, value in members) + " end"
            load = "begin " + " ".join(f"{q} <= {data};" for q, data, _ in members) + " end"
            if enable:
                load = f"if ({enable}) {load}"
            if reset:
                load = f"if ({reset}) begin " + " ".join(f"{q} <= {value};" for q, _, value in members) + f" end else {load}"
            if at_once:
                falls = re.fullmatch(r"\(~(n\d+)\)", reset)
                assert falls or re.fullmatch(r"n\d+", reset), "an edge of a net"
                when = f"{edge} or negedge {falls[1]}" if falls else f"{edge} or posedge {reset}"
            yield f"always @({when if at_once else edge}) {load}"

    def write_side(self, cell):
        """What takes data and address of a write from a slice's inputs to the RAM of its neighbours."""
        ways = {"WDO0": "C1", "WDO1": "A1", "WDO2": "D1", "WDO3": "B1", "WADO0": "D0", "WADO1": "B0", "WADO2": "C0", "WADO3": "A0"}
        for to, of in ways.items():
            if cell.net(to):
                yield f"assign {cell.out(to)} = {cell.pin(of)};"

    def pad(self, cell):
        """A pin, which is an input or an output for good: nextpnr enables the driver of any other whose enable has no net."""
        pad = self.pads[cell.net("B")]
        assert cell.text("DIR") in {"INPUT", "OUTPUT"}, pad
        if cell.text("DIR") == "OUTPUT":
            assert not cell.net("T")
            yield f"assign {pad} = {cell.pin('I')};"
        elif cell.net("O"):
            yield f"assign {cell.out('O')} = {pad};"

    def block_ram(self, cell):
        """Written by port A, read by port B, both as wide; with 36 bits each takes the data pins of both."""
        width, size = int(cell.text("DATA_WIDTH_A"), 2), {1: 0, 2: 1, 4: 2, 9: 3, 18: 4, 36: 5}
        assert int(cell.text("DATA_WIDTH_B"), 2) == width
        assert {cell.text(f"REGMODE_{port}") for port in "AB"} == {"NOREG"}
        assert {cell.text(f"{name}MUX") for name in ("WEB", "RSTA", "RSTB")} == {"INV"}  # of a high input: never
        assert not any(cell.net(name) for name in ("WEB", "RSTA", "RSTB"))
        assert not int("".join(cell.text(name) for name in cell.names("INITVAL_")) or "0", 2)
        rows = 1 << 14 - size[width]
        address = {port: cell.bus([f"AD{port}{bit}" for bit in range(13, size[width] - 1, -1)]) for port in "AB"}
        own = [f"{port}{bit}" for port in ("A", "B") for bit in range(18)][:width]
        memory, read = cell.own("memory"), cell.own("read")
        yield f"reg [{width - 1}:0] {memory} [0:{rows - 1}];"
        yield f"integer {cell.own('row')}; initial for ({cell.own('row')} = 0; {cell.own('row')} < {rows};"
        yield f"    {cell.own('row')} = {cell.own('row')} + 1) {memory}[{cell.own('row')}] = {width}'d0;"
        yield f"reg [{width - 1}:0] {read} = {width}'d0;"
        yield f"always @(posedge {cell.raw('CLKB')}) if ({cell.pin('CEB')}) {read} <= {memory}[{address['B']}];"
        yield f"always @(posedge {cell.raw('CLKA')}) if ({cell.pin('CEA')} && {cell.pin('WEA')}) begin"
        for low in range(0, width, 9):  # address bits that such a width leaves are its byte enables
            high = min(low + 8, width - 1)
            data = cell.bus([f"DI{own[bit]}" for bit in range(high, low - 1, -1)])
            byte = f"if ({cell.pin(f'ADA{low // 9}')}) " if width >= 18 else ""
            yield f"    {byte}{memory}[{address['A']}][{high}:{low}] <= {data};"
        yield "end"
        for bit, name in enumerate(own if width == 36 else [f"B{bit}" for bit in range(width)]):
            if cell.net(f"DO{name}"):
                yield f"assign {cell.out(f'DO{name}')} = {read}[{bit}];"

    def buffer(self, cell):
        """The clock's way into its network."""
        assert not cell.net("CE")
        yield f"assign {cell.out('CLKO')} = {cell.pin('CLKI')};"

    def pll(self, cell):
        """As the board's bench models it."""
        values = {name: int(value, 2) if set(value) <= set("01") else f'"{value}"' for name, value in cell.parameters.items()}
        reported = ", ".join(f".{name}({value})" for name, value in values.items())
        wired = ", ".join(f".{name}(n{cell.net(name)})" for name in cell.connections if cell.net(name))
        yield f"EHXPLLL #({reported}) pll ({wired});"

    def oscillator(self, cell):
        """As the board's bench models it."""
        yield f"OSCG #(.DIV({int(cell.text('DIV'), 2)})) oscillator (.OSC({cell.out('OSC')}));"


class GowinNetlist(Netlist):
    """Of a GW2A; an input without a net is low."""

    ALU = {"2": "0110000010011010", "C2L": "0" * 16, "ONE2C": "0" * 12 + "1" * 4}  # noqa: RUF012

    @property
    def made(self):
        kinds = {f"LUT{inputs}": self.lut for inputs in range(1, 5)} | {f"MUX2_LUT{inputs}": self.mux for inputs in range(5, 9)}
        kinds |= {"".join(("DFF", *of)): self.flip_flop for of in itertools.product(("", "N"), ("", *"SRPC"), ("", "E"))}
        kinds |= {"ALU": self.alu, "RAM16SDP4": self.small_ram, "IBUF": self.pad, "OBUF": self.pad}
        kinds |= dict.fromkeys(("DP", "SDP"), self.block_ram)
        return (
            kinds
            | {"rPLL": self.pll, "OSC": self.oscillator, "GOWIN_GND": self.constant, "GOWIN_VCC": self.constant}
            | {
                "GSR": self.left,  # of a reset at configuration, which all have anyway
                "BUFG": self.left,  # routed: its load is wired to its driver
            }
        )

    def left(self, cell):
        assert not cell.net("O")
        return ()

    def constant(self, cell):
        pin = cell.kind[6]
        if cell.net(pin):
            yield f"assign {cell.out(pin)} = {LOW if pin == 'G' else HIGH};"

    def lut(self, cell):
        count = int(cell.kind[3:])
        table = cell.text("INIT").zfill(1 << count)[-(1 << count) :]
        yield f"assign {cell.out('F')} = {function(table, [cell.low(f'I{place}') for place in reversed(range(count))])};"

    def mux(self, cell):
        yield f"assign {cell.out('O')} = {cell.low('S0')} ? {cell.low('I1')} : {cell.low('I0')};"

    def alu(self, cell):
        """A look-up table before the carry chain, whose lowest quarter is also what the carry is where the rest says so."""
        raw = cell.text("RAW_ALU_LUT")
        mode = cell.text("ALU_MODE")
        table = raw[-16:] if raw else self.ALU[mode if mode in self.ALU else str(int(mode, 2))]
        assert cell.net("I2") is None or self.high(cell.net("I2"))
        first, second = cell.low("I0"), cell.low("I1")
        chosen, carry, spread = function(table[-4:], [second, first]), cell.low("CIN"), cell.own("spread")
        yield f"wire {spread} = {function(table, [cell.low('I3'), HIGH, second, first])};"
        if cell.net("SUM"):
            yield f"assign {cell.out('SUM')} = {spread} ^ {carry};"
        if cell.net("COUT"):
            yield f"assign {cell.out('COUT')} = {spread} ? {carry} : {chosen};"

    def high(self, net):
        return any(cell["type"] == "GOWIN_VCC" and net in cell["connections"]["V"] for cell in self.cells.values())

    def flip_flop(self, cell):
        """Collected by what they share: see `registers`."""
        edge, kind, enable = re.fullmatch(r"DFF(N?)([SRPC]?)(E?)", cell.kind).groups()
        port = {"": None, "S": "SET", "R": "RESET", "P": "PRESET", "C": "CLEAR"}[kind]
        reset = f"n{cell.net(port)}" if port and cell.net(port) else None
        clock = f"{'negedge' if edge else 'posedge'} {cell.low('CLK')}"
        at_once = reset is not None and kind in ("P", "C")
        start = HIGH if kind in ("S", "P") else LOW
        key = (clock, cell.low("CE") if enable else None, reset, at_once)
        self.flip_flops[key].append((cell.out("Q"), cell.low("D"), start))
        return ()

    def small_ram(self, cell):
        """Sixteen words, read by its look-up tables."""
        memory = cell.own("memory")
        assert not any(int(cell.text(name) or "0", 2) for name in cell.names("INIT"))
        assert cell.net("CE") is None or self.high(cell.net("CE"))
        yield f"reg [3:0] {memory} [0:15];"
        yield f"integer {cell.own('row')}; initial for ({cell.own('row')} = 0; {cell.own('row')} < 16;"
        yield f"    {cell.own('row')} = {cell.own('row')} + 1) {memory}[{cell.own('row')}] = 4'd0;"
        write = f"{memory}[{cell.lows('WAD', 4)}] <= {cell.lows('DI', 4)}"
        yield f"always @(posedge {cell.low('CLK')}) if ({cell.low('WRE')}) {write};"
        for bit in range(4):
            if cell.net(f"DO{bit}"):
                yield f"assign {cell.out(f'DO{bit}')} = {memory}[{cell.lows('RAD', 4)}][{bit}];"

    def block_ram(self, cell):
        """Written by port A, read by port B, both as wide, without a register at its output."""
        width = int(cell.text("BIT_WIDTH_0"), 2)
        two, nine = cell.kind == "DP", width % 9 == 0
        assert width == int(cell.text("BIT_WIDTH_1"), 2)
        assert {cell.text(name) for name in cell.names("READ_MODE")} == {"0"}
        assert {cell.text(name) for name in cell.names("BLK_SEL")} == {"000"}
        assert not any(int(cell.text(name) or "0", 2) for name in cell.names("INIT_RAM"))
        low = (width // 9 if nine else width).bit_length() + (2 if nine else -1)
        rows = 1 << 14 - low
        address = {port: "{" + ", ".join(cell.low(f"AD{port}{bit}") for bit in range(13, low - 1, -1)) + "}" for port in "AB"}
        memory, read = cell.own("memory"), cell.own("read")
        yield f"reg [{width - 1}:0] {memory} [0:{rows - 1}];"
        yield f"integer {cell.own('row')}; initial for ({cell.own('row')} = 0; {cell.own('row')} < {rows};"
        yield f"    {cell.own('row')} = {cell.own('row')} + 1) {memory}[{cell.own('row')}] = {width}'d0;"
        yield f"reg [{width - 1}:0] {read} = {width}'d0;"
        selected = {port: " && ".join(f"!{cell.low(f'BLKSEL{port}{bit}')}" for bit in range(3)) for port in "AB"}
        reads = f"{cell.low('CEB')} && {selected['B']}" + (f" && !{cell.low('WREB')}" if two else "")
        yield f"always @(posedge {cell.low('CLKB')}) if ({reads}) {read} <= {memory}[{address['B']}];"
        writes = f"{cell.low('CEA')} && {selected['A']}" + (f" && {cell.low('WREA')}" if two else "")
        yield f"always @(posedge {cell.low('CLKA')}) if ({writes}) begin"
        byte = 9 if nine else 8
        for lowest in range(0, width, byte):  # address bits that such a width leaves are its byte enables
            highest = min(lowest + byte, width) - 1
            data = "{" + ", ".join(cell.low(f"DI{'A' * two}{bit}") for bit in range(highest, lowest - 1, -1)) + "}"
            enable = f"if ({cell.low(f'ADA{lowest // byte}')}) " if width >= 2 * byte else ""
            yield f"    {enable}{memory}[{address['A']}][{highest}:{lowest}] <= {data};"
        yield "end"
        if two:
            assert not cell.net("WREB") or not self.high(cell.net("WREB"))
            assert not any(cell.net(f"DOA{bit}") and self.used(cell.net(f"DOA{bit}")) for bit in range(18)), "read by port A"
        for bit in range(width):
            name = f"DOB{bit}" if two else f"DO{bit}"
            if cell.net(name):
                yield f"assign {cell.out(name)} = {read}[{bit}];"

    def used(self, net):
        """Whether anything but its driver has the net."""
        return sum(net in bits for cell in self.cells.values() for bits in cell["connections"].values()) > 1

    def pad(self, cell):
        if cell.kind == "OBUF":
            yield f"assign {self.pads[cell.net('O')]} = {cell.low('I')};"
        elif cell.net("O"):
            yield f"assign {cell.out('O')} = {self.pads[cell.net('I')]};"

    def pll(self, cell):
        """As the board's bench models it."""
        names = ("IDIV_SEL", "FBDIV_SEL", "ODIV_SEL")
        reported = ", ".join(f".{name}({int(cell.text(name), 2)})" for name in names)
        wired = ", ".join(f".{name}(n{cell.net(name)})" for name in ("CLKIN", "CLKOUT", "LOCK") if cell.net(name))
        yield f"rPLL #({reported}) pll ({wired});"

    def oscillator(self, cell):
        """As the board's bench models it."""
        yield f"OSC #(.FREQ_DIV({int(cell.text('FREQ_DIV'), 2)})) oscillator (.OSCOUT({cell.out('OSCOUT')}));"


def function(table, inputs):
    """Expression of a look-up table, whose last digit is its value for inputs that are all low; the first input is the highest."""
    if set(table) in ({"0"}, {"1"}):
        return f"1'b{table[0]}"
    first, half = inputs[0], len(table) // 2
    high, low = table[:half], table[half:]
    if first in {LOW, HIGH} or high == low:
        return function(high if first == HIGH else low, inputs[1:])
    of_high, of_low = function(high, inputs[1:]), function(low, inputs[1:])
    forms = {(HIGH, LOW): first, (LOW, HIGH): f"~{first}"}
    if (of_high, of_low) in forms:
        return forms[of_high, of_low]
    if high == low.translate(str.maketrans("01", "10")):
        return f"({first} ^ {of_low})"
    for value, form in ((of_low, {LOW: "{0} & {1}", HIGH: "~{0} | {1}"}), (of_high, {LOW: "~{0} & {2}", HIGH: "{0} | {2}"})):
        if value in form:
            return f"({form[value].format(first, of_high, of_low)})"
    return f"({first} ? {of_high} : {of_low})"


class Cell:
    """A cell's parameters and nets."""

    numbers = iter(range(1 << 30))

    def __init__(self, name, cell):
        self.name, self.kind = name, cell["type"]
        self.parameters = cell["parameters"]
        self.connections = {  # pins of a bus are numbered, as those of most cells are anyway
            f"{pin}{place}" if len(bits) > 1 else pin: [bit]
            for pin, bits in cell["connections"].items()
            for place, bit in enumerate(bits)
        }
        self._number = next(self.numbers)

    def text(self, name):
        return self.parameters.get(name, "").strip()

    def names(self, start):
        return [name for name in self.parameters if name.startswith(start)]

    def own(self, what):
        """Name of something inside this cell."""
        return f"{what}_{self._number}"

    def net(self, pin):
        """Number of the net; None where there is none."""
        bits = self.connections.get(pin, [])
        return bits[0] if bits else None

    def out(self, pin):
        return f"n{self.net(pin)}"

    def raw(self, pin):
        return f"n{self.net(pin)}" if self.net(pin) is not None else "1'b1"

    def pin(self, pin):
        """An input behind the multiplexer that its cell has there."""
        chosen = self.text(f"{pin}MUX")
        if chosen in {"0", "1"}:
            return f"1'b{chosen}"
        return f"(~{self.raw(pin)})" if chosen == "INV" else self.raw(pin)

    def low(self, pin):
        """An input that is low where it has no net."""
        return f"n{self.net(pin)}" if self.net(pin) is not None else LOW

    def lows(self, name, width):
        """A bus of such inputs."""
        return "{" + ", ".join(self.low(f"{name}{bit}") for bit in reversed(range(width))) + "}"

    def bus(self, pins):
        return "{" + ", ".join(map(self.pin, pins)) + "}"
