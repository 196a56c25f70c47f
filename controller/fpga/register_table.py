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
from collections.abc import Callable, Iterable
from dataclasses import fields
from enum import IntEnum
from pathlib import Path

from controller.board.lookup import data_folder
from controller.fpga.build_parameters import Parameters
from controller.fpga.registers import CONSTANTS, Control, Fault, FrameType, Kind, Register, Result, Start, State

HEADER = ("address", "name", "access", "bits", "after reset", "what")
SETTINGS = (Kind.SETTING, Kind.MASK)
INPUTS = (Kind.LIVE, Kind.COUNTER, Kind.TIME_LOW)  # wires of haptic_core.v that register_file.v reads
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
    names = [field.name.upper() for field in fields(Parameters) if field.name not in OTHER_PARAMETERS]
    parameters = [f"parameter [31:0] {name:<19} = 32'd0," for name in names]
    built_in = [f".{name}({name})," for name in names]
    tops = {str(path): {"parameters": parameters, "built_in": built_in} for path in (folder.parent / "boards").glob("*/top.v")}
    blocks = tops | {
        "registers.vh": {"codes": _codes(registers)},
        "register_file.v": {
            "parameters": parameters,
            "inputs": [f"input  wire {_range(_width(register))}{signal(register)}_i," for register in _inputs(registers)],
            "outputs": [f"output wire {_range(register.bits)}{signal(register)}_o," for register in _settings(registers)],
            "settings": _setting_lines(registers),
            "read": [line for register in registers for line in _case(register)],
        },
        "haptic_core.v": {
            "parameters": parameters,
            "built_in": built_in,
            "wires": [
                f"wire {_range(_width(register))}{signal(register)};"
                for register in registers
                if register.kind in INPUTS + SETTINGS
            ],
            "connections": [
                *(f".{signal(register)}_i({signal(register)})," for register in _inputs(registers)),
                *(f".{signal(register)}_o({signal(register)})," for register in _settings(registers)),
            ],
        },
    }
    texts = {folder / name: _with_blocks((folder / name).read_text(), name, lines) for name, lines in blocks.items()}
    texts[folder / "registers.vh"] = _with_numbers(texts[folder / "registers.vh"])
    readme = folder / "README.md"
    return texts | {readme: with_table(readme.read_text(), table(registers))}


def signal(register: Register) -> str:
    """Name of a register's wire in the Verilog; the port of register_file.v has _i or _o behind it.

    Parameters
    ----------
    register : Register
        Both halves of a time give the same name.
    """
    return register.name.removesuffix("_LOW").removesuffix("_HIGH").lower()


def table(registers: Iterable[Register]) -> list[str]:
    """Lines of the README's table, in Markdown.

    Parameters
    ----------
    registers : iterable of Register
        In the order of their addresses.
    """
    rows = [HEADER, ("---",) * len(HEADER)]
    for register in registers:
        bits = f"{register.bits - 1}:0" if register.bits > 1 else "0"
        rows.append(
            (str(int(register)), register.name, register.access, bits, _after_reset(register), register.text + _limits(register))
        )
    return ["|" + "|".join(cell if cell == "---" else f" {cell} " for cell in cells) + "|" for cells in rows]


def _after_reset(register: Register) -> str:
    """Value after reset as the README says it: a number, or where it comes from."""
    if register.kind is Kind.BUILT_IN:
        return "built in"
    if register.kind is Kind.COMMAND:
        return "nothing"
    number = CONSTANTS.get(register.reset, register.reset) if isinstance(register.reset, str) else register.reset
    return f"0x{number:08X}" if isinstance(number, int) and number >= 1 << 16 else str(number)


def _codes(registers: Iterable[Register]) -> list[str]:
    """Defines of all codes, bits and addresses."""
    registers = list(registers)
    groups: tuple[tuple[str, str, Iterable[IntEnum]], ...] = (
        ("TYPE", "8'd", FrameType),
        ("START", "2'd", Start),
        ("RESULT", "8'd", Result),
        ("CONTROL", "32'd", Control),
        ("REGISTER", "16'd", registers),
    )
    lines = []
    for prefix, size, members in groups:
        lines += [f"// {_title(members)}"] if prefix != "REGISTER" else ["// Addresses of the registers, and how many there are"]
        lines += [f"`define {prefix}_{code.name} {size}{int(code)}" for code in members]
    lines.append(f"`define REGISTER_COUNT 16'd{len(registers)}")
    for prefix, flags in (("STATE", State), ("FAULT", Fault)):
        lines += [f"// {_title(flags)}: numbers of the bits"]
        lines += [f"`define {prefix}_{flag.name} {flag.bit_length() - 1}" for flag in flags]
    lines.append(f"`define FAULT_CAUSES {len(Fault)}")
    return lines


