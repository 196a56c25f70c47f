import re

import pytest

from controller.board.board import MIN_BIT_TICKS, data_folder
from controller.fpga import registers
from controller.fpga.register_table import ACCESS, insert, table
from controller.fpga.registers import REGISTERS, Control, Fault, FrameType, Register, Result, Start, State

README = data_folder("fpga_rtl") / "README.md"
DEFINE = re.compile(r"^`define (\w+) (?:\d*'([dh]))?([0-9A-Fa-f]+)\b", re.MULTILINE)


@pytest.fixture(scope="module")
def verilog():
    text = (data_folder("fpga_rtl") / "registers.vh").read_text()
    return {name: int(number, 16 if base == "h" else 10) for name, base, number in DEFINE.findall(text)}


def python_constants():
    """Every constant of registers.py under the name it has in registers.vh."""
    constants = {name: value for name, value in vars(registers).items() if name.isupper() and isinstance(value, int)}
    for prefix, codes in (("TYPE", FrameType), ("RESULT", Result), ("REGISTER", Register), ("CONTROL", Control), ("START", Start)):
        constants |= {f"{prefix}_{code.name}": int(code) for code in codes}
    for prefix, bits in (("STATE", State), ("FAULT", Fault)):
        constants |= {f"{prefix}_{bit.name}": bit.bit_length() - 1 for bit in bits}
    return constants


def test_verilog_and_python_have_the_same_names_and_numbers(verilog):
    assert verilog == python_constants()
    assert len(verilog) > 130


def test_every_code_has_its_own_plain_sentence():
    sentences = [result.sentence for result in Result] + [fault.sentence for fault in Fault]
    assert len(set(sentences)) == len(sentences)
    assert all(sentence[0].isupper() and sentence.endswith(".") for sentence in sentences)
    assert Fault(0).sentence == "No fault."
    assert (~Fault(0)).sentence == " ".join(fault.sentence for fault in Fault)


def test_every_register_is_described_once():
    assert list(REGISTERS) == list(Register)
    assert sorted(Register) == list(range(len(Register)))


def test_the_readme_has_the_table_of_the_code():
    """`.venv/bin/python -m controller.fpga.register_table` writes it."""
    readme = README.read_text()
    assert insert(readme, table(REGISTERS)) == readme
    text = REGISTERS[Register.IDENTITY].text
    assert insert(readme.replace(text, text[:-1]), table(REGISTERS)) == readme


def test_the_readme_describes_every_register_as_the_code_does():
    rows = re.findall(r"^\| (\d+) \| ([A-Z_]+) \| ([A-Za-z ]+) \|(?:.*\|)? ([^|]+) \|$", README.read_text(), re.MULTILINE)
    described = [(str(int(register)), register.name, entry.access, entry.text) for register, entry in REGISTERS.items()]
    assert [row for row in rows if row[2] in ACCESS] == described


def test_what_can_be_read_besides_registers_does_not_meet_them_or_each_other():
    slots = 16
    addresses = [*map(int, Register)]
    addresses += [registers.READ_SLOT_CRC + slot for slot in range(slots)]
    addresses += [registers.READ_QUEUE + 8 * play + word for play in range(registers.QUEUE_PLAYS) for word in range(6)]
    addresses += [registers.READ_MEMORY + 1024 * slot + word for slot in range(slots) for word in range(registers.WAVEFORM_WORDS)]
    assert len(set(addresses)) == len(addresses)
    assert max(addresses) < 1 << 16


def test_the_boards_shortest_word_is_the_gatewares():
    assert MIN_BIT_TICKS == registers.BIT_TICKS_MIN
