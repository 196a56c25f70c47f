"""Bring-up, arming and disarming on a link of which any one frame or answer is damaged or lost: the outcome is the same."""

import numpy as np
import pytest
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.doctor import bring_up
from controller.device.doctor.bit_errors import bit_errors
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.configuration import IncompatibleFpga, settings
from controller.device.fpga.exchange import ATTEMPTS
from controller.device.fpga.registers import IDENTITY_MAGIC, Register, Result, State
from controller.device.fpga.session import Session
from controller.errors import LinkError
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink

BUILD = 0x1234ABCD
BOARD = load_board(find_board("simulated"))
ALWAYS = range(1 << 30)


def to_fpga(frame, answer, exchange):
    frame[len(frame) // 2] ^= 4
    exchange(frame)


def to_host(frame, answer, exchange):
    exchange(frame)
    answer[len(answer) // 2] ^= 4


def lost(frame, answer, exchange):
    """Chip select never fell."""
    answer[:] = b"\xff" * len(answer)


def unheard(frame, answer, exchange):
    """The frame was executed, and nothing came back."""
    exchange(frame)
    answer[:] = b"\0" * len(answer)


DAMAGES = [to_fpga, to_host, lost, unheard]


class DamagingLink(SimulatedLink):
    """A link that does a damage to the frames of some numbers."""

    def __init__(self, clock, gateware=None, damage=to_fpga, numbers=()):
        super().__init__(BOARD.link, clock.now_s, gateware or GatewareModel(BuildParameters.of(BOARD, BUILD)))
        self.damage, self.numbers, self.frames = damage, numbers, 0

    def exchange(self, sent, lengths, received):
        start = 0
        for length in lengths:
            answer = received[start : start + length]
            pass_on = self._pass_on(length, answer)
            if self.frames in self.numbers:
                self.damage(bytearray(sent[start : start + length]), answer, pass_on)
            else:
                pass_on(sent[start : start + length])
            self.frames += 1
            start += length

    def _pass_on(self, length, answer):
        return lambda frame: super(DamagingLink, self).exchange(memoryview(frame), [length], answer)


def arm_and_disarm(link, clock):
    """All that a session does but for plays; the registers it has set."""
    session = Session(link, BOARD, BUILD, clock.now_s)
    clock._now_s = session.arm()
    session.require_armed()
    set_to = {register: session.exchange.read(register) for register in settings(BOARD)}
    clock._now_s = session.disarm()
    assert State.HV_ENABLE not in session.heartbeat().state
    session.off()
    return set_to


def frames_of(task):
    clock = VirtualClock()
    link = DamagingLink(clock)
    task(link, clock)
    return link.frames


@each_row("damage", DAMAGES)
def test_a_damage_at_any_one_frame_of_bring_up_and_arming_changes_nothing(damage):
    frames = frames_of(arm_and_disarm)
    assert frames > 100
    for number in range(frames):
        clock = VirtualClock()
        link = DamagingLink(clock, None, damage, {number})
        assert arm_and_disarm(link, clock) == settings(BOARD), f"frame {number}"
        link.close()
        capture = link.take_capture()
        assert (capture.hv.max(), capture.hv[-1], capture.words[-1]) == (1, 0, 0)


@each_row("damage", DAMAGES)
def test_what_fails_each_time_is_reported_after_three_attempts_and_nothing_is_on(damage):
    clock = VirtualClock()
    link = DamagingLink(clock, None, damage, ALWAYS)
    with pytest.raises(LinkError) as caught:
        Session(link, BOARD, BUILD, clock.now_s)
    assert not isinstance(caught.value, IncompatibleFpga)
    link.close()
    assert not link.take_capture().hv.any()


@each_row("damage", DAMAGES)
def test_two_damaged_frames_in_a_row_between_heartbeats_do_not_switch_the_outputs_off(damage):
    """The host is 1 ms late each time, so that a third heartbeat would come after the FPGA's timeout."""
    clock = VirtualClock()
    link = DamagingLink(clock, None, damage)
    session = Session(link, BOARD, BUILD, clock.now_s)
    clock._now_s = session.arm()
    link.numbers = {link.frames + 1, link.frames + 2}
    for _ in range(6):
        clock._now_s = session.heartbeat_due_s + 1e-3
        assert State.HV_ENABLE in session.heartbeat().state
    assert link.frames > max(link.numbers) + 1
    session.off()


def fpga_with(write=None, read=None):
    """The model with a register file that does otherwise: each takes the model's own method and what it is called with."""
    model = GatewareModel(BuildParameters.of(BOARD, BUILD))
    registers = model._commands.registers
    own_write, own_read = registers.write, registers.read
    if write is not None:
        registers.write = lambda *what, **state: write(own_write, *what, **state)
    if read is not None:
        registers.read = lambda register: read(own_read, register)
    return model


@each_row("refusal", [Result.BAD_VALUE, Result.UNKNOWN_REGISTER, Result.READ_ONLY])
@each_row("damage", [None, *DAMAGES])
def test_an_fpga_that_refuses_a_setting_is_refused_at_its_first_word_whatever_is_damaged(refusal, damage):
    asked = []

    def write(own, address, value, **state):
        if address != Register.DUTY_SHARE:
            return own(address, value, **state)
        asked.append(value)
        return refusal

    numbers = set() if damage is None else set(range(0, 200, 7))  # never three times in a row
    clock = VirtualClock()
    link = DamagingLink(clock, fpga_with(write=write), damage, numbers)
    with pytest.raises(IncompatibleFpga, match=r"the FPGA does not take \d+ for DUTY_SHARE") as caught:
        Session(link, BOARD, BUILD, clock.now_s)
    assert caught.value.exit_code == 78
    assert 1 <= len(asked) <= ATTEMPTS


@each_row(("wrong", "good"), [(1, True), (2, True), (5, True), (6, False)])
def test_a_setting_that_reads_back_otherwise_is_read_again_and_written_again(wrong, good):
    wrong_for, written = iter(range(wrong)), []

    def read(own, register):
        return own(register) ^ (register is Register.IDLE_WORD and next(wrong_for, None) is not None)

    def write(own, address, value, **state):
        written.append(address)
        return own(address, value, **state)

    clock = VirtualClock()
    link = DamagingLink(clock, fpga_with(write, read))
    if good:
        Session(link, BOARD, BUILD, clock.now_s)
    else:
        with pytest.raises(LinkError, match="did not keep the value of IDLE_WORD") as caught:
            Session(link, BOARD, BUILD, clock.now_s)
        assert not isinstance(caught.value, IncompatibleFpga)
    assert written.count(Register.IDLE_WORD) == 1 + min(wrong // 2, ATTEMPTS - 1)


@pytest.mark.parametrize(("wrong", "good"), [(1, True), (2, False)])
def test_another_identity_is_read_twice_before_the_fpga_is_refused_for_it(wrong, good):
    wrong_for = iter(range(wrong))

    def read(own, register):
        return own(register) ^ (register is Register.BUILD_HASH and next(wrong_for, None) is not None)

    clock = VirtualClock()
    link = DamagingLink(clock, fpga_with(read=read))
    if good:
        Session(link, BOARD, BUILD, clock.now_s)
    else:
        with pytest.raises(IncompatibleFpga, match="BUILD_HASH"):
            Session(link, BOARD, BUILD, clock.now_s)


def examine(link, clock):
    """What `gateware check` and `doctor --link` do, with random bits that are few: their damage is a result and no failure."""
    session = Session(link, BOARD, BUILD, clock.now_s)
    registers = bring_up.identify(session)
    words = np.random.default_rng(7).bytes(4 * BOARD.waveform.samples)
    session.upload(0, memoryview(words))
    kept = bring_up.read_slot(session, 0, 16)
    list(bring_up.channel_self_test(session, BOARD, clock, bring_up.Chirps([3])))
    return registers["identity"], kept == words[:64]


@each_row("damage", DAMAGES)
def test_a_damage_at_one_frame_of_an_examination_is_no_failure_of_the_board(damage):
    frames = frames_of(examine)
    for number in range(0, frames, 5):
        clock = VirtualClock()
        assert examine(DamagingLink(clock, None, damage, {number}), clock) == (IDENTITY_MAGIC, True), f"frame {number}"


@each_row("damage", DAMAGES)
def test_bit_errors_are_counted_where_the_message_that_asks_for_the_count_was_damaged_first(damage):
    clock = VirtualClock()
    session = Session(link := DamagingLink(clock), BOARD, BUILD, clock.now_s)
    link.damage, link.numbers = damage, {link.frames}
    found = bit_errors(session, 1, np.random.default_rng(1))
    assert (found.frames_refused, found.answers_damaged, found.wrong_bits) == (0, 0, 0)
