"""LOAD frames of waveforms: packed, taken apart, and numbered again without reading their payload."""

import zlib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device import kernel
from controller.device.fpga import frames, registers
from controller.device.fpga.frames import upload_slices
from controller.device.kernel import twin

WORDS = bytes((37 * n * n + n >> 3) & 0xFF for n in range(4000))
waveforms = st.integers(1, 1000).flatmap(lambda samples: st.binary(min_size=4 * samples, max_size=4 * samples))


def packed(words, sequence=0):
    out = bytearray(kernel.load_frames_bytes(len(words)))
    kernel.pack_loads(out, sequence, words)
    return bytes(out)


def one_by_one(words, sequence):
    """What `frames.pack_load` makes of each chunk."""
    out, end = bytearray(frames.UPLOAD_BYTES), 0
    for chunk in range(-(-len(words) // 500)):
        end = frames.pack_load(out, end, sequence + chunk, chunk, memoryview(words)[500 * chunk : 500 * (chunk + 1)])
    return bytes(out[:end])


def test_the_kernel_and_the_registers_have_the_same_numbers():
    assert twin.FRAME_SYNC == registers.FRAME_SYNC
    assert twin.LOAD == registers.FrameType.LOAD
    assert twin.CHUNK_BYTES == 4 * registers.CHUNK_WORDS == registers.LOAD_PAYLOAD_MAX_BYTES
    assert twin.PADDED_BYTES == registers.LOAD_PAYLOAD_MIN_BYTES
    assert twin.CHUNKS == registers.CHUNKS
    assert kernel.SHORT_FRAME_BYTES == frames.FRAME_BYTES
    assert all(kernel.load_frames_bytes(4 * samples) == upload_slices(samples)[-1].stop for samples in range(1, 1001))


@given(waveforms, st.integers(0, 1000))
def test_words_become_the_frames_that_packing_one_by_one_gives(words, sequence):
    out = bytearray(b"\xff" * frames.UPLOAD_BYTES)
    assert kernel.pack_loads(out, sequence, words) == zlib.crc32(words)
    end = kernel.load_frames_bytes(len(words))
    assert out[:end] == one_by_one(words, sequence)
    assert set(out[end:]) <= {0xFF}


@each_row("samples", [1000, 130, 129, 5, 1])
def test_frames_numbered_anew_are_those_packed_with_that_number_for_every_number(samples):
    words = WORDS[-4 * samples :]
    ready = packed(words)
    out = bytearray(len(ready))
    for sequence in range(256):
        kernel.renumber_loads(out, sequence, ready)
        assert out == one_by_one(words, sequence), sequence


def test_every_number_gets_the_right_crc_in_a_frame_of_every_length():
    for samples in range(1, 126):
        ready = packed(WORDS[: 4 * samples])
        out = bytearray(len(ready))
        for sequence in range(256):
            kernel.renumber_loads(out, sequence, ready)
            assert (out[:3], out[3], out[4:-4]) == (ready[:3], sequence, ready[4:-4])
            assert zlib.crc32(out[:-4]).to_bytes(4, "little") == out[-4:], (samples, sequence)


@given(waveforms, st.integers(0, 1000))
def test_ready_frames_give_words_back_and_frames_of_any_number(words, sequence):
    ready, back, out = packed(words), bytearray(len(words)), bytearray(b"\xff" * frames.UPLOAD_BYTES)
    assert kernel.unpack_loads(back, ready) == zlib.crc32(words)
    assert back == words
    kernel.renumber_loads(out, sequence, ready)
    assert out[: len(ready)] == packed(words, sequence)
    assert set(out[len(ready) :]) <= {0xFF}


def test_the_change_of_a_crc_by_a_number_is_right_for_every_length_and_number():
    """Against zlib over the whole frame, from a number that is not 0 to each of 256."""
    for payload in range(20, 501, 4):
        frame = bytearray(WORDS[: 8 + payload])
        was = frame[twin.NUMBER_AT]
        before = zlib.crc32(frame)
        changes = twin.number_changes(8 + payload + 4)
        for number in range(256):
            frame[twin.NUMBER_AT] = number
            assert zlib.crc32(frame) == before ^ changes[was ^ number]


@given(waveforms, st.data())
def test_a_page_with_any_bit_flipped_is_refused_and_its_frames_are_loads_that_the_fpga_refuses(words, data):
    ready = bytearray(packed(words))
    bit = data.draw(st.integers(0, 8 * len(ready) - 1))
    ready[bit >> 3] ^= 1 << (bit & 7)
    chunk = min(bit // 8 // 512, (len(words) - 1) // 500)
    with pytest.raises(ValueError, match=f"frame {chunk} is damaged"):
        kernel.unpack_loads(bytearray(len(words)), ready)
    out = bytearray(len(ready))
    kernel.renumber_loads(out, 99, ready)
    good = one_by_one(words, 99)
    if bit // 8 - 512 * chunk < 8:  # a header: it is written, not copied
        assert out == good
        return
    assert out != good
    frame, sound = out[512 * chunk : 512 * (chunk + 1)], good[512 * chunk : 512 * (chunk + 1)]
    assert frame[:8] == sound[:8]
    assert zlib.crc32(frame[:-4]) != int.from_bytes(frame[-4:], "little")


def test_padding_that_is_not_zero_is_damage_even_with_the_right_crc():
    ready = bytearray(packed(WORDS[:4]))
    ready[8 + 4] = 1
    ready[-4:] = zlib.crc32(ready[:-4]).to_bytes(4, "little")
    with pytest.raises(ValueError, match="frame 0 is damaged"):
        kernel.unpack_loads(bytearray(4), ready)


def test_frames_of_other_chunks_or_numbers_are_damage():
    ready = packed(WORDS)
    swapped = ready[512:1024] + ready[:512] + ready[1024:]
    for wrong, chunk in ((swapped, 0), (packed(WORDS, 1), 0), (ready[:-512] + packed(WORDS, 1)[-512:], 7)):
        with pytest.raises(ValueError, match=f"frame {chunk} is damaged"):
            kernel.unpack_loads(bytearray(4000), wrong)


@each_row("size", [0, 1, 31, 34, 513, 512 + 28, 512 + 510, 4096 + 32, 4097])
def test_a_page_of_an_impossible_length_is_refused(size):
    with pytest.raises(ValueError, match=f"{size} bytes are not the LOAD frames of a waveform"):
        kernel.renumber_loads(bytearray(8192), 0, bytes(size))
    with pytest.raises(ValueError, match=f"{size} bytes are not the frames of 4000 bytes of words"):
        kernel.unpack_loads(bytearray(4000), bytes(size))


@each_row("size", [0, 2, 3, 501, 4004])
def test_words_of_an_impossible_length_are_refused(size):
    for call in (
        lambda: kernel.pack_loads(bytearray(8192), 0, bytes(size)),
        lambda: kernel.unpack_loads(bytearray(size), packed(WORDS)),
        lambda: kernel.load_frames_bytes(size),
    ):
        with pytest.raises(ValueError, match=f"a waveform has 4 to 4000 bytes, a multiple of 4, not {size}"):
            call()


def test_a_buffer_that_is_too_short_is_refused_and_untouched():
    out = bytearray(b"\xff" * 4095)
    for call in (lambda: kernel.pack_loads(out, 0, WORDS), lambda: kernel.renumber_loads(out, 0, packed(WORDS))):
        with pytest.raises(ValueError, match="4096 bytes of frames do not fit into 4095"):
            call()
    for start, count in ((-1, 1), (4095, 1), (4060, 1), (0, 114), (0, -1)):
        with pytest.raises(ValueError, match="do not fit into 4095 bytes"):
            kernel.seal_short_frames(out, start, count, 0)
    assert set(out) == {0xFF}


def test_a_buffer_that_cannot_be_written_is_refused():
    for call in (
        lambda: kernel.pack_loads(bytes(4096), 0, WORDS),
        lambda: kernel.renumber_loads(memoryview(bytes(4096)), 0, packed(WORDS)),
        lambda: kernel.unpack_loads(bytes(4000), packed(WORDS)),
        lambda: kernel.seal_short_frames(memoryview(bytes(36)), 0, 1, 0),
    ):
        with pytest.raises((TypeError, ValueError, BufferError)):
            call()


@given(st.integers(0, 40), st.integers(0, 12), st.integers(0, 1000), st.randoms(use_true_random=False))
def test_short_frames_are_numbered_and_sealed(start, count, sequence, random):
    before = random.randbytes(start + 36 * count + 7)
    out = bytearray(before)
    kernel.seal_short_frames(out, start, count, sequence)
    expected = bytearray(before)
    for number in range(count):
        at = start + 36 * number
        expected[at + 3] = sequence + number & 0xFF
        expected[at + 32 : at + 36] = zlib.crc32(expected[at : at + 32]).to_bytes(4, "little")
    assert out == expected
