"""The FPGA behind a board's top.v: fpga.toml, from which `haptic-panel gateware build` knows how its bitstream is made."""

import math
import re
from pathlib import Path
from typing import Annotated, Literal, NamedTuple

from msgspec import Meta

from controller.device.board.board import Board
from controller.device.board.lookup import board_places, find_board
from controller.device.board.records import Record, load_toml
from controller.errors import ConfigError

FILE = "fpga.toml"
TOP = "top.v"

Name = Annotated[str, Meta(pattern=r"^[A-Za-z0-9_-]+\Z")]


class Family(NamedTuple):
    """What goes with a family of FPGAs."""

    devices: str  # devices, example: pattern of its sizes, and one
    example: str
    pins: str  # ending of the files of pins
    clocks: str  # of the file of clocks beside it; empty where they are among the pins


FAMILIES = {
    "ecp5": Family(r"(um5?g?-)?(12k|25k|45k|85k)", "25k", ".lpf", ""),
    "gowin": Family(r"GW[\w-]+", "GW2A-18", ".cst", ".sdc"),
}
PLL = re.compile(r"\bPLL_HZ(?: *= *|\()32'd([\d_]+)")
SCK = re.compile(  # MHz in an .lpf, or ns of a period in an .sdc
    r'^FREQUENCY (?:PORT "spi_sck"|NET "core\.spi_link\.spi_sck_i") (?P<mhz>[\d.]+) MHZ;'
    r"|^create_clock -name spi_sck -period (?P<ns>[\d.]+) ",
    re.MULTILINE,
)
BAUD = re.compile(r"\.BAUD\(([\d_]+)\)")


class FpgaPart(Record, frozen=True, kw_only=True):
    """The whole fpga.toml.

    Attributes:
    family: Which of nextpnr's programs places it.
    devices: Sizes that fit the board with the same pins, as nextpnr calls them; the first is built unless another is asked for.
    package: Its package, as nextpnr calls it; for a Gowin the whole part number, with package and speed.
    speed: Speed grade, of an ECP5.
    constraints: File with its pins, beside this one; clocks of a Gowin are in one of the same name that ends in .sdc.
    seed: Of nextpnr's placement: one that is known to meet the clock.
    """

    family: Literal["ecp5", "gowin"]
    devices: Annotated[tuple[Name, ...], Meta(min_length=1)]
    package: Annotated[str, Meta(pattern=r"^[A-Za-z0-9/-]+\Z")]
    speed: Annotated[int, Meta(ge=1, le=9)] | None = None
    constraints: Annotated[str, Meta(pattern=r"^[\w-]+\.(lpf|cst)\Z")]
    seed: Annotated[int, Meta(ge=1)] = 1

    def __post_init__(self) -> None:
        family = FAMILIES[self.family]
        for device in self.devices:
            if not re.fullmatch(family.devices, device):
                raise ValueError(f"devices: {device!r} is no size of family {self.family!r}, such as {family.example!r}")
        if not self.constraints.endswith(family.pins):
            raise ValueError(f"constraints = {self.constraints!r}: pins of family {self.family!r} are in a file {family.pins}")
        if self.speed is not None and self.family == "gowin":
            raise ValueError(f"speed = {self.speed}: a Gowin has its speed in `package`; leave it out")

    @property
    def clocks(self) -> str:
        """File with its clocks."""
        ending = FAMILIES[self.family].clocks
        return self.constraints.rpartition(".")[0] + ending if ending else self.constraints

    @property
    def files(self) -> tuple[str, ...]:
        """Files beside fpga.toml that a bitstream is made of."""
        return tuple(dict.fromkeys((TOP, self.constraints, self.clocks)))


def load_part(folder: Path) -> FpgaPart:
    """Read the fpga.toml of a board.

    Raises ConfigError if it has none, or an invalid one; the message lists boards that have one.
    """
    if not (folder / FILE).is_file():
        known = sorted({file.parent.name for place in board_places() for file in place.glob(f"*/{FILE}")})
        raise ConfigError(
            f"{folder}: has no {FILE}, so no gateware of its own; give the board whose top.v it uses: --top {' or '.join(known)}"
        )
    return load_toml(folder / FILE, FpgaPart)


def find_part(board: Path, top: str | None) -> tuple[Path, FpgaPart]:
    """Folder of top.v and pins for the board in a folder, and what they are for.

    `top` is the name or folder of the board whose top.v is built in its place.
    """
    folder = find_board(top) if top else board
    part = load_part(folder)
    for name in part.files:
        if not (folder / name).is_file():
            raise ConfigError(f"{folder / FILE}: there is no {name} beside it")
    return folder, part


def check_top(board: Board, top: Path, clocks: str) -> None:
    """Refuse a board whose clock, baud rate or SCK is not that of top.v and clocks, before minutes of work; raises ConfigError."""
    text = (top / TOP).read_text(encoding="utf-8", errors="replace")
    link = board.link
    wanted = [("clock_hz", link.clock_hz, PLL)] + ([("baud", link.baud, BAUD)] if link.kind == "serial" else [])
    for key, value, written in wanted:
        found = written.search(text)
        if found and int(found[1].replace("_", "")) != value:
            raise ConfigError(
                f"{board.folder / 'board.toml'}: link.{key} = {value}, but {top / TOP} makes {found[1]}: set the same"
            )
    sck = SCK.search((top / clocks).read_text(encoding="utf-8", errors="replace"))
    sck_mhz = (float(sck["mhz"]) if sck["mhz"] else 1e3 / float(sck["ns"])) if sck else math.inf
    if link.kind == "spi" and sck_mhz * 1e6 < link.sck_hz:
        says = f"link.sck_hz = {link.sck_hz}, but {top / clocks} constrains SCK to {sck_mhz:g} MHz"
        raise ConfigError(f"{board.folder / 'board.toml'}: {says}: set the same")
