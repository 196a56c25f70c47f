"""The FPGA behind a board's top.v: fpga.toml, from which `haptic-panel gateware build` knows how its bitstream is made."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from msgspec import Meta

from controller.board.lookup import board_places, find_board
from controller.board.records import Record, load_toml
from controller.errors import ConfigError

FILE = "fpga.toml"
TOP = "top.v"

Name = Annotated[str, Meta(pattern=r"^[A-Za-z0-9_-]+\Z")]


class FpgaPart(Record, frozen=True, kw_only=True):
    """The whole fpga.toml.

    Attributes
    ----------
    family
        Which of nextpnr's programs places it.
    devices
        Sizes that fit the board with the same pins, as nextpnr calls them; the first is built unless another is asked for.
    package
        Its package, as nextpnr calls it.
    speed
        Speed grade; left out where the family has none.
    constraints
        File with its pins, beside this one.
    seed
        Of nextpnr's placement: one that is known to meet the clock.
    """

    family: Literal["ecp5", "ice40"]
    devices: Annotated[tuple[Name, ...], Meta(min_length=1)]
    package: Name
    speed: Annotated[int, Meta(ge=1, le=9)] | None = None
    constraints: Annotated[str, Meta(pattern=r"^[\w-]+\.(lpf|pcf)\Z")]
    seed: Annotated[int, Meta(ge=1)] = 1


def load_part(folder: Path) -> FpgaPart:
    """Read the fpga.toml of a board.

    Parameters
    ----------
    folder : Path
        Of the board.

    Raises
    ------
    ConfigError
        If it has none, or an invalid one; the message lists boards that have one.
    """
    if not (folder / FILE).is_file():
        known = sorted({file.parent.name for place in board_places() for file in place.glob(f"*/{FILE}")})
        raise ConfigError(
            f"{folder}: has no {FILE}, so no gateware of its own; give the board whose top.v it uses: --top {' or '.join(known)}"
        )
    return load_toml(folder / FILE, FpgaPart)


def find_part(board: Path, top: str | None) -> tuple[Path, FpgaPart]:
    """Folder of top.v and pins for a board, and what they are for.

    Parameters
    ----------
    board : Path
        Folder of the board.
    top : str, optional
        Name or folder of the board whose top.v is built in its place.
    """
    folder = find_board(top) if top else board
    return folder, load_part(folder)
