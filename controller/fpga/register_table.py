"""The register table of fpga_rtl/README.md, from the one description in controller/fpga/registers.py.

    .venv/bin/python -m controller.fpga.register_table       # rewrites the table in the README

What a description says is checked here as well, so that a table that can be printed can be trusted.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

from controller.board.board import data_folder
from controller.fpga.registers import REGISTERS, Register

HEADER = ("address", "name", "access", "bits", "after reset", "what")
ACCESS = ("RO", "RW", "RW idle", "WO")
_BITS = re.compile(r"(\d+)(?::(\d+))?(?: [^|\n]+)?")


class Described(Protocol):
    """A register as `registers.Description` describes it.

    Attributes
    ----------
    access : str
        One of `ACCESS`.
    bits : str
        Those that mean something, as in Verilog: `31:0`; what each part of them is may follow it: `7:0 slots, 31:24 channels`.
    reset : str
        Value after reset: a number (decimal or 0x...), or words where it depends on how the gateware was built.
    text : str
        What it is, without a vertical bar.
    """

    @property
    def access(self) -> str:
        """One of `ACCESS`."""

    @property
    def bits(self) -> str:
        """Used bits."""

    @property
    def reset(self) -> str:
        """Value after reset."""

    @property
    def text(self) -> str:
        """What it is."""


def table(registers: Mapping[Register, Described]) -> list[str]:
    """Lines of the table in Markdown, in the order of the addresses.

    Raises
    ------
    ValueError
        If a description cannot be right: access, bits, or text that breaks the table.
    """
    lines = [_row(HEADER), _row(("---",) * len(HEADER))]
    for register, description in sorted(registers.items()):
        _check(register, description)
        lines.append(
            _row((str(int(register)), register.name, description.access, description.bits, description.reset, description.text))
        )
    return lines


def used_bits(bits: str) -> int:
    """Mask of the bits that a description names.

    Raises
    ------
    ValueError
        If that is not a list of bits `n` and ranges `high:low` of a 32-bit word, each there once.
    """
    mask = 0
    for part in bits.split(","):
        matched = _BITS.fullmatch(part.strip())
        if not matched:
            raise ValueError(f"bits {bits!r}: {part.strip()!r} is neither a bit nor high:low")
        high, low = int(matched[1]), int(matched[2] or matched[1])
        if not 0 <= low <= high < 32:
            raise ValueError(f"bits {bits!r}: {part.strip()!r} are not bits of a word, highest first")
        named = (1 << high + 1) - (1 << low)
        if mask & named:
            raise ValueError(f"bits {bits!r}: {part.strip()!r} is named twice")
        mask |= named
    return mask


def reset_value(reset: str) -> int | None:
    """The number that a description gives for the value after reset; None if it gives words."""
    return int(reset, 0) if re.fullmatch(r"\d+|0x[0-9A-Fa-f]+", reset) else None


def insert(readme: str, lines: list[str]) -> str:
    """The README's text with its register table replaced.

    Raises
    ------
    ValueError
        If it does not have exactly one table that begins with the columns address and name.
    """
    found = list(re.finditer(r"^\| address \| name \|.*\n(?:\|.*\n)*", readme, re.MULTILINE))
    if len(found) != 1:
        raise ValueError(f"the README has {len(found)} tables of registers, not one")
    start, end = found[0].span()
    return readme[:start] + "\n".join(lines) + "\n" + readme[end:]


def _check(register: Register, description: Described) -> None:
    if description.access not in ACCESS:
        raise ValueError(f"{register.name}: access is {', '.join(ACCESS)}, not {description.access!r}")
    mask, value = used_bits(description.bits), reset_value(description.reset)
    if value is not None and value & ~mask:
        raise ValueError(f"{register.name}: {description.reset} after reset has bits beside {description.bits}")
    for cell in (description.reset, description.text):
        if not cell or "|" in cell or "\n" in cell:
            raise ValueError(f"{register.name}: {cell!r} would break the table")


def _row(cells: tuple[str, ...]) -> str:
    return "|" + "|".join(cell if cell == "---" else f" {cell} " for cell in cells) + "|"


def main(readme: Path | None = None) -> None:
    """Rewrite the table in the README."""
    path = readme or data_folder("fpga_rtl") / "README.md"
    described: Any = REGISTERS
    path.write_text(insert(path.read_text(), table(described)))


if __name__ == "__main__":
    main()
