// What register_file promises, whatever the host writes: settings within the board's limits, changed by what is accepted and at rest
// only; commands only where they are written; ARM only behind the key of the same link.
// What is kept here beside the module is `_g`; inputs and registers of clocks before are `_1_q` and `_2_q`.
localparam ALL_BITS = 32 + 32 + 32 + 18 + 32 + 16 + 24 + 29 + 32 + 17 + 32;

reg        started_q = 0;
reg        rst_1_q;
reg [2:0]  rested_g;                     // clocks for which address, words and link have rested, 7 at most
reg [2:0]  pause_g;                      // clocks since a frame was accepted, 7 at most
reg [1:0]  key_g;                        // of each link, the last frame was an UNLOCK with the right words, and accepted
reg        write_1_q, good_1_q, off_1_q, quiet_1_q, uart_1_q, accept_1_q;
reg [15:0] address_1_q;
reg [127:0] words_1_q;
reg [ALL_BITS-1:0] settings_1_q;
wire [ALL_BITS-1:0] settings = {idle_word_o, channel_mask_o, bit_period_o, ramp_samples_o, heartbeat_ticks_o, pulse_ticks_o,
                                channel_edges_o, total_edges_o, emission_ticks_o, duty_share_o, duty_ticks_o};
wire       writes_control = write_i && address_i == `REGISTER_CONTROL;
wire       key = word0 == `CONTROL_UNLOCK && word1 == `IDENTITY_MAGIC && word2 == `PROTOCOL_VERSION && word3 == BUILD_HASH;

