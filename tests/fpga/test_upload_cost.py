"""Cost of an upload on the host: the payload is copied once, into the frames, with one CRC pass there and one for its slot."""

import tracemalloc
import zlib

import numpy as np
import pytest
from alone import alone
from hypothesis import given
from hypothesis import strategies as st

from controller.bank import reader
from controller.bank.reader import Bank
from controller.clocks import VirtualClock
from controller.fpga import frames, session, upload_image
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.upload_image import UploadImage, upload_slices
from controller.loop.commands import Outcome
from controller.loop.occupancy import Occupancy
from controller.loop.playback import Playback
from controller.loop.records import Batch
from controller.metrics import Counters
from controller.scene.emission import Emission
from controller.service.drivers import open_session, open_simulated
from controller.waveforms import selection as selection_module
from controller.waveforms.selection import Selection

WORDS = memoryview(np.random.default_rng(3).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8))
BUFFER = memoryview(bytearray(frames.UPLOAD_BYTES))


def test_packing_copies_nothing_but_into_the_frame():
    """With a payload so large that a second copy of it could not hide behind the few memoryviews made (0.7 kB)."""
    payload = memoryview(bytes(60_000))
    buffer = memoryview(bytearray(60_100))
    frames.pack_load(buffer, 0, 0, 0, payload)

    def peak_bytes():
        tracemalloc.start()
        before, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        frames.pack_load(buffer, 0, 0, 0, payload)
        return tracemalloc.get_traced_memory()[1] - before

    assert alone(peak_bytes) < 2_000


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
    checked = count_crcs(monkeypatch, upload_image)
    UploadImage(BUFFER, 1000).pack(0, WORDS)
    assert checked == [8 + 500] * 8


@pytest.mark.parametrize(("crc", "more"), [(None, [4000]), (zlib.crc32(WORDS), [])], ids=["composed", "of the bank"])
def test_an_upload_is_one_crc_pass_and_one_more_for_words_without_a_banks_crc(monkeypatch, board, crc, more):
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    fpga = open_session(link, board, clock.now_s)
    checked = count_crcs(monkeypatch, frames, session, upload_image)
    fpga.upload(0, WORDS, crc)
    long = sorted(size for size in checked if size > frames.FRAME_BYTES)
    assert long == [*[8 + 500] * 8, *more]
    assert link.bytes_sent > frames.UPLOAD_BYTES


def test_an_entry_that_was_used_before_is_passed_by_the_crc_of_its_frames_only(monkeypatch, board, bank_file):
    """First uses are checked by the host; later ones by the FPGA, against the bank's own table."""
    clock, counters = VirtualClock(), Counters()
    link = open_simulated(board, clock.now_s)
    fpga = open_session(link, board, clock.now_s)
    fpga.arm()
    clock._now_s += 0.02
    with Bank.open(bank_file, board) as bank:
        selection = Selection(bank, 1e-3, board.idle_word)
        estimate = ClockEstimate(link.clock_hz)
        playback = Playback(
            fpga, selection, estimate, Occupancy(estimate, 2e-3, 1.0), lambda *_: None, slots=4, upload_s=1.4e-3, command_s=1e-5,
            counters=counters,
        )  # fmt: skip
        checked = count_crcs(monkeypatch, frames, session, upload_image, reader, selection_module)
        passes = []
        for x_m, y_m in [tuple(place) for place in bank.grid.points()[[60, 61, 62, 63, 64]]] * 2:  # of four slots none serves
            checked.clear()
            clock._now_s += 0.01
            assert playback.prepare(Batch([Emission(0.0, x_m, y_m, None, "")]), 0).outcome is Outcome.PLAYED
            passes.append(sum(size > frames.FRAME_BYTES for size in checked))
    assert counters.uploads == 10
    assert passes == [8 + 1] * 5 + [8] * 5


def test_every_byte_of_the_payload_arrives_in_its_chunk():
    UploadImage(BUFFER, 1000).pack(0, WORDS)
    payload = b"".join(bytes(BUFFER[piece][8:-4]) for piece in upload_slices(1000))
    assert payload == bytes(WORDS)


@given(st.integers(1, 1000), st.integers(0, 255), st.binary(min_size=36, max_size=36))
def test_an_upload_image_equals_packing_frame_by_frame(samples, sequence, between):
    words = WORDS[: 4 * samples]
    plain, kept = (memoryview(bytearray(frames.UPLOAD_BYTES)) for _ in range(2))
    image = UploadImage(kept, samples)
    image.pack(sequence ^ 0x55, WORDS[-4 * samples :])
    kept[: len(between)] = between
    end = 0
    for chunk in range(-(-samples // 125)):
        end = frames.pack_load(plain, end, sequence + chunk, chunk, words[500 * chunk : 500 * (chunk + 1)])
    assert image.pack(sequence, words) == end == sum(image.lengths)
    assert kept[:end] == plain[:end]
