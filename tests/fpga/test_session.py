"""The host's side of the protocol against the gateware model, and on links that damage what they carry."""

import msgspec
import numpy as np
import pytest

from controller.errors import LinkError
from controller.event_loop import VirtualClock
from controller.fpga import frames
from controller.fpga.exchange import Refused
from controller.fpga.model import GatewareModel
from controller.fpga.registers import Result, State
from controller.fpga.session import Session
from controller.fpga.simulated_link import SimulatedLink

BUILD = 0x1234ABCD
WORDS = memoryview(np.random.default_rng(7).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8)).cast("B")


def gateware(settings, build_hash=BUILD):
    return GatewareModel(settings.clock_hz, settings.slots, build_hash, settings.clock_hz // 4)


class NoisyLink(SimulatedLink):
    """A link that flips one bit of what passes: `noise` maps the number of a frame to (direction, byte)."""

    def __init__(self, *args):
        super().__init__(*args)
        self.noise = {}
        self.frames = 0

    def exchange(self, sent, lengths, received):
        start = 0
        for length in lengths:
            direction, byte = self.noise.get(self.frames, ("", 0))
            self.frames += 1
            frame = bytearray(sent[start : start + length])
            if direction == "to the FPGA":
                frame[byte % length] ^= 4
            if direction == "lost, an old NOP instead":
                frames.pack_nop(frame, 0, 200)
            super().exchange(memoryview(frame), [length], received[start : start + length])
            if direction == "to the host":
                received[start + byte % length] ^= 4
            start += length


@pytest.fixture
def clock():
    return VirtualClock()


@pytest.fixture
def link(board, clock):
    return NoisyLink(board.link, clock.now_s, gateware(board.link))


@pytest.fixture
def armed(board, clock, link):
    session = Session(link, board, BUILD, clock.now_s)
    clock._now_s = session.arm()
    session.require_armed()
    return session


def wait(clock, link, seconds):
    clock._now_s = max(clock.now_s(), link.free_s()) + seconds


def test_arming_glides_to_the_idle_word_and_disarming_back_to_zero(board, clock, link, armed):
    assert State.HV_ENABLE in armed.heartbeat().state
    clock._now_s = armed.disarm()
    assert armed.heartbeat().state & (State.ARMED | State.HV_ENABLE) == 0
    link.close()
    capture = link.take_capture()
    assert board.idle_word in capture.words
    assert not (capture.words & ~np.uint32(board.idle_word)).any()
    assert capture.words[-1] == capture.hv[-1] == 0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"build_hash": BUILD + 1}, "BUILD_HASH"),
        ({"clock_hz": 50_000_000, "sck_hz": 8_000_000}, "CLOCK_HZ"),
        ({"slots": 3}, "has 3 slots"),
    ],
)
def test_refuses_another_fpga_than_the_boards_before_anything_is_armed(board, clock, change, said):
    settings = msgspec.structs.replace(board.link, **{k: v for k, v in change.items() if k != "build_hash"})
    link = SimulatedLink(settings, clock.now_s, gateware(settings, change.get("build_hash", BUILD)))
    with pytest.raises(LinkError, match=said):
        Session(link, board, BUILD, clock.now_s)
    link.close()
    assert not link.take_capture().hv.any()


def test_refuses_an_fpga_that_somebody_else_has_armed(board, clock, link, armed):
    with pytest.raises(LinkError, match="armed already"):
        Session(link, board, BUILD, clock.now_s)


def test_a_silent_link_is_explained(board, clock):
    class Silent(SimulatedLink):
        def exchange(self, _sent, _lengths, received):
            received[:] = bytes(len(received))

    with pytest.raises(LinkError, match="is MISO wired"):
        Session(Silent(board.link, clock.now_s, gateware(board.link)), board, BUILD, clock.now_s)


