"""Recovery from a reset, a brown-out, a damaged link or a lost permit: outputs are off meanwhile, and work afterwards."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from loop_parts import context_of
from restarting_gateware import RestartingGateware
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.panel_state import PanelState
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.configuration import IncompatibleFpga
from controller.device.fpga.exchange import FpgaReset, HostSilent, Refused
from controller.device.fpga.frames import Play
from controller.device.fpga.recovery import Action, Recovery, action_for, arming_permitted, panel_state_after
from controller.device.fpga.registers import Control, Fault, Register, Result, State
from controller.device.fpga.session import Session
from controller.device.loop.outputs import Outputs
from controller.errors import FaultError, LinkError, TouchError
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink

BUILD = 0x1234ABCD
WORDS = memoryview(np.random.default_rng(7).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8)).cast("B")
BOARD = load_board(find_board("simulated"))
TIMEOUT_S = BOARD.limits.heartbeat_timeout_ms * 1e-3


class BadDay(SimulatedLink):
    """A link with faults: `events` maps the number of a frame to a function that is called before it."""

    def __init__(self, *args):
        super().__init__(*args)
        self.events = {}
        self.frames = 0

    def exchange(self, sent, lengths, received):
        start = 0
        for length in lengths:
            frame = bytearray(sent[start : start + length])
            answer = received[start : start + length]
            happens = self.events.pop(self.frames, None)
            if happens is not None:
                happens(frame)
            self.frames += 1
            if frame:
                super().exchange(memoryview(frame), [length], answer)
            else:
                answer[:] = b"\xff" * length
            start += length

    def reset(self, dark_s=1e-3):
        """Interrupt the FPGA's supply now."""
        self.gateware.restart(max(self._tick_now(), self._bus.free_tick), round(dark_s * self.clock_hz))


class Panel:
    """Link, session and outputs on a virtual clock, armed."""

    def __init__(self):
        self.clock = VirtualClock()
        parameters = BuildParameters.of(BOARD, BUILD)
        self.gateware = RestartingGateware(GatewareModel, parameters)
        self.link = BadDay(BOARD.link, self.clock.now_s, self.gateware)
        self.session = Session(self.link, BOARD, BUILD, self.clock.now_s)
        context = context_of(BOARD, self.clock, self.session)
        self.counters = context.counters
        self.outputs = Outputs(context)
        self.come_on(1.0)

    def rest(self, until_s):
        while self.clock.now_s() < until_s:
            self.session.heartbeat()
            self.clock._now_s = min(until_s, self.session.heartbeat_due_s)

    def wait(self, seconds):
        self.clock._now_s = max(self.clock.now_s(), self.link.wire_free_s()) + seconds

    def recover(self, error, give_up_s=10.0):
        """Recover as the loop does; returns how long it took."""
        began_s = self.clock.now_s()
        self.outputs.failed(error, began_s)
        self.come_on(began_s + give_up_s)
        self.outputs.emission_started()  # so that stalls are not in a row
        return self.clock.now_s() - began_s

    def come_on(self, until_s):
        """Do turns until the outputs are on."""
        while not self.advance():
            assert self.clock.now_s() < until_s, self.outputs.cause

    def advance(self):
        """One turn of the loop."""
        self.clock._now_s = max(self.clock.now_s(), self.outputs.next_s())
        try:
            return self.outputs.advance(self.clock.now_s())
        except (LinkError, FaultError) as error:
            self.outputs.failed(error, self.clock.now_s())
            return False

    def lost(self, seconds=1.0):
        """The error that heartbeats raise within `seconds`."""
        with pytest.raises((LinkError, FaultError)) as caught:
            self.rest(self.clock.now_s() + seconds)
        return caught.value

    def plays(self):
        before = self.session.heartbeat().emissions
        self.session.upload_and_play(Play(0), WORDS, stop=False)
        self.session.trigger()
        self.wait(3e-3)
        return self.session.heartbeat().emissions - before == 1

    def off_between(self, from_s, until_s):
        """Whether the high voltage was off during an interval, except a heartbeat timeout at its beginning."""
        self.link.close()
        capture = self.link.take_capture()
        times_s = capture.ticks.astype(float) / BOARD.link.clock_hz
        spans = [*pairwise(times_s), (times_s[-1], np.inf)]
        return not any(hv and begin < until_s and end > from_s for (begin, end), hv in zip(spans, capture.hv, strict=True))


