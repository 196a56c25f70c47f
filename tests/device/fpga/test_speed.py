"""Benchmarks of frames: `pytest -o addopts=--import-mode=importlib --benchmark-only tests/device/fpga/test_speed.py`."""

import pytest

from controller.device import kernel
from controller.device.fpga import frames, play_messages
from controller.device.fpga.frames import Play, ReadyFrames
from controller.device.fpga.play_messages import PlayMessages
from controller.device.kernel import twin

WORDS = memoryview(bytes((37 * n * n + n >> 3) & 0xFF for n in range(4000)))
PAGE = bytearray(frames.UPLOAD_BYTES)
READY = ReadyFrames(memoryview(PAGE).toreadonly(), twin.pack_loads(PAGE, 0, WORDS))
PLAY = Play(1)


@pytest.fixture(params=["compiled", "twin"])
def by(request, monkeypatch):
    """The kernel's functions, compiled or the twin's, also for the messages."""
    if request.param == "compiled" and not kernel.COMPILED:
        pytest.skip("the package was built without a C compiler")
    module = kernel if request.param == "compiled" else twin
    for name in ("pack_loads", "renumber_loads", "seal_short_frames"):
        monkeypatch.setattr(play_messages, name, getattr(module, name))
    return module


@pytest.fixture
def sent():
    return memoryview(bytearray(frames.UPLOAD_BYTES + 8 * frames.FRAME_BYTES))


def test_loads_of_a_lone_cell(benchmark, by, sent):
    """From the bank's page to the send buffer."""
    benchmark(by.renumber_loads, sent, 77, READY.frames)


def test_loads_of_composed_words(benchmark, by, sent):
    benchmark(by.pack_loads, sent, 77, WORDS)


def test_check_of_a_page(benchmark, by):
    """On the first use of an entry."""
    benchmark(by.unpack_loads, bytearray(4000), PAGE)


@pytest.mark.parametrize("waveform", [READY, WORDS], ids=["lone cell", "composed"])
def test_message_of_an_upload(benchmark, by, board, sent, waveform):
    """LOADs, STORE, NOP, PLAY, NOP."""
    messages = PlayMessages(sent, board)
    benchmark(lambda: messages.upload_and_play(77, PLAY, waveform, stop=False))


def test_message_of_a_resident_play(benchmark, by, board, sent):
    messages = PlayMessages(sent, board)
    benchmark(lambda: messages.play(77, PLAY, stop=False))
