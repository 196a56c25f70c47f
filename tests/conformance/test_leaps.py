"""Leaps over clocks in which only counters move (fpga_rtl/simulation/leap.sv): everything here goes with them, and this without."""

from functools import partial

import pytest
from pin_script import MODEL, assert_same
from random_script import SEEDS, random_script
from tables import each_row

from controller.device.fpga.status import DamagedStatus
from controller.workshop.gateware.rtl_build import clocked_design, core_design

QUICK_BUILD = "-O0"  # a clock takes three times as long
WRONG = {  # what stands in leap.sv, and what is put in its place
    "a drive word": ("bit_period_i[31:16] - `player.hold_q", "bit_period_i[31:16] - `player.hold_q + 1"),
    "a delay or period": ("`player.elapsed_q = `player.elapsed_q + clocks", "`player.elapsed_q = `player.elapsed_q + clocks - 1"),
    "hv_alive": ("most = least(most, `gate.alive_left_q)", "most = least(most, `gate.alive_left_q + 1)"),
    "the heartbeat": ("`gate.silence_q = `gate.silence_q - clocks", "`gate.silence_q = `gate.silence_q - clocks + 1"),
    "the time": ("tick_counter.now_q = tick_counter.now_q + clocks", "tick_counter.now_q = tick_counter.now_q + clocks + 1"),
    "the bucket": ("`limits.level_q = `limits.level_q + clocks * inflow()", "`limits.level_q = `limits.level_q + inflow()"),
    "the turns' time": ("`limits.turn_q       = round_turn[4:0]", "`limits.turn_q       = round_turn[4:0] + 5'd1"),
    "edges of a channel": ("edges > `limits.channel_edges_i) return clock;", "edges > `limits.channel_edges_i) return ALWAYS;"),
    "a byte of the UART": ("`receiver.timer_q = `receiver.timer_q - {clocks, 8'd0}", "`receiver.timer_q = `receiver.timer_q"),
    "a byte of the SPI": ("(`spi.idle_q || `spi.count_sync_q == `spi.odd_q)", "1'b1"),
    "the trigger": ("trigger_input.trigger_q == {4{trigger_i}} &&", ""),
}


def differs(rtl, seeds):
    for seed in seeds:
        script = random_script(seed)
        try:
            assert_same(script.perform(MODEL), script.perform(rtl))
        except (AssertionError, DamagedStatus):  # which names the answers that differ, or cannot
            return True
    return False


def test_without_leaps_all_is_the_same(rtl):
    assert not differs(partial(rtl, design=clocked_design()._replace(optimise=QUICK_BUILD)), SEEDS[::24])


@pytest.mark.slow
@each_row("counter", WRONG)
def test_a_leap_that_is_wrong_is_noticed(rtl, counter, tmp_path):
    design, (right, wrong) = core_design(), WRONG[counter]
    text = design.sources[1].read_text()
    assert text.count(right) == 1
    leap = tmp_path / "leap.sv"
    leap.write_text(text.replace(right, wrong))
    assert differs(partial(rtl, design=design._replace(sources=(design.sources[0], leap), optimise=QUICK_BUILD)), SEEDS)
