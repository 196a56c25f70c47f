"""Idle: after so long without a touch the outputs ramp down and nothing is sent; the next touch is felt a ramp later."""

import signal
from itertools import pairwise

import msgspec
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule
from loop_parts import context_of
from restarting_gateware import RestartingGateware
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.panel_state import PanelState
from controller.device.fpga.registers import State
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.outputs import IDLE_TURN_S, Outputs
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.errors import ControllerError
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import open_simulated

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
TRAIN = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "train", rate_hz = 100.0, duration_ms = 200.0 }]\n'
KEPT = CLICK + "keep_armed = true\n"
SPOT = """[[regions]]
name = "spot"
shape = "circle"
x_mm = 60.0
y_mm = 54.0
radius_mm = 3.0
effects = [{ effect = "always", rate_hz = 20.0 }]
"""
START_S, IDLE_S = 0.1, 1.0
TAPS = [(0.0, {0: (60.0, 54.0)}), (0.05, {0: None}), (4.0, {0: (90.0, 54.0)}), (4.3, {0: None})]


class Run:
    """One loop in virtual time; every message with its time, and what `at_s` were commanded to do."""

    def __init__(self, board, bank_file, scene_file, recording, idle_s, calls=()):
        on = msgspec.structs.replace(board, idle_disarm_s=idle_s)
        self.clock, self.messages, self.played, self.states = VirtualClock(), [], [], []
        self.calls = sorted(calls, key=lambda call: call[0])
        self.link = open_simulated(on, self.clock.now_s, lambda parameters: RestartingGateware(GatewareModel, parameters))
        exchange = self.link.exchange

        def noting(sent, lengths, received):
            self.messages.append((self.clock.now_s(), sum(lengths)))
            exchange(sent, lengths, received)

        self.link.exchange = noting
        session = open_session(self.link, on, self.clock.now_s)
        with Bank.open(bank_file, on) as bank:
            source = tracked(RecordingSource(recording, recording.axes(on), START_S), on)
            assembly = assemble(
                LoopContext(on, self.clock, session, source),
                load_scene(scene_file, on),
                bank,
                played=self.played.append,
                watch=Watch(self.progress),
            )
            self.loop, self.counters = assembly.loop, assembly.counters
            self.loop.run()
            assert not self.loop._stopped, "a signal to the process of these tests has ended the loop"
        self.link.close()
        self.capture = self.link.take_capture()

    def progress(self, now_s):
        state = self.loop.outputs.state
        if not self.states or self.states[-1][1] is not state:
            self.states.append((now_s, state))
        while self.calls and self.calls[0][0] <= now_s:
            self.calls.pop(0)[1](self)

    def bytes_between(self, from_s, to_s):
        return sum(size for at_s, size in self.messages if from_s < at_s < to_s)


@pytest.fixture
def run(board, bank_file, tmp_path, evemu_text):
    def run_it(scene, idle_s=IDLE_S, reports=TAPS, calls=()):
        (tmp_path / "s.toml").write_text(scene)
        return Run(board, bank_file, tmp_path / "s.toml", Recording(evemu_text(*reports)), idle_s, calls)

    return run_it


def test_not_a_byte_is_sent_while_the_panel_is_idle(run, board):
    done = run(CLICK)
    idle_from_s = START_S + 0.05 + IDLE_S + 0.1 + board.limits.ramp_ms * 1e-3
    assert done.bytes_between(0.5, 1.0) > 0, "heartbeats before"
    assert done.bytes_between(idle_from_s, START_S + 4.0) == 0
    assert done.bytes_between(START_S + 4.0, START_S + 4.1) > 0
    assert done.counters.idled == 1
    assert done.counters.host_silent == done.counters.outages == 0, "the silence of a host is no fault of outputs that are off"
    states = [state for _, state in done.states]
    assert states[-5:] == [PanelState.ARMED, PanelState.RAMPING, PanelState.IDLE, PanelState.RAMPING, PanelState.ARMED]


def test_outputs_are_at_0_v_while_idle_and_ramp_both_ways(run, board):
    done = run(CLICK)
    capture, hz = done.capture, board.link.clock_hz
    middle = (capture.ticks > 1.5 * hz) & (capture.ticks < 4.0 * hz)
    assert not middle.any(), "no pin moves"
    before = capture.ticks <= 1.5 * hz
    assert capture.words[before][-1] == 0
    assert capture.hv[before][-1] == 0
    ramp = (capture.ticks > 1.1 * hz) & before
    assert ramp.sum() > 50, "many edges: a ramp, not a step"


def test_the_first_touch_is_felt_a_ramp_later(run, board):
    first, second = run(CLICK).played
    assert first.trigger_s - START_S < 3e-3
    late_s = second.trigger_s - START_S - 4.0
    assert board.limits.arming_s < late_s < board.limits.arming_s + 15e-3
    assert [emission.x_m for emission in second.emissions] == pytest.approx([0.09])


def test_a_train_that_wakes_the_panel_keeps_its_spacing(run):
    moving = [(4.0 + 0.008 * k, {0: (90.0 + 0.1 * k, 54.0)}) for k in range(40)]
    done = run(TRAIN, reports=[*TAPS[:2], *moving, (4.4, {0: None})])
    second = [played for played in done.played if played.trigger_s > 4.0]
    assert len(second) == 20
    apart_s = [after.trigger_s - before.trigger_s for before, after in pairwise(second)]
    assert apart_s == pytest.approx([0.01] * 19, abs=1e-7)


