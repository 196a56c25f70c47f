"""Two FPGAs on one clock, one trigger line and one line of run permit: their pins in the same tick, a fault of one shuts both."""

import numpy as np
import pytest
from restarting_gateware import RestartingGateware
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.exchange import HostSilent, OutOfStep, Refused
from controller.device.fpga.frames import Play, ReadyFrames, joined, parted
from controller.device.fpga.recovery import Action, Recovery, action_for
from controller.device.fpga.registers import Control, Fault, Register, Result, Start, State
from controller.device.fpga.session import Session
from controller.device.fpga.several.wide_session import APART_TICKS, WideSession
from controller.device.service.drivers import await_session, open_session
from controller.errors import FaultError, LinkError
from controller.workshop.gateware.actual_panel import gateware_of
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.wired_fpgas import LINE_TICKS, SimulatedFpgas

BOARD = load_board(find_board("simulated_64"))
HZ = BOARD.link.clock_hz
SHUT_TICKS = HZ // 10_000  # 100 us
PARTS = [memoryview(np.random.default_rng(seed).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8)) for seed in (7, 8)]
WORDS = joined(PARTS)


class Panel:
    """Two FPGAs whose resets end at different ticks, with their outputs on."""

    def __init__(self, back_end, ready_ticks=(0, 31_415)):
        self.clock = VirtualClock()
        self.link = SimulatedFpgas(BOARD, self.clock.now_s, back_end, ready_ticks)
        self.session = open_session(self.link, BOARD, self.clock.now_s)
        assert isinstance(self.session, WideSession)
        self.clock._now_s = self.session.arm()
        self.session.require_armed()
        self.link.take_captures()

    def wait(self, seconds):
        self.clock._now_s = max(self.clock.now_s(), self.link.wire_free_s()) + seconds

    def captures(self):
        self.link.close()
        return self.link.take_captures()

    def off_ticks(self):
        """Tick in which the high voltage of each FPGA went off."""
        found = [capture.ticks[capture.hv == 0] for capture in self.captures()]
        assert [len(ticks) for ticks in found] == [1, 1]
        return [int(ticks[0]) for ticks in found]


@pytest.fixture
def panel():
    return Panel(GatewareModel)


def test_the_verilog_of_each_is_closed_in_any_order(back_end):
    """Verilator's names belong to a context of the thread: that of whichever ran last, which may be the one that is gone."""
    for number in range(20):
        pair = [back_end(gateware_of(one, 0)) for one in BOARD.fpga_boards]
        pair[number % 2].advance(1000)
        del pair[number % 2]
        pair.pop()


def test_all_pins_play_in_the_same_tick_by_the_trigger_and_at_a_time(back_end):
    panel = Panel(back_end)
    session = panel.session
    session.upload_and_play(Play(1), WORDS, stop=False)
    session.trigger()
    panel.wait(3e-3)
    when = session.heartbeat().timestamp_ticks + HZ // 1000
    session.play(Play(1, start=Start.TIME, when_ticks=when), stop=False)
    panel.wait(5e-3)
    assert session.heartbeat().emissions == 2
    first, second = panel.captures()
    assert first.focus_ticks.tolist() == second.focus_ticks.tolist()
    assert first.focus_ticks[1] == when + BOARD.emission_ticks
    for capture, words in zip((first, second), PARTS, strict=True):
        starts = capture.focus_ticks - BOARD.emission_ticks
        for start in starts.astype(np.int64):
            ticks = start + np.arange(1000) * BOARD.bit_ticks
            on_pins = capture.words[np.searchsorted(capture.ticks, ticks, "right") - 1]
            assert on_pins.tobytes() == bytes(words)


@each_row(
    ("number", "which", "fault"),
    [
        (0, Permit.TEMPERATURE, Fault.OVER_TEMPERATURE),
        (1, Permit.TEMPERATURE, Fault.OVER_TEMPERATURE),
        (0, Permit.RUN, Fault.NO_PERMIT),
    ],
)
def test_what_shuts_one_shuts_both_and_its_cause_is_said(number, which, fault):
    shut_by(Panel(GatewareModel), number, which, fault)


