"""What is sent ahead of a moving finger, and what stays resident: counted, on the pins of the simulated panel."""

import math
import random
from pathlib import Path

import msgspec
import pytest
from tables import each_row

from controller.device.bank.reader import Bank
from controller.device.scene.scene import load_scene
from controller.device.touch.recordings.recording import Recording
from controller.device.waveforms.selection import REUSE_RADIUS_M
from controller.workshop.simulation.simulated_run import play

TEXTURE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 5.0 }]\n'
CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
SPOT = """[[regions]]
name = "spot"
shape = "circle"
x_mm = 60.0
y_mm = 54.0
radius_mm = 3.0
effects = [{ effect = "always", rate_hz = 20.0 }]
"""
REPORT_S = 0.008


def stroke(speed_mm_s, duration_s, y_mm=74.0):
    """Reports of one finger that goes straight along x."""
    reports = [(k * REPORT_S, {0: (20.0 + speed_mm_s * k * REPORT_S, y_mm)}) for k in range(round(duration_s / REPORT_S))]
    return [*reports, (duration_s + 0.1, {0: None})]


@each_row(
    ("speed_mm_s", "spacing", "emissions"),
    [
        (40.0, "5.0", 24),
        (60.0, "1.0", 149),  # in every second report
        (200.0, "1.0", 93),  # in every report: what the next will ask for is sent once the wire is free
    ],
)
def test_prefetch_has_most_waveforms_of_a_straight_stroke_resident_in_time(perform, speed_mm_s, spacing, emissions):
    reports = stroke(speed_mm_s, min(3.0, 150.0 / speed_mm_s), y_mm=71.0)  # between two rows of cells, as most strokes are
    counters = perform(reports, TEXTURE.replace("5.0", spacing)).counters
    assert counters.emissions == pytest.approx(emissions, abs=1)
    assert counters.prefetched >= 0.8 * counters.emissions
    assert counters.resident >= 0.8 * counters.emissions
    assert counters.prefetch_wasted <= 2


def test_a_prefetched_waveform_is_played_at_the_place_of_the_finger(perform):
    run = perform(stroke(40.0, 3.0), TEXTURE)
    track = run.tracks[0]
    for played in run.played[2:]:
        (emission,) = played.emissions
        x_m, y_m = track.position(played.trigger_s - run.start_s + run.board.waveform.duration_s)
        assert emission.x_m == pytest.approx(x_m, abs=REUSE_RADIUS_M + 0.6e-3)
        assert emission.y_m == pytest.approx(y_m, abs=REUSE_RADIUS_M)


def test_no_prefetch_for_a_finger_at_rest_or_without_effects_of_movement(perform):
    assert perform([(0.0, {0: (60.0, 54.0)}), (1.0, {0: None})], TEXTURE).counters.prefetched == 0
    assert perform(stroke(40.0, 1.0), CLICK).counters.prefetched == 0


def test_a_finger_too_fast_for_prediction_is_still_played(perform):
    run = perform(stroke(600.0, 0.25), TEXTURE)
    assert run.counters.emissions >= 20
    assert run.counters.skipped.bad_entries == 0


def test_a_spot_stays_resident_whatever_fingers_play(perform):
    places = [(30.0 + 13.0 * k, 110.0) for k in range(10)]
    taps = [report for k, place in enumerate(places) for report in ((0.1 * k, {0: place}), (0.1 * k + 0.05, {0: None}))]
    run = perform([*taps, (1.2, {})], SPOT + CLICK)
    assert run.counters.uploads == len(places) + 1, "each place once, and the fixed emitter once"


def test_a_spot_stays_resident_though_more_is_played_between_its_pulses_than_there_are_slots(perform):
    places = [(30.0 + 13.0 * k, 110.0) for k in range(10)]
    taps = [report for k, place in enumerate(places) for report in ((0.6 + 0.04 * k, {0: place}), (0.62 + 0.04 * k, {0: None}))]
    run = perform([(0.0, {}), *taps, (2.2, {})], SPOT.replace("rate_hz = 20.0", "rate_hz = 2.0") + CLICK)
    assert run.counters.uploads == len(places) + 1


def rubbing(seed, duration_s):
    """Reports of a finger that goes to and fro, each stroke at another speed."""
    rng = random.Random(seed)
    x_mm, speed_mm_s, reports = 60.0, 80.0, []
    for k in range(round(duration_s / REPORT_S)):
        reports.append((k * REPORT_S, {0: (x_mm, 74.0)}))
        x_mm += speed_mm_s * REPORT_S
        if not 50.0 < x_mm < 90.0:
            speed_mm_s = -speed_mm_s / abs(speed_mm_s) * rng.uniform(60, 250)
            x_mm = min(max(x_mm, 50.0), 90.0)
    return [*reports, (duration_s + 0.1, {0: None})]


@pytest.mark.parametrize("seed", [*range(3), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(3, 6))])
def test_rubbing_a_fine_texture_back_and_forth_keeps_playing(perform, board, seed):
    """What a stroke asks for lies near what the one before asked for: often nearer to where an upload would meet the finger."""
    sixteen = msgspec.structs.replace(board, link=msgspec.structs.replace(board.link, slots=16))
    run = perform(rubbing(seed, 6.0), TEXTURE.replace("5.0", "2.0"), on=sixteen)
    assert run.counters.emissions > 150