def test_an_upload_comes_out_of_the_pins_word_by_word(board, clock, link, armed):
    armed.upload_and_play(2, WORDS, 1, 0.0, stop=False)
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 1
    capture = link.take_capture()
    start = int(capture.focus_ticks[0]) - 1000 * board.bit_ticks
    sampled = start + board.bit_ticks * np.arange(1000)
    words = capture.words[np.searchsorted(capture.ticks.astype(np.int64), sampled, side="right") - 1]
    assert words.tobytes() == bytes(WORDS)


@pytest.mark.parametrize("chunk", range(8))
@pytest.mark.parametrize("byte", [0, 3, 5, 7, 100, 510])
def test_a_chunk_damaged_on_its_way_is_sent_again_and_played_right(board, clock, link, armed, chunk, byte):
    link.noise = {link.frames + chunk: ("to the FPGA", byte)}
    armed.upload_and_play(0, WORDS, 1, 0.0, stop=False)
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 1
    link.close()
    assert link.take_capture().focus_ticks.size == 1


@pytest.mark.parametrize("direction", ["to the FPGA", "to the host"])
def test_a_link_that_damages_everything_is_given_up_with_nothing_left_to_play(clock, link, armed, direction):
    link.noise = dict.fromkeys(range(link.frames, link.frames + 1000), (direction, 20))
    with pytest.raises(LinkError):
        armed.upload_and_play(0, WORDS, 1, 0.0, stop=False)
    link.noise = {}
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 0


def test_a_frame_that_did_not_arrive_is_missed_by_its_number(clock, link, armed):
    armed.upload_and_play(0, WORDS, 1, 0.0, stop=False)
    armed.trigger()
    wait(clock, link, 3e-3)
    link.noise = {link.frames: ("lost, an old NOP instead", 0)}
    armed.play(0, 1, 0.0, stop=False)
    assert State.PENDING in armed.heartbeat().state, "sent again: it is there after all"
    link.noise = {link.frames: ("lost, an old NOP instead", 0)}
    with pytest.raises(LinkError, match="lost on its way"):
        armed.clear_faults()


@pytest.mark.parametrize("frame", range(11))
def test_a_damaged_answer_to_an_upload_makes_it_go_again_and_play_once(clock, link, armed, frame):
    link.noise = {link.frames + frame: ("to the host", 9)}
    armed.upload_and_play(0, WORDS, 1, 0.0, stop=False)
    armed.trigger()
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 1


@pytest.mark.parametrize("byte", [0, 2, 4, 20, 31])
def test_damaged_answers_are_asked_for_again_and_never_believed(link, armed, byte):
    link.noise = {link.frames: ("to the host", byte)}
    assert State.ARMED in armed.heartbeat().state
    link.noise = dict.fromkeys(range(link.frames, link.frames + 3), ("to the host", byte))
    with pytest.raises(LinkError, match="status"):
        armed.heartbeat()


def test_what_the_fpga_refuses_is_said_in_a_sentence_and_changes_nothing(armed):
    with pytest.raises(Refused, match="Nothing has been stored in this slot") as caught:
        armed.play(3, 1, 0.0, stop=False)
    assert caught.value.result is Result.EMPTY_SLOT
    armed.upload_and_play(3, WORDS, 1, 0.0, stop=False)
    with pytest.raises(Refused, match="still in use"):
        armed.play(3, 1, 0.0, stop=False)
    assert State.PENDING in armed.heartbeat().state


def test_time_on_the_wire_is_that_of_the_bits_at_sck_and_a_pause_between_frames(board, link, armed):
    wire_ns, bytes_sent = link.wire_ns, link.bytes_sent
    armed.upload_and_play(0, WORDS, 1, 0.0, stop=False)
    assert link.bytes_sent - bytes_sent == 4096 + 3 * 32
    bits_ns = 8 * (4096 + 3 * 32) / board.link.sck_hz * 1e9
    assert bits_ns < link.wire_ns - wire_ns < bits_ns * 1.003 + 11 * 300
