// What the island promises from pin to pin: only its ports and parameters are named here (tests/rtl/test_formal.py sees to it), so
// that no register inside can agree with a mistake of its own. Every count is the proof's, and begins at any clock (`mark`).
initial assume (rst_i);
always @* clock_is_lost_in_reset: assume (!clock_lost_i || rst_i);

(* anyconst *) reg [4:0] one;                 // any channel
(* anyseq *)   reg       mark;                // any clock: a window begins

wire any = channel_o != 32'd0 || hv_enable_o || hv_alive_o || focus_o;

// Pins and outputs of the clocks before
reg [4:0]  run_g = 5'd0;                      // clocks since reset, one bit each
reg        permit_1_g, permit_2_g, permit_3_g, cool_1_g, cool_2_g, cool_3_g, hv_1_g, alive_1_g, clear_1_g, faulted_1_g;
reg        rst_1_g = 1'b0;
reg [31:0] channel_1_g, drive_1_g, mask_1_g, fault_count_1_g;
reg [15:0] fault_1_g;
reg [3:0]  off_g;                             // it said that it was off, one bit a clock
always @(posedge clk_i) begin
    run_g       <= rst_i ? 5'd0 : {run_g[3:0], 1'b1};
    rst_1_g     <= rst_i;
    {permit_3_g, permit_2_g, permit_1_g} <= rst_i ? 3'd0 : {permit_2_g, permit_1_g, run_permit_i};
    {cool_3_g, cool_2_g, cool_1_g}       <= rst_i ? 3'd0 : {cool_2_g, cool_1_g, temperature_ok_i};
    hv_1_g      <= hv_enable_o;
    alive_1_g   <= hv_alive_o;
    clear_1_g   <= clear_i;
    faulted_1_g <= faulted_o;
    channel_1_g <= rst_i ? 32'd0 : channel_o;
    drive_1_g   <= drive_i;
    mask_1_g    <= channel_mask_i & CHANNEL_MASK_MAX;
    fault_1_g   <= fault_o;
    fault_count_1_g <= fault_count_o;
    off_g       <= rst_i ? 4'd0 : {off_g[2:0], off_o};
end
wire since_reset = run_g[0] && !rst_i;

// An ARM that counts, and what was asked for then: settings count up to the last clock in which it is off, those of edges with
// the ARM itself; more than the board bears counts as that
wire arms = arm_i && off_o && !faulted_o && permit_2_g && cool_2_g;
reg        armed_g, armer_g, armed_twice_g, other_link_g;
reg [31:0] patience_g, edges_most_g, total_most_g, emission_most_g, duty_most_g;
reg [16:0] share_g;
reg [15:0] pulse_least_g;
always @(posedge clk_i) begin
    if (off_o) begin
        patience_g      <= heartbeat_ticks_i > HEARTBEAT_TICKS_MAX ? HEARTBEAT_TICKS_MAX : heartbeat_ticks_i;
        emission_most_g <= emission_ticks_i > EMISSION_TICKS_MAX ? EMISSION_TICKS_MAX : emission_ticks_i;
        share_g         <= duty_share_i > DUTY_SHARE_MAX[16:0] ? DUTY_SHARE_MAX[16:0] : duty_share_i;
        duty_most_g     <= duty_ticks_i > DUTY_TICKS_MAX ? DUTY_TICKS_MAX : duty_ticks_i;
        pulse_least_g   <= pulse_ticks_i < PULSE_TICKS_MIN[15:0] ? PULSE_TICKS_MIN[15:0] : pulse_ticks_i;
    end
    if (arms) begin
        armer_g         <= link_i;
        armed_twice_g   <= armed_twice_g || armed_g;
        other_link_g    <= other_link_g || (armed_g && link_i != armer_g);
        edges_most_g    <= channel_edges_i > CHANNEL_EDGES_MAX ? CHANNEL_EDGES_MAX : channel_edges_i;
        total_most_g    <= total_edges_i > TOTAL_EDGES_MAX ? TOTAL_EDGES_MAX : total_edges_i;
        armed_g         <= 1'b1;
    end
    if (rst_i) begin
        {armed_g, armer_g, armed_twice_g, other_link_g} <= 4'd0;
        patience_g      <= HEARTBEAT_TICKS_MAX;
        emission_most_g <= EMISSION_TICKS_MAX;
        share_g         <= DUTY_SHARE_MAX[16:0];
        duty_most_g     <= DUTY_TICKS_MAX;
        pulse_least_g   <= PULSE_TICKS_MIN[15:0];
        edges_most_g    <= CHANNEL_EDGES_MAX;
        total_most_g    <= TOTAL_EDGES_MAX;
    end