def test_heat_at_one_shuts_both(back_end):
    shut_by(Panel(back_end), 1, Permit.TEMPERATURE, Fault.OVER_TEMPERATURE)


def shut_by(panel, number, which, fault):
    """A permit of one of them is lost: both are off in time and say why, and both can be armed again."""
    panel.wait(0)
    at = max(panel.link.tick(panel.clock.now_s()), panel.link.panel.now) + 1000
    panel.link.panel.permit(number, at, level=False, which=which)
    panel.wait(1e-3)
    with pytest.raises(FaultError) as said:
        panel.session.heartbeat()
    assert said.value.faults == fault
    assert all(at < tick <= at + LINE_TICKS + 8 <= at + SHUT_TICKS for tick in panel.off_ticks())
    panel.link.panel.permit(number, panel.link.panel.now + 1000, level=True, which=which)
    panel.wait(1e-3)
    panel.session.bring_up()
    panel.clock._now_s = panel.session.arm()
    panel.session.require_armed()


def test_a_host_that_is_silent_to_one_of_them_shuts_both_and_may_arm_again(panel):
    silent, other = panel.session._others[0], panel.session.exchange
    timeout_s = BOARD.limits.heartbeat_timeout_ms * 1e-3
    silent_from = panel.link.tick(panel.clock.now_s())
    while panel.clock.now_s() < panel.link.time_s(silent_from) + 0.9 * timeout_s:
        panel.wait(timeout_s / 10)
        other.control(Control.STOP)
    panel.wait(timeout_s / 5)
    with pytest.raises(HostSilent) as said:
        panel.session.heartbeat()
    assert action_for(said.value) is Action.RETRY
    first, second = panel.off_ticks()
    assert second < first <= second + LINE_TICKS + 8 <= second + SHUT_TICKS
    assert silent.may_be_on is False
    recovered(panel, said.value)


def test_a_trigger_line_that_does_not_reach_one_of_them_is_found_before_anything_is_armed():
    clock = VirtualClock()
    link = SimulatedFpgas(BOARD, clock.now_s)
    link.panel.gatewares[1].trigger = lambda *_: None
    with pytest.raises(LinkError, match=r"FPGA 1 saw 0 edges of the trigger line and not one"):
        open_session(link, BOARD, clock.now_s)


def test_a_fault_of_another_is_the_cause_also_where_the_first_one_was_at_work(panel):
    panel.session.upload(1, WORDS)
    at = panel.link.panel.now + 1000
    panel.link.panel.permit(1, at, level=False, which=Permit.TEMPERATURE)
    panel.wait(1e-3)
    with pytest.raises(FaultError) as said:
        panel.session.play(Play(1), stop=False)
    assert (said.value.faults, str(said.value)[:7]) == (Fault.NO_PERMIT, "FPGA 0:")
    cause = panel.session.cause_of(said.value)
    assert (cause.faults, str(cause)[:7]) == (Fault.OVER_TEMPERATURE, "FPGA 1:")
    assert not panel.session.on_anywhere


def recovered(panel, error):
    """Recovery until all are on again."""
    recovery = Recovery(panel.session, BOARD)
    recovery.begin(error, panel.clock.now_s())
    for _ in range(20):
        panel.clock._now_s = max(panel.clock.now_s(), recovery.next_s)
        if recovery.step(panel.clock.now_s()):
            return
    pytest.fail(f"not armed again: {recovery.cause}")


def test_one_that_does_not_answer_ends_with_all_off_and_that_it_was(panel):
    deaf, receive = panel.link.links[1], panel.link.links[1].exchange

    def silent(sent, lengths, received):
        receive(sent, lengths, received)
        received[:] = bytes(len(received))

    deaf.exchange = silent
    with pytest.raises(LinkError, match=r"^FPGA 1: only zeros came back") as said:
        panel.session.heartbeat()
    recovery = Recovery(panel.session, BOARD)
    recovery.begin(said.value, panel.clock.now_s())
    heard_s = max(one.exchange.heartbeat_due_s for one in (panel.session, panel.session._others[0]))
    assert recovery.off_by_s == heard_s + (BOARD.limits.heartbeat_timeout_ms + BOARD.limits.ramp_ms) * 1e-3
    panel.clock._now_s = recovery.off_by_s
    panel.off_ticks()
    del deaf.exchange
    recovered(panel, said.value)


