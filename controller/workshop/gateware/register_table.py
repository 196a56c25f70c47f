"""What follows from the records in registers.py and frame_table.py of device/fpga, in Verilog, kernel and README.

`controller.generate` writes it.

`registers.vh` gets the numbers of its constants, all codes and the places of fields. In the Verilog (`registers.vh`,
`register_file.v`, `haptic_core.v`, `board_core.v`, the `top.v` of each board), `kernel.c` and `twin.py` only the lines between
`generated: NAME` and `end of NAME` are written, in README.md only the tables of registers and of frames.
"""

import re
from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.registers import CONSTANTS, FrameType, Kind, Register, Result
from controller.workshop.gateware.frame_lines import kernel_c, kernel_twin, places
from controller.workshop.gateware.frame_lines import table as frames_table
from controller.workshop.gateware.register_lines import (
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

OTHER_PARAMETERS = ("clock_hz", "slots", "build_hash", "board")  # each module writes these by itself
_BLOCK = re.compile(r"^( *)(//|#) generated: (\w+)\n.*?^ *\2 end of \3\n", re.MULTILINE | re.DOTALL)
_DEFINE = re.compile(r"^(`define (\w+) \d+'([dh]))[0-9A-Fa-f]+", re.MULTILINE)
KERNEL = Path("controller", "device", "kernel")  # in a checkout


def rewritten(folder: Path, registers: Iterable[Register] = Register) -> dict[Path, str]:
    """Text that each generated file has to have.

    `folder` is that of the Verilog, whose files give what is not generated; registers come in the order of their addresses. Raises
    ValueError if a record cannot be right, or a file has no place for what is generated.
    """
    registers = list(registers)
    _check(registers)
    names = [field.name.upper() for field in fields(BuildParameters) if field.name not in OTHER_PARAMETERS]
    parameters = [f"parameter [31:0] {name:<19} = 32'd0," for name in names]
    built_in = [f".{name}({name})," for name in names]
    boards = [folder / "board" / "board_core.v", *(folder.parent / "boards").glob("*/top.v")]
    tops = {str(path): {"parameters": parameters, "built_in": built_in} for path in boards}
    blocks = tops | {
        "registers.vh": {"codes": [*codes(registers), *places()]},
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
    blocks["simulation/frame_view.sv"] = {
        "kinds": [f"{kind.name} = `TYPE_{kind.name}," for kind in FrameType],
        "results": [f"{result.name} = `RESULT_{result.name}," for result in Result],
    }
    texts = {folder / name: _with_blocks((folder / name).read_text(), name, lines) for name, lines in blocks.items()}
    texts[folder / "registers.vh"] = _with_numbers(texts[folder / "registers.vh"])
    readme = folder / "README.md"
    kernel = {folder.parent / KERNEL / "kernel.c": kernel_c(), folder.parent / KERNEL / "twin.py": kernel_twin()}
    texts |= {path: _with_blocks(path.read_text(), path.name, {"frames": lines}) for path, lines in kernel.items() if path.exists()}
    return texts | {readme: with_table(with_table(readme.read_text(), table(registers)), frames_table())}


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
    """The text of a file with its generated blocks replaced; raises ValueError if it does not have exactly these blocks."""
    found = [match[3] for match in _BLOCK.finditer(text)]
    if sorted(found) != sorted(blocks):
        raise ValueError(f"{name} has the generated blocks {found}, not {list(blocks)}")

    def block(match: re.Match[str]) -> str:
        indent, comment, name = match.groups()
        return "".join(f"{indent}{line}\n" for line in (f"{comment} generated: {name}", *blocks[name], f"{comment} end of {name}"))

    return _BLOCK.sub(block, text)


def _with_numbers(text: str) -> str:
    """The text of registers.vh with the numbers of registers.py; size, base and comment of each are its own.

    Raises ValueError if a constant is in one of the two only.
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
    """The README's text with one of its tables replaced: that whose first two columns have the same heads.

    `lines` are the table's, without line ends. Raises ValueError if it does not have exactly one such table.
    """
    head = "|".join(lines[0].split("|")[:3])
    found = list(re.finditer(rf"^{re.escape(head)}\|.*\n(?:\|.*\n)*", readme, re.MULTILINE))
    if len(found) != 1:
        raise ValueError(f"the README has {len(found)} tables that begin with {head} |, not one")
    start, end = found[0].span()
    return readme[:start] + "\n".join(lines) + "\n" + readme[end:]
