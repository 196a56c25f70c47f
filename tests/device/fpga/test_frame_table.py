"""The table of frames: records have its fields in its order, and all of them fit into a short frame."""

import re

from controller.device.board.lookup import data_folder
from controller.device.fpga.frame_table import HEADER_FIELDS, PAYLOADS, STATUS_FIELDS, offset_of, packing
from controller.device.fpga.frames import FRAME_BYTES, HEADER, Play, pack_play
from controller.device.fpga.registers import SHORT_PAYLOAD_BYTES, FrameType
from controller.device.fpga.status import Status

PLAY_FIELDS = PAYLOADS[FrameType.PLAY].fields


def test_a_play_has_the_fields_of_its_frame():
    assert Play._fields == ("slot", *(field.name for field in PLAY_FIELDS))


def test_a_status_has_the_fields_of_its_frame():
    assert ("sync", *Status._fields) == tuple(field.name for field in STATUS_FIELDS)


def test_each_type_has_a_payload_that_a_short_frame_holds():
    assert PAYLOADS.keys() == set(FrameType)
    for kind, payload in PAYLOADS.items():
        assert packing(payload.fields).size <= SHORT_PAYLOAD_BYTES, kind


def test_each_field_of_a_play_lies_where_the_table_says():
    play = Play(0x1234, 1, 2, 3, 1, True, 4, 5, 6)
    frame = bytearray(FRAME_BYTES)
    pack_play(frame, 0, 0, play)
    for field, value in zip(PLAY_FIELDS, play[1:], strict=True):
        at = HEADER.size + offset_of(field.name, PLAY_FIELDS)
        assert int.from_bytes(frame[at : at + field.size], "little") == value, field.name
    at = offset_of("argument", HEADER_FIELDS)
    assert frame[at : at + 2] == b"\x34\x12"


def test_the_verilog_has_the_same_places():
    """Read on its own, without what wrote it: bytes of the header, bits of payloads and of the status."""
    text = (data_folder("fpga_rtl") / "registers.vh").read_text()
    bytes_of_header = dict(re.findall(r"^`define FRAME_(\w+)_AT 10'd(\d+)$", text, re.MULTILINE))
    assert bytes_of_header == {"SYNC": "0", "TYPE": "2", "SEQUENCE": "3", "LENGTH": "4", "ARGUMENT": "6"}
    assert "`define FRAME_OVERHEAD_BYTES 17'd12\n" in text
    assert "`define STATUS_COVERED_BYTES 6'd32 " in text
    bits = {
        name: (int(low), int(high) + 1) for name, high, low in re.findall(r"^`define (\w+)_BITS (\d+):(\d+)$", text, re.MULTILINE)
    }
    groups = {kind.name: payload.fields for kind, payload in PAYLOADS.items()} | {"STATUS": STATUS_FIELDS}
    assert len(bits) == sum(map(len, groups.values()))
    for group, fields in groups.items():
        low = 0
        for field in fields:
            assert bits[f"{group}_{field.name.upper()}"] == (low, low := low + 8 * field.size)


def test_no_text_breaks_the_table_of_the_readme():
    for field in (*HEADER_FIELDS, *STATUS_FIELDS, *(field for payload in PAYLOADS.values() for field in payload.fields)):
        assert field.text, field.name
        assert "|" not in field.text, field.name