@pytest.fixture
def panel():
    return Panel()


def test_a_reset_while_armed_is_detected_by_the_next_heartbeat_and_recovered(panel):
    assert panel.plays()
    panel.link.reset()
    lost_s = panel.link.wire_free_s()
    error = panel.lost()
    assert isinstance(error, FpgaReset | LinkError)
    took_s = panel.recover(error)
    assert took_s < 1.0
    assert panel.session.exchange.read(Register.IDLE_WORD) == BOARD.idle_word
    back_s = panel.clock.now_s()
    assert panel.plays()
    assert panel.off_between(lost_s, back_s - BOARD.limits.arming_s - 1e-3)


def test_a_reset_between_two_frames_is_still_detected(panel):
    panel.wait(1e-3)
    panel.link.reset(dark_s=0)
    panel.wait(1e-3)
    with pytest.raises(FpgaReset, match="was reset, or lost its supply"):
        panel.session.heartbeat()


@each_row("ran_s", [1e-3, 1.0, 100.0])
@each_row("away_s", [1e-3, 0.2, 0.5, 99.0])
def test_a_reset_before_arming_never_arms_without_the_boards_limits(ran_s, away_s):
    clock = VirtualClock()
    clock._now_s = 5.0
    gateware = RestartingGateware(GatewareModel, BuildParameters.of(BOARD, BUILD))
    link = BadDay(BOARD.link, clock.now_s, gateware)
    clock._now_s += ran_s
    session = Session(link, BOARD, BUILD, clock.now_s)
    clock._now_s = max(clock.now_s(), link.wire_free_s()) + 1e-3
    session.heartbeat()
    link.reset(dark_s=1e-3)
    clock._now_s += away_s + 2e-3
    try:
        session.arm()
    except FpgaReset:
        session.bring_up()
        session.arm()
    assert session.exchange.read(Register.IDLE_WORD) == BOARD.idle_word
    assert session.exchange.read(Register.DUTY_TICKS) == BOARD.limits.duty_budget_ms * 1e-3 * BOARD.link.clock_hz


def test_a_clock_that_is_a_little_slow_is_no_reset(panel):
    panel.session.disarm()
    panel.wait(10.0)
    hz = panel.link.clock_hz
    panel.link.clock_hz = round(hz * 0.9995)  # from its start on
    panel.session._heartbeat_ticks = round(panel.session._heartbeat_ticks * 0.9995)
    panel.session.heartbeat()


@pytest.mark.parametrize("resident", [True, False])
def test_a_play_finds_a_reset_and_never_takes_it_for_a_refusal(panel, resident):
    assert panel.plays()
    panel.link.reset(dark_s=0)
    panel.wait(1e-3)
    with pytest.raises(FpgaReset):
        panel.session.play(Play(0), stop=False) if resident else panel.session.upload_and_play(Play(0), WORDS, stop=False)


@each_row("frame", range(12))
@each_row("dark_s", [0.0, 0.3e-3, 50e-3])
def test_a_brown_out_during_an_upload_is_recovered(frame, dark_s):
    panel = Panel()
    assert panel.plays()
    panel.link.events = {panel.link.frames + frame: lambda _: panel.link.reset(dark_s)}
    with pytest.raises(LinkError) as caught:
        panel.session.upload_and_play(Play(1), WORDS, stop=False)
    lost_s = panel.link.wire_free_s()
    panel.recover(caught.value)
    back_s = panel.clock.now_s()
    assert panel.plays()
    assert panel.off_between(lost_s, back_s - BOARD.limits.arming_s - 1e-3)


