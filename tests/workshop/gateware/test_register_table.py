"""What is written for a register of each kind, and which records and files are refused."""

import shutil
from enum import IntEnum

import pytest
from tables import each_row

from controller.device.board.lookup import data_folder
from controller.device.fpga.registers import Kind, Register
from controller.workshop.gateware.register_lines import table
from controller.workshop.gateware.register_table import KERNEL, rewritten, with_table


class Toy(IntEnum):
    """Registers with the fields of `Register`."""

    __new__ = Register._new_member_
    IDENTITY = 0, Kind.CONSTANT, 32, "'HPNL'", "IDENTITY_MAGIC"
    CONTROL = 1, Kind.COMMAND, 32, "1 ARM, 2 DISARM"
    WORDS = 2, Kind.SETTING, 18, "drive words", 5000, 1
    MASK = 3, Kind.MASK, 32, "channels", "CHANNEL_MASK_MAX", 0, "CHANNEL_MASK_MAX"
    ON = 4, Kind.LIVE, 1, "whether it is on"
    HEAT_TIME_LOW = 5, Kind.TIME_LOW, 32, "tick of the last alarm"

    access = Register.access
    used_bits = Register.used_bits


class Loose(int):
    """A register beside an enum."""

    name = "EXTRA"
    used_bits = Register.used_bits


TABLE = [
    "| address | name | access | bits | after reset | what |",
    "|---|---|---|---|---|---|",
    "| 0 | IDENTITY | RO | 31:0 | 0x4C4E5048 | 'HPNL' |",
    "| 1 | CONTROL | WO | 31:0 | nothing | 1 ARM, 2 DISARM |",
    "| 2 | WORDS | RW | 17:0 | 5000 | drive words |",
    "| 3 | MASK | RW | 31:0 | CHANNEL_MASK_MAX | channels; a bit only where CHANNEL_MASK_MAX has it |",
    "| 4 | ON | RO | 0 | 0 | whether it is on |",
    "| 5 | HEAT_TIME_LOW | RO | 31:0 | 0 | tick of the last alarm |",
]


