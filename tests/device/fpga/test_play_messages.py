"""Messages of uploads and plays: the same frames as packed one by one, whatever the fields and numbers are."""

import zlib
from itertools import accumulate

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.exchange import COMMANDS
from controller.device.fpga.frames import FRAME_BYTES, Play, ReadyFrames
from controller.device.fpga.play_messages import PlayMessages, _pattern
from controller.device.fpga.registers import Control, Start
from controller.device.kernel import load_frames_bytes, pack_loads

WORDS = memoryview(np.random.default_rng(3).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8))
ROOM = frames.UPLOAD_BYTES + COMMANDS * FRAME_BYTES
plays = st.builds(
    Play,
    slot=st.integers(0, 65535),
    first=st.integers(0, 65535),
    length=st.integers(0, 65535),
    emissions=st.integers(0, 65535),
    start=st.sampled_from(Start),
    inverted=st.booleans(),
    period_ticks=st.integers(0, 2**32 - 1),
    mask=st.integers(0, 2**32 - 1),
    when_ticks=st.integers(0, 2**64 - 1),
)
sequences = st.integers(0, 255)


@pytest.fixture(scope="module")
def panel(board):
    """A send buffer that holds what messages before left there, and the messages of a board for it."""
    sent = memoryview(bytearray(b"\xa5" * ROOM))
    return sent, PlayMessages(sent, board)


def one_by_one(sequence, *packed):
    """Frames packed by their own functions, with numbers from `sequence` on."""
    buffer, end, lengths = bytearray(ROOM), 0, []
    for pack, *arguments in packed:
        start, end = end, pack(buffer, end, sequence + len(lengths), *arguments)
        lengths.append(end - start)
    return buffer[:end], tuple(lengths)


def loads(words):
    return [(frames.pack_load, chunk, words[500 * chunk : 500 * (chunk + 1)]) for chunk in range(-(-len(words) // 500))]


NOP, STOP = (frames.pack_nop,), (frames.pack_control, Control.STOP)


def ready(words):
    page = bytearray(load_frames_bytes(words.nbytes))
    return ReadyFrames(memoryview(page).toreadonly(), pack_loads(page, 0, words))


@given(plays, sequences, st.booleans())
def test_a_resident_play(panel, play, sequence, stop):
    sent, messages = panel
    lengths = messages.play(sequence, play, stop=stop)
    expected = one_by_one(sequence, *[STOP] * stop, (frames.pack_play, play), NOP)
    assert (sent[: sum(lengths)], lengths) == expected


@pytest.mark.parametrize("waveform", [WORDS, ready(WORDS)], ids=["words", "ready frames"])
@given(play=plays, sequence=sequences, stop=st.booleans())
def test_an_upload_with_its_play(panel, waveform, play, sequence, stop):
    sent, messages = panel
    lengths = messages.upload_and_play(sequence, play, waveform, stop=stop)
    store = (frames.pack_store, play.slot, 1000, zlib.crc32(WORDS))
    wait = STOP if stop else NOP
    expected = one_by_one(sequence, *loads(WORDS), store, wait, (frames.pack_play, play), NOP)
    assert (sent[: sum(lengths)], lengths) == expected


@each_row("samples", [1000, 999, 876, 501, 126, 5, 1])
@each_row("kind", [memoryview, ready], ids=["words", "ready frames"])
def test_an_upload_on_boards_of_any_length(board, samples, kind):
    """Also of so few samples that the last payload is padded."""
    short = msgspec.structs.replace(board, waveform=msgspec.structs.replace(board.waveform, duration_ms=samples / 500))
    assert short.waveform.samples == samples
    sent = memoryview(bytearray(b"\xa5" * ROOM))
    messages = PlayMessages(sent, short)
    words = WORDS[: 4 * samples]
    for sequence in (0, 7, 250):
        lengths = messages.upload(sequence, 2, kind(words))
        store = (frames.pack_store, 2, samples, zlib.crc32(words))
        waits = len(lengths) - messages.loads - 1
        assert 36 * 8 * (waits - 1) / board.link.sck_hz <= (samples + 8) / board.link.clock_hz < 36 * 8 * waits / board.link.sck_hz
        expected = one_by_one(sequence, *loads(words), store, *[NOP] * waits)
        assert (sent[: sum(lengths)], lengths) == expected
        assert [piece.start for piece in frames.upload_slices(samples)] == [0, *accumulate(lengths[: messages.loads - 1])]


@pytest.mark.parametrize("waveform", [WORDS[:3996], ready(WORDS[:2000])], ids=["words", "ready frames"])
def test_a_waveform_of_another_length_is_refused(panel, waveform):
    """With other frames than those announced, the FPGA would store a mixture of two uploads."""
    _, messages = panel
    with pytest.raises(ValueError, match=r"not 4\d{3} as the board's waveforms have"):
        messages.upload(0, 0, waveform)
    with pytest.raises(ValueError, match="as the board's waveforms have"):
        messages.upload_and_play(0, Play(0, start=Start.NOW), waveform, stop=False)
    assert len(_pattern((), [bytearray(FRAME_BYTES)] * COMMANDS, None).lengths) == COMMANDS, "as many as the buffer has room for"
    with pytest.raises(AssertionError):
        _pattern((), [bytearray(FRAME_BYTES)] * (COMMANDS + 1), None)
