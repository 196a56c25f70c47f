"""Messages of uploads and plays: the same frames as packed one by one, whatever the fields and numbers are."""

import zlib
from itertools import accumulate

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.fpga import frames
from controller.fpga.exchange import COMMANDS
from controller.fpga.frames import FRAME_BYTES, ReadyFrames
from controller.fpga.play_messages import PlayMessages
from controller.fpga.registers import Control, Start
from controller.kernel import load_frames_bytes, pack_loads

WORDS = memoryview(np.random.default_rng(3).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8))
ROOM = frames.UPLOAD_BYTES + COMMANDS * FRAME_BYTES
plays = st.fixed_dictionaries(
    {
        "count": st.integers(0, 65535),
        "period_ticks": st.integers(0, 2**32 - 1),
        "start": st.sampled_from(Start),
        "when_ticks": st.integers(0, 2**64 - 1),
    }
)
sequences, slots = st.integers(0, 255), st.integers(0, 255)


@pytest.fixture(scope="module")
def panel(board):
    """A send buffer that holds what messages before left there, and the messages of a board for it."""
    sent = memoryview(bytearray(b"\xa5" * ROOM))
    return sent, PlayMessages(sent, board)


def one_by_one(sequence, *packed):
    """Frames packed by their own functions, with numbers from `sequence` on."""
    buffer, end, lengths = bytearray(ROOM), 0, []
    for pack, arguments, named in packed:
        start, end = end, pack(buffer, end, sequence + len(lengths), *arguments, **named)
        lengths.append(end - start)
    return buffer[:end], tuple(lengths)


def loads(words):
    return [(frames.pack_load, (chunk, words[500 * chunk : 500 * (chunk + 1)]), {}) for chunk in range(-(-len(words) // 500))]


NOP, STOP = (frames.pack_nop, (), {}), (frames.pack_control, (Control.STOP,), {})


def ready(words):
    page = bytearray(load_frames_bytes(words.nbytes))
    return ReadyFrames(memoryview(page).toreadonly(), pack_loads(page, 0, words))


@given(plays, sequences, slots, st.integers(0, 2**32 - 1), st.booleans())
def test_a_resident_play(panel, play, sequence, slot, mask, stop):
    sent, messages = panel
    lengths = messages.play(sequence, slot, **play, mask=mask, stop=stop)
    expected = one_by_one(sequence, *[STOP] * stop, (frames.pack_play, (slot,), {**play, "mask": mask}), NOP)
    assert (sent[: sum(lengths)], lengths) == expected


@pytest.mark.parametrize("waveform", [WORDS, ready(WORDS)], ids=["words", "ready frames"])
@given(play=plays, sequence=sequences, slot=slots, stop=st.booleans())
def test_an_upload_with_its_play(panel, waveform, play, sequence, slot, stop):
    sent, messages = panel
    lengths = messages.upload_and_play(sequence, slot, waveform, **play, stop=stop)
    store = (frames.pack_store, (slot, 1000, zlib.crc32(WORDS)), {})
    wait = STOP if stop else NOP
    expected = one_by_one(sequence, *loads(WORDS), store, wait, (frames.pack_play, (slot,), play), NOP)
    assert (sent[: sum(lengths)], lengths) == expected


@pytest.mark.parametrize("samples", [1000, 999, 876, 501, 126, 5, 1])
@pytest.mark.parametrize("kind", [memoryview, ready], ids=["words", "ready frames"])
def test_an_upload_on_boards_of_any_length(board, samples, kind):
    """Also of so few samples that the last payload is padded."""
    short = msgspec.structs.replace(board, waveform=msgspec.structs.replace(board.waveform, duration_ms=samples / 500))
    assert short.waveform.samples == samples
    sent = memoryview(bytearray(b"\xa5" * ROOM))
    messages = PlayMessages(sent, short)
    words = WORDS[: 4 * samples]
    for sequence in (0, 7, 250):
        lengths = messages.upload(sequence, 2, kind(words))
        store = (frames.pack_store, (2, samples, zlib.crc32(words)), {})
        waits = len(lengths) - messages.loads - 1
        assert 36 * 8 * (waits - 1) / board.link.sck_hz <= (samples + 8) / board.link.clock_hz < 36 * 8 * waits / board.link.sck_hz
        expected = one_by_one(sequence, *loads(words), store, *[NOP] * waits)
        assert (sent[: sum(lengths)], lengths) == expected
        assert [piece.start for piece in frames.upload_slices(samples)] == [0, *accumulate(lengths[: messages.loads - 1])]


@pytest.mark.parametrize("waveform", [WORDS[:3996], ready(WORDS[:2000])], ids=["words", "ready frames"])
def test_a_waveform_of_another_length_is_refused(panel, waveform):
    """With other frames than the FPGA is told of, it would store a mixture of two uploads."""
    _, messages = panel
    with pytest.raises(ValueError, match=r"not 4\d{3} as the board's waveforms have"):
        messages.upload(0, 0, waveform)
    with pytest.raises(ValueError, match="as the board's waveforms have"):
        messages.upload_and_play(0, 0, waveform, count=1, period_ticks=0, start=Start.NOW, when_ticks=0, stop=False)