@each_row(("scene", "idle_s"), [(CLICK, None), (KEPT, IDLE_S), (CLICK + SPOT, IDLE_S), (SPOT + CLICK, IDLE_S)])
def test_by_default_with_keep_armed_and_with_spots_the_outputs_stay_on(run, scene, idle_s):
    done = run(scene, idle_s)
    assert done.counters.idled == 0
    assert all(done.bytes_between(from_s, from_s + 0.1) > 0 for from_s in (1.3, 2.5, 3.9)), "heartbeats at least"
    click = next(played for played in done.played if played.trigger_s > START_S + 4.0 and played.emissions[0].finger is not None)
    assert click.trigger_s - START_S - 4.0 < 6e-3


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_to_the_process_of_the_tests_is_named_and_not_taken_for_a_silent_loop(run, number):
    with pytest.raises(AssertionError, match="a signal to the process of these tests"):
        run(CLICK, None, calls=[(0.5, lambda _: signal.raise_signal(number))])


def test_a_finger_that_rests_keeps_the_outputs_on(run):
    done = run(CLICK, reports=[(0.0, {0: (60.0, 54.0)}), (4.0, {0: None})])
    assert done.counters.idled == 0


def test_a_command_wakes_the_panel_and_is_played(run):
    def play(done):
        done.loop.control.play(7, "click", 0.1, 0.07, None, 1.0, done.clock.now_s())

    done = run(CLICK, calls=[(2.5, play)])
    assert done.counters.idled == 2, "and again after it"
    (played,) = [one for one in done.played if one.emissions[0].finger is None]
    assert 2.5 < played.trigger_s < 2.5 + IDLE_TURN_S + 0.05


def test_a_panel_that_a_client_disarms_while_it_is_idle_is_disarmed(run):
    done = run(CLICK, calls=[(2.5, lambda done: done.loop.control.switch(on=False))])
    assert done.states[-1][1] is PanelState.DISARMED
    assert [played for played in done.played if played.trigger_s > 2.5] == []


def test_an_fpga_that_was_reset_while_idle_is_found_and_armed_anew(run):
    def reset(done):
        done.link.gateware.restart(done.link.tick(done.clock.now_s()), round(1e-3 * done.link.clock_hz))

    touches = [*TAPS, (5.0, {0: (120.0, 54.0)}), (5.05, {0: None})]
    done = run(CLICK, reports=touches, calls=[(2.5, reset)])
    assert done.counters.outages == 1
    assert [emission.x_m for emission in done.played[-1].emissions] == pytest.approx([0.12])


class IdleMachine(RuleBasedStateMachine):
    """Outputs of the product with a session on the model of the gateware, in virtual time."""

    BOARD = load_board(find_board("simulated"))

    def __init__(self):
        super().__init__()
        self.clock = VirtualClock()
        self.link = open_simulated(self.BOARD, self.clock.now_s)
        self.session = open_session(self.link, self.BOARD, self.clock.now_s)
        context = context_of(self.BOARD, self.clock, self.session)
        self.counters = context.counters
        self.outputs = Outputs(context)
        self.quiet_from_s = None

    def turn(self):
        """As the loop: failures begin the recovery."""
        try:
            if self.outputs.unwanted:
                self.outputs.disarm()
            self.outputs.advance(self.clock.now_s())
        except ControllerError as error:
            self.outputs.failed(error, self.clock.now_s())

    @rule(for_s=st.sampled_from([0.001, 0.02, 0.1, 0.6]))
    def time_passes(self, for_s):
        end_s = self.clock.now_s() + for_s
        while self.clock.now_s() < end_s:
            self.turn()
            self.clock._now_s = max(self.clock.now_s() + 1e-6, min(end_s, self.outputs.next_s()))

    @precondition(lambda self: self.outputs.on)
    @rule()
    def nothing_is_touched(self):
        self.outputs.begin_idle()
        self.quiet_from_s = None

    @precondition(lambda self: self.outputs.idle)
    @rule()
    def a_touch(self):
        self.outputs.wake()
        self.outputs.switch(on=True)
        for _ in range(500):
            self.turn()
            self.clock._now_s = max(self.clock.now_s() + 1e-6, min(self.outputs.next_s(), self.clock.now_s() + 0.01))
            if self.outputs.on:
                return
        raise AssertionError("a touch arms the outputs")

    @precondition(lambda self: not self.outputs.idle)
    @rule(wanted=st.booleans())
    def a_client_switches(self, wanted):
        self.outputs.switch(on=wanted)

    @invariant()
    def nothing_is_sent_while_idle(self):
        if not self.outputs.idle:
            self.quiet_from_s = None
        elif not self.outputs.ramping_down:
            if self.quiet_from_s is None:
                self.quiet_from_s = self.link.bytes_sent
            assert self.link.bytes_sent == self.quiet_from_s

    @invariant()
    def the_fpga_never_switched_off_by_itself(self):
        assert self.counters.host_silent == self.counters.outages == 0

    @invariant()
    def outputs_that_are_on_are_not_idle(self):
        assert not (self.outputs.on and self.outputs.idle)
        if self.outputs.idle:
            assert self.outputs.state is (PanelState.RAMPING if self.outputs.ramping_down else PanelState.IDLE)
            assert self.outputs.cause

    @invariant()
    def off_is_said_only_of_outputs_that_are_off(self):
        self.link.gateware.advance(self.link.tick(self.clock.now_s()))
        if not self.outputs.may_be_on:
            assert State.HV_ENABLE not in self.link.gateware.status().state
        elif not self.outputs.on:
            assert self.outputs.state is PanelState.RAMPING, "there are no failures here"


TestIdleMachine = IdleMachine.TestCase
TestIdleMachine.settings = settings(max_examples=30, stateful_step_count=15, deadline=None)
