"""When outputs are said to be on, ramping or off, against the pins: whatever is lost, whoever asks, however the loop ends."""

from functools import partial

import msgspec
import numpy as np
import pytest
from restarting_gateware import RestartingGateware
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.panel_state import PanelState
from controller.device.fpga.registers import State
from controller.device.fpga.session import Session
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import gateware_hash, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.errors import LinkError
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import open_simulated

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
SPOT = """[[regions]]
name = "spot"
shape = "circle"
x_mm = 60.0
y_mm = 54.0
radius_mm = 3.0
effects = [{ effect = "always", rate_hz = 20.0 }]
"""
STILL = [(0.0, {}), (0.6, {})]


class Broken(Exception):
    """A mistake of the program's own."""


class Panel:
    """A loop in virtual time on the model; in each turn what the outputs are said to be is compared with what the FPGA says.

    `messages` counts the messages to the FPGA; `damage(number, answer)` is called after each, and may damage the answer or raise.
    """

    def __init__(self, board, bank_file, tmp_path, evemu_text, scene=CLICK, reports=STILL, gateware=None, at=()):
        self.board, self.clock, self.messages, self.said, self.reported = board, VirtualClock(), 0, [], []
        self.damage = lambda _number, _answer: None
        self.at = list(at)
        (tmp_path / "scene.toml").write_text(scene)
        self.link = open_simulated(board, self.clock.now_s, gateware or GatewareModel)
        self._exchange, self.link.exchange = self.link.exchange, self.exchange
        self.session = Session(self.link, board, gateware_hash(), self.clock.now_s, bring_up=False)
        self.bank = Bank.open(bank_file, board)
        recording = Recording(evemu_text(*reports))
        source = tracked(RecordingSource(recording, recording.axes(board), 0.1), board)
        built = assemble(
            LoopContext(board, self.clock, self.session, source),
            load_scene(tmp_path / "scene.toml", board),
            self.bank,
            watch=Watch(self.progress),
        )
        self.loop, self.counters = built.loop, built.counters

    def exchange(self, sent, lengths, received):
        self._exchange(sent, lengths, received)
        self.messages += 1
        self.damage(self.messages - 1, received)

    @property
    def hv(self):
        """Whether the FPGA has its high voltage on now."""
        self.link.gateware.advance(self.link.tick(self.clock.now_s()))
        gateware = self.link.gateware
        return State.HV_ENABLE in getattr(gateware, "_gateware", gateware).status().state

    def progress(self, now_s):
        while self.at and self.at[0][0] <= now_s:
            self.at.pop(0)[1](self)
        outputs = self.loop.outputs
        if self.hv:
            assert outputs.may_be_on, f"{now_s}: said to be off, and is on"
            assert outputs.state not in {PanelState.DISARMED, PanelState.IDLE}, now_s
        if not self.said or self.said[-1][1:] != (outputs.state, outputs.may_be_on):
            self.said.append((now_s, outputs.state, outputs.may_be_on))

    def run(self):
        try:
            with self.bank:
                self.loop.run()
        finally:
            assert not self.hv
            self.link.close()
            capture = self.link.take_capture()
            assert not capture.words[-1:].any()


@pytest.fixture
def panel(board, bank_file, tmp_path, evemu_text):
    return lambda on=board, **more: Panel(on, bank_file, tmp_path, evemu_text, **more)


def unplugged(panel):
    def raise_it(number, answer):
        raise LinkError("unplugged")

    panel.damage = raise_it


def deaf(panel):
    """Nothing comes back any more; the FPGA hears all."""

    def blank(number, answer):
        answer[:] = bytes(len(answer))

    panel.damage = blank


def stopped(panel):
    panel.loop.stop()


def broken(panel):
    raise Broken


WAYS = {"stop": (stopped,), "a mistake": (broken,), "unplugged": (stopped, unplugged), "deaf": (stopped, deaf)}


def end(made, way):
    """Run until the way out is taken, which happens in `made`; all that `Panel` looks at holds to the end."""
    if way == "a mistake":
        with pytest.raises(Broken):
            made.run()
    else:
        made.run()


