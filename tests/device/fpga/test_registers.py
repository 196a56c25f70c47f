import re

from controller.device.board.lookup import data_folder
from controller.device.board.relations.limits import BIT_CLOCK_HZ, MAX_FRAME_BYTES, MIN_BIT_TICKS
from controller.device.fpga import frames, registers
from controller.device.fpga.registers import CONSTANTS, Control, Fault, FrameType, Register, Result, Start, State
from controller.workshop.gateware.register_table import rewritten

DEFINE = re.compile(r"^`define (\w+) (?:\d*'([dh]))?([0-9A-Fa-f]+)\b(?!:)", re.MULTILINE)
PLACES = (
    "FRAME_SYNC_AT",
    "FRAME_TYPE_AT",
    "FRAME_SEQUENCE_AT",
    "FRAME_LENGTH_AT",
    "FRAME_ARGUMENT_AT",
    "FRAME_OVERHEAD",
    "STATUS_COVERED",
)


def test_the_verilog_has_the_same_names_and_numbers():
    """Read on its own, without what wrote it."""
    text = (data_folder("fpga_rtl") / "registers.vh").read_text()
    verilog = {name: int(number, 16 if base == "h" else 10) for name, base, number in DEFINE.findall(text)}
    expected = CONSTANTS | {"REGISTER_COUNT": len(Register), "FAULT_CAUSES": len(Fault)}
    for prefix, codes in (("TYPE", FrameType), ("RESULT", Result), ("REGISTER", Register), ("CONTROL", Control), ("START", Start)):
        expected |= {f"{prefix}_{code.name}": int(code) for code in codes}
    for prefix, bits in (("STATE", State), ("FAULT", Fault)):
        expected |= {f"{prefix}_{bit.name}": bit.bit_length() - 1 for bit in bits}
    assert {name: value for name, value in verilog.items() if not name.startswith(PLACES)} == expected
    assert len(verilog) > 130


def test_addresses_and_codes_stay_what_they_are():
    """A host and a bitstream of another release meet: what has a number keeps it."""
    assert [register.name for register in sorted(Register)[::10]] == [
        "IDENTITY",
        "CHANNEL_MASK",
        "FAULT",
        "TRIGGER_TIME_LOW",
        "QUEUE",
        "DUTY_TICKS_MAX",
    ]
    assert (Fault.NO_PERMIT, Fault.DUTY, Fault(0x110)) == (1, 256, Fault.SHORT_PULSE | Fault.DUTY)
    assert (Result.OK, Result.BAD_VALUE, Result.LINK_SLOW) == (0, 7, 26)
    assert Register(22) is Register.FAULT_COUNT


def test_every_code_has_its_own_plain_sentence():
    sentences = [result.sentence for result in Result] + [fault.sentence for fault in Fault]
    assert len(set(sentences)) == len(sentences)
    assert all(sentence[0].isupper() and sentence.endswith(".") for sentence in sentences)
    assert Fault(0).sentence == "No fault."
    assert (~Fault(0)).sentence == " ".join(fault.sentence for fault in Fault)


def test_the_constants_are_those_of_the_module():
    assert CONSTANTS["QUEUE_PLAYS"] == registers.QUEUE_PLAYS
    assert {name for name, value in vars(registers).items() if name.isupper() and isinstance(value, int)} == CONSTANTS.keys()


def test_the_readme_describes_every_register():
    readme = data_folder("fpga_rtl") / "README.md"
    rows = re.findall(r"^\| (\d+) \| ([A-Z_]+) \| (RO|RW|WO) \|", rewritten(readme.parent)[readme], re.MULTILINE)
    assert rows == [(str(int(register)), register.name, register.access) for register in Register]


def test_readable_memory_does_not_overlap_registers_or_itself():
    slots = 16
    addresses = [*map(int, Register)]
    addresses += [registers.READ_SLOT_CRC + slot for slot in range(slots)]
    addresses += [registers.READ_QUEUE + 8 * play + word for play in range(registers.QUEUE_PLAYS) for word in range(6)]
    addresses += [registers.READ_MEMORY + 1024 * slot + word for slot in range(slots) for word in range(registers.WAVEFORM_WORDS)]
    assert len(set(addresses)) == len(addresses)
    assert max(addresses) < 1 << 16


def test_the_boards_shortest_word_is_the_gatewares():
    assert MIN_BIT_TICKS == registers.BIT_TICKS_MIN
    assert BIT_CLOCK_HZ == (registers.BIT_CLOCK_HZ_MIN, registers.BIT_CLOCK_HZ_MAX)
    assert MAX_FRAME_BYTES == frames.LOAD_FRAME_BYTES