def test_one_that_is_reset_shuts_the_others_by_the_wire_and_all_play_in_step_again():
    made = []

    def restarting(parameters):
        made.append(RestartingGateware(GatewareModel, parameters))
        return made[-1]

    panel = Panel(restarting)
    wires = panel.link.panel
    at = wires.now + 1000
    wires.advance(at)
    made[1].restart(wires.now - wires.ready_ticks[1], 1000)
    wires.advance(wires.now + 1)
    panel.wait(1e-3)
    with pytest.raises(LinkError, match=r"^FPGA 1: the FPGA was reset") as said:
        panel.session.heartbeat()
    first, second = panel.off_ticks()
    assert second < first <= second + SHUT_TICKS
    recovered(panel, said.value)
    panel.link.take_captures()
    when = panel.session.heartbeat().timestamp_ticks + HZ // 100
    panel.session.upload_and_play(Play(1, start=Start.TIME, when_ticks=when), WORDS, stop=False)
    panel.wait(15e-3)
    foci = [capture.focus_ticks.tolist() for capture in panel.captures()]
    assert foci == [[when + BOARD.emission_ticks]] * 2


@each_row("emissions", [1, 3])
def test_what_has_begun_on_one_is_not_refused_since_another_refuses_it(emissions):
    panel = Panel(GatewareModel)
    session = panel.session
    session.upload(1, WORDS)
    session.ahead_ticks = [session.ahead_ticks[0] - HZ // 1000]  # that of the second one has passed
    when = session.heartbeat().timestamp_ticks + HZ // 12_500  # 80 us: while the second one is asked
    play = Play(1, start=Start.TIME, when_ticks=when, emissions=emissions, period_ticks=BOARD.emission_ticks)
    if emissions == 1:
        session.play(play, stop=False)
    else:
        with pytest.raises(OutOfStep, match=r"a repetition has begun on FPGA 0 .*: FPGA 1: the FPGA refused"):
            session.play(play, stop=False)
    assert session.counters.misplaced == 1
    panel.wait(10e-3)
    assert [len(capture.focus_ticks) for capture in panel.captures()] == [1, 0]


def test_all_are_opened_by_the_first_message_for_which_they_are_there():
    clock = VirtualClock()
    opened = []

    def open_fpga(board, now_s):
        if not opened:
            raise LinkError("there is no /dev/spidev0.1")
        opened.append(SimulatedFpgas(board, now_s))
        return opened[-1]

    link, session = await_session(BOARD, clock.now_s, open_fpga)
    recovery = Recovery(session, BOARD)
    assert not recovery.step(clock.now_s())
    assert recovery.cause.endswith("there is no /dev/spidev0.1")
    opened.append(None)
    for _ in range(20):
        clock._now_s = max(clock.now_s(), recovery.next_s)
        if recovery.step(clock.now_s()):
            break
    session.require_armed()
    assert len(opened) == 2
    assert link.bytes_sent == opened[1].bytes_sent > 0


def test_what_one_of_them_refuses_none_plays(panel):
    session = panel.session
    session.upload(1, WORDS)
    Session.upload(session, 3, PARTS[0])  # to the first one alone
    with pytest.raises(Refused) as said:
        session.play(Play(3), stop=False)
    assert said.value.result is Result.EMPTY_SLOT
    assert session.heartbeat().queued == 0
    session.trigger()
    panel.wait(3e-3)
    assert session.heartbeat().emissions == 0
    session.play(Play(1), stop=False)
    session.trigger()
    panel.wait(3e-3)
    assert session.heartbeat().emissions == 1


def test_fpgas_that_have_played_different_numbers_of_emissions_are_out_of_step(panel):
    session = panel.session
    session.upload_and_play(Play(1), WORDS, stop=False)
    session.trigger()
    panel.wait(4e-3)
    session.heartbeat()
    one = session._others[0]
    one.play(Play(1, start=Start.NOW), stop=False)  # behind the back of the others
    panel.wait(4e-3)
    with pytest.raises(OutOfStep, match="have played 0, 1 emissions"):
        session.heartbeat()


@each_row("ticks", [2, 3, -3])
def test_fpgas_that_drift_apart_while_they_play_are_switched_off(ticks):
    """A crystal of its own: the second one sees the edge at another tick of what it counts."""
    panel = Panel(GatewareModel)
    session, second = panel.session, panel.link.panel.gatewares[1]
    trigger = second.trigger
    second.trigger = lambda tick, high_ticks: trigger(tick + ticks, high_ticks)
    session.upload_and_play(Play(1), WORDS, stop=False)
    session.trigger()
    panel.wait(5e-3)
    if abs(ticks) <= APART_TICKS:
        session.heartbeat()
        return
    with pytest.raises(OutOfStep, match=rf"FPGA 1 counts {ticks} ticks more than FPGA 0 .*: have all run") as said:
        session.heartbeat()
    recovery = Recovery(session, BOARD)
    recovery.begin(said.value, panel.clock.now_s())
    panel.clock._now_s = recovery.off_by_s
    panel.off_ticks()


@pytest.mark.interpreted
def test_the_ticks_are_looked_at_once_a_second_and_only_after_a_trigger(panel):
    session, looks = panel.session, []
    read = session.exchange.read
    session.exchange.read = lambda register: looks.append(register) or read(register)
    session.upload(1, WORDS)
    for _ in range(30):  # 1.5 s
        session.play(Play(1), stop=False)
        session.trigger()
        panel.wait(50e-3)
        session.heartbeat()
    assert looks == [Register.TRIGGER_TIME_LOW] * 2
    for _ in range(30):
        panel.wait(50e-3)
        session.heartbeat()
    assert len(looks) == 3, "of the last edge"


def test_a_repetition_that_ends_once_more_on_one_of_them_is_no_reason_to_switch_off(panel):
    session = panel.session
    session.upload(1, WORDS)
    period = BOARD.emission_ticks
    for before_us in range(0, 80, 10):  # of the next emission: between the commands to each, for one of these
        session.play(Play(1, emissions=0, period_ticks=period), stop=False)
        at = panel.link.tick(session.trigger())
        panel.clock._now_s = panel.link.time_s(at + 2 * period - round(before_us * 1e-6 * HZ))
        session.stop()
        panel.wait(5e-3)
        session.heartbeat()
    first, second = (len(capture.focus_ticks) for capture in panel.captures())
    assert first < second <= first + 4


def test_the_bit_clock_changes_for_all_of_them_or_for_none(panel):
    session = panel.session
    assert session.set_bit_period(1.01)
    periods = [one.bit_period for one in (session, *session._others)]
    assert periods == [round(BOARD.bit_period / 1.01)] * 2
    session._others[0].upload_and_play(Play(1), PARTS[1], stop=False)  # it waits for a trigger
    assert not session.set_bit_period(1.0)
    assert [one.bit_period for one in (session, *session._others)] == periods


def test_a_state_is_of_all_fpgas_and_ramps_end_when_the_last_does(panel):
    session = panel.session
    assert State.ARMED in session.heartbeat().state
    panel.clock._now_s = session.disarm()
    panel.wait(1e-3)
    status = session.heartbeat()
    assert not status.state & (State.ARMED | State.HV_ENABLE)
    assert not session.on_anywhere
    assert not any(capture.hv[-1] for capture in panel.captures())


def test_waveforms_of_several_fpgas_are_one_behind_the_other():
    assert [bytes(part) for part in parted(WORDS, 2)] == [bytes(part) for part in PARTS]
    with pytest.raises(ValueError, match="words of one FPGA, frames of another"):
        joined([PARTS[0], ReadyFrames(PARTS[1], 0)])
    ready = [ReadyFrames(memoryview(bytes([number]) * 100), 0xFFFFFFFF - number) for number in range(3)]
    assert parted(joined(ready), 3) == ready
