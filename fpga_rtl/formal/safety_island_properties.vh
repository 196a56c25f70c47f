// What safety_island promises whatever is asked for: no limit is ever looser than the board's, and none changes while anything is on.
reg        started_q = 0;
reg        rst_1_q, off_1_q;
reg [HEARTBEAT_BITS-1:0] heartbeat_1_q;
reg [EDGE_BITS-1:0]      edges_1_q;
reg [TOTAL_BITS-1:0]     total_1_q;
reg [EMISSION_BITS-1:0]  emission_1_q;
reg [DUTY_BITS-1:0]      duty_1_q;
reg [15:0]               pulse_1_q;
reg [16:0]               share_1_q;
reg                      link_1_q, arm_1_q;

`ifndef END_TO_END  // which has these two itself
initial assume (rst_i);
always @* clock_is_lost_in_reset: assume (!clock_lost_i || rst_i);
`endif

always @(posedge clk_i) begin
    started_q     <= 1;
    rst_1_q       <= rst_i;
    off_1_q       <= off_o;
    arm_1_q       <= arm;
    heartbeat_1_q <= heartbeat_ticks_q;
    edges_1_q     <= channel_edges_q;
    total_1_q     <= total_edges_q;
    emission_1_q  <= emission_ticks_q;
    duty_1_q      <= duty_ticks_q;
    pulse_1_q     <= pulse_ticks_q;
    share_1_q     <= duty_share_q;
    link_1_q      <= link_q;
end

always @* if (started_q) begin
    heartbeat_is_clamped: assert (heartbeat_ticks_q <= HEARTBEAT_TICKS_MAX);
    edges_are_clamped:    assert (channel_edges_q <= CHANNEL_EDGES_MAX && total_edges_q <= TOTAL_EDGES_MAX);
    pulse_is_clamped:     assert (pulse_ticks_q >= PULSE_TICKS_MIN);
    emission_is_clamped:  assert (emission_ticks_q <= EMISSION_TICKS_MAX);
    duty_is_clamped:      assert (duty_share_q <= DUTY_SHARE_MAX && duty_ticks_q <= DUTY_TICKS_MAX);
    no_stage_no_move:     assert ((channel_o & ~CHANNEL_MASK_MAX) == 32'd0);
    if (!rst_1_q && !off_1_q)
        limits_rest:      assert (heartbeat_ticks_q == heartbeat_1_q && channel_edges_q == edges_1_q && total_edges_q == total_1_q
                                  && emission_ticks_q == emission_1_q && duty_ticks_q == duty_1_q && pulse_ticks_q == pulse_1_q
                                  && duty_share_q == share_1_q && link_q == link_1_q);
    if (!rst_1_q && !arm_1_q)
        limits_of_edges_rest: assert (channel_edges_q == edges_1_q && total_edges_q == total_1_q);
    any_fault_is_known:   assert (faulted_o == (fault_o != 16'd0));
    if (heartbeat) one_link_feeds: assert (arm_i || (heard_i && link_i == link_q));
    if (arm)       arming_is_safe: assert (off_o && fault_o == 16'd0 && run_permit_o && temperature_ok_o);
end
