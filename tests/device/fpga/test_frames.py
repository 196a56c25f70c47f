import zlib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, HEADER, Play
from controller.device.fpga.registers import (
    CRC_RESIDUE,
    IDENTITY_MAGIC,
    PLAY_LANDING,
    PROTOCOL_VERSION,
    Control,
    Fault,
    FrameType,
    Register,
    Result,
    Start,
    State,
)
from controller.device.fpga.status import Status, pack_status, parse_status
from controller.device.kernel import pack_loads
from controller.errors import LinkError
from controller.workshop.gateware.model.decoder import decode

u8, u16, u32 = (st.integers(0, 2**bits - 1) for bits in (8, 16, 32))
bytes_of_words = st.integers(1, 125).flatmap(lambda words: st.binary(min_size=4 * words, max_size=4 * words))
statuses = st.builds(
    Status,
    st.sampled_from(Result),
    st.integers(0, 255),
    u16.map(State),
    st.integers(0, int(~Fault(0))).map(Fault),
    u32,
    u32,
    st.integers(0, 2**64 - 1),
    u32,
    u8,
    u8,
    u16,
)


@given(statuses, st.integers(0, 40))
def test_a_status_comes_back_as_it_was_packed(status, offset):
    buffer = bytearray(offset + FRAME_BYTES)
    assert pack_status(buffer, offset, status) == len(buffer)
    assert parse_status(buffer, offset) == status


