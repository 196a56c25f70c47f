"""An entry of the bank that changes in the file after it was checked, as on failing storage or under `cp`.

Its frames are in the file: the FPGA refuses what changed, the host finds which entry it was, and does not send it again.
"""

import shutil
import struct
import zlib
from types import SimpleNamespace

import numpy as np
import pytest
from loop_parts import context_of, playback_of
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.fpga import frames
from controller.device.fpga.registers import Control, FrameType, Register
from controller.device.fpga.status import State
from controller.device.loop.commands import Outcome
from controller.device.loop.playing.records import Accepted, Batch
from controller.device.scene.emission import Emission
from controller.device.service.drivers import open_session
from controller.device.waveforms.selection import Selection
from controller.workshop.gateware.simulated_link import open_simulated

CELL, OTHER = 60, 130


def payload(page):
    page[5 * 512 + 100] ^= 0x10


def crc(page):
    page[3 * 512 + 510] ^= 0x01


def all_of_it(page):
    page[:] = np.random.default_rng(1).bytes(4096)


def zeros(page):
    page[:] = bytes(4096)


def another_entry(page, other):
    page[:] = other


def commands(page):
    """Good frames, that would arm, write and trigger if they were sent as they are."""
    for number in range(8):
        head = struct.pack("<HBBHHI", 0xA55A, FrameType.WRITE, number, 500, Register.CONTROL, Control.TRIGGER).ljust(508, b"\0")
        page[512 * number : 512 * (number + 1)] = head + struct.pack("<I", zlib.crc32(head))


@pytest.fixture
def panel(board, bank_file, tmp_path):
    """A playback from a file of its own, entries CELL and OTHER of which have been used; frames that go out are kept."""
    path = tmp_path / "own.bank"
    shutil.copyfile(bank_file, path)
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    session.arm()
    clock._now_s += 0.02
    sent = []
    exchange = link.exchange

    def kept(message, lengths, received):
        start = 0
        for length in lengths:
            sent.append(bytes(message[start : start + length]))
            start += length
        exchange(message, lengths, received)

    link.exchange = kept
    with Bank.open(path, board) as bank:
        context = context_of(board, clock, session)
        playback = playback_of(context, Selection(bank, 1e-3, board.idle_word), slots=1)
        there = SimpleNamespace(
            path=path, bank=bank, clock=clock, counters=context.counters, session=session, playback=playback, sent=sent, link=link
        )
        for cell in (CELL, OTHER):
            assert play(there, cell) is Outcome.PLAYED
        clock._now_s += 0.01  # until it has sounded
        sent.clear()
        yield there


def play(panel, cell):
    panel.clock._now_s += 0.01
    x_m, y_m = panel.bank.grid.place(cell)
    became = panel.playback.prepare(Batch([Emission(0.0, x_m, y_m, None, "")]), 0)
    return Outcome.PLAYED if isinstance(became, Accepted) else became


def rot(panel, damage):
    """Change the entry of CELL in the file, below the mapping."""
    page = bytearray(panel.bank.drive.frames(CELL)[0])
    if damage is another_entry:
        damage(page, panel.bank.drive.frames(OTHER)[0])
    else:
        damage(page)
    entry = panel.bank.file.tables.entries[CELL]
    section = panel.bank.sections["drive"]
    with panel.path.open("r+b") as file:
        file.seek(section.offset + entry * section.stride)
        file.write(page)
    return entry


