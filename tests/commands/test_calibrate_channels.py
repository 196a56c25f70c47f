"""`haptic-panel calibrate channels` on the simulated panel, before which a simulated person feels which patch moves."""

import json

import pytest
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.registers import State
from controller.device.service.drivers import open_session
from controller.device.touch.live_source import LiveSource
from controller.device.touch_calibration.channel_survey import buzz_words, survey
from controller.errors import CalibrationError, FaultError
from controller.workshop.gateware.simulated_link import open_simulated
from controller.workshop.simulation.feeling_person import FeelingPerson

BOARD = load_board(find_board("simulated"))


def found(capsys, *arguments, code=0):
    assert main(["calibrate", "channels", "--json", *arguments]) == code
    return json.loads(capsys.readouterr().out)


def test_swapped_wires_and_dead_patches_are_named_and_every_other_channel_moves_its_own_disc(capsys):
    figures = found(capsys, "--swapped", "7", "8", "--swapped", "0", "31", "--dead", "12", code=1)
    felt = {int(channel): disc for channel, disc in figures["felt_at_disc"].items()}
    assert {channel for channel in range(32) if felt.get(channel) != channel // 4} == {0, 7, 8, 12, 31}
    assert [line.partition(":")[0] for line in figures["wrong"]] == [
        "channel 12",
        "channels 0 and 31 are swapped",
        "channels 7 and 8 are swapped",
    ]


def test_channels_of_several_fpgas_are_felt_by_their_numbers_on_the_panel(capsys):
    asked = [word for channel in (3, 40, 33) for word in ("--channel", str(channel))]
    figures = found(capsys, "--board", "simulated_64", *asked, "--swapped", "3", "40", "--dead", "33", code=1)
    assert figures["felt_at_disc"] == {"3": 10, "40": 0, "33": None}
    assert [line.partition(":")[0] for line in figures["wrong"]] == ["channel 33", "channels 3 and 40 are swapped"]


def test_some_channels_alone(capsys):
    figures = found(capsys, "--channel", "3", "--channel", "9")
    assert (figures["felt_at_disc"], figures["wrong"]) == ({"3": 0, "9": 2}, [])


@each_row(
    ("arguments", "code", "said"),
    [
        (("--channel", "32"), 2, "channel 32: board 'simulated' has 0 to 31"),
        (("--dead", "-1"), 2, "channel -1: board 'simulated' has 0 to 31"),
        (("--board", "ulx3s", "--dead", "1"), 2, "--swapped and --dead are for a simulated board"),
    ],
)
def test_what_cannot_be_asked_is_refused_in_one_line(capsys, arguments, code, said):
    assert main(["calibrate", "channels", *arguments]) == code
    out, err = capsys.readouterr()
    assert out == ""
    assert said in err
    assert err.count("\n") == 1


def test_a_buzz_is_one_step_away_from_idle_and_back():
    words = buzz_words(BOARD)
    assert words[0] == BOARD.idle_word
    assert int(words[0]) ^ int(words[-1]) == 0xFFFFFFFF
    assert (words[1:] != words[:-1]).sum() == 1


ASKED = range(8)


@pytest.fixture
def begun():
    """A survey of some channels, its session and link, and who feels it."""
    clock = VirtualClock()
    link = open_simulated(BOARD, clock.now_s)
    person = FeelingPerson(BOARD, link, BOARD)
    session = open_session(link, BOARD, clock.now_s)
    return survey(session, BOARD, clock, LiveSource(person.panel, BOARD), ASKED, person, lambda _: None), session, link, person


def is_on(link):
    """Whether the supply of the stages is on once a ramp has passed."""
    link.gateware.advance(link.gateware.now + round(2 * BOARD.limits.ramp_ms * 1e-3 * link.clock_hz))
    return State.HV_ENABLE in link.gateware.status().state


def test_only_the_channel_that_is_asked_for_moves_and_the_outputs_are_off_at_the_end(begun):
    going, session, link, person = begun
    asked = []
    for channel, place in going:
        asked.append(channel)
        assert person.felt == asked
        assert place is not None
    assert asked == list(ASKED)
    assert not session.may_be_on
    assert not is_on(link)


def test_a_survey_that_is_left_switches_off(begun):
    going, session, link, _ = begun
    next(going)
    assert session.may_be_on
    going.close()
    assert not is_on(link)


def test_a_panel_that_ends_is_one_line_and_off(begun):
    going, _, link, person = begun
    next(going)
    person.panel.close()
    with pytest.raises(CalibrationError, match="ends before every channel was touched"):
        next(going)
    assert not is_on(link)


def test_an_open_interlock_ends_it(begun):
    going, _, link, _ = begun
    next(going)
    link.gateware.permit(link.gateware.now, level=False)
    with pytest.raises(FaultError):
        next(going)
    assert not is_on(link)


def test_what_was_said_before_a_channel_buzzed_is_not_of_that_channel(begun):
    going, _, _, person = begun
    next(going)
    person._says_nothing = True
    channel, place = next(going)
    assert channel == 1
    assert place is not None
    going.close()
