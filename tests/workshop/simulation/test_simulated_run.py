"""Where `run` says that a finger was: evaluated by all its contacts."""

import math

import numpy as np
import pytest

from controller.device.touch.recordings.recording import Track
from controller.workshop.simulation.focus_evaluation import judge

TEXTURE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 20.0 }]\n'
STEP_S = 8e-3


def test_a_finger_that_the_panel_loses_twice_is_evaluated_by_all_its_contacts(perform):
    lost = {20, 45}
    reports = [(k * STEP_S, {0: None if k in lost else (30.0 + 2 * k, 70.0)}) for k in range(70)]
    run = perform([*reports, (0.8, {0: None})], TEXTURE)
    assert run.touch["bridged"] == 2
    foci = judge(run).foci
    assert {focus.emission.finger for focus in foci} == {0}
    assert max(focus.x_m for focus in foci) > 0.15
    assert max(math.dist((focus.x_m, focus.y_m), (focus.emission.x_m, focus.emission.y_m)) for focus in foci) < 0.2e-3


def test_a_joined_track_leads_from_one_contact_to_the_next():
    parts = [Track.of(3, [(0.0, 0.0, 0.1), (1.0, 0.1, 0.1)]), Track.of(5, [(2.0, 0.2, 0.1), (3.0, 0.5, 0.2)])]
    track = Track.joined(3, parts)
    assert (track.finger, track.time_s[0], track.end_s) == (3, 0.0, 3.0)
    assert np.diff(track.time_s).min() > 0
    assert track.position(1.5) == pytest.approx((0.15, 0.1))
    assert track.position(2.5) == pytest.approx((0.35, 0.15))
