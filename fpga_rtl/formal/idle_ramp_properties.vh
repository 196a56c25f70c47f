// What idle_ramp promises: the level goes by ones from where it is to 0 or full scale, and the bits stand for it: what a bit is too
// high or too low is carried on to the next two, within bounds. Inputs and registers of the clock before are `_1_q`.
localparam WIDE = SAMPLES_BITS + 6;

reg                    started_q = 0;
reg                    rst_1_q, up_1_q, down_1_q, stay_1_q, sample_1_q, done_1_q;
reg [15:0]             ticks_1_q;
reg [SAMPLES_BITS-1:0] samples_1_q, level_1_q;
reg [2:0]              step_1_q;
reg signed [WIDE-1:0]  recent_1_q, older_1_q;

wire signed [WIDE-1:0] full   = $signed({6'd0, samples_i});
wire signed [WIDE-1:0] half   = (full + 1) >>> 1;
wire signed [WIDE-1:0] limit  = full + (full >>> 1);
wire signed [WIDE-1:0] recent = $signed({{WIDE-ERROR_BITS{recent_q[ERROR_BITS-1]}}, recent_q}) + (full >>> 1) + 1;   // as they are
wire signed [WIDE-1:0] older_ = $signed({{WIDE-ERROR_BITS{older_q[ERROR_BITS-1]}}, older_q}) + (full >>> 1) + 1;
wire signed [WIDE-1:0] value_ = $signed({{WIDE-VALUE_BITS{value_q[VALUE_BITS-1]}}, value_q}) + half;
wire signed [WIDE-1:0] error_ = $signed({{WIDE-ERROR_BITS{error[ERROR_BITS-1]}}, error}) + (full >>> 1) + 1;
wire signed [WIDE-1:0] raw    = bit_o ? value_ - full : value_;                                  // error before it is kept in bounds

always @(posedge clk_i) begin
    started_q   <= 1;
    rst_1_q     <= rst_i;
    up_1_q      <= up_i;
    down_1_q    <= down_i;
    stay_1_q    <= stay_i;
    sample_1_q  <= sample;
    done_1_q    <= done;
    ticks_1_q   <= bit_ticks_i;
    samples_1_q <= samples_i;
    level_1_q   <= level_q;
    step_1_q    <= step_q;
    recent_1_q  <= recent;
    older_1_q   <= older_;
end

// The contract: settings rest but while disarmed (register_file), one direction at a time, up from 0 and not from full scale,
// down not from 0, and neither directly behind a reset (output_gate)
initial assume (rst_i);
always @* begin
    settings_make_a_ramp: assume (samples_i != 0 && bit_ticks_i >= 4 && bit_ticks_i != 16'hFFFF && !(up_i && down_i) && !(stay_i && active));
    if (rst_1_q) off_behind_reset: assume (!active && !stay_i);
    if (started_q && (active || up_1_q || down_1_q || stay_i || stay_1_q)) settings_rest_in_a_ramp: assume (samples_i == samples_1_q && bit_ticks_i == ticks_1_q);
    if (up_i && sample)   up_from_below: assume (level_q != samples_i);
    if (down_i && sample) down_from_above: assume (level_q != 0);
end

// The promises
always @* if (started_q && !rst_1_q) begin
    level_is_within_scale: assert (level_q <= samples_i || (!active && !stay_i));
    if (up_1_q)                           level_only_rises:    assert (level_q == level_1_q + sample_1_q);
    if (down_1_q)                         level_only_falls:    assert (level_q == level_1_q - sample_1_q);
    if (!up_1_q && !down_1_q && stay_1_q) level_stays:         assert (level_q == level_1_q);
    if (!up_1_q && !down_1_q && !stay_1_q) level_is_forgotten: assert (level_q == 0);
    if (done)                             done_is_the_end:     assert (up_i ? level_q == samples_i : level_q == 0);
    bit_is_the_nearer: assert (bit_o == (value_ >= half));
`ifdef ERRORS
    if (step_1_q[0] && (up_1_q || down_1_q)) begin
        bit_stands_for_level:  assert (value_ == $signed({6'd0, level_1_q}) + 2 * recent_1_q - older_1_q);
    end
    if (step_q[2]) error_is_carried_on:   assert (error_ == (raw > limit ? limit : raw < -limit ? -limit : raw));
    if (step_1_q[2] && (up_1_q || down_1_q) && !done_1_q) error_before_is_older: assert (older_ == recent_1_q);
    if (up_1_q || down_1_q) errors_are_bounded: assert (recent <= limit && recent >= -limit && older_ <= limit && older_ >= -limit);
`endif
end

// What induction must know of the inside
always @* if (started_q && !rst_1_q) begin
    assert (step_q == (!active_q ? 0 : tick_q == 3 ? 1 : tick_q == 4 ? 2 : tick_q == 5 ? 4 : 0) || tick_q == 2);
    assert (tick_q >= 2 && tick_q <= bit_ticks_i + 17'd1);
    if (active_q) assert (last_q == (tick_q == bit_ticks_i + 17'd1));
    else          assert (tick_q == 2 && !last_q);
    if (tick_q == 2) assert (step_q == 0);
    if (active_q && tick_q > 2) assert (up_1_q || down_1_q);
    if (tick_q > 3) assert (top_q == (level_q == samples_i) && bottom_q == (level_q == 0));
`ifdef ERRORS
    if (step_q[1] || step_q[2]) assert (value_ <= full + 3 * limit && value_ >= -3 * limit);
    if (step_q[2]) beyond_is_found: assert (beyond_q == (raw > limit || raw < -limit));
    if (step_q[0]) assert (base_q == twice - older);
`endif
    if (!active_q) assert (recent_q == {3'b111, ~samples_1_q[SAMPLES_BITS-1:1]} && older_q == recent_q);
    assert (active_q == (up_1_q || down_1_q));
end
