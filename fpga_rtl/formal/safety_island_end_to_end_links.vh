// What induction must know of the inside: each count of the pins beside the register that stands for it. Only a help, proven with
// the promises: a link that does not hold leaves them unproven.
(* hierconn *) wire [31:0] \output_gate.unfed_q , \output_gate.fed_ticks_q ;
(* hierconn *) wire [4:0]  \output_gate.limits_1_q ;
(* hierconn *) wire [2:0]  \output_gate.on_later_q ;
(* hierconn *) wire        \output_gate.fed_q , \output_gate.live_q ;
(* hierconn *) wire [$clog2(HV_SETTLE_TICKS+32'd2)-1:0] \output_gate.up_q ;
(* hierconn *) wire [(ALIVE_HALF_TICKS > 32'd1 ? $clog2(ALIVE_HALF_TICKS) : 1)-1:0] \output_gate.alive_left_q ;
(* hierconn *) wire [31:0] \stage_limits.pins_q , \stage_limits.change_q , \stage_limits.recent_q ;
(* hierconn *) wire        \stage_limits.moved_q , \stage_limits.soon_q ;
(* hierconn *) wire [15:0] \stage_limits.since_q ;
(* hierconn *) wire [EMISSION_BITS-1:0] \stage_limits.age ;
(* hierconn *) wire [DUTY_BITS+16:0]    \stage_limits.level_q ;
(* hierconn *) wire [31:0] \stage_limits.channel_i ;
(* hierconn *) wire [EDGE_BITS-1:0]  \stage_limits.channel_edges_i ;
(* hierconn *) wire [TOTAL_BITS-1:0] \stage_limits.total_edges_i ;
wire [15:0] since_own = \stage_limits.since_q ;

reg [17:0] since_1_g;
reg [15:0] least_1_g;
reg        edge_1_g;
always @(posedge clk_i) begin
    since_1_g <= rst_i ? LONG_AGO : since_g;
    least_1_g <= rst_i ? PULSE_TICKS_MIN[15:0] : pulse_least_g;
    edge_1_g  <= !rst_i && edge_one;
end

always @* if (started_q && !clock_lost_i) begin
    // pins and settings
    permits_are_linked: assert (run_permit_q == {permit_2_g, permit_1_g} && temperature_ok_q == {cool_2_g, cool_1_g});
    armer_is_linked:    assert (link_q == armer_g);
    wishes_are_linked:  assert (heartbeat_ticks_q == patience_g && emission_ticks_q == emission_most_g && duty_share_q == share_g
                                && duty_ticks_q == duty_most_g && pulse_ticks_q == pulse_least_g
                                && channel_edges_q == edges_most_g && total_edges_q == total_most_g);
    // the gate
    if (\output_gate.fed_q ) silence_is_linked: assert (quiet_g == \output_gate.unfed_q && quiet_most_g == \output_gate.fed_ticks_q );
    if (\output_gate.live_q ) allowed_is_linked: assert (allowed_g);
    assert ((off_g[2:0] & \output_gate.on_later_q ) == 3'd0 && !(off_g[3] && hv_enable_o));
    if (run_g != 5'd0) assert (up_g == \output_gate.up_q );
    if (since_reset && hv_enable_o) beat_is_linked: assert (beat_g == ALIVE_HALF_TICKS ? \output_gate.alive_left_q == ALIVE_HALF_TICKS - 32'd1
                                     : beat_g < ALIVE_HALF_TICKS && beat_g + \output_gate.alive_left_q == ALIVE_HALF_TICKS - 32'd1);
    if (since_reset && hv_enable_o) assert ((beat_g == 32'd0) == !hv_1_g);
    // the limits
    assert (channel_1_g == \stage_limits.pins_q );
    assert (edge_1_g == \stage_limits.change_q [one] && \stage_limits.moved_q == (\stage_limits.change_q != 32'd0));
    edges_are_of_the_pins: assert (\stage_limits.channel_i == channel_o && \stage_limits.channel_edges_i == edges_most_g
                                   && \stage_limits.total_edges_i == total_most_g);
    soon_is_linked:     assert (\stage_limits.soon_q == (since_own < least_1_g) && since_own != 16'd0);
    assert (since_1_g <= LONG_AGO && {2'b00, since_own} <= since_1_g && since_g <= LONG_AGO);
    pulses_are_linked:  assert (\stage_limits.recent_q [one] || since_1_g == LONG_AGO || since_1_g >= {2'b00, since_own} + {2'b00, least_1_g});
    if (since_g != LONG_AGO) assert (edge_1_g || since_1_g == LONG_AGO || since_g == since_1_g + 18'd1);
    if (short_g[0])     assert (edge_1_g && since_1_g < {2'b00, least_1_g});
    if (playing_i)      emissions_are_linked: assert (sounds_g <= \stage_limits.age || \stage_limits.age >= emission_most_g);
    assert (!owed_g[DUTY_WIDTH-1] && owed_g <= MOST_OWED);
    duty_is_linked:     assert (owed_g <= $signed({1'b0, \stage_limits.level_q }));
    if (short_g[1])     assert (limits[0]);
    if (late_g[0])      assert (limits[3]);
    if (much_g[0])      assert (limits[4]);
    assert ((!short_g[2] || \output_gate.limits_1_q [0]) && (!late_g[1] || \output_gate.limits_1_q [3]) && (!much_g[1] || \output_gate.limits_1_q [4]));
end
