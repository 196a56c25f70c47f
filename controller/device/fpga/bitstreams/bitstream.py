"""What a bitstream says of itself: an identity and a seal in its header, which the FPGA skips, and a file of figures beside it.

Bitstreams of both FPGA families begin with comments: those of an ECP5 with FF 00, each ended by a zero byte, and all by FF; those
of a Gowin, which are text, with a line of each. The seal is the last of them, a SHA-256 of all others and of what follows: a file
that was cut off or damaged on its way is found before it is loaded.
"""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Final, NamedTuple

import msgspec

from controller.device.board.board import Board
from controller.device.board.validation import NO_JSON
from controller.device.fpga.build_parameters import top_parameters
from controller.device.fpga.configuration import LIMITS
from controller.errors import GatewareError
from controller.regular_file import open_regular, read_regular

KEY: Final = "Haptic-panel: "  # of the comment with the identity; tools that list comments split them at the colon
SEAL: Final = "Haptic-panel-SHA-256: "  # of the last comment
FIGURES_BYTES_MAX: Final = 1 << 20
HEADER_BYTES: Final = 4096  # in which the comments end
HASHED_BYTES: Final = 1 << 16  # at once


class Comments(NamedTuple):
    """How the comments of a family's bitstreams are written."""

    begin: bytes
    each: bytes  # behind each comment
    end: bytes  # behind all


COMMENTS: Final = (Comments(b"\xff\x00", b"\0", b"\xff"), Comments(b"//", b"\n//", b"\n1"))  # ECP5, Gowin


class Identity(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All that determines the bytes of a bitstream."""

    board: str  # whose board.toml gave the parameters
    top: str  # folder of top.v and of the pins
    device: str  # family, size, package and speed grade of the FPGA
    seed: int  # of the placement
    parameters: dict[str, int]  # of top.v, among them BUILD_HASH
    sources: str  # SHA-256 of every file that the tools read, and of their arguments
    tools: dict[str, str]  # versions, by package

    def comment(self) -> str:
        """One line of the header, in ASCII."""
        return KEY + json.dumps(msgspec.to_builtins(self), sort_keys=True, separators=(",", ":"))


class Figures(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What became of a build: the file beside a bitstream."""

    identity: Identity
    sha256: str  # of the bitstream
    bytes: int  # its size
    clock_mhz: float  # clock_mhz, fmax_mhz: the core's clock that was asked for, and the fastest that nextpnr finds possible
    fmax_mhz: float
    longest_path: str  # of that clock: time, and the cells where it begins and ends
    cells: dict[str, tuple[int, int]]  # used and available, by kind
    miso_ns: float | None = None  # from the fall of SCK to MISO's pad, as far as nextpnr knows it


def figures_path(bitstream: Path) -> Path:
    """File of figures beside a bitstream."""
    return bitstream.with_name(f"{bitstream.name}.json")


def sealed(bitstream: bytes) -> bytes:
    """A bitstream with its seal: the SHA-256 of its comments and of its content, as one more comment."""
    written, comments, content = _split(bitstream)
    seal = SEAL + hashlib.sha256(comments + content).hexdigest()
    return written.begin + comments + seal.encode() + written.each + written.end + content


def _split(bitstream: bytes) -> tuple[Comments, bytes, bytes]:
    """How its comments are written, what they are, and what follows.

    Raises GatewareError if it does not begin as a bitstream.
    """
    for written in COMMENTS:
        comments, end, content = bitstream.removeprefix(written.begin).partition(written.end)
        if bitstream.startswith(written.begin) and end:
            return written, comments, content
    raise GatewareError("is no bitstream of an ECP5 or Gowin")


def read_identity(bitstream: Path) -> Identity:
    """Identity in the header of a bitstream that is whole.

    Raises GatewareError if the file is no bitstream, has no identity or no seal, or was cut off or damaged since it was sealed.
    """
    with os.fdopen(open_regular(bitstream, links=True), "rb") as file:
        try:
            written, comments, content = _split(file.read(HEADER_BYTES))
        except GatewareError as error:
            raise GatewareError(f"{bitstream}: {error}") from error
        identity = _identity(bitstream, comments.split(written.each))
        sealed_comments, reported, seal = comments.rpartition(SEAL.encode())
        found = hashlib.sha256(sealed_comments + content)
        while block := file.read(HASHED_BYTES):
            found.update(block)
    if not reported:
        raise GatewareError(f"{bitstream}: is of an earlier release, without a SHA-256 of its content: build it again")
    if seal != found.hexdigest().encode() + written.each:
        raise GatewareError(f"{bitstream}: is cut off or damaged: its SHA-256 is not the one in its header; copy or build it again")
    return identity


def _identity(bitstream: Path, comments: list[bytes]) -> Identity:
    for comment in comments:
        if comment.startswith(KEY.encode()):
            try:
                return msgspec.json.decode(comment.removeprefix(KEY.encode()), type=Identity)
            except NO_JSON as error:
                raise GatewareError(f"{bitstream}: its identity is damaged, or of another release ({error})") from error
    raise GatewareError(f"{bitstream}: does not say what it is: build it with `haptic-panel gateware build`")


def read_figures(bitstream: Path) -> Figures | None:
    """Figures beside a bitstream; None if there are none.

    Raises GatewareError if they are damaged, or those of another bitstream.
    """
    path = figures_path(bitstream)
    if not path.exists():
        return None
    try:
        figures = msgspec.json.decode(read_regular(path, FIGURES_BYTES_MAX, links=True), type=Figures)
    except NO_JSON as error:
        raise GatewareError(f"{path}: is damaged, or of another release ({error})") from error
    if figures.sha256 != sha256_of(bitstream):
        raise GatewareError(f"{path}: tells of another file than {bitstream.name}: their SHA-256 differ")
    return figures


def sha256_of(file: Path) -> str:
    """SHA-256 of a file, in hexadecimal."""
    with os.fdopen(open_regular(file, links=True), "rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()


def differences(identity: Identity, board: Board, build_hash: int) -> list[str]:
    """Why bring-up would refuse a bitstream on a board; empty if it would not.

    `build_hash` is that of the Verilog that belongs to this software.
    """
    wanted, built = top_parameters(board, build_hash), identity.parameters
    keys = {register.name: key for register, key in LIMITS.items()} | {"CLOCK_HZ": "link.clock_hz", "SLOTS": "link.slots"}
    found = []
    if built.get("BUILD_HASH") != build_hash:
        found.append(f"its BUILD_HASH is 0x{built.get('BUILD_HASH', 0):08X}, not 0x{build_hash:08X}: it is of other Verilog")
    for name, key in keys.items():
        if built.get(name) != wanted[name] and not (name == "SLOTS" and built.get(name, 0) > wanted[name]):
            found.append(f"its {name} is {built.get(name)}, not {wanted[name]} ({key} of board {board.name})")
    return found
