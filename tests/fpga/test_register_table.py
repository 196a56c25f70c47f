"""The register table: what is printed, and which descriptions are refused."""

from enum import IntEnum
from typing import NamedTuple

import pytest

from controller.fpga.register_table import insert, main, reset_value, table, used_bits


class Toy(IntEnum):
    LIMIT = 2
    CONTROL = 1
    IDENTITY = 0


class Description(NamedTuple):
    access: str
    bits: str
    reset: str
    text: str


TOYS = {
    Toy.LIMIT: Description("RW", "17:0", "5000", "drive words, 1 to 262143"),
    Toy.CONTROL: Description("WO", "31:0", "-", "1 ARM, 2 DISARM"),
    Toy.IDENTITY: Description("RO", "31:0", "0x4C4E5048", "'HPNL'"),
}
TABLE = [
    "| address | name | access | bits | after reset | what |",
    "|---|---|---|---|---|---|",
    "| 0 | IDENTITY | RO | 31:0 | 0x4C4E5048 | 'HPNL' |",
    "| 1 | CONTROL | WO | 31:0 | - | 1 ARM, 2 DISARM |",
    "| 2 | LIMIT | RW | 17:0 | 5000 | drive words, 1 to 262143 |",
]


def test_the_table_is_in_the_order_of_addresses():
    assert table(TOYS) == TABLE


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"access": "rw"}, "access"),
        ({"bits": "0:17"}, "highest first"),
        ({"bits": "32"}, "highest first"),
        ({"bits": "all"}, "neither a bit"),
        ({"bits": ""}, "neither a bit"),
        ({"bits": "8:4, 4"}, "twice"),
        ({"bits": "11:0"}, "beside"),
        ({"text": "a | b"}, "break"),
        ({"text": ""}, "break"),
        ({"reset": ""}, "break"),
    ],
)
def test_a_description_that_cannot_be_right_is_refused(changes, what):
    with pytest.raises(ValueError, match=what):
        table(TOYS | {Toy.LIMIT: TOYS[Toy.LIMIT]._replace(**changes)})


def test_bits_and_resets():
    assert used_bits("31:0") == 0xFFFFFFFF
    assert used_bits("0, 7:4, 31") == 0x800000F1
    assert used_bits("7:0 slots, 31:24 channels") == 0xFF0000FF
    assert [reset_value(reset) for reset in ("0", "0xFF", "the limit built in", "HEARTBEAT_TICKS_MAX")] == [0, 255, None, None]


def test_the_table_replaces_the_one_that_is_there():
    readme = "# A\n\n| address | name | what |\n|---|---|---|\n| 0 | OLD | x |\n\nbelow\n"
    assert insert(readme, TABLE) == "# A\n\n" + "\n".join(TABLE) + "\n\nbelow\n"
    assert insert(insert(readme, TABLE), TABLE) == insert(readme, TABLE)
    for wrong in ("no table\n", readme + readme):
        with pytest.raises(ValueError, match="not one"):
            insert(wrong, TABLE)


def test_a_readme_is_rewritten(tmp_path, monkeypatch):
    monkeypatch.setattr("controller.fpga.register_table.REGISTERS", TOYS)
    readme = tmp_path / "README.md"
    readme.write_text("| address | name |\n|---|---|\n")
    main(readme)
    assert readme.read_text() == "\n".join(TABLE) + "\n"