@each_row("damage", [payload, crc, all_of_it, zeros, another_entry, commands], afresh=[panel])
def test_an_entry_that_rotted_after_its_check_is_never_played_and_is_named_once(panel, damage):
    before = panel.session.heartbeat()
    panel.sent.clear()
    entry = rot(panel, damage)
    assert play(panel, CELL) is Outcome.SKIPPED
    said = panel.counters.bad_entry
    assert said.startswith(f"{panel.path}: drive of entry {entry} (cell {CELL}) is damaged; rebuild it: haptic-panel bank build ")
    assert panel.counters.skipped.bad_entries == 1
    assert panel.counters.skipped.refused == 0
    longs = [frame for frame in panel.sent if len(frame) == 512]
    assert 0 < len(longs) <= 3 * 8, "as many attempts as for a damaged wire"
    for frame in longs:
        assert struct.unpack_from("<HB", frame) == (0xA55A, FrameType.LOAD), "whatever the file holds"
        assert frame[4] | frame[5] << 8 == 500
    panel.sent.clear()
    for attempt in (2, 3):
        assert play(panel, CELL) is Outcome.SKIPPED
        assert panel.counters.skipped.bad_entries == attempt
    assert panel.sent == [], "the host knows by now"
    after = panel.session.heartbeat()
    assert after.emissions == before.emissions
    assert after.queued == 0
    assert after.state & State.ARMED
    assert not after.state & State.PENDING
    assert play(panel, OTHER) is Outcome.PLAYED
    panel.clock._now_s += 0.01
    assert panel.session.heartbeat().emissions == before.emissions + 1


def test_an_entry_whose_frames_have_wrong_headers_in_the_file_is_sent_with_right_ones(panel):
    """Of a page only words and CRCs are taken: headers are the host's own."""

    def headers(page):
        for number in range(8):
            page[512 * number : 512 * number + 8] = b"\xff" * 8

    rot(panel, headers)
    assert play(panel, CELL) is Outcome.PLAYED


def test_an_entry_that_is_repaired_is_played_again(panel):
    whole = panel.path.read_bytes()
    rot(panel, payload)
    assert play(panel, CELL) is Outcome.SKIPPED
    with panel.path.open("r+b") as file:
        file.write(whole)
    assert play(panel, CELL) is Outcome.PLAYED


def test_a_rotten_entry_is_not_fetched_ahead_again_and_again(panel, monkeypatch):
    rot(panel, payload)
    x_m, y_m = panel.bank.grid.place(CELL)
    panel.playback.sender.slots.slots = 2  # of one slot none is spared for what is fetched ahead
    monkeypatch.setattr(panel.playback.sender._prefetch, "predict", lambda *_: True)
    assert not panel.playback.sender.prefetch(0, x_m, y_m, 1.0)
    assert sum(len(frame) == 512 for frame in panel.sent) <= 3 * 8
    panel.sent.clear()
    for _ in range(3):
        assert not panel.playback.sender.prefetch(0, x_m, y_m, 1.0)
    assert panel.sent == []
    assert panel.bank.counters.bad == 4


def test_a_wire_that_damages_every_upload_is_not_blamed_on_the_bank(panel):
    good = panel.link.exchange

    def damaging(message, lengths, received):
        at = lengths[0] // 2
        if lengths[0] == 512:
            message[at] ^= 1
        good(message, lengths, received)
        if lengths[0] == 512:
            message[at] ^= 1

    panel.link.exchange = damaging
    assert play(panel, CELL) is Outcome.REFUSED
    assert (panel.counters.skipped.refused, panel.counters.skipped.bad_entries) == (1, 0)
    panel.link.exchange = good
    assert play(panel, CELL) is Outcome.PLAYED


def test_frames_of_the_file_go_out_with_the_number_that_is_due(panel):
    for _ in range(30):  # through 256
        panel.sent.clear()
        for cell in (CELL, OTHER):
            assert play(panel, cell) is Outcome.PLAYED
            loads = [frame for frame in panel.sent if len(frame) == 512][-8:]
            first = loads[0][3]
            packed = bytearray(frames.LOAD_FRAME_BYTES)
            words = panel.bank.drive.words(cell)
            for chunk, frame in enumerate(loads):
                frames.pack_load(packed, 0, first + chunk, chunk, words[500 * chunk : 500 * (chunk + 1)])
                assert frame == packed