def _setting_lines(registers: Iterable[Register]) -> list[str]:
    """Flip-flops of the settings: what is written, what they are after reset, what leaves."""
    kept = _settings(registers)
    lines = [f"reg {_range(register.bits)}{signal(register)}_q;" for register in kept]
    lines += ["always @(posedge clk_i) begin", "    if (change) begin", "        case (register)"]
    for register in kept:
        label = "default" if register is kept[-1] else f"`REGISTER_{register.name}"
        lines.append(f"            {label}: {signal(register)}_q <= word0{_part(register.bits)};")
    lines += ["        endcase", "    end", "    if (rst_i) begin"]
    lines += [f"        {signal(register)}_q <= {_sized(register.reset, register.bits)};" for register in kept]
    lines += ["    end", "end"]
    return lines + [f"assign {signal(register)}_o = {signal(register)}_q;" for register in kept]


def _case(register: Register) -> list[str]:
    """What a READ of a register gives, and whether a WRITE may change it."""
    name, label = signal(register), f"`REGISTER_{register.name}:"
    match register.kind:
        case Kind.COMMAND:
            return []
        case Kind.CONSTANT:
            return [f"{label} value = {_verilog(register.reset)};"]
        case Kind.BUILT_IN:
            return [f"{label} value = {register.name};"]
        case Kind.LINK_COUNTER:
            return [f"{label} value = {name};"]
        case Kind.TIME_LOW:
            return [f"{label} begin value = {name}_i[31:0]; high = {name}_i[63:32]; low = 1'b1; end"]
        case Kind.TIME_HIGH:
            return [f"{label} value = held;"]
        case Kind.LIVE | Kind.COUNTER:
            return [f"{label} value = {_padded(f'{name}_i', register.bits)};"]
    lines = [f"{label} begin", f"    value    = {_padded(f'{name}_q', register.bits)};", "    setting  = 1'b1;"]
    condition = _condition(register)
    return [*lines, *([f"    in_range = {condition};"] if condition else []), "end"]


def _condition(register: Register) -> str:
    """Verilog for: word0 is a value for this setting; empty if every word is."""
    if register.kind is Kind.MASK:
        return f"(word0 & ~{_verilog(register.high or 0)}) == 32'd0"
    conditions = []
    if register.low != 0:
        conditions.append("word0 != 32'd0" if register.low == 1 else f"word0 >= {_verilog(register.low)}")
    if register.high is not None or register.bits < 32:
        conditions.append(f"word0 <= {_verilog(register.used_bits if register.high is None else register.high)}")
    return " && ".join(conditions)


def _limits(register: Register) -> str:
    """Range of a setting, for the README."""
    if register.kind is Kind.MASK:
        return f"; a bit only where {register.high} has it"
    if register.high is None or not _known(register.low) or not _known(register.high):
        return ""
    return f"; {register.low} to {register.high}" if register.low else f"; at most {register.high}"


def _known(value: int | str) -> bool:
    """Whether a reader of the table can tell what this is: a number, a constant or another register."""
    return isinstance(value, int) or value in CONSTANTS or value in Register.__members__


def _verilog(value: int | str) -> str:
    """A number, or a name as the Verilog writes it."""
    if isinstance(value, int):
        return f"32'd{value}"
    return f"`{value}" if value in CONSTANTS else value


def _sized(value: int | str, bits: int) -> str:
    return f"{bits}'d{value}" if isinstance(value, int) else f"{_verilog(value)}{_part(bits)}"


def _part(bits: int) -> str:
    return "" if bits == 32 else f"[{bits - 1}:0]" if bits > 1 else "[0]"


def _padded(name: str, bits: int) -> str:
    return name if bits == 32 else f"{{{32 - bits}'d0, {name}}}"


def _range(bits: int) -> str:
    return f"{f'[{bits - 1}:0]' if bits > 1 else '':<6} "


def _width(register: Register) -> int:
    return 64 if register.kind is Kind.TIME_LOW else register.bits


def _settings(registers: Iterable[Register]) -> list[Register]:
    return [register for register in registers if register.kind in SETTINGS]


def _inputs(registers: Iterable[Register]) -> list[Register]:
    return [register for register in registers if register.kind in INPUTS]


def _title(members: object) -> str:
    """First sentence of an enum's docstring."""
    return (members.__doc__ or "").partition("\n")[0].partition(":")[0].rstrip(".")


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


def main(arguments: list[str] | None = None, say: Callable[[str], object] = sys.stdout.write) -> int:
    """Write, or compare, the files.

    Parameters
    ----------
    arguments : list of str
        Of the command line; those of this process unless given.
    say : callable
        Takes a line for each file that differs, with its line end.

    Returns
    -------
    int
        Exit code: 1 if `--check` finds a difference, otherwise 0. Exits with 2 if a record or a file is refused.
    """
    parser = argparse.ArgumentParser(prog="python -m controller.fpga.register_table", description="Registers as registers.py says.")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a file would change")
    parser.add_argument("--folder", type=Path, default=data_folder("fpga_rtl"), help="folder of the Verilog")
    options = parser.parse_args(arguments)
    try:
        other = {path: text for path, text in rewritten(options.folder).items() if path.read_text() != text}
    except (OSError, ValueError) as error:
        parser.exit(2, f"{error}\n")
    for path, text in other.items():
        say(f"{path}: {'not as registers.py says' if options.check else 'written'}\n")
        if not options.check:
            path.write_text(text)
    return int(options.check and bool(other))


if __name__ == "__main__":
    sys.exit(main())
