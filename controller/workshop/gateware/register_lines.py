"""Lines of Verilog and of the README's table that follow from the records in registers.py; `controller.generate` writes them."""

from collections.abc import Iterable
from enum import IntEnum

from controller.device.fpga.registers import CONSTANTS, Control, Fault, FrameType, Kind, Register, Result, Start, State

HEADER = ("address", "name", "access", "bits", "after reset", "what")
SETTINGS = (Kind.SETTING, Kind.MASK)
INPUTS = (Kind.LIVE, Kind.COUNTER, Kind.TIME_LOW)  # wires of haptic_core.v that register_file.v reads


def signal(register: Register) -> str:
    """Name of a register's wire in the Verilog; the port of register_file.v has _i or _o behind it.

    Both halves of a time give the same name.
    """
    return register.name.removesuffix("_LOW").removesuffix("_HIGH").lower()


def table(registers: Iterable[Register]) -> list[str]:
    """Lines of the README's table, in Markdown; registers come in the order of their addresses."""
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


def codes(registers: Iterable[Register]) -> list[str]:
    """Lines of registers.vh that define all codes, bits and addresses, for registers in the order of their addresses."""
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


def setting_lines(registers: Iterable[Register]) -> list[str]:
    """Flip-flops of the settings: what is written, what they are after reset, what leaves."""
    kept = settings(registers)
    bits = max(1, (len(kept) - 1).bit_length())
    lines = [f"localparam SETTINGS = {len(kept)}, KEPT_BITS = {bits};"]
    lines += [f"reg {vector(32)}kept [0:SETTINGS-1];  // for a READ, by their place in this list", "reg [SETTINGS-1:0] written_q;"]
    lines += [f"reg {vector(register.bits)}{signal(register)}_q;" for register in kept]
    lines += ["always @(posedge clk_i) begin", "    if (change) begin", "        case (register)"]
    for register in kept:
        label = "default" if register is kept[-1] else f"`REGISTER_{register.name}"
        lines.append(f"            {label}: {signal(register)}_q <= word0{_part(register.bits)};")
    lines += ["        endcase", "    end", "    if (rst_i) begin"]
    lines += [f"        {signal(register)}_q <= {_sized(register.reset, register.bits)};" for register in kept]
    lines += ["    end", "end"]
    return lines + [f"assign {signal(register)}_o = {signal(register)}_q;" for register in kept]


def read_case(register: Register, registers: Iterable[Register]) -> list[str]:
    """What a READ of one of these registers gives; of a setting also which words it takes, and its value until it is written."""
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
    place = settings(registers).index(register)
    lines = [
        f"value   = {_verilog(register.reset)};",
        "setting = 1'b1;",
        *([f"place   = {place};"] if place else []),
        *_bounds(register),
    ]
    return [f"{label} begin", *(f"    {line}" for line in lines), "end"]


def _bounds(register: Register) -> list[str]:
    """Verilog for the words that a setting takes: what is not said is no bound."""
    if register.kind is Kind.MASK:
        return [f"barred  = ~{_verilog(register.high or 0)};"]
    lines = [f"least   = {_verilog(register.low)};"] if register.low != 0 else []
    if register.high is not None or register.bits < 32:
        lines.append(f"most    = {_verilog(register.used_bits if register.high is None else register.high)};")
    return lines


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


def vector(bits: int) -> str:
    """Range of a Verilog vector of some bits, padded for columns; blank for one bit."""
    return f"{f'[{bits - 1}:0]' if bits > 1 else '':<6} "


def wire_bits(register: Register) -> int:
    """Bits of a register's wire: both halves of a time share one of 64."""
    return 64 if register.kind is Kind.TIME_LOW else register.bits


def settings(registers: Iterable[Register]) -> list[Register]:
    """Those that a WRITE may change."""
    return [register for register in registers if register.kind in SETTINGS]


def inputs(registers: Iterable[Register]) -> list[Register]:
    """Those whose value comes from a wire of haptic_core.v."""
    return [register for register in registers if register.kind in INPUTS]


def _title(members: object) -> str:
    """First sentence of an enum's docstring."""
    return (members.__doc__ or "").partition("\n")[0].partition(":")[0].rstrip(".")