@each_row("way", WAYS)
def test_the_loop_ends_with_outputs_off_at_whichever_message_it_ends(panel, way):
    """From the first message of bring-up, through ARM and the ramp, until the outputs are on."""
    whole = panel()
    on_at = []
    whole.damage = lambda number, _: on_at.append(number) if whole.hv else None
    whole.run()
    arm = on_at[0]
    assert arm > 30
    seen = set()
    for message in [*range(0, arm - 3, 6), *range(arm - 3, arm + 6)]:
        made = panel()

        def at_message(number, answer, made=made, message=message):
            if number == message:
                seen.add(made.hv)
                for each in WAYS[way]:
                    each(made)

        made.damage = at_message
        end(made, way)
    assert seen == {False, True}


@each_row("way", WAYS)
def test_the_loop_ends_with_outputs_off_in_whichever_millisecond_of_arming_it_ends(panel, board, way):
    whole = panel()
    whole.run()
    ramp_s = next(at_s for at_s, state, _ in whole.said if state is PanelState.RAMPING)
    seen = set()
    for ms in range(int(board.limits.arming_s * 1e3) + 3):
        made = panel()
        wait, due_s = made.clock.wait, ramp_s + ms * 1e-3

        def wait_until(selector, until_s, made=made, wait=wait, due_s=due_s):
            ended = made.loop._stopped or made.clock.now_s() > due_s
            wait(selector, until_s if ended else min(until_s, due_s))
            if not ended and made.clock.now_s() >= due_s:
                seen.add((made.hv, made.loop.outputs.state))
                made.clock.wait = wait
                for each in WAYS[way]:
                    each(made)

        made.clock.wait = wait_until
        end(made, way)
    assert seen == {(True, PanelState.RAMPING), (True, PanelState.ARMED)}


def switch(on):
    return lambda made: made.loop.control.switch(on=on)


def states(made):
    return [(state, may_be_on) for _, state, may_be_on in made.said]


ON, OFF = True, False
DISARM = [(PanelState.ARMED, ON), (PanelState.RAMPING, ON), (PanelState.DISARMED, OFF)]


def test_a_client_that_disarms_and_arms_sees_both_ramps_and_off_only_at_0_v(panel):
    made = panel(at=[(0.3, switch(False)), (0.5, switch(True))])
    made.run()
    start = (PanelState.RAMPING, ON)
    assert states(made) == [start, *DISARM, start, (PanelState.ARMED, ON)]
    assert made.counters.outages == made.counters.host_silent == 0


@each_row("ms", range(0, 14, 3))
def test_a_client_that_disarms_while_the_outputs_come_on_has_them_turn_back_at_once(panel, ms):
    at_s = 0.5 + ms * 1e-3
    made = panel(at=[(0.3, switch(False)), (0.5, switch(True)), (at_s, switch(False))])
    made.run()
    assert made.said[-1][1:] == (PanelState.DISARMED, OFF)
    assert PanelState.ARMED not in [state for now_s, state, _ in made.said if now_s > 0.5]


def test_heartbeats_go_on_while_a_client_has_outputs_ramp_for_longer_than_their_timeout(panel, board):
    limits = msgspec.structs.replace(board.limits, heartbeat_timeout_ms=20.0, ramp_ms=100.0)
    made = panel(msgspec.structs.replace(board, limits=limits), at=[(0.3, switch(False))])
    made.run()
    assert states(made)[-3:] == DISARM
    assert made.counters.outages == made.counters.host_silent == 0
    ramp_s = [at_s for at_s, state, _ in made.said if state in {PanelState.RAMPING, PanelState.DISARMED}][-2:]
    assert ramp_s[1] - ramp_s[0] == pytest.approx(0.1, abs=0.01)


@each_row("answers", [1, 2, 3, 5, 30])
def test_a_disarm_whose_answers_are_lost_is_reported_as_off_only_when_it_is(panel, answers):
    lost = []

    def disarm(made):
        def blank(number, answer):
            if len(lost) < answers:
                lost.append(number)
                answer[:] = bytes(len(answer))

        made.loop.control.switch(on=False)
        made.damage = blank

    made = panel(at=[(0.3, disarm)], reports=[(0.0, {}), (8.0, {})])
    made.run()
    assert len(lost) == answers
    assert made.said[-1][1:] == (PanelState.DISARMED, OFF)
    assert made.counters.outages == (answers > 14)  # those to a heartbeat and to STOPs, three times each, and then to three DISARMs


