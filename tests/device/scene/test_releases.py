"""What a finger feels as it is lifted: the panel has forgotten it by then, but not whether it was sure of it."""

from pathlib import Path

from tables import each_row

PIANO = "".join(
    f'[[regions]]\nname = "key {k}"\nshape = "rectangle"\nx_mm = {20.0 + 17 * k}\ny_mm = 30.0\nwidth_mm = 16.0\nheight_mm = 90.0\n'
    'effects = ["click", { effect = "click", when = "release", amplitude = 0.5 }]\n'
    for k in range(10)
)
LIBRARY = (Path(__file__).parents[3] / "boards" / "simulated" / "library.toml").read_text()


def felt(run):
    """(time_s, finger, amplitude) of every focus of a finger."""
    return [(p.trigger_s - run.start_s, e.finger, e.amplitude) for p in run.played for e in p.emissions if e.finger is not None]


def strokes(run, amplitude):
    return [time_s for time_s, _, how_strong in felt(run) if how_strong == amplitude]


@each_row("reports", [(0.0, 0.06), (0.0, 0.008, 0.016, 0.06), (0.0, 0.05, 0.058, 0.066, 0.074)])
def test_a_piano_gives_a_click_for_each_press_and_for_each_release(perform, reports):
    """Of panels that tell a still finger again, and of those that do not; the last report of each is that without it."""
    taps = [(0.0, {})]
    for k in range(10):
        at = (28.0 + 17 * k, 60.0)
        taps += [(0.2 * k + after_s + 0.1, {0: (at[0] + 0.1 * n, at[1])}) for n, after_s in enumerate(reports[:-1])]
        taps.append((0.2 * k + reports[-1] + 0.1, {0: None}))
    run = perform(taps, PIANO)
    assert len(strokes(run, 1.0)) == 10
    assert len(strokes(run, 0.5)) == 10
    assert run.counters.skipped.unconfirmed == 0
    for k, released_s in enumerate(strokes(run, 0.5)):
        assert 0.0 < released_s - (0.2 * k + reports[-1] + 0.1) < 0.04  # what a lost finger has to come back, and the plate


def test_a_finger_that_the_panel_loses_for_a_report_is_pressed_once_and_released_once(perform):
    places = [(0.1 + 8e-3 * k, {0: (60.0 + 0.3 * k, 60.0)}) for k in range(12)]
    places[4] = (places[4][0], {0: None})  # another tracking id from the next report on
    run = perform([(0.0, {}), *places, (0.25, {0: None})], PIANO)
    assert run.touch["bridged"] == 1
    assert len(strokes(run, 1.0)) == len(strokes(run, 0.5)) == 1
    assert {finger for _, finger, _ in felt(run)} == {0}


def test_the_librarys_volume_clicks_when_the_finger_is_lifted_from_it(perform):
    """After a way over several stops, and without any."""
    slides = [(0.1 + 8e-3 * k, {0: (30.0 + 1.0 * k, 65.0)}) for k in range(30)]
    rests = [(1.0, {0: (33.0, 65.0)}), (1.008, {0: (33.2, 65.0)}), (1.1, {0: None})]
    run = perform([(0.0, {}), *slides, (0.4, {0: None}), *rests], LIBRARY)
    first, second = sorted(time_s for time_s, finger, _ in felt(run) if finger is not None and (time_s > 0.395))
    assert 0.4 < first < 0.44
    assert 1.1 < second < 1.14
    assert run.counters.skipped.unconfirmed == 0


def test_a_contact_that_one_report_reported_and_the_next_did_not_gets_its_share_and_no_more(perform):
    run = perform([(0.0, {}), (0.1, {0: (60.0, 60.0)}), (0.108, {0: None})], PIANO)
    assert len(strokes(run, 1.0)) == 1
    assert strokes(run, 0.5) == []
    assert run.counters.skipped.unconfirmed == 1


def test_all_of_ten_fingers_lifted_at_once_feel_it(perform):
    chord = {k: (28.0 + 17 * k, 60.0) for k in range(10)}
    moved = {k: (x + 0.2, y) for k, (x, y) in chord.items()}
    run = perform([(0.0, {}), (0.1, chord), (0.108, moved), (0.2, dict.fromkeys(chord))], PIANO)
    assert len(strokes(run, 1.0)) == len(strokes(run, 0.5)) == 10