def test_a_long_absence_of_the_fpga_is_waited_for(panel):
    panel.link.reset(dark_s=7.0)
    error = panel.lost()
    assert "only ones came back" in str(error)
    assert 6.0 < panel.recover(error) < 9.5
    assert panel.plays()


def test_garbage_on_the_line_switches_outputs_off_and_is_recovered(panel):
    rng = np.random.default_rng(5)

    def garble(frame):
        frame[:] = rng.bytes(len(frame))

    first = panel.link.frames
    panel.link.events = dict.fromkeys(range(first, first + 40), garble)
    error = panel.lost()
    lost_s = panel.clock.now_s()
    panel.recover(error)
    back_s = panel.clock.now_s()
    assert panel.plays()
    safe_s = TIMEOUT_S + BOARD.limits.arming_s
    assert panel.off_between(lost_s + safe_s, back_s - BOARD.limits.arming_s - 1e-3)


@settings(max_examples=25, deadline=None)
@given(st.dictionaries(st.integers(0, 300), st.sampled_from(["flip", "lost", "reset", "brown-out", "silence"]), max_size=6))
def test_any_sequence_of_failures_is_recovered(bad):
    panel = Panel()
    first = panel.link.frames

    def flip(frame):
        frame[len(frame) // 2] ^= 1

    def lost(frame):
        frame.clear()

    happenings = {
        "flip": flip,
        "lost": lost,
        "reset": lambda _: panel.link.reset(0),
        "brown-out": lambda _: panel.link.reset(2e-3),
        "silence": lambda _: panel.wait(2 * TIMEOUT_S),
    }
    panel.link.events = {first + at: happenings[what] for at, what in bad.items()}
    for _ in range(60):
        try:
            panel.plays()
            panel.rest(panel.clock.now_s() + 0.05)
        except (LinkError, FaultError) as error:
            panel.recover(error, give_up_s=30)
    panel.link.events = {}
    assert panel.plays()


def test_silence_of_this_host_is_cleared_at_once(panel):
    panel.wait(2 * TIMEOUT_S)
    error = panel.lost()
    assert isinstance(error, HostSilent)
    assert panel.recover(error) < 0.05
    assert panel.plays()


@pytest.mark.parametrize("which", list(Permit))
def test_a_permit_that_goes_away_is_waited_for(panel, which):
    def permit(level):
        panel.gateware.permit(round(panel.link.wire_free_s() * panel.link.clock_hz) + 100, level=level, which=which)

    permit(False)
    panel.wait(1e-3)
    error = panel.lost()
    assert action_for(error) is Action.WAIT_FOR_PERMIT
    panel.outputs.failed(error, panel.clock.now_s())
    assert not panel.advance()
    frames = panel.link.frames
    for _ in range(50):
        assert not panel.advance()
    assert panel.link.frames - frames == 50, "waiting is a heartbeat at a time"
    panel.session.exchange.control(Control.CLEAR, raise_faults=False)
    assert State.HV_ENABLE not in panel.session.heartbeat().state
    permit(True)
    panel.wait(1e-3)
    assert panel.recover(error) < 0.3
    assert panel.plays()


def test_a_reset_while_waiting_for_the_permit_does_not_leave_old_settings(panel):
    panel.gateware.permit(round(panel.link.wire_free_s() * panel.link.clock_hz) + 100, level=False, which=Permit.RUN)
    panel.wait(1e-3)
    error = panel.lost()
    panel.outputs.failed(error, panel.clock.now_s())
    panel.advance()
    panel.link.reset()
    panel.wait(2e-3)
    panel.gateware.permit(round(panel.link.wire_free_s() * panel.link.clock_hz) + 100, level=True, which=Permit.RUN)
    panel.come_on(panel.clock.now_s() + 2)
    assert panel.session.exchange.read(Register.IDLE_WORD) == BOARD.idle_word
    assert panel.plays()


@each_row("cause", [Fault.UNDERRUN, Fault.SHORT_PULSE, Fault.CHANNEL_EDGES, Fault.TOTAL_EDGES, Fault.LONG_EMISSION, Fault.DUTY])
@each_row("beside", [Fault(0), Fault.HOST_SILENT, Fault.NO_PERMIT])
def test_faults_of_host_or_board_end_the_program_with_outputs_off(cause, beside):
    panel = Panel()
    error = FaultError("outputs off", cause | beside)
    assert action_for(error) is Action.FAIL
    with pytest.raises(FaultError) as caught:
        panel.outputs.failed(error, panel.clock.now_s())
    assert caught.value is error
    panel.wait(BOARD.limits.arming_s + 1e-3)
    assert State.HV_ENABLE not in panel.session.heartbeat().state


@each_row(
    ("error", "action"),
    [
        (HostSilent("", Fault.HOST_SILENT), Action.RETRY),
        (FaultError("", Fault.NO_PERMIT), Action.WAIT_FOR_PERMIT),
        (FaultError("", Fault.OVER_TEMPERATURE | Fault.HOST_SILENT), Action.WAIT_FOR_PERMIT),
        (FaultError("not known which"), Action.FAIL),
        (FpgaReset(), Action.RETRY),
        (LinkError(""), Action.RETRY),
        (Refused(Result.NO_PERMIT), Action.WAIT_FOR_PERMIT),
        (TouchError(""), Action.FAIL),
    ],
)
def test_decisions_after_each_kind_of_failure(error, action):
    assert action_for(error) is action


@each_row(
    ("error", "state"),
    [
        (FaultError("", Fault.NO_PERMIT), PanelState.NO_PERMIT),
        (FaultError("", Fault.OVER_TEMPERATURE), PanelState.FAULTED),
        (Refused(Result.NO_PERMIT), PanelState.NO_PERMIT),
        (Refused(Result.NOT_ARMED), PanelState.WAITING_FOR_FPGA),
        (LinkError(""), PanelState.WAITING_FOR_FPGA),
    ],
)
def test_the_state_of_the_panel_after_each_error(error, state):
    assert panel_state_after(error) is state


def test_pauses_between_attempts_double_up_to_two_seconds_and_are_short_again_after_the_next_loss():
    def unplugged():
        raise LinkError("unplugged")

    recovery = Recovery(
        SimpleNamespace(off=lambda: None, bring_up=unplugged, cause_of=lambda error: error, quiet_since_s=0.0), BOARD
    )
    safe_s = TIMEOUT_S + BOARD.limits.ramp_ms * 1e-3
    for lost_s in (10.0, 100.0):
        recovery.begin(LinkError("unplugged"), lost_s)
        tried_s = [lost_s]
        for _ in range(8):
            tried_s.append(recovery.next_s)
            assert not recovery.step(recovery.next_s)
        assert np.diff(tried_s) == pytest.approx([min(safe_s * 2**k, 2.0) for k in range(8)])


def test_a_permit_is_asked_for_ten_times_a_second():
    session = SimpleNamespace(fresh=True, heartbeat=lambda: SimpleNamespace(state=State.TEMPERATURE_GOOD))
    recovery = Recovery(session, BOARD)
    assert not recovery.step(5.0)
    assert recovery.state is PanelState.NO_PERMIT
    assert recovery.next_s == pytest.approx(5.1)


def test_another_fpga_ends_the_program_and_is_never_armed():
    clock = VirtualClock()
    clock._now_s = 1.0
    gateware = RestartingGateware(GatewareModel, BuildParameters.of(BOARD, BUILD))
    session = Session(SimulatedLink(BOARD.link, clock.now_s, gateware), BOARD, BUILD + 1, clock.now_s, bring_up=False)
    outputs = Outputs(context_of(BOARD, clock, session))
    clock._now_s += 1.0
    with pytest.raises(IncompatibleFpga, match="BUILD_HASH"):
        outputs.advance(clock.now_s())
    assert action_for(IncompatibleFpga("")) is Action.FAIL
    assert not gateware.take_capture().hv.any()


@pytest.mark.parametrize("permit", list(Permit))
def test_a_late_fpga_and_a_later_permit_are_each_waited_for_and_named(permit):
    clock = VirtualClock()
    link = simulated(clock, dark_s=7.0)
    session = Session(link, BOARD, BUILD, clock.now_s, bring_up=False)
    link.gateware.permit(0, level=False, which=permit)
    context = context_of(BOARD, clock, session)
    counters = context.counters
    outputs = Outputs(context)
    seen = []

    def turns(until_s):
        while not outputs.advance(clock.now_s()) and clock.now_s() < until_s:
            seen.extend([outputs.state] if seen[-1:] != [outputs.state] else [])
            clock._now_s = max(clock.now_s() + 1e-6, outputs.next_s())

    assert (outputs.state, outputs.cause) == (PanelState.WAITING_FOR_FPGA, "")
    turns(20.0)
    waits = PanelState.NO_PERMIT if permit is Permit.RUN else PanelState.FAULTED
    assert seen == [PanelState.WAITING_FOR_FPGA, waits]
    assert (outputs.on, outputs.state) == (False, waits)
    link.gateware.permit(round(link.wire_free_s() * link.clock_hz) + 100, level=True, which=permit)
    turns(21.0)
    assert (outputs.on, outputs.state, outputs.cause) == (True, PanelState.ARMED, "")
    assert (counters.outages, counters.host_silent) == (0, 0), "waiting at the start is no outage"


def simulated(clock, dark_s):
    """A link to an FPGA that is without supply at first."""
    gateware = RestartingGateware(GatewareModel, BuildParameters.of(BOARD, BUILD))
    link = BadDay(BOARD.link, clock.now_s, gateware)
    link.reset(dark_s)
    return link


def test_a_panel_that_a_client_disarmed_stays_so_through_a_reset_until_it_is_armed_again(panel):
    assert panel.plays()
    panel.outputs.switch(on=False)
    panel.outputs.disarm()
    off_s = panel.session.ramp_end_s
    while panel.clock.now_s() < off_s + 1.0:
        assert not panel.advance()
    assert (panel.outputs.state, panel.outputs.on) == (PanelState.DISARMED, False)
    assert panel.session.heartbeat().faults == 0, "it is fed all the while"
    panel.link.reset()
    while panel.clock.now_s() < off_s + 5.0:
        assert not panel.advance()
    assert panel.outputs.state is PanelState.DISARMED
    back_s = panel.clock.now_s()
    panel.outputs.switch(on=True)
    panel.come_on(back_s + 1.0)
    assert panel.plays()
    assert panel.off_between(off_s, back_s)


@pytest.mark.interpreted
def test_a_failure_during_arming_disarms_the_fpga_at_once(panel, monkeypatch):
    panel.outputs.failed(LinkError("gone for a moment"), panel.clock.now_s())

    def damaged():
        raise LinkError("its answer was damaged")

    monkeypatch.setattr(panel.session, "require_armed", damaged)
    while panel.outputs.cause in {"gone for a moment", "the outputs are being switched on"}:
        panel.advance()
    assert panel.outputs.cause == "its answer was damaged"
    panel.wait(BOARD.limits.arming_s + 1e-3)
    assert BOARD.limits.arming_s + 2e-3 < TIMEOUT_S, "sooner than by the heartbeat's end"
    assert State.HV_ENABLE not in panel.session.heartbeat().state


def test_both_permits_are_needed():
    assert arming_permitted(State.RUN_PERMIT | State.TEMPERATURE_GOOD | State.HEARTBEAT)
    assert not arming_permitted(State.RUN_PERMIT)
    assert not arming_permitted(State.TEMPERATURE_GOOD)