end

// The host: clocks since a frame of the link that armed last, and what it asked for then; whether it may be on at all
reg [31:0] quiet_g, quiet_most_g;
reg        allowed_g;                         // armed since a permit was away or a fault was shown
wire feeds = arms || (heard_i && !off_o && link_i == armer_g);
always @(posedge clk_i) begin
    quiet_g      <= feeds ? 32'd1 : quiet_g == 32'hFFFFFFFF ? quiet_g : quiet_g + 32'd1;
    if (feeds) quiet_most_g <= patience_g;
    allowed_g    <= arms || (allowed_g && permit_2_g && cool_2_g && !faulted_o);
    if (rst_i) begin
        quiet_g      <= 32'hFFFFFFFF;
        quiet_most_g <= 32'd0;
        allowed_g    <= 1'b0;
    end
end

// Pulses of one channel, while what is asked for rests: clocks between two of its changes, and since one came too early
localparam [17:0] LONG_AGO = 18'h20000;
reg [17:0] since_g;
reg [2:0]  short_g;
wire [15:0] pulse_least = pulse_ticks_i < PULSE_TICKS_MIN[15:0] ? PULSE_TICKS_MIN[15:0] : pulse_ticks_i;
wire       edge_one = channel_o[one] != channel_1_g[one];
wire       too_soon = edge_one && since_g < {2'b00, pulse_least_g};
always @(posedge clk_i) begin
    since_g <= off_o && pulse_least != pulse_least_g ? LONG_AGO : edge_one ? 18'd1 : since_g == LONG_AGO ? since_g : since_g + 18'd1;
    short_g <= {short_g[1:0], too_soon};
    if (rst_i) begin
        since_g <= LONG_AGO;
        short_g <= 3'd0;
    end
end

// Emissions and duty: what is on for longer than was asked for, or for more than its share from any clock on, up to what is too much
localparam DUTY_WIDTH = $clog2(DUTY_TICKS_MAX + 32'd4) + 18;
localparam signed [DUTY_WIDTH-1:0] MOST_OWED = (DUTY_TICKS_MAX + 32'd2) << 16;
localparam SOUNDS_WIDTH = $clog2(EMISSION_TICKS_MAX + 32'd2) + 1;
wire       active = playing_i || ramp_up_o || ramp_down_o;
reg [SOUNDS_WIDTH-1:0]      sounds_g;
reg signed [DUTY_WIDTH-1:0] owed_g;
reg [1:0]  late_g, much_g;
wire signed [DUTY_WIDTH-1:0] flow_g   = $signed({1'b0, active, 16'd0}) - $signed({1'b0, share_g});
wire signed [DUTY_WIDTH-1:0] owed     = owed_g + flow_g;
wire signed [DUTY_WIDTH-1:0] duty_may = $signed({1'b0, duty_most_g, 16'd0});
always @(posedge clk_i) begin
    sounds_g <= start_i || !playing_i || off_o ? {SOUNDS_WIDTH{1'b0}} : &sounds_g ? sounds_g : sounds_g + 1'b1;
    late_g   <= {late_g[0], playing_i && sounds_g >= emission_most_g};
    owed_g   <= mark || owed[DUTY_WIDTH-1] ? {DUTY_WIDTH{1'b0}} : owed > MOST_OWED ? MOST_OWED : owed;
    much_g   <= {much_g[0], active && owed_g > duty_may};
    if (rst_i) begin
        sounds_g <= {SOUNDS_WIDTH{1'b0}};
        owed_g   <= {DUTY_WIDTH{1'b0}};
        late_g   <= 2'd0;
        much_g   <= 2'd0;
    end
end

// Signs of life, and the supply's time to settle
reg [31:0] beat_g, up_g;
always @(posedge clk_i) begin
    beat_g <= rst_i || !hv_enable_o ? 32'd0 : hv_alive_o != alive_1_g ? 32'd1 : beat_g + 32'd1;
    up_g   <= rst_i || !hv_enable_o ? 32'd0 : up_g == HV_SETTLE_TICKS ? up_g : up_g + 32'd1;
end

always @* if (clock_lost_i) no_clock_is_off: assert (!any);
always @* if (rst_1_g) reset_is_off: assert (!any);
always @* if (since_reset) begin
    // pins, by their clock
    permit_is_its_pin:    assert (run_permit_o == permit_2_g);
    heat_is_its_pin:      assert (temperature_ok_o == cool_2_g);
    if (!permit_3_g) permit_pin_is_off: assert (!any);
    if (!cool_3_g)   heat_pin_is_off:   assert (!any);
    // no channel without a stage, a wish and a word; none before the supply has settled
    only_what_may_move:   assert ((channel_o & ~(mask_1_g & drive_1_g)) == 32'd0);
    supply_comes_first:   assert (channel_o == 32'd0 || (hv_enable_o && up_g == HV_SETTLE_TICKS));
    // signs of life: high with the supply, a change every ALIVE_HALF_TICKS, no other
    if (!hv_enable_o) no_life_when_off: assert (!hv_alive_o && !focus_o);
    else if (!hv_1_g) life_begins:      assert (hv_alive_o);
    else              life_has_its_rate: assert ((hv_alive_o != alive_1_g) == (beat_g == ALIVE_HALF_TICKS));
    // the host
    if (any)         on_while_allowed:  assert (allowed_g);
    if (any)         only_the_armer_feeds: assert ({1'b0, quiet_g} <= {1'b0, quiet_most_g} + 33'd1 || quiet_g <= 32'd2);
    // faults
    if (any)         on_without_fault:  assert (!faulted_o && fault_o == 16'd0);
    if (!clear_1_g)  a_fault_is_kept:   assert ((fault_1_g & ~fault_o) == 16'd0);
    if (run_g[1] && hv_1_g && !permit_3_g) lost_permit_is_a_fault: assert (fault_o[`FAULT_NO_PERMIT]);
    if (run_g[1] && hv_1_g && !cool_3_g)   heat_is_a_fault: assert (fault_o[`FAULT_OVER_TEMPERATURE]);
    if (run_g[1])    each_fault_counts: assert (fault_count_o == fault_count_1_g + {31'd0, faulted_o && !faulted_1_g && !clear_1_g} || clear_1_g);
    if (off_g[3])    off_is_off:        assert (!any);
    // limits, as they were asked for: off so many clocks behind the pin or the emission
    if (short_g[2])  short_pulse_is_off: assert (!any);
    if (late_g[1])   long_emission_is_off: assert (!any);
    if (much_g[1])   much_duty_is_off:   assert (!any);
end

// None of them holds because it never applies: each is tried on moving channels, again after a fault, with less asked for
wire moved = channel_1_g != 32'd0;
always @* if (clock_lost_i && run_g[4]) clock_is_lost: cover (moved);
always @* if (since_reset) begin
    permit_is_lost_for_a_clock: cover (moved && !permit_3_g && permit_2_g && permit_1_g);
    heat_lasts_a_clock:         cover (moved && !cool_3_g && cool_2_g && cool_1_g);
    supply_settles:             cover (channel_o == CHANNEL_MASK_MAX && up_g == HV_SETTLE_TICKS);
    life_goes_on:               cover (hv_enable_o && hv_1_g && !hv_alive_o && alive_1_g);
    other_link_arms:            cover (other_link_g && moved && quiet_g == 32'd1 && quiet_most_g < HEARTBEAT_TICKS_MAX);
    other_link_is_silent:       cover (other_link_g && moved && !any && fault_o[`FAULT_HOST_SILENT]);
    second_fault:               cover (armed_twice_g && moved && fault_count_o == 32'd2);
    pulse_is_short:             cover (moved && short_g[2] && pulse_least_g > PULSE_TICKS_MIN);
    emission_is_long:           cover (moved && late_g[1] && emission_most_g < EMISSION_TICKS_MAX);
    duty_is_much:               cover (moved && much_g[1] && duty_most_g < DUTY_TICKS_MAX && share_g < DUTY_SHARE_MAX);
end