class Disobedient(GatewareModel):
    """An FPGA that accepts DISARM, and stays on."""

    def __init__(self, parameters):
        super().__init__(parameters)
        self._gate.disarm = lambda *_: None


def test_an_fpga_that_stays_on_is_no_panel_that_is_off_and_is_left_to_its_heartbeat_timeout(panel, board):
    made = panel(gateware=Disobedient, at=[(0.3, switch(False))], reports=[(0.0, {}), (1.5, {})])
    made.run()
    after = [(state, may_be_on) for now_s, state, may_be_on in made.said if now_s > 0.3]
    assert after[:3] == [(PanelState.RAMPING, ON), (PanelState.FAULTED, ON), (PanelState.DISARMED, OFF)]
    assert made.counters.outages == 1
    assert "still has its outputs on" in made.counters.outage
    ramp_s = [now_s for now_s, state, _ in made.said if state is PanelState.RAMPING][-1]
    reported_s = next(now_s for now_s, state, _ in made.said if state is PanelState.FAULTED)
    off_s = next(now_s for now_s, state, _ in made.said if state is PanelState.DISARMED)
    assert reported_s - ramp_s < (board.limits.ramp_ms + 15) * 1e-3
    assert off_s - reported_s < 2 * (board.limits.heartbeat_timeout_ms + board.limits.ramp_ms) * 1e-3


@pytest.mark.parametrize("way", [unplugged, deaf])
def test_of_a_link_that_is_lost_it_is_not_said_that_the_outputs_are_off_before_they_are(panel, board, way):
    made = panel(at=[(0.3, way)], reports=[(0.0, {}), (1.5, {})])
    made.run()
    lost = [(now_s, may_be_on) for now_s, state, may_be_on in made.said if state is PanelState.WAITING_FOR_FPGA]
    assert [may_be_on for _, may_be_on in lost][:2] == [ON, OFF]
    waited_s = lost[1][0] - lost[0][0]
    assert waited_s < 2 * (board.limits.heartbeat_timeout_ms + board.limits.ramp_ms) * 1e-3
    assert way is unplugged or made.counters.outages == 1


@each_row("seed", range(16))
def test_outputs_are_never_said_to_be_off_while_they_are_on(panel, board, seed):
    """Random switching, idle times, stalls, resets and damaged answers; `Panel` compares in each turn."""
    rng = np.random.default_rng(seed)
    actions = [
        switch(True),
        switch(False),
        lambda made: setattr(made.clock, "_now_s", made.clock.now_s() + 0.25),
        lambda made: made.link.gateware.restart(made.link.tick(made.clock.now_s()), 80_000),
    ]
    at = [(at_s, actions[rng.integers(len(actions))]) for at_s in np.sort(rng.uniform(0.01, 2.2, 6)).tolist()]
    noise = [0.0, 0.02, 0.3][seed % 3]
    made = panel(
        msgspec.structs.replace(board, idle_disarm_s=[None, 0.3][seed % 2]),
        reports=[(0.0, {}), (0.9, {0: (60.0, 54.0)}), (0.95, {0: None}), (2.2, {})],
        gateware=partial(RestartingGateware, GatewareModel),
        at=at,
    )

    def damage(number, answer):
        if rng.random() < noise:
            answer[3] ^= 1

    made.damage = damage
    made.run()


def test_a_failure_is_seen_before_the_outputs_are_armed_again(panel):
    made = panel(at=[(0.3, lambda made: setattr(made.clock, "_now_s", made.clock.now_s() + 0.25))])
    made.run()
    ramp = (PanelState.RAMPING, ON)
    assert states(made) == [ramp, (PanelState.ARMED, ON), (PanelState.FAULTED, OFF), ramp, (PanelState.ARMED, ON)]