def wandering(seed, duration_s, fingers):
    """Reports of fingers that go in arcs and turn, each stroke in another direction at another speed, and lift now and then."""
    rng, at = random.Random(seed), {}
    for slot in range(fingers):
        k, x_mm, y_mm = slot, rng.uniform(20, 190), rng.uniform(15, 135)
        while k * REPORT_S < duration_s:
            step_mm, angle, bend = (
                rng.choice([20, 50, 100, 200, 400]) * REPORT_S,
                rng.uniform(0, 2 * math.pi),
                rng.uniform(-0.03, 0.03),
            )
            for _ in range(rng.randint(10, 80)):
                angle += bend
                to_mm = x_mm + step_mm * math.cos(angle), y_mm + step_mm * math.sin(angle)
                if not (5 < to_mm[0] < 205 and 5 < to_mm[1] < 143):
                    angle += math.pi
                    continue
                x_mm, y_mm = at.setdefault(k, {})[slot] = to_mm
                k += 1
            if rng.random() < 0.5:
                at.setdefault(k, {})[slot] = None
                k, x_mm, y_mm = k + rng.randint(6, 36), rng.uniform(20, 190), rng.uniform(15, 135)
        at.setdefault(k, {})[slot] = None
    return [(k * REPORT_S, slots) for k, slots in sorted(at.items())]


def strokes(seed, duration_s, speed_mm_s):
    """Reports of a finger that draws arcs of 50 to 120 mm, each from another place into another direction."""
    rng, k, reports = random.Random(seed), 0, []
    while k * REPORT_S < duration_s:
        x_mm, y_mm, angle = rng.uniform(30, 180), rng.uniform(25, 120), rng.uniform(0, 2 * math.pi)
        bend = rng.uniform(-0.02, 0.02)
        for _ in range(round(rng.uniform(50, 120) / speed_mm_s / REPORT_S)):
            angle += bend
            x_mm += speed_mm_s * REPORT_S * math.cos(angle) + rng.gauss(0, 0.03)
            y_mm += speed_mm_s * REPORT_S * math.sin(angle) + rng.gauss(0, 0.03)
            if not (5 < x_mm < 205 and 5 < y_mm < 143):
                break
            reports.append((k * REPORT_S, {0: (x_mm, y_mm)}))
            k += 1
        reports.append((k * REPORT_S, {0: None}))
        k += 25
    return reports


@pytest.mark.slow
@pytest.mark.parametrize("spacing", ["1.0", "2.0", "5.0"])
def test_a_sliding_finger_finds_four_of_five_waveforms_resident(perform, spacing):
    for speed_mm_s in (50.0, 100.0, 150.0, 200.0):
        runs = [perform(strokes(seed, 8.0, speed_mm_s), TEXTURE.replace("5.0", spacing)).counters for seed in range(2)]
        emissions, resident, sent, wasted = (
            sum(getattr(counters, what) for counters in runs) for what in ("emissions", "resident", "prefetched", "prefetch_wasted")
        )
        print(f"{spacing} mm, {speed_mm_s:3.0f} mm/s: {resident / emissions:.2f} resident, {wasted / sent:.2f} wasted")
        assert resident >= 0.8 * emissions
        assert wasted <= 0.06 * sent


@pytest.mark.slow
def test_of_two_fingers_that_turn_at_random_a_fifth_of_what_is_sent_ahead_is_never_played(perform, board):
    """Where they turn nobody can know: a waveform is sent ahead only of one that has gone as expected, and is played alone."""
    texts = [(board.folder / name).read_text() for name in ("scene.toml", "library.toml")]
    runs = [perform(wandering(seed, 8.0, 2), text).counters for seed in range(6) for text in texts]
    sent, wasted = (sum(getattr(counters, what) for counters in runs) for what in ("prefetched", "prefetch_wasted"))
    print(f"{wasted} of {sent} wasted")
    assert sent >= 300, "it is of use"
    assert 0 < wasted <= 0.2 * sent


@pytest.mark.slow
def test_at_most_a_fifth_of_prefetched_waveforms_is_never_played(perform, board, bank_file):
    """Over the recordings of real panels on each scene of the board alone, and over strokes to and fro on textures."""
    scene, library = (load_scene(board.folder / name, board) for name in ("scene.toml", "library.toml"))
    recordings = sorted((Path(__file__).parents[1] / "touch" / "recordings").glob("*.ev*"))
    with Bank.open(bank_file, board) as bank:
        real = [play(board, scene, bank, Recording.open(file), real_time=False).counters for file in recordings]
        alone = [play(board, library, bank, Recording.open(file), real_time=False).counters for file in recordings]
    strokes = [perform(rubbing(9, 3.0), TEXTURE.replace("5.0", spacing)).counters for spacing in ("1.0", "2.0", "5.0")]
    for runs, least in ((real, 30), (alone, 10), (strokes, 200)):
        sent, wasted = (sum(getattr(counters, name) for counters in runs) for name in ("prefetched", "prefetch_wasted"))
        assert sent >= least, "it is of use"
        assert wasted <= 0.2 * sent
        uploads = sum(counters.uploads for counters in runs)
        assert sent - wasted <= sum(counters.resident for counters in runs)
        assert uploads > 0


def test_prefetch_for_a_lifted_finger_is_counted_as_wasted(perform):
    """Of a stroke it is known where the next waveform is wanted; lifted before, or not."""
    lengths_s = [1.2 + k * REPORT_S for k in range(0, 16, 2)]  # within one spacing
    counted = set()
    for length_s in lengths_s:
        reports = [(time_s, slots) for time_s, slots in stroke(40.0, 3.0) if time_s < length_s]
        counters = perform([*reports, (length_s + REPORT_S / 2, {0: None})], TEXTURE).counters
        counted.add(counters.prefetch_wasted)
        assert counters.prefetched >= counters.resident
    assert counted == {0, 1}
