"""What an upload costs the host: the payload copied once into the frames, a CRC pass there and one for its slot, no more."""

import tracemalloc
import zlib

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from controller.clocks import VirtualClock
from controller.fpga import frames, session, upload_image
from controller.fpga.upload_image import UploadImage
from controller.hardware import open_session, open_simulated

WORDS = memoryview(np.random.default_rng(3).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8))
BUFFER = memoryview(bytearray(frames.UPLOAD_BYTES))


def test_packing_copies_nothing_but_into_the_frame():
    """With a payload so large that a second copy of it could not hide behind the few memoryviews made (0.7 kB)."""
    payload = memoryview(bytes(60_000))
    buffer = memoryview(bytearray(60_100))
    frames.pack_load(buffer, 0, 0, 0, payload)
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        frames.pack_load(buffer, 0, 0, 0, payload)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak - before < 2_000


def count_crcs(monkeypatch, *modules):
    checked = []

    class CountingZlib:
        @staticmethod
        def crc32(data):
            checked.append(len(data))
            return zlib.crc32(data)

    for module in modules:
        monkeypatch.setattr(module, "zlib", CountingZlib)
    return checked


def test_packing_an_upload_is_one_crc_pass(monkeypatch):
    checked = count_crcs(monkeypatch, frames)
    frames.pack_upload(BUFFER, 0, 0, WORDS)
    assert checked == [8 + 500] * 8


def test_an_upload_and_its_play_are_two_crc_passes(monkeypatch, board):
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    fpga = open_session(link, board, clock.now_s)
    checked = count_crcs(monkeypatch, frames, session, upload_image)
    fpga.upload(0, WORDS)
    long = [size for size in checked if size > frames.FRAME_BYTES]
    assert long == [*[8 + 500] * 8, 4000]
    assert link.bytes_sent > frames.UPLOAD_BYTES


def test_every_byte_of_the_payload_arrives_in_its_chunk():
    frames.pack_upload(BUFFER, 0, 0, WORDS)
    payload = b"".join(bytes(BUFFER[piece][8:-4]) for piece in frames.upload_slices(1000))
    assert payload == bytes(WORDS)


@given(st.integers(1, 1000), st.integers(0, 255), st.binary(min_size=36, max_size=36))
def test_the_image_of_an_upload_is_what_packing_it_frame_by_frame_gives(samples, sequence, between):
    words = WORDS[: 4 * samples]
    plain, kept = (memoryview(bytearray(frames.UPLOAD_BYTES)) for _ in range(2))
    image = UploadImage(kept, samples)
    image.pack(sequence ^ 0x55, WORDS[-4 * samples :])
    kept[: len(between)] = between
    end = frames.pack_upload(plain, 0, sequence, words)
    assert image.pack(sequence, words) == end == sum(image.lengths)
    assert kept[:end] == plain[:end]
