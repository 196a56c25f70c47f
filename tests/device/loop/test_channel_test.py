"""The test of one channel: a chirp on its pin, and no other pin moves; alone, between what fingers feel, refused while off."""

import zlib

import numpy as np
import pytest
from device.board.changed_board import changed
from pins_and_counters import emissions_on_pins
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board, simulated
from controller.device.board.lookup import find_board
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.waveforms.channel_test import chirp_words
from controller.errors import FaultError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.gateware.simulated_link import open_simulated

IDLE = 0x99999999
PAPER_HZ = (20e3, 70e3)
BANDS_HZ = (PAPER_HZ, (24e3, 55e3))
TRAIN = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ when = "press", rate_hz = 50, count = 20 }]\n'
NOTHING = '[[regions]]\nname = "all"\nshape = "plate"\neffects = []\n'


def words_of(channel, samples=1000, bit_clock_hz=500e3, band_hz=PAPER_HZ):
    return np.frombuffer(chirp_words(channel, samples, bit_clock_hz, IDLE, band_hz), "<u4")


@each_row("band_hz", BANDS_HZ)
@each_row("channel", [0, 5, 31])
def test_one_channel_moves_through_the_band_and_no_other(channel, band_hz):
    words = words_of(channel, band_hz=band_hz)
    assert words.size == 1000
    assert ((words ^ IDLE) & ~np.uint32(1 << channel) == 0).all()
    assert words[0] == IDLE, "it begins where the channel rests"
    level = ((words >> channel) & 1).astype(float) * 2 - 1
    edges = np.flatnonzero(np.diff(level)).size
    assert edges == pytest.approx(2 * np.mean(band_hz) * 2e-3, abs=2)
    power = np.abs(np.fft.rfft(level)) ** 2
    hz = np.fft.rfftfreq(1000, 2e-6)
    in_band = (hz > 0.9 * band_hz[0]) & (hz < 1.1 * band_hz[1])
    assert power[in_band].sum() > 0.75 * power[1:].sum(), "the rest are harmonics of a square wave"
    assert power[(hz > 0) & (hz < 16e3)].sum() < 0.02 * power[1:].sum(), "it is hardly heard"


@pytest.mark.parametrize("band_hz", [PAPER_HZ, (60e3, 90e3)])
def test_a_slow_bit_clock_goes_as_far_as_it_can(band_hz):
    level = (words_of(3, 500, 250e3, band_hz) >> 3) & 1
    changes = np.flatnonzero(np.diff(level.astype(int)))
    assert np.diff(changes).min() >= 2, "no pulse of a single bit"


@pytest.mark.parametrize("channel", [-1, 32])
def test_there_are_32(channel):
    with pytest.raises(ValueError, match="is not 0 to 31"):
        chirp_words(channel, 1000, 500e3, IDLE, PAPER_HZ)


@pytest.fixture
def run(board, bank_file, tmp_path, evemu_text):
    """A loop whose `progress` may ask its control for something; pins, counters, what was played, outcomes."""

    def play(asks, *, on=(board, bank_file), scene_text=NOTHING, until_s=0.6, reports=((0.0, {}), (5.0, {0: (100.0, 70.0)}))):
        board, bank_file = on
        (tmp_path / "s.toml").write_text(scene_text)
        clock, played, outcomes = VirtualClock(), [], []
        link = open_simulated(board, clock.now_s)
        recording = Recording(evemu_text(*reports))
        source = tracked(RecordingSource(recording, recording.axes(board), 0.1), board)

        def progress(now_s):
            for ask in [ask for ask in asks if ask[0] <= now_s]:
                asks.remove(ask)
                ask[1](assembly.loop.control, now_s)
            if now_s >= until_s:
                assembly.loop.stop()

        with Bank.open(bank_file, board) as bank:
            context = LoopContext(board, clock, open_session(link, board, clock.now_s), source)
            scene = load_scene(tmp_path / "s.toml", board)
            assembly = assemble(context, scene, bank, played=played.append, watch=Watch(progress))
            scheduler = assembly.loop._scheduler
            scheduler._outcomes = scheduler.queue._outcomes = lambda ticket, outcome, _: outcomes.append((ticket, outcome.value))
            assembly.loop.run()
            link.close()
        return link.take_capture(), assembly.counters, played, outcomes

    return play


def test_its_pin_plays_the_chirp_and_a_second_time_it_is_resident(run, board):
    asks = [
        (at_s, lambda control, now_s, ticket=ticket, channel=channel: control.test_channel(ticket, channel, 0.05, 0.05, now_s))
        for ticket, (at_s, channel) in enumerate([(0.2, 5), (0.3, 31), (0.4, 5)], 1)
    ]
    capture, counters, played, outcomes = run(asks)
    assert outcomes == [(1, "played"), (2, "played"), (3, "played")]
    bit_ticks = board.link.clock_hz / board.waveform.bit_clock_hz
    expected = [
        zlib.crc32(chirp_words(channel, 1000, board.waveform.bit_clock_hz, board.idle_word, PAPER_HZ)) for channel in (5, 31, 5)
    ]
    assert [crc for _, crc in emissions_on_pins(capture, round(bit_ticks))] == expected
    assert (counters.emissions, counters.uploads, counters.resident) == (3, 2, 1)
    assert [start.emissions[0].region for start in played] == ["channel 5", "channel 31", "channel 5"]


def test_on_a_shipped_board_it_goes_through_that_boards_band(run, tmp_path):
    band = {"waveform__band_low_hz": 24e3, "waveform__band_high_hz": 55e3}
    board = simulated(changed(load_board(find_board("ulx3s")), **band, bank__pitch_mm=12.0, bank__coarse=True))
    build_bank(BankRequest(board, tmp_path / "other.bank", 12e-3))
    asks = [(0.2, lambda control, now_s: control.test_channel(1, 9, 0.05, 0.05, now_s))]
    capture, _, _, outcomes = run(asks, on=(board, tmp_path / "other.bank"))
    assert outcomes == [(1, "played")]
    waveform = board.waveform
    words = chirp_words(9, waveform.samples, waveform.bit_clock_hz, board.idle_word, (24e3, 55e3))
    ((_, crc),) = emissions_on_pins(capture, board.bit_ticks)
    assert crc == zlib.crc32(words)


def test_between_the_pulses_of_a_train_it_is_played_alone(run):
    asks = [(0.31, lambda control, now_s: control.test_channel(1, 7, 0.05, 0.05, now_s))]
    reports = ((0.0, {}), (0.1, {0: (100.0, 70.0)}), (0.9, {}))
    capture, counters, played, outcomes = run(asks, scene_text=TRAIN, reports=reports, until_s=1.0)
    assert outcomes == [(1, "played")]
    kinds = [[emission.channel for emission in start.emissions] for start in played]
    assert kinds.count([7]) == 1
    assert kinds.count([-1]) == len(kinds) - 1 == 20
    assert counters.emissions == capture.focus_ticks.size == 21


def test_while_the_outputs_are_off_it_is_refused(run):
    said = []

    def asked(control, now_s):
        with pytest.raises(FaultError, match="the outputs are off") as refusal:
            control.test_channel(1, 7, 0.05, 0.05, now_s)
        said.append(str(refusal.value))

    asks = [(0.2, lambda control, _: control.switch(on=False, by="a test")), (0.3, asked)]
    _, counters, _, outcomes = run(asks)
    assert (len(said), outcomes, counters.emissions) == (1, [], 0)
