"""What an upload costs the host: the payload copied once into the frames, one CRC pass over it, nothing else of its size."""

import tracemalloc
import zlib

import numpy as np

from controller.fpga import frames

WORDS = memoryview(np.random.default_rng(3).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8))
BUFFER = memoryview(bytearray(frames.UPLOAD_BYTES))


def test_packing_an_upload_allocates_nothing_of_the_payloads_size():
    frames.pack_upload(BUFFER, 0, 0, WORDS)
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        frames.pack_upload(BUFFER, 0, 0, WORDS)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak - before < 1000, "a few memoryviews (0.7 kB); a hidden copy of one chunk would be 0.5 kB more"


def test_packing_an_upload_is_one_crc_pass(monkeypatch):
    checked = []

    class CountingZlib:
        @staticmethod
        def crc32(data):
            checked.append(len(data))
            return zlib.crc32(data)

    monkeypatch.setattr(frames, "zlib", CountingZlib)
    frames.pack_upload(BUFFER, 0, 0, WORDS)
    assert checked == [8 + 500] * 8


def test_every_byte_of_the_payload_arrives_in_its_chunk():
    frames.pack_upload(BUFFER, 0, 0, WORDS)
    payload = b"".join(bytes(BUFFER[piece][8:-4]) for piece in frames.upload_slices(1000))
    assert payload == bytes(WORDS)
