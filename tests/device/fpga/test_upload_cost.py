"""Cost of an upload on the host: a payload is copied once, into the frames; that of a bank is not read for a CRC."""

import tracemalloc
import zlib

import numpy as np
import pytest
from alone import alone
from loop_parts import context_of, playback_of

from controller.clocks import VirtualClock
from controller.device.bank import drive_entries
from controller.device.bank.reader import Bank
from controller.device.fpga import frames, play_messages
from controller.device.fpga.frames import ReadyFrames
from controller.device.kernel import pack_loads, twin
from controller.device.loop.playing.records import Accepted, Batch
from controller.device.scene.emission import Emission
from controller.device.service.drivers import open_session
from controller.device.waveforms.selection import Selection
from controller.workshop.gateware.simulated_link import open_simulated

WORDS = memoryview(np.random.default_rng(3).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8))


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


def count_crcs(monkeypatch):
    """Lengths of what is read for a CRC from now on, by the kernel's twin: what the compiled one does is the same."""
    checked = []
    twin.number_changes(512)  # made once

    class CountingZlib:
        @staticmethod
        def crc32(data):
            checked.append(len(data))
            return zlib.crc32(data)

    monkeypatch.setattr(twin, "zlib", CountingZlib)
    for name in ("pack_loads", "renumber_loads", "seal_short_frames"):
        monkeypatch.setattr(play_messages, name, getattr(twin, name))
    monkeypatch.setattr(drive_entries, "unpack_loads", twin.unpack_loads)
    return checked


def ready():
    page = bytearray(frames.UPLOAD_BYTES)
    return ReadyFrames(memoryview(page).toreadonly(), pack_loads(page, 0, WORDS))


@pytest.mark.parametrize(("waveform", "crcs"), [(WORDS, [*[8 + 500] * 8, 4000]), (ready(), [])], ids=["composed", "of the bank"])
def test_composed_words_are_read_for_the_crcs_of_frames_and_slot_and_ready_frames_not_at_all(monkeypatch, board, waveform, crcs):
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    fpga = open_session(link, board, clock.now_s)
    checked = count_crcs(monkeypatch)
    fpga.upload(0, waveform)
    assert [size for size in checked if size > frames.FRAME_BYTES] == crcs
    assert link.bytes_sent > frames.UPLOAD_BYTES
    assert fpga.exchange.read_slot_crc(0) == zlib.crc32(WORDS)


def test_an_entry_that_was_used_before_is_sent_without_reading_its_payload_for_a_crc(monkeypatch, board, bank_file):
    """First uses are checked by the host; later ones by the FPGA, against the CRCs of the frames and the bank's own table."""
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    fpga = open_session(link, board, clock.now_s)
    fpga.arm()
    clock._now_s += 0.02
    with Bank.open(bank_file, board) as bank:
        selection = Selection(bank, 1e-3, board.idle_word)
        context = context_of(board, clock, fpga)
        playback = playback_of(context, selection, slots=4)
        checked = count_crcs(monkeypatch)
        passes = []
        for x_m, y_m in [tuple(place) for place in bank.grid.points()[[60, 61, 62, 63, 64]]] * 2:  # of four slots none serves
            checked.clear()
            clock._now_s += 0.01
            assert isinstance(playback.prepare(Batch([Emission(0.0, x_m, y_m, None, "")]), 0), Accepted)
            passes.append(sum(size > frames.FRAME_BYTES for size in checked))
    assert context.counters.uploads == 10
    assert passes == [8 + 1] * 5 + [0] * 5