@pytest.fixture
def folder(tmp_path):
    """A copy of what is written into."""
    folder = tmp_path / "fpga_rtl"
    for name in ("registers.vh", "register_file.v", "haptic_core.v", "README.md", "simulation/frame_view.sv", "board/board_core.v"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(data_folder("fpga_rtl") / name, folder / name)
    return folder


def test_the_table_follows_the_records():
    assert table(Toy) == TABLE


def test_each_kind_has_its_verilog(folder):
    texts = {path.name: text for path, text in rewritten(folder, Toy).items()}
    assert "`define REGISTER_HEAT_TIME_LOW 16'd5\n`define REGISTER_COUNT 16'd6\n" in texts["registers.vh"]
    for line in (
        "`REGISTER_IDENTITY: value = `IDENTITY_MAGIC;",
        "value   = 32'd5000;",
        "least   = 32'd1;",
        "most    = 32'd262143;",
        "place   = 1;",
        "barred  = ~CHANNEL_MASK_MAX;",
        "`REGISTER_ON: value = {31'd0, on_i};",
        "`REGISTER_HEAT_TIME_LOW: begin value = heat_time_i[31:0]; high = heat_time_i[63:32]; low = 1'b1; end",
        "input  wire        on_i,",
        "input  wire [63:0] heat_time_i,",
        "output wire [17:0] words_o,",
        "words_q <= 18'd5000;",
        "mask_q <= CHANNEL_MASK_MAX;",
    ):
        assert f" {line}\n" in texts["register_file.v"], line
    assert "REGISTER_CONTROL:" not in texts["register_file.v"], "a command has no value"
    for line in ("wire        on;", "wire [63:0] heat_time;", ".on_i(on),", ".words_o(words),"):
        assert f" {line}\n" in texts["haptic_core.v"], line


def test_the_last_setting_needs_no_label(folder):
    """Only a setting is written there: of the last one no address is compared."""
    lines = rewritten(folder, Toy)[folder / "register_file.v"].splitlines()
    assert [line.strip() for line in lines if "_q <= word0" in line] == [
        "`REGISTER_WORDS: words_q <= word0[17:0];",
        "default: mask_q <= word0;",
    ]


@each_row(
    ("record", "what"),
    [
        ((7, Kind.LIVE, 32, "text"), "the next one free is 6"),
        ((6, Kind.LIVE, 33, "text"), "33 bits"),
        ((6, Kind.LIVE, 0, "text"), "0 bits"),
        ((6, Kind.SETTING, 8, "text", 256), "more than 8 bits"),
        ((6, Kind.LIVE, 8, "a | b"), "break"),
        ((6, Kind.LIVE, 8, ""), "break"),
        ((6, Kind.TIME_LOW, 32, "text"), "_LOW"),
    ],
)
def test_a_record_that_cannot_be_right_is_refused(folder, record, what):
    wrong = Register._new_member_(Loose, *record)
    with pytest.raises(ValueError, match=f"EXTRA: .*{what}"):
        rewritten(folder, [*Toy, wrong])


def test_the_table_replaces_the_one_that_is_there():
    readme = "# A\n\n| address | name | what |\n|---|---|---|\n| 0 | OLD | x |\n\nbelow\n"
    assert with_table(readme, TABLE) == "# A\n\n" + "\n".join(TABLE) + "\n\nbelow\n"
    assert with_table(with_table(readme, TABLE), TABLE) == with_table(readme, TABLE)
    for wrong in ("no table\n", readme + readme):
        with pytest.raises(ValueError, match="not one"):
            with_table(wrong, TABLE)


@each_row(
    ("name", "old", "new"),
    [
        ("registers.vh", "`define FAULT_DUTY 8", "`define FAULT_DUTY 9"),
        ("registers.vh", "`define QUEUE_PLAYS 8'd8", "`define QUEUE_PLAYS 8'd9"),
        ("registers.vh", "`define FRAME_SYNC 16'hA55A", "`define FRAME_SYNC 16'hA55B"),
        ("register_file.v", "`REGISTER_TRIGGERS: value = triggers_i;", "`REGISTER_TRIGGERS: value = emissions_i;"),
        ("haptic_core.v", "        .duty_level_i(duty_level),\n", ""),
        ("README.md", "| 28 | TRIGGERS |", "| 28 | TRIGGER |"),
        ("README.md", "| PLAY | 8–9 | first |", "| PLAY | 8–9 | last |"),
        ("registers.vh", "`define PLAY_START_BITS 55:48", "`define PLAY_START_BITS 55:49"),
    ],
    afresh=[folder],
)
def test_changes_by_hand_are_overwritten(folder, name, old, new):
    path = folder / name
    right = path.read_text()
    assert right.count(old) == 1
    path.write_text(right.replace(old, new))
    differing = {path: text for path, text in rewritten(folder).items() if path.read_text() != text}
    assert differing == {path: right}


@each_row(
    ("name", "old", "new", "what"),
    [
        ("registers.vh", "`define QUEUE_PLAYS 8'd8", "`define OTHER 8'd8", "OTHER, QUEUE_PLAYS"),
        ("register_file.v", "// end of read", "", "has the generated blocks"),
        ("haptic_core.v", "// generated: wires", "", "has the generated blocks"),
    ],
    afresh=[folder],
)
def test_a_file_without_the_generated_blocks_is_refused(folder, name, old, new, what):
    path = folder / name
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(ValueError, match=what):
        rewritten(folder)


def test_the_kernel_beside_the_verilog_is_written_too(folder):
    """Only its lines between the marks."""
    kernel = folder.parent / KERNEL
    kernel.mkdir(parents=True)
    for name, mark in (("kernel.c", "//"), ("twin.py", "#")):
        (kernel / name).write_text(f"above\n    {mark} generated: frames\n    stale\n    {mark} end of frames\nbelow\n")
    texts = {path.name: text.splitlines() for path, text in rewritten(folder).items()}
    assert "    CHUNK_BYTES = 500, /* words of a LOAD frame that is not the last */" in texts["kernel.c"]
    assert "    CHUNK_BYTES: Final = 500  # words of a LOAD frame that is not the last" in texts["twin.py"]
    for name in ("kernel.c", "twin.py"):
        assert (texts[name][0], texts[name][-1], "stale" in "".join(texts[name])) == ("above", "below", False)
