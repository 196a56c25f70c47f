"""One frame or answer damaged, or one trigger lost, at every position of a session: the pins equal the counters, one by one.

A finger under which a train of 50 Hz plays, and one that draws over a texture of 3 mm, in virtual time. What is struck is one frame
on its way to the FPGA, one answer, or one edge of the trigger. The loop recovers within one emission, and counts the cause.
"""

import random

import pytest
from pin_script import MODEL
from pins_and_counters import Damage, Notes, assert_pins_equal_counters

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.loop.context import LoopContext
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.workshop.gateware.simulated_link import open_simulated

SCENE = """
[[regions]]
name = "train"
shape = "rectangle"
x_mm = 0.0
y_mm = 0.0
width_mm = 80.0
height_mm = 148.0
effects = [{ effect = "train", rate_hz = 50.0, duration_ms = 400.0 }]

[[regions]]
name = "texture"
shape = "rectangle"
x_mm = 80.0
y_mm = 0.0
width_mm = 130.0
height_mm = 148.0
effects = [{ effect = "texture", spacing_mm = 3.0 }]
"""
SPOTS = (
    SCENE
    + """
[[regions]]
name = "spot"
shape = "circle"
x_mm = 180.0
y_mm = 120.0
radius_mm = 5.0
effects = [{ effect = "always", rate_hz = 40.0 }]
"""
)
REPORTS = [
    (0.01 * k, {slot: place for slot, place in ((0, (40.0, 70.0)), (1, (90.0 + 1.3 * k, 60.0 + 0.4 * k))) if slot == 1 or k == 0})
    for k in range(45)
]
SHORT, LONG = 8, len(REPORTS)  # reports: of a session for every position on the Verilog, and of the others


@pytest.fixture
def session(board, bank_file, tmp_path, evemu_text):
    """Perform the session on a back-end behind wires that strike; the wires, the notes, the counters."""

    def run(back_end, strikes, scene_text=SCENE, bit=100, reports=LONG):
        (tmp_path / "scene.toml").write_text(scene_text)
        scene, clock = load_scene(tmp_path / "scene.toml", board), VirtualClock()
        recording = Recording(evemu_text(*REPORTS[:reports], (0.01 * reports, {0: None, 1: None})))
        link = open_simulated(board, clock.now_s, lambda parameters: Damage(back_end(parameters), strikes, bit))
        wires = link.gateware
        with Bank.open(bank_file, board) as bank:
            own = open_session(link, board, clock.now_s)
            notes = Notes(own)
            source = tracked(RecordingSource(recording, recording.axes(board), 0.1), board)
            assembly = assemble(LoopContext(board, clock, own, source), scene, bank, played=notes.started)
            assembly.loop.run(lambda: setattr(wires, "armed", True))
            link.close()
        counters = assembly.counters
        assert counters.outages == counters.host_silent == 0, counters.outage
        assert_pins_equal_counters(link.take_capture(), notes, counters, link, board.bit_ticks)
        assert counters.due == counters.foci + counters.skipped.emissions
        return wires, counters

    return run


def nothing(*_):
    return None


def at(kind, number, strike):
    return lambda *what: strike if what == (kind, number) else None


def everything(clean):
    """Every frame, every answer and every edge of the trigger."""
    frames = [(kind, number, strike) for number in range(clean.frames) for kind in ("to", "from") for strike in ("bit", "lost")]
    return frames + [("trigger", number, "lost") for number in range(clean.triggers)]


def sample(count, seed):
    """Some of everything, and as many edges, PLAYs and answers to them."""

    def chosen(clean):
        rng = random.Random(seed)
        plays = [(kind, number, "bit") for play in clean.plays for kind, number in (("to", play), ("from", play + 1))]
        edges = [("trigger", number, "lost") for number in range(clean.triggers)]
        return [position for some in (everything(clean), plays, edges) for position in rng.sample(some, count)]

    return chosen


def strike_each(session, back_end, positions, scene_text=SCENE, **how):
    """Strike at each of the positions, one in a run."""
    clean, untouched = session(back_end, nothing, scene_text, **how)
    assert untouched.emissions > 5
    for kind, number, strike in positions(clean):
        where = f"{kind} {number} {strike}"
        try:
            wires, counters = session(back_end, at(kind, number, strike), scene_text, bit=101 + 37 * number, **how)
        except Exception as error:
            raise AssertionError(f"{where}: {error!r}") from error
        assert wires.struck, where
        link, lost = counters.link, kind == "trigger"
        assert (link.triggers_lost, link.emissions_lost) == (lost, lost), f"{where}: {link}"
        assert link.emissions_unexpected == link.plays_missed == link.triggers_stray == link.misplaced == 0, f"{where}: {link}"
        assert counters.skipped.emissions <= 1, f"{where}: {counters.skipped}"


def test_a_session_struck_anywhere_plays_what_it_counts(session):
    strike_each(session, MODEL, sample(6, 1))


def test_a_session_with_a_repetition_struck_anywhere_plays_what_it_counts(session):
    strike_each(session, MODEL, sample(3, 2), SPOTS)


def test_a_session_on_the_verilog_struck_anywhere_plays_what_it_counts(session, rtl):
    strike_each(session, rtl, sample(1, 3), reports=SHORT)


@pytest.mark.slow
@pytest.mark.parametrize("scene_text", [SCENE, SPOTS], ids=["fingers", "fingers and a spot"])
@pytest.mark.parametrize("part", range(8))
def test_every_position(session, part, scene_text):
    strike_each(session, MODEL, lambda clean: everything(clean)[part::8], scene_text)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(8))
def test_every_position_on_the_verilog(session, rtl, part):
    strike_each(
        session, rtl, lambda clean: [at for at in everything(clean) if at[2] == "bit" or at[0] == "trigger"][part::8], reports=SHORT
    )
