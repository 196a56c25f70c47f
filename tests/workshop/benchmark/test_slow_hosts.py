"""The schedule on slow hosts: few beats are late, and each by no more than its own command."""

import pytest

from controller.device.bank.reader import Bank
from controller.device.touch.recordings.recording import Recording
from tests.workshop.benchmark.slow_host import LATE_S, TRAIN, moving, run_slow, scene_of

FINE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 0.5 }]\n'
LATE_PERCENT = {140: 0.5, 220: 0.5, 550: 2.0, 1300: 5.0}  # of the beats, at most, by the median host time in µs


@pytest.fixture(scope="module")
def run(board, bank_file):
    def run_it(p50_us, recording, seed=1):
        with Bank.open(bank_file, board) as bank:
            return run_slow(board, scene_of(board, TRAIN), bank, recording, p50_us * 1e-6, seed)

    return run_it


@pytest.mark.parametrize("fingers", [1, pytest.param(2, marks=pytest.mark.slow)])
@pytest.mark.parametrize("p50_us", [pytest.param(p50, marks=() if p50 == 220 else pytest.mark.slow) for p50 in LATE_PERCENT])
def test_few_beats_are_late_on_a_slow_host(run, p50_us, fingers):
    done = run(p50_us, moving(10.0, fingers))
    assert len(done.late) >= 500 * fingers
    assert 100 * sum(done.late) <= LATE_PERCENT[p50_us] * len(done.late)


@pytest.mark.parametrize("p50_us", [pytest.param(550, marks=pytest.mark.slow), 1300])
def test_few_beats_of_five_trains_at_once_are_late_where_each_cannot_have_an_upload(run, board, p50_us):
    done = run(p50_us, Recording.open(board.beside(board.touch.recording)))
    assert len(done.late) >= 400
    assert 100 * sum(done.late) <= LATE_PERCENT[p50_us] * len(done.late)


@pytest.mark.parametrize("p50_us", [pytest.param(550, marks=pytest.mark.slow), 1300])
def test_a_late_beat_starts_on_arrival_and_does_not_shift_the_next_ones(run, p50_us):
    done = run(p50_us, moving(10.0), seed=5)
    late_s = [off_s for off_s in done.off_s if off_s > LATE_S]
    assert late_s
    assert len(done.held_s) == len(late_s), "each is started by the host"
    assert max(done.held_s) < 20e-6, "as soon as its command has arrived"
    on_time = [off_s for off_s in done.off_s if off_s <= LATE_S]
    assert max(map(abs, on_time)) < LATE_S
    assert len(on_time) + len(late_s) == 500


def test_a_host_that_takes_no_time_is_never_late(run):
    done = run(0, moving(2.0))
    assert not any(done.late)
    assert max(map(abs, done.off_s)) < LATE_S


@pytest.mark.slow
def test_a_host_says_the_rate_that_it_reaches(board, bank_file):
    fine, reached_hz = scene_of(board, FINE), []
    with Bank.open(bank_file, board) as bank:
        for p50_us in (220, 1300):
            done = run_slow(board, fine, bank, moving(1.5, speed_m_s=1.0, report_s=2e-3), p50_us * 1e-6)
            assert done.timing.figures()["uploads_hz"] == pytest.approx(done.emissions_hz, rel=0.2)
            reached_hz.append(done.emissions_hz)
    assert reached_hz[0] > 1.5 * reached_hz[1]
