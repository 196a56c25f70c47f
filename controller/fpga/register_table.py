"""Write everything that follows from the records in controller/fpga/registers.py into the Verilog and its README.

    .venv/bin/python -m controller.fpga.register_table            # write what differs
    .venv/bin/python -m controller.fpga.register_table --check    # exit code 1 if anything differs

`registers.vh` gets the numbers of its constants and all codes. In the Verilog (`registers.vh`, `register_file.v`,
`haptic_core.v`, the `top.v` of each board) only the lines between `// generated: NAME` and `// end of NAME` are written, in
README.md only the table of registers.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path

from controller.board.lookup import data_folder
from controller.console import program, say
from controller.errors import UsageError
from controller.fpga.build_parameters import BuildParameters
from controller.fpga.register_lines import (
    INPUTS,
    SETTINGS,
    codes,
    inputs,
    read_case,
    setting_lines,
    settings,
    signal,
    table,
    vector,
    wire_bits,
)
from controller.fpga.registers import CONSTANTS, Kind, Register

OTHER_PARAMETERS = ("clock_hz", "slots", "build_hash", "board")  # each module writes these by itself
_BLOCK = re.compile(r"^( *)// generated: (\w+)\n.*?^ *// end of \2\n", re.MULTILINE | re.DOTALL)
_DEFINE = re.compile(r"^(`define (\w+) \d+'([dh]))[0-9A-Fa-f]+", re.MULTILINE)
_TABLE = re.compile(r"^\| address \| name \|.*\n(?:\|.*\n)*", re.MULTILINE)


def rewritten(folder: Path, registers: Iterable[Register] = Register) -> dict[Path, str]:
    """Text that each generated file has to have.

    Parameters
    ----------
    folder : Path
        That of the Verilog; its files give what is not generated.
    registers : iterable of Register
        All registers, in the order of their addresses.

    Raises
    ------
    ValueError
        If a record cannot be right, or a file has no place for what is generated.
    """
    registers = list(registers)
    _check(registers)
    names = [field.name.upper() for field in fields(BuildParameters) if field.name not in OTHER_PARAMETERS]
    parameters = [f"parameter [31:0] {name:<19} = 32'd0," for name in names]
    built_in = [f".{name}({name})," for name in names]
    tops = {str(path): {"parameters": parameters, "built_in": built_in} for path in (folder.parent / "boards").glob("*/top.v")}
    blocks = tops | {
        "registers.vh": {"codes": codes(registers)},
        "register_file.v": {
            "parameters": parameters,
            "inputs": [f"input  wire {vector(wire_bits(register))}{signal(register)}_i," for register in inputs(registers)],
            "outputs": [f"output wire {vector(register.bits)}{signal(register)}_o," for register in settings(registers)],
            "settings": setting_lines(registers),
            "read": [line for register in registers for line in read_case(register, registers)],
        },
        "haptic_core.v": {
            "parameters": parameters,
            "built_in": built_in,
            "wires": [
                f"wire {vector(wire_bits(register))}{signal(register)};"
                for register in registers
                if register.kind in INPUTS + SETTINGS
            ],
            "connections": [
                *(f".{signal(register)}_i({signal(register)})," for register in inputs(registers)),
                *(f".{signal(register)}_o({signal(register)})," for register in settings(registers)),
            ],
        },
    }
    texts = {folder / name: _with_blocks((folder / name).read_text(), name, lines) for name, lines in blocks.items()}
    texts[folder / "registers.vh"] = _with_numbers(texts[folder / "registers.vh"])
    readme = folder / "README.md"
    return texts | {readme: with_table(readme.read_text(), table(registers))}


def _check(registers: list[Register]) -> None:
    for address, register in enumerate(registers):
        if register != address:
            raise ValueError(f"{register.name}: its address is {int(register)}; the next one free is {address}")
        if not 1 <= register.bits <= 32:
            raise ValueError(f"{register.name}: {register.bits} bits are not 1 to 32")
        if isinstance(register.reset, int) and register.reset & ~register.used_bits:
            raise ValueError(f"{register.name}: the value after reset, {register.reset}, has more than {register.bits} bits")
        if not register.text or "|" in register.text or "\n" in register.text:
            raise ValueError(f"{register.name}: the text {register.text!r} is empty or would break the table")
        if register.kind is Kind.TIME_LOW and not register.name.endswith("_LOW"):
            raise ValueError(f"{register.name}: the low half of a time has a name that ends in _LOW")


def _with_blocks(text: str, name: str, blocks: dict[str, list[str]]) -> str:
    """The text of a file with its generated blocks replaced.

    Raises
    ------
    ValueError
        If it does not have exactly these blocks.
    """
    found = [match[2] for match in _BLOCK.finditer(text)]
    if sorted(found) != sorted(blocks):
        raise ValueError(f"{name} has the generated blocks {found}, not {list(blocks)}")

    def block(match: re.Match[str]) -> str:
        lines = [f"// generated: {match[2]}", *blocks[match[2]], f"// end of {match[2]}"]
        return "".join(f"{match[1]}{line}\n" for line in lines)

    return _BLOCK.sub(block, text)


def _with_numbers(text: str) -> str:
    """The text of registers.vh with the numbers of registers.py; size, base and comment of each are its own.

    Raises
    ------
    ValueError
        If a constant is in one of the two only.
    """
    own, blocks = _BLOCK.sub("", text), _BLOCK.search(text)
    names = {match[2] for match in _DEFINE.finditer(own)}
    if names != CONSTANTS.keys():
        raise ValueError(f"in only one of registers.vh and registers.py: {', '.join(sorted(names ^ CONSTANTS.keys()))}")
    assert blocks

    def number(match: re.Match[str]) -> str:
        value = CONSTANTS[match[2]]
        return f"{match[1]}{value:X}" if match[3] == "h" else f"{match[1]}{value}"

    start, end = blocks.span()
    return _DEFINE.sub(number, text[:start]) + text[start:end] + _DEFINE.sub(number, text[end:])


def with_table(readme: str, lines: list[str]) -> str:
    """The README's text with its table of registers replaced.

    Parameters
    ----------
    readme : str
        Text of the README.
    lines : list of str
        Of the table, without line ends.

    Raises
    ------
    ValueError
        If it does not have exactly one table that begins with the columns address and name.
    """
    found = list(_TABLE.finditer(readme))
    if len(found) != 1:
        raise ValueError(f"the README has {len(found)} tables of registers, not one")
    start, end = found[0].span()
    return readme[:start] + "\n".join(lines) + "\n" + readme[end:]


@program
def main(arguments: list[str] | None = None) -> int:
    """Write, or compare, the files.

    Parameters
    ----------
    arguments : list of str
        Of the command line; those of this process unless given.

    Returns
    -------
    int
        Exit code: 1 if `--check` finds a difference, 2 if a record or a file is refused, otherwise 0.
    """
    parser = argparse.ArgumentParser(prog="python -m controller.fpga.register_table", description="Registers as registers.py says.")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a file would change")
    parser.add_argument("--folder", type=Path, default=data_folder("fpga_rtl"), help="folder of the Verilog")
    options = parser.parse_args(arguments)
    try:
        other = {path: text for path, text in rewritten(options.folder).items() if path.read_text() != text}
    except (OSError, ValueError) as error:
        raise UsageError(str(error)) from error
    for path, text in other.items():
        say(f"{path}: {'not as registers.py says' if options.check else 'written'}")
        if not options.check:
            path.write_text(text)
    return int(options.check and bool(other))


if __name__ == "__main__":
    sys.exit(main())