@given(statuses)
def test_a_status_with_any_bit_flipped_is_refused(status):
    buffer = bytearray(FRAME_BYTES)
    pack_status(buffer, 0, status)
    for bit in range(8 * FRAME_BYTES):
        buffer[bit // 8] ^= 1 << bit % 8
        with pytest.raises(LinkError, match="begins with" if bit < 16 else "has CRC"):
            parse_status(buffer)
        buffer[bit // 8] ^= 1 << bit % 8


def test_each_field_of_a_status_lies_where_the_gateware_puts_it():
    """The bytes of status_encoder.v, written out: neither side may move a field alone."""
    status = Status(Result.BUSY, 0x11, State(0x1213), Fault(0x114), 0x18191A1B, 0x1C1D1E1F, 0x2021222324252627, 0x28292A2B)
    status = status._replace(queued=0x2C, chunks=0x2D, ignored=0x2E2F)
    buffer = bytearray(FRAME_BYTES)
    pack_status(buffer, 0, status)
    assert buffer[:-4].hex(" ") == (
        "a5 5a 0c 11 13 12 14 01 1b 1a 19 18 1f 1e 1d 1c 27 26 25 24 23 22 21 20 2b 2a 29 28 2c 2d 2f 2e"
    )
    assert zlib.crc32(buffer) == CRC_RESIDUE ^ 0xFFFFFFFF


def test_a_status_of_zeros_or_of_a_result_unknown_is_refused_with_the_reason():
    with pytest.raises(LinkError, match=r"0x0000 and not 0x5AA5.*configured"):
        parse_status(bytes(FRAME_BYTES))
    buffer = bytearray(FRAME_BYTES)
    pack_status(buffer, 0, Status(99, 0, State(0), Fault(0), 0, 0, 0, 0))  # as a later version might
    with pytest.raises(LinkError, match="result code 99"):
        parse_status(buffer)


@given(
    st.integers(0, 300),
    st.integers(0, 15),
    u16,
    u16,
    u16,
    u32,
    st.sampled_from(Start),
    st.integers(0, 2**64 - 1),
    u32,
    st.booleans(),
)
def test_a_play_is_36_bytes_whose_words_the_gateware_reads_back(
    sequence, slot, first, length, count, period_ticks, start, when_ticks, mask, inverted
):
    offset = sequence % 7
    buffer = bytearray(offset + FRAME_BYTES + 3)
    end = frames.pack_play(
        buffer,
        offset,
        sequence,
        Play(
            slot,
            first=first,
            length=length,
            emissions=count,
            period_ticks=period_ticks,
            start=start,
            when_ticks=when_ticks,
            mask=mask,
            inverted=inverted,
        ),
    )
    assert end - offset == FRAME_BYTES == 36
    words = (
        first | length << 16,
        count | start << 16 | inverted << 24,
        period_ticks,
        mask,
        when_ticks & 0xFFFFFFFF,
        when_ticks >> 32,
    )
    frame = decode(memoryview(buffer)[offset:end])
    assert frame[:6] == (Result.OK, FrameType.PLAY, sequence & 0xFF, slot, words, 0)
    assert not any(buffer[:offset])
    assert not any(buffer[end:])


def test_the_default_play_is_the_whole_slot_once_at_the_next_trigger_on_all_channels():
    buffer = bytearray(FRAME_BYTES)
    frames.pack_play(buffer, 0, 1, Play(3))
    assert decode(memoryview(buffer)).words == (0, 1, 0, 0xFFFFFFFF, 0, 0)


@each_row(
    ("pack", "kind", "argument", "words"),
    [
        (lambda b: frames.pack_nop(b, 0, 1), FrameType.NOP, 0, ()),
        (lambda b: frames.pack_read(b, 0, 1, Register.FAULT), FrameType.READ, Register.FAULT, ()),
        (lambda b: frames.pack_read(b, 0, 1, 0x8000 + 1024 * 3 + 999), FrameType.READ, 0x8FE7, ()),
        (lambda b: frames.pack_write(b, 0, 1, Register.IDLE_WORD, 7), FrameType.WRITE, Register.IDLE_WORD, (7,)),
        (
            lambda b: frames.pack_unlock(b, 0, 1, 0xABCD),
            FrameType.WRITE,
            Register.CONTROL,
            (Control.UNLOCK, IDENTITY_MAGIC, PROTOCOL_VERSION, 0xABCD),
        ),
        (lambda b: frames.pack_control(b, 0, 1, Control.ARM), FrameType.WRITE, Register.CONTROL, (Control.ARM,)),
        (lambda b: frames.pack_control(b, 0, 1, Control.TRIGGER), FrameType.WRITE, Register.CONTROL, (Control.TRIGGER,)),
        (lambda b: frames.pack_store(b, 0, 1, 3, 1000, 0xFEDCBA98), FrameType.STORE, 3, (1000, 0xFEDCBA98)),
        (lambda b: frames.pack_play(b, 0, 1, Play(PLAY_LANDING, length=7)), FrameType.PLAY, 0xFFFF, (7 << 16, 1, 0, 0xFFFFFFFF)),
    ],
)
def test_each_command_has_the_specified_words(pack, kind, argument, words):
    buffer = bytearray(b"\xff" * FRAME_BYTES)
    assert pack(buffer) == FRAME_BYTES
    frame = decode(memoryview(buffer))
    assert frame == (Result.OK, kind, 1, argument, words + (0,) * (6 - len(words)), 0, 6, b"")


@given(st.integers(5, 125).flatmap(lambda words: st.binary(min_size=4 * words, max_size=4 * words)), st.integers(0, 9))
def test_a_test_frame_carries_its_bytes_and_loads_nothing(payload, offset):
    buffer = bytearray(b"\xff" * (offset + frames.LOAD_FRAME_BYTES))
    end = frames.pack_test(buffer, offset, 9, payload)
    frame = decode(memoryview(buffer)[offset:end])
    assert (frame.refusal, frame.kind, frame.sequence, frame.loaded_words) == (Result.OK, FrameType.TEST, 9, 0)
    assert buffer[offset + HEADER.size : end - 4] == payload


@each_row(("size", "good"), [(16, False), (20, True), (22, False), (496, True), (500, True), (504, False)])
@each_row("kind", [FrameType.LOAD, FrameType.TEST])
def test_a_long_frame_holds_20_to_500_bytes_in_words(kind, size, good):
    buffer = bytearray(HEADER.size + size + 4)
    frames.pack_test(buffer, 0, 1, bytes(size))
    buffer[2] = kind
    buffer[-4:] = zlib.crc32(buffer[:-4]).to_bytes(4, "little")
    assert decode(memoryview(buffer)).refusal is (Result.OK if good else Result.BAD_LENGTH)


@each_row("kind", [FrameType.NOP, FrameType.READ, FrameType.WRITE, FrameType.STORE, FrameType.PLAY, 7, 255])
@each_row(("size", "good"), [(20, False), (24, True), (28, False)])
def test_any_other_frame_holds_24_bytes(kind, size, good):
    buffer = bytearray(HEADER.size + size + 4)
    frames.pack_test(buffer, 0, 1, bytes(size))
    buffer[2] = kind
    buffer[-4:] = zlib.crc32(buffer[:-4]).to_bytes(4, "little")
    assert decode(memoryview(buffer)).refusal is (Result.OK if good else Result.BAD_LENGTH)


@given(bytes_of_words, st.integers(0, 7))
def test_a_load_carries_its_words_and_a_good_crc(payload, chunk):
    buffer = bytearray(b"\xff" * frames.LOAD_FRAME_BYTES)
    end = frames.pack_load(buffer, 0, 5, chunk, memoryview(payload))
    frame = decode(memoryview(buffer)[:end])
    assert (frame.refusal, frame.kind, frame.argument) == (Result.OK, FrameType.LOAD, chunk)
    assert frame.loaded_words == max(len(payload) // 4, 5)
    sent = buffer[HEADER.size : end - 4]
    assert sent == payload + bytes(len(sent) - len(payload))
    assert zlib.crc32(buffer[:end]) == CRC_RESIDUE ^ 0xFFFFFFFF == 0x2144DF1C  # of any bytes and their own CRC-32


@given(bytes_of_words, st.data())
def test_a_frame_with_a_bit_flipped_or_bytes_lost_or_added_is_refused(payload, data):
    buffer = bytearray(frames.LOAD_FRAME_BYTES)
    frame = buffer[: frames.pack_load(buffer, 0, 5, 0, memoryview(payload))]
    bit = data.draw(st.integers(0, 8 * len(frame) - 1))
    lost = data.draw(st.integers(0, len(frame) - 1))
    for damaged, reasons in (
        (frame[: bit // 8] + bytes([frame[bit // 8] ^ 1 << bit % 8]) + frame[bit // 8 + 1 :], (1, 2, 3)),
        (frame[:lost] + frame[lost + 1 :], (1, 2, 3)),
        (frame[:lost], (1, 2)),
        (frame + b"\0", (2,)),
    ):
        assert decode(memoryview(damaged)).refusal in reasons


@given(st.integers(1, 1000))
def test_load_frames_lie_where_upload_slices_say(length):
    words = bytes(range(256)) * 16
    buffer = bytearray(frames.UPLOAD_BYTES)
    pack_loads(buffer, 250, memoryview(words)[: 4 * length])
    slices = frames.upload_slices(length)
    end = slices[-1].stop
    assert slices[0].start == 0
    received = b""
    for chunk, place in enumerate(slices):
        frame = decode(memoryview(buffer)[place])
        assert (frame.refusal, frame.argument, frame.sequence) == (Result.OK, chunk, (250 + chunk) & 0xFF)
        received += buffer[place][HEADER.size : -4]
    assert received[: 4 * length] == words[: 4 * length]
    assert end <= frames.UPLOAD_BYTES == 4096


@each_row("length", [0, 1001])
def test_a_waveform_of_an_impossible_length_is_refused(length):
    with pytest.raises(ValueError, match="1 to 1000 words"):
        frames.upload_slices(length)
