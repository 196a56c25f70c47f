// Clocks in which nothing but counters moves are not computed: wrapper.cpp asks here how many follow, and then adds them to the counters
// at once. Bound into haptic_core in the compiled library alone.
// The panel rests where every register but the counters keeps its value with the next clock, its pins as they are. A rest ends with the
// clock in which a counter makes anything happen. Only registers are looked at here, and what follows from registers that rest: what
// follows from a counter is old until the next eval(). Left as it is: ahead_q of the UART's frame_decoder, which nobody reads.
// A register that is added to the Verilog is looked at here too, or it must not move in a rest: tests/conformance runs with leaps.
`default_nettype none
`include "registers.vh"

`define spi         spi_link.spi_peripheral
`define receiver    uart.uart_link.uart_peripheral.uart_receiver
`define transmitter uart.uart_link.uart_peripheral.uart_transmitter
`define cobs(WAY)   uart.uart_link.uart_peripheral.cobs_``WAY
`define player      waveform_player
`define gate        safety_island.output_gate
`define limits      safety_island.stage_limits

/* verilator lint_off WIDTH */         // a counter is as wide as its limit needs: each difference is asked for before it is taken
module leap #(
    parameter [31:0] PULSE_TICKS_MIN = 32'd0, CHANNEL_EDGES_MAX = 32'd0
) (
    input wire trigger_i, run_permit_i, temperature_ok_i, uart_rx_i, spi_cs_n_i
);
    export "DPI-C" function rest;
    export "DPI-C" function pass;

    typedef longint unsigned ticks_t;
    localparam ticks_t ALWAYS = 64'hFFFFFFFF;

    // Edges as in stage_limits.v
    localparam LOW_BITS     = $clog2((PULSE_TICKS_MIN == 32'd0 ? 32'd31 : 32'd31 / PULSE_TICKS_MIN) + 32'd6);
    localparam ACCOUNT_BITS = $clog2(CHANNEL_EDGES_MAX + 32'd64) + 1;
    typedef bit [LOW_BITS-1:0]     low_t;
    typedef bit [ACCOUNT_BITS-1:0] account_t;
    wire [31:0] low_bits [0:LOW_BITS-1];
    generate
        for (genvar k = 0; k < LOW_BITS; k = k + 1) assign low_bits[k] = `limits.low_bit[k].count_q;
    endgenerate

    // Whether each part would do nothing but count with the next clock

    function automatic bit pins_rest();
        return trigger_input.trigger_q == {4{trigger_i}} && trigger_input.triggered_q == trigger_i && !trigger_input.command_q
            && safety_island.run_permit_q == {2{run_permit_i}} && safety_island.temperature_ok_q == {2{temperature_ok_i}}
            && tick_counter.permits_q == {temperature_ok_i, run_permit_i};
    endfunction

    function automatic bit spi_rests();
        return {`spi.cs_n_meta_q, `spi.cs_n_q, `spi.idle_q, `spi.sck_reset_q, !spi_link.busy_q} == {6{spi_cs_n_i}}
            && (`spi.idle_q || `spi.count_sync_q == `spi.odd_q)
            && {`spi.byte_valid_q, `spi.release_q, `spi.take_first_q, `spi.take_second_q, `spi.take_next_q} == 5'd0
            && {spi_link.frame_decoder.word_valid_q, spi_link.frame_decoder.accept_q, spi_link.frame_decoder.refuse_q} == 3'd0
            && !spi_encoder.selected_q && !spi_reply.refused_q;
    endfunction

    function automatic bit uart_rests();
        return `receiver.rx_q == {2{uart_rx_i}} && (`receiver.busy_q || `receiver.high_q == uart_rx_i) && !`receiver.valid_q
            && {`cobs(decoder).select_q, `cobs(decoder).release_q, `cobs(decoder).byte_valid_q, `cobs(encoder).taking_q} == 4'd0
            && `cobs(encoder).sending_q == `cobs(encoder).valid_q
            && (`transmitter.left_q != 4'd0 || (!`cobs(encoder).valid_q && `transmitter.shift_q == 10'h3FF))
            && {uart.uart_link.frame_decoder.word_valid_q, uart.uart_link.frame_decoder.accept_q, uart.uart_link.frame_decoder.refuse_q} == 3'd0
            && {uart.uart_link.frame_relay.full_q, uart.uart_link.frame_relay.turn_q, uart.uart_link.frame_relay.refuse_q} == 3'd0
            && !uart.uart_encoder.selected_q && !uart.uart_reply.refused_q;
    endfunction

    function automatic bit frames_rest();
        return {frame_select.chosen_q, frame_select.taken_q, frame_select.returned_q, frame_select.lengths_q, frame_result.done_q} == 7'd0
            && !register_file.link_counters.fetched_q && register_file.link_counters.due_q == 4'd0
            && !play_check.open_q && play_check.step_q == 6'd63 && !play_check.taken_q;
    endfunction

    function automatic bit buffers_rest();
        return {waveform_buffer.check_q, waveform_buffer.fetched_q, waveform_buffer.played_q, waveform_buffer.writes_q} == 4'd0
            && !waveform_buffer.read_memory && waveform_buffer.settled_q == 3'd0
            && (frame_select.kind_q != `TYPE_STORE || looks_in_vain());
    endfunction

    function automatic bit looks_in_vain();   // for the chunks of a STORE that has taken them
        return waveform_buffer.left_q == left_at(waveform_buffer.look_q) && waveform_buffer.whole_q == (waveform_buffer.look_q == 3'd0)
            && waveform_buffer.chunks_q == 8'd0 && !waveform_buffer.complete_q && waveform_buffer.word0_i[9:0] != 10'd0;
    endfunction

    function automatic bit [9:0] left_at(bit [2:0] chunk);
        return waveform_buffer.word0_i[9:0] > 10'd125 * chunk ? waveform_buffer.word0_i[9:0] - 10'd125 * chunk : 10'd0;
    endfunction

    function automatic bit queue_rests();
        return {play_queue.fetch_q, play_queue.fetched_q, play_queue.moved_q} == 3'd0 && play_queue.index_later_q == play_queue.index_q
            && play_queue.valid_q == (play_queue.count_q != 4'd0);
    endfunction

    function automatic bit player_rests();
        return !`player.trigger_i && !`player.wants && !`player.due_q && !`player.missed_q
            && !(`player.elapsed_over_q && (`player.delayed_q || `player.repeating_q))
            && {`player.hold_over_q, `player.read_q, `player.underrun_q, `player.ended_q} == 7'd0
            && !(`player.playing_q && `player.live_q && `player.missing_i)
            && `player.playing_later_q == `player.playing_q && `player.ramping_later_q == {2{`player.ramping_i}}
            && (`player.resting_q || !`player.ramping_i)
            && `player.plays_q == (`player.playing_q && !`player.ramping_i ? `player.mask_q : 32'd0)
            && `player.drive_q == ((`player.plays_q & (`player.read_data_i ^ {32{`player.polarity_q}}))
                                   | (~`player.plays_q & `player.idle_word_i & {32{`player.ramp_bit_i || !`player.ramping_i}}));
    endfunction

    function automatic bit ramp_rests();
        return idle_ramp.active_q == idle_ramp.active && idle_ramp.step_q == 3'd0 && !idle_ramp.last_q
            && idle_ramp.base_q == idle_ramp.twice - idle_ramp.older
            && idle_ramp.top_q == (idle_ramp.level_q == idle_ramp.samples_i) && idle_ramp.bottom_q == (idle_ramp.level_q == 18'd0)
            && (idle_ramp.active || idle_ramp.stay_i
                || (idle_ramp.bottom_q && idle_ramp.tick_q == 16'd2
                    && idle_ramp.recent_q == idle_ramp.no_error && idle_ramp.older_q == idle_ramp.no_error));
    endfunction

    function automatic bit gate_rests();
        return !`gate.shut && `gate.exists && !(`gate.stopping_o && `gate.settled_i)
            && `gate.on_later_q == {3{`gate.on && `gate.stays}} && `gate.moves_later_q == {3{`gate.moves && `gate.stays}}
            && `gate.live_q == (`gate.on && `gate.stays)
            && `gate.hv_enable_q == `gate.open && `gate.focus_q == (`gate.focus_left_q != 16'd0)
            && `gate.channel_q == (`gate.open && `gate.moves_later_q[2] ? `gate.drive_i & `gate.channel_mask_i : 32'd0)
            && indicator_pins.waiting_q == indicator_pins.waiting_i && indicator_pins.fault_q == indicator_pins.fault_i;
    endfunction

    function automatic bit limits_rest();
        return `limits.pins_q == `gate.channel_q && !`limits.moved_q
            && `limits.stay_q <= 6'd33 && (`limits.stay_q != 6'd0 || !`limits.new_q)  // turns on their way have seen the last change
            && {`limits.last_round_q, `limits.fetched_last_q, `limits.made_last_q, `limits.first_round_q, `limits.fetched_first_q} == 5'd0
            && {`limits.cause_o, `limits.moves_q, `limits.begun_q, `limits.first_moves_q, `limits.begins_q} == 14'd0;
    endfunction

    // Clocks before the one in which a counter makes anything happen

    function automatic ticks_t least(ticks_t one, ticks_t other);
        return one < other ? one : other;
    endfunction

    function automatic ticks_t links_wait();
        ticks_t most = ALWAYS;
        if (`spi.count_sync_q != `spi.count_meta_q)      most = 1;  // a byte is on its way through the flip-flops from SCK
        else if (`spi.count_meta_q != `spi.count_q[3])   most = 2;
        if (`receiver.busy_q)            most = least(most, `receiver.timer_q >> 8);
        if (`transmitter.left_q != 4'd0) most = least(most, `transmitter.timer_q >> 8);
        return most;
    endfunction

    function automatic bit holds();           // hold_q counts
        return `player.playing_q || (`player.resting_q && !`player.ramping_i);
    endfunction

    function automatic ticks_t player_waits();
        ticks_t most = ALWAYS;
        if (holds()) most = `player.bit_period_i[31:16] - `player.hold_q;
        if (`player.delayed_q || `player.repeating_q)
            most = least(most, 32'((`player.delayed_q ? `player.delay_q : `player.period_q) - `player.elapsed_q));
        if (`player.head_scheduled_i)
            most = least(most, `player.head_when_i < `player.ahead_q ? 64'd0 : `player.head_when_i - `player.ahead_q);
        if (idle_ramp.active) most = least(most, idle_ramp.tick_q == 16'd2 ? 16'd0 : idle_ramp.bit_ticks_i - idle_ramp.tick_q);
        return most;
    endfunction

    function automatic ticks_t gate_waits();
        ticks_t most = ALWAYS;
        if (!`gate.silent_q)              most = `gate.silence_q == 32'd0 ? 32'd0 : `gate.silence_q - 32'd1;
        if (`gate.resting_q)              most = least(most, `gate.rest_left_q - 32'd1);
        if (`gate.settling)               most = least(most, `gate.settle_left_q);
        if (`gate.focus_left_q != 16'd0)  most = least(most, `gate.focus_left_q);
        if (`gate.hv_enable_q)            most = least(most, `gate.alive_left_q);
        return most;
    endfunction

    function automatic ticks_t inflow();      // into the bucket, in 65536ths of a tick
        return 64'd65536 - `limits.duty_share_i;
    endfunction

    function automatic ticks_t limits_wait();
        ticks_t most = ticks_t'(`limits.LAST_ROUND - `limits.round_q) * 32 - `limits.turn_q;
        ticks_t room = ticks_t'(`limits.duty_ticks_i) << 16;
        if (`limits.part_begins) return 64'd0;
        if (`limits.stay_q != 6'd0) most = least(most, turns_wait());
        if (`player.playing_q) most = least(most, `limits.emission_ticks_i - `limits.age_q);
        if (!`limits.active_i) return most;
        if (room < `limits.level_q) return 64'd0;
        room = room - `limits.level_q;
        return room >= most * inflow() ? most : room / inflow();
    endfunction

    // The turn of a channel: what its account will be, and how many clocks none has too many edges
    function automatic low_t low(bit [4:0] turn);
        for (int k = 0; k < LOW_BITS; k = k + 1) low[k] = low_bits[k][turn];
    endfunction

    function automatic account_t made(bit [4:0] turn);
        account_t account = `limits.accounts[turn];
        bit       wraps   = low(turn) < account[LOW_BITS-1:0];
        return {account[ACCOUNT_BITS-1:LOW_BITS] + wraps, low(turn)};
    endfunction

    function automatic account_t base(bit [4:0] turn);
        return `limits.parts_full_q ? `limits.made_by[{`limits.part_q, turn}] : 0;
    endfunction

    function automatic ticks_t turns_wait();
        for (bit [5:0] clock = 6'd0; clock <= `limits.stay_q; clock = clock + 6'd1) begin
            bit [4:0] turn  = `limits.turn_q + clock[4:0] - 5'd2;
            account_t edges = made(turn) - base(turn);
            if (made(turn) != `limits.accounts[turn] && edges > `limits.channel_edges_i) return clock;
        end
        return ALWAYS;
    endfunction

    // Clocks of the rest that begins with the next one; 0: none
    function automatic int unsigned rest();
        if (!spi_rests() || !limits_rest() || !frames_rest() || !player_rests()) return 0;
        if (!pins_rest() || !uart_rests() || !buffers_rest() || !queue_rests() || !ramp_rests() || !gate_rests()) return 0;
        return least(least(limits_wait(), gate_waits()), least(player_waits(), links_wait()));
    endfunction

    // Let so many of them pass. All that counts is written here, in no function of its own: else Verilator misses that what follows
    // from it is old.
    function automatic void pass(int unsigned clocks);
        ticks_t   behind, since, round_turn;
        bit [5:0] awake;
        bit [4:0] turn;

        tick_counter.now_q = tick_counter.now_q + clocks;
        `player.ahead_q    = `player.ahead_q + clocks;
        `player.before_q   = `player.before_q + clocks;
        if (holds())                                  `player.hold_q = `player.hold_q + clocks;
        if (`player.delayed_q || `player.repeating_q) `player.elapsed_q = `player.elapsed_q + clocks;
        if (idle_ramp.active)                         idle_ramp.tick_q = idle_ramp.tick_q + clocks;

        if (!`gate.silent_q)             `gate.silence_q = `gate.silence_q - clocks;
        if (`gate.resting_q)             `gate.rest_left_q = `gate.rest_left_q - clocks;
        if (`gate.settling)              `gate.settle_left_q = `gate.settle_left_q - clocks;
        if (`gate.focus_left_q != 16'd0) `gate.focus_left_q = `gate.focus_left_q - clocks;
        if (`gate.hv_enable_q)           `gate.alive_left_q = `gate.alive_left_q - clocks;

        // limits: turns that have anything to do, two of which are on their way at each time; time; the bucket
        awake = least(clocks, `limits.stay_q);
        for (bit [5:0] clock = 6'd0; clock < awake; clock = clock + 6'd1) begin
            turn = `limits.turn_q + clock[4:0] - 5'd2;
            `limits.accounts[turn] = made(turn);
        end
        if (awake != 6'd0) begin
            turn = `limits.turn_q + awake[4:0] - 5'd1;
            `limits.fetched_q   = turn;
            `limits.low_1_q     = low(turn);
            `limits.account_q   = `limits.accounts[turn];
            `limits.oldest_q    = `limits.made_by[{`limits.part_q, turn}];
            turn = turn - 5'd1;
            `limits.made_turn_q = turn;
            `limits.made_one_q  = 32'd1 << turn;
            `limits.made_q      = made(turn);
            `limits.base_q      = base(turn);
            `limits.new_q       = clocks == awake && made(turn) != `limits.accounts[turn];
        end
        `limits.stay_q       = `limits.stay_q - awake;
        round_turn           = ticks_t'(`limits.turn_q) + clocks;
        `limits.turn_q       = round_turn[4:0];
        `limits.round_q      = `limits.round_q + (round_turn >> 5);
        `limits.last_round_q = `limits.round_q == `limits.LAST_ROUND;
        since                = least(ticks_t'(`limits.since_q) + clocks - 1, 64'hFFFF);  // as of the last clock
        `limits.soon_q       = since + 1 < `limits.pulse_ticks_i;
        `limits.since_q      = least(since + 1, 64'hFFFF);
        if (`player.playing_q) `limits.age_q = `limits.age_q + clocks;
        if (`limits.active_i)  `limits.level_q = `limits.level_q + clocks * inflow();
        else                   `limits.level_q = `limits.level_q - least(`limits.level_q, ticks_t'(clocks) * `limits.duty_share_i);

        for (int unsigned clock = 0; clock < 3 && clock < clocks; clock = clock + 1) begin  // flip-flops from SCK
            {`spi.count_sync_q, `spi.count_meta_q}                = {`spi.count_meta_q, `spi.count_q[3]};
            {`spi.begun_sync_q, `spi.begun_meta_q}                = {`spi.begun_meta_q, `spi.begun_q};
            {`spi.partial_q, `spi.part_sync_q, `spi.part_meta_q}  = {`spi.part_sync_q, `spi.part_meta_q, `spi.part_q};
        end
        if (`receiver.busy_q)            `receiver.timer_q = `receiver.timer_q - {clocks, 8'd0};
        if (`transmitter.left_q != 4'd0) `transmitter.timer_q = `transmitter.timer_q - {clocks, 8'd0};
        if (spi_link.frame_decoder.ahead_q[39:38] != 2'b10) begin
            behind = ((ticks_t'($signed(spi_link.frame_decoder.ahead_q)) + 64'h4000000000) >> 16) + 1;  // clocks until it stays so
            spi_link.frame_decoder.ahead_q = spi_link.frame_decoder.ahead_q - {least(behind, clocks), 16'd0};
        end
        if (frame_select.kind_q == `TYPE_STORE) begin
            waveform_buffer.look_q  = waveform_buffer.look_q + clocks;
            waveform_buffer.left_q  = left_at(waveform_buffer.look_q);
            waveform_buffer.whole_q = waveform_buffer.look_q == 3'd0;
        end
    endfunction
endmodule
/* verilator lint_on WIDTH */

bind haptic_core leap #(.PULSE_TICKS_MIN(PULSE_TICKS_MIN), .CHANNEL_EDGES_MAX(CHANNEL_EDGES_MAX)) leap (
    .trigger_i, .run_permit_i, .temperature_ok_i, .uart_rx_i, .spi_cs_n_i
);

`default_nettype wire