// The contract: frames come one at a time, and what they ask rests before they are accepted
initial assume (rst_i);
always @* begin
    judged_always: assume (judge_i);                                                // frame_select: always, where it is synthesised
    reads_or_writes: assume (!(read_i && write_i) && (accept_i || !(read_i || write_i)));
    fault_is_a_cause: assume (faulted_i == (fault_i != 16'd0));                        // output_gate: any_is_known
    if (started_q && accept_i) frame_has_rested: assume (pause_g == 3'd7 && rested_g >= 3'd3 && words_i == words_1_q && address_i == address_1_q && uart_i == uart_1_q);
end

always @(posedge clk_i) begin
    started_q    <= 1;
    rst_1_q      <= rst_i;
    rested_g     <= rst_i || words_i != words_1_q || address_i != address_1_q || uart_i != uart_1_q ? 3'd0 : rested_g == 3'd7 ? 3'd7 : rested_g + 3'd1;
    pause_g      <= rst_i || accept_i ? 3'd0 : pause_g == 3'd7 ? 3'd7 : pause_g + 3'd1;
    if (refused_i[0]) key_g[0] <= 0;
    if (refused_i[1]) key_g[1] <= 0;
    if (accept_i) key_g[uart_i] <= writes_control && key;
    if (rst_i) key_g <= 2'b00;
    accept_1_q   <= accept_i && !rst_i;
    write_1_q    <= write_i && !rst_i;
    good_1_q     <= write_result_o == `RESULT_OK;
    off_1_q      <= off_i;
    quiet_1_q    <= quiet_i;
    uart_1_q     <= uart_i;
    address_1_q  <= address_i;
    words_1_q    <= words_i;
    settings_1_q <= settings;
end

always @* if (started_q && !rst_1_q) begin
    // never looser than the board's, and such as the player and the ramp need
    mask_is_of_stages:       assert ((channel_mask_o & ~CHANNEL_MASK_MAX) == 0);
    bit_period_is_in_range:  assert (bit_period_o >= BIT_PERIOD_LOW && bit_period_o <= BIT_PERIOD_HIGH);
    pulse_is_in_range:       assert (pulse_ticks_o >= PULSE_TICKS_MIN && pulse_ticks_o <= bit_period_o[31:16]);
    ramp_is_in_range:        assert (ramp_samples_o != 0);
    heartbeat_is_in_range:   assert (heartbeat_ticks_o != 0 && heartbeat_ticks_o <= HEARTBEAT_TICKS_MAX);
    edges_are_in_range:      assert (channel_edges_o <= CHANNEL_EDGES_MAX && total_edges_o <= TOTAL_EDGES_MAX);
    emission_is_in_range:    assert (emission_ticks_o <= EMISSION_TICKS_MAX);
    duty_is_in_range:        assert (duty_share_o <= DUTY_SHARE_MAX && duty_ticks_o <= DUTY_TICKS_MAX);
    // changed by what is accepted, once, and only at rest
    if (!write_1_q || !good_1_q) refused_write_changes_nothing: assert (settings == settings_1_q);
    if (settings != settings_1_q && !off_1_q) settings_rest: assert (quiet_1_q && address_1_q == `REGISTER_BIT_PERIOD);
    if (write_1_q && good_1_q) case (address_1_q)
        `REGISTER_IDLE_WORD:       idle_is_written:      assert (idle_word_o == words_1_q[31:0]);
        `REGISTER_CHANNEL_MASK:    mask_is_written:      assert (channel_mask_o == words_1_q[31:0]);
        `REGISTER_BIT_PERIOD:      bit_is_written:       assert (bit_period_o == words_1_q[31:0]);
        `REGISTER_RAMP_SAMPLES:    ramp_is_written:      assert (ramp_samples_o == words_1_q[31:0]);
        `REGISTER_HEARTBEAT_TICKS: heartbeat_is_written: assert (heartbeat_ticks_o == words_1_q[31:0]);
        `REGISTER_PULSE_TICKS:     pulse_is_written:     assert (pulse_ticks_o == words_1_q[31:0]);
        `REGISTER_CHANNEL_EDGES:   edges_are_written:    assert (channel_edges_o == words_1_q[31:0]);
        `REGISTER_TOTAL_EDGES:     total_is_written:     assert (total_edges_o == words_1_q[31:0]);
        `REGISTER_EMISSION_TICKS:  emission_is_written:  assert (emission_ticks_o == words_1_q[31:0]);
        `REGISTER_DUTY_SHARE:      share_is_written:     assert (duty_share_o == words_1_q[31:0]);
        `REGISTER_DUTY_TICKS:      duty_is_written:      assert (duty_ticks_o == words_1_q[31:0]);
        default:                   nothing_else_is:      assert (settings == settings_1_q);
    endcase
    // commands
    if (arm_o)     arm_needs_the_key:   assert (writes_control && word0 == `CONTROL_ARM && key_g[uart_i] && off_i && !faulted_i && permitted_i);
    if (disarm_o)  disarm_is_written:   assert (writes_control && word0 == `CONTROL_DISARM);
    if (clear_o)   clear_is_written:    assert (writes_control && word0 == `CONTROL_CLEAR);
    if (stop_o)    stop_is_written:     assert (writes_control && word0 == `CONTROL_STOP);
    if (trigger_o) trigger_is_written:  assert (writes_control && word0 == `CONTROL_TRIGGER);
    if (writes_control && word0 == `CONTROL_DISARM) disarm_is_done: assert (disarm_o);
    if (writes_control && word0 == `CONTROL_STOP)   stop_is_done:   assert (stop_o);
    if (writes_control && write_result_o != `RESULT_OK) refused_command_is_none: assert (!arm_o && !disarm_o && !clear_o && !stop_o && !trigger_o);
    // what is read is what counts
    if (read_i && read_result_o == `RESULT_OK) case (address_i)
        `REGISTER_BIT_PERIOD:      bit_is_read:          assert (data_o == bit_period_o);
        `REGISTER_PULSE_TICKS:     pulse_is_read:        assert (data_o == pulse_ticks_o);
        `REGISTER_HEARTBEAT_TICKS: heartbeat_is_read:    assert (data_o == heartbeat_ticks_o);
        `REGISTER_CHANNEL_MASK:    mask_is_read:         assert (data_o == channel_mask_o);
        `REGISTER_FAULT:           fault_is_read:        assert (data_o == fault_i);
        default: ;
    endcase
end

// What induction must know of the inside
always @* if (started_q && !rst_1_q) begin
    key_is_known: assert (unlocked_q == key_g);
    assert ((written_q[2] ? kept[2] : BIT_PERIOD_RESET) == bit_period_q && (written_q[1] ? kept[1] : CHANNEL_MASK_MAX) == channel_mask_q);
    assert ((written_q[4] ? kept[4] : HEARTBEAT_TICKS_MAX) == heartbeat_ticks_q && (written_q[5] ? kept[5] : PULSE_TICKS_MIN) == pulse_ticks_q);
end
