"""Clicks of the ghost survey keep their distance by when they begin: over a serial link, an upload after they were asked for."""

import itertools

from tables import each_row

from controller.clocks import NEVER
from controller.device.loop.commands import Outcome
from controller.device.touch_calibration.ghost_figures import MAX_GHOST_LIFE_S
from controller.device.touch_calibration.ghost_survey import MOST_EMISSIONS, Knocks, Overheard
from controller.errors import FaultError

T_S = 2e-3


class Silent:
    """A panel without contacts."""

    def read(self, _now_s):
        return ()


class Control:
    """The loop, over a link that takes so long for what is not resident."""

    def __init__(self, upload_s, refuses=lambda _: False, off_s=(NEVER, NEVER)):
        self.starts_s, self._upload_s, self._refuses, self._off_s = [], upload_s, refuses, off_s
        self.knocks = Knocks(Overheard(Silent()), [(0.1, 0.07)], T_S, self.stop, lambda *_: None)
        self.running = True

    def play(self, ticket, _effect, _x_m, _y_m, _finger, _amplitude, now_s):
        if self._off_s[0] <= now_s < self._off_s[1]:
            raise FaultError("the outputs are off")
        if self._refuses(ticket):
            self.knocks.outcome(ticket, Outcome.REFUSED, 0.0)
            return
        self.starts_s.append(now_s + self._upload_s * (ticket % 3 == 0))  # the others are resident
        self.begins = ticket

    def stop(self):
        self.running = False

    def run(self):
        """The turns of a loop that sleeps until something is due."""
        now_s, self.begins = 0.0, 0
        self.knocks.ready()
        while self.running:
            self.knocks.serve(now_s, self)
            if self.begins:
                now_s = self.starts_s[-1]
                self.knocks.begun(now_s)
                self.knocks.outcome(self.begins, Outcome.PLAYED, 0.0)
                self.begins = 0
            if self.running:
                assert self.knocks.next_time_s() > now_s
                now_s = self.knocks.next_time_s()
        self.knocks.close()


@each_row("upload_s", [1e-3, 0.045, 0.4])
def test_each_begins_late_enough_for_the_ghosts_of_the_one_before(upload_s):
    control = Control(upload_s)
    control.run()
    assert control.knocks.error is None
    assert control.knocks.played == len(control.starts_s) == MOST_EMISSIONS
    gaps_s = [later - start - T_S for start, later in itertools.pairwise(control.starts_s)]
    assert min(gaps_s) > MAX_GHOST_LIFE_S
    assert max(gaps_s) < MAX_GHOST_LIFE_S + 0.1 + upload_s


def test_one_that_was_refused_is_followed_by_the_next_and_the_survey_ends():
    control = Control(0.045, refuses=lambda ticket: ticket % 2)
    control.run()
    assert control.knocks.played == MOST_EMISSIONS // 2
    assert control.knocks.next_time_s() == NEVER


def test_outputs_that_go_off_and_on_again_are_waited_for_and_the_clicks_go_on():
    control = Control(1e-3, off_s=(5.0, 12.0))
    control.run()
    assert control.knocks.error is None
    assert control.knocks.played == MOST_EMISSIONS
    assert not [start for start in control.starts_s if 5.0 <= start < 12.0]


def test_outputs_that_stay_off_end_the_survey_with_their_reason():
    control = Control(1e-3, off_s=(5.0, NEVER))
    control.run()
    assert str(control.knocks.error) == "the outputs are off"
    assert max(control.starts_s) < 5.0
