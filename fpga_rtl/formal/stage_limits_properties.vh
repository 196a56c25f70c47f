// What stage_limits promises of any one channel and any one part, from reset on, by induction at the real constants.
// Settings rest: safety_island takes new ones only while everything is off.
(* anyconst *) reg [4:0]  one;                // a channel
(* anyconst *) reg [3:0]  slot;               // parts with this number, modulo 16
(* anyconst *) reg [15:0] pulse_ticks;
(* anyconst *) reg [AGE_BITS-1:0] emission_ticks;
(* anyconst *) reg [DUTY_BITS-1:0] duty_ticks;
(* anyseq *)   reg        mark;               // from here on activity is summed

initial assume (rst_i);
always @* settings_rest: assume (pulse_ticks_i == pulse_ticks && emission_ticks_i == emission_ticks && duty_ticks_i == duty_ticks);

reg started_q = 0;
always @(posedge clk_i) started_q <= 1;

// Short pulses: ticks since the channel's own last change
localparam [17:0] LONG_AGO = 18'h20000;
reg [31:0] pins_before_q;
reg [17:0] own_since_q;
reg        short_due_q;
always @(posedge clk_i) begin
    pins_before_q <= rst_i ? 32'd0 : pins_q;
    own_since_q   <= rst_i ? LONG_AGO : change_q[one] ? 18'd1 : own_since_q == LONG_AGO ? LONG_AGO : own_since_q + 18'd1;
    short_due_q   <= !rst_i && change_q[one] && own_since_q < {2'b00, pulse_ticks};
end

// Longest emission: ticks that it has sounded
localparam [AGE_BITS:0] ENDLESS = {1'b1, {AGE_BITS{1'b0}}};
reg [AGE_BITS:0] sounded_q;
reg              late_due_q;
always @(posedge clk_i) begin
    sounded_q  <= rst_i || start_i || !emission_i ? {AGE_BITS+1{1'b0}} : sounded_q == ENDLESS ? ENDLESS : sounded_q + 1'b1;
    late_due_q <= !rst_i && emission_i && sounded_q >= {1'b0, emission_ticks};
end

// Duty: activity less its share since the mark, whenever that was
localparam signed [LEVEL_BITS+1:0] FULL = {3'b001, {LEVEL_BITS-1{1'b0}}};
reg signed [LEVEL_BITS+1:0] sum_q;
reg                         duty_due_q;
wire signed [LEVEL_BITS+1:0] sum = sum_q + {{LEVEL_BITS-16{flow[17]}}, flow};
always @(posedge clk_i) begin
    sum_q      <= rst_i || mark ? {LEVEL_BITS+2{1'b0}} : sum > FULL ? FULL : sum < -FULL ? -FULL : sum;
    duty_due_q <= !rst_i && active_i && sum_q > $signed({3'b000, duty_ticks, 16'd0});
end

// Edges of the channel: all of them; when it had its turn; when it had that at the end of the last part with this number
reg [ACCOUNT_BITS-1:0] edges_all_q, turned_q, turned_before_q, at_end_q, at_end_before_q;
reg                    had_q, ended_q, at_1_q, at_2_q, ends_1_q, ends_2_q, uses_1_q, uses_2_q, edges_due_q;
reg                    uses_3_q, moved_1_q, moved_2_q;
reg [1:0]              run_q;                // clocks since reset, up to 3
wire                   at     = turn_q == one;
wire                   uses   = at && part_q == slot;
wire                   end_at = uses && last_round_q;
wire [ACCOUNT_BITS-1:0] since_turn = edges_all_q - turned_q;
wire [ACCOUNT_BITS-1:0] in_window  = turned_q - at_end_before_q;
localparam [31:0]      PART_TICKS = ROUNDS << 5;
localparam [ACCOUNT_BITS-1:0] LOW_COUNTS = 1 << LOW_BITS;
reg [31:0]             end_age_q;            // ticks since that turn
wire [31:0]            place     = {{27-ROUND_BITS{1'b0}}, round_q, turn_q};
wire [31:0]            end_place = PART_TICKS - 32'd32 + {27'd0, one};
wire [3:0]             parts_ago = part_q - slot;
wire [4:0]             parts_since = {parts_ago == 4'd0 && place <= end_place, parts_ago};
// Fewer edges between two turns than the count holds: changes are PULSE_TICKS_MIN apart, or a short pulse shuts the outputs
always @* turns_see_few_edges: assume (since_turn < LOW_COUNTS);
always @(posedge clk_i) begin
    run_q       <= run_q == 2'd3 ? 2'd3 : run_q + 2'd1;
    edges_all_q <= edges_all_q + {{ACCOUNT_BITS-1{1'b0}}, change_q[one]};
    {at_2_q, at_1_q}     <= {at_1_q, at};
    {ends_2_q, ends_1_q} <= {ends_1_q, end_at};
    {uses_2_q, uses_1_q} <= {uses_1_q, uses};
    {moved_2_q, moved_1_q} <= {moved_1_q, moved_q};
    uses_3_q             <= uses_2_q;
    end_age_q            <= end_age_q + 32'd1;
    edges_due_q          <= uses_2_q && turned_q != turned_before_q && in_window > {{ACCOUNT_BITS-EDGE_BITS{1'b0}}, channel_edges_i};
    if (at) begin
        had_q           <= 1'b1;
        turned_q        <= edges_all_q;
        turned_before_q <= turned_q;
    end
    if (uses) at_end_before_q <= parts_full_q ? at_end_q : {ACCOUNT_BITS{1'b0}};
    if (end_at) begin
        at_end_q  <= edges_all_q;
        ended_q   <= 1'b1;
        end_age_q <= 32'd1;
    end
    if (rst_i) begin
        run_q       <= 2'd0;
        edges_all_q <= {ACCOUNT_BITS{1'b0}};
        turned_q    <= {ACCOUNT_BITS{1'b0}};
        {had_q, ended_q, at_1_q, at_2_q, ends_1_q, ends_2_q, uses_1_q, uses_2_q, edges_due_q} <= 9'd0;
        {uses_3_q, moved_2_q, moved_1_q} <= 3'd0;
    end
end

wire [LOW_BITS-1:0] low_one;
generate
    for (k = 0; k < LOW_BITS; k = k + 1) begin : low_one_bit
        assign low_one[k] = low_bit[k].count_q[one];
    end
endgenerate

// Edges of all channels: all of them; how many when the last part with this number began; those from which the last part of the
// window counts, in the part behind which that number comes next. Counts are modulo 2**TOTAL_BITS, as those of the module
reg [TOTAL_BITS-1:0]   total_g, began_g, base_g;
reg                    has_begun_g, in_1_q, in_2_q, in_3_q, total_due_q;
reg [31:0]             began_age_g;          // ticks since that part began
wire                   in     = part_q + 4'd1 == slot;
wire                   begins_slot = begun_q && part_q == slot;
wire [TOTAL_BITS-1:0]  in_all = total_g - base_g;
wire [5:0]             ones_g = ones_32(change_q);
wire [5:0]             ones_less = ones_32(change_q & ~(32'd1 << one));
wire [4:0]             parts_all = {parts_ago == 4'd0 && place <= 32'd1, parts_ago};
// More than these are never made: those of the change too many and of the 4 clocks until the outputs are low, and as many once
// more, as a part that counts may be older than REST_TICKS
always @* if (in_2_q) window_sees_few_edges: assume (in_all <= TOTAL_EDGES_MAX + 32'd320);
always @(posedge clk_i) begin
    total_g <= total_g + {{TOTAL_BITS-6{1'b0}}, ones_g};
    {in_3_q, in_2_q, in_1_q} <= {in_2_q, in_1_q, in};
    began_age_g <= began_age_g + 32'd1;
    if (begins_slot) begin
        began_g     <= total_g;
        has_begun_g <= 1'b1;
        began_age_g <= 32'd2;
    end
    if (begun_q && in) base_g <= parts_full_q || part_q == 4'd15 ? began_g : {TOTAL_BITS{1'b0}};
    total_due_q <= in_2_q && moves_q != 6'd0 && in_all > total_edges_i;
    if (rst_i) begin
        {total_g, began_g, base_g} <= {3{{TOTAL_BITS{1'b0}}}};
        {has_begun_g, in_1_q, in_2_q, in_3_q, total_due_q} <= 5'd0;
    end
end
(* anyconst *) reg [ALL_BITS-1:0] total_edges;
always @* total_limit_rests: assume (total_edges_i == total_edges && total_edges <= TOTAL_EDGES_MAX);  // safety_island: edges_are_clamped, limits_of_edges_rest

always @* if (started_q) begin
    // of none it is 0, and any channel adds 1: so it is their number
    each_channel_adds_one: assert (ones_32(32'd0) == 6'd0 && ones_g == ones_less + {5'd0, change_q[one]});
    change_is_of_pins:    assert (change_q == (pins_q ^ pins_before_q) && moved_q == (change_q != 32'd0));
    if (short_due_q)      short_pulse_is_seen:   assert (cause_o[0]);
    if (late_due_q)       long_emission_is_seen: assert (cause_o[3]);
    if (duty_due_q)       duty_is_seen:          assert (cause_o[4]);
    // a turn judges what the channel has made since the end of the part 16 before its own: 15 parts and a round ago or more, so
    // that an interval of EDGE_WINDOW_TICKS up to any edge that the turn counts begins behind it
    if (at_2_q)           no_edge_is_lost:       assert (made_q == turned_q);
    if (edges_due_q)      edges_are_seen:        assert (cause_o[1]);
    // output_gate takes these two at any time: at rest, or with no more edges than the limit, there is none
    if (uses_3_q && cause_o[1]) only_new_edges_are_too_many: assert (edges_due_q);
    if (cause_o[2])       only_moves_are_too_many: assert (moved_2_q);
    if (uses && parts_full_q) window_is_long:    assert (end_age_q >= 32'd15 * PART_TICKS + 32'd32 && 32'd15 * PART_TICKS >= EDGE_WINDOW_TICKS);

    if (total_due_q)      total_edges_are_seen:  assert (cause_o[2]);
    if (in_3_q && cause_o[2]) only_too_many_are_too_many: assert (total_due_q);
    if (in && parts_full_q) window_of_all_is_long: assert (began_age_g >= 32'd15 * PART_TICKS && 32'd15 * PART_TICKS >= EDGE_WINDOW_TICKS);

    // what induction must know of the inside
    all_are_counted: assert (all == total_g);
    assert (begun_q == (run_q != 2'd0 && place == 32'd1) && first_moves_q == (run_q >= 2'd2 && place == 32'd2));
    if (has_begun_g && !(first_moves_q && part_q == slot)) beginning_is_kept: assert (made_in[slot] == began_g);
    if (first_moves_q && part_q == slot) assert (all_q == began_g && has_begun_g);
    if (in_1_q) base_is_of_its_part: assert (all_base_q == (begun_q && in ? (parts_full_q || part_q == 4'd15 ? began_g : {TOTAL_BITS{1'b0}}) : base_g));
    if (in_2_q) base_is_a_beginning: assert (all_limit_q == base_g + {{TOTAL_BITS-ALL_BITS{1'b0}}, total_edges_i});
    if (has_begun_g) assert (began_age_g == place + {27'd0, parts_all} * PART_TICKS);
    every_part_has_begun: assert (has_begun_g || (!parts_full_q && (part_q < slot || (part_q == slot && place <= 1))));
    none_is_known:        assert (none_q == (channels_o == 32'd0));
    soon_is_known:        assert (soon_q == (since_q < pulse_ticks));
    ticks_are_counted:    assert (own_since_q <= LONG_AGO && {2'b00, since_q} <= own_since_q);
    own_change_is_recent: assert (recent_q[one] || own_since_q == LONG_AGO || own_since_q >= {2'b00, since_q} + {2'b00, pulse_ticks});
    assert (sounded_q <= ENDLESS && {1'b0, age} == (sounded_q < {1'b0, emission_ticks} ? sounded_q : {1'b0, emission_ticks}));
    bucket_holds_the_sum: assert (sum_q <= FULL && sum_q >= -FULL && sum_q <= $signed({2'b00, level_q}));
    low_bits_count:       assert (low_one == edges_all_q[LOW_BITS-1:0]);
    assert (round_q <= LAST_ROUND[ROUND_BITS-1:0] && last_round_q == (round_q == LAST_ROUND[ROUND_BITS-1:0]));
    assert (!first_round_q || (round_q == {ROUND_BITS{1'b0}} && part_q == 4'd0 && !parts_full_q));
    assert (run_q == 2'd3 || (first_round_q && turn_q == {3'd0, run_q}));
    assert (had_q == !(first_round_q && turn_q <= one) && (had_q || turned_q == {ACCOUNT_BITS{1'b0}}));
    assert (at_1_q == (had_q && turn_q == one + 5'd1) && at_2_q == (had_q && turn_q == one + 5'd2 && !at_1_q));
    if (run_q >= 2'd1) assert (at_1_q == (fetched_q == one));
    if (run_q >= 2'd2) assert (at_2_q == (made_turn_q == one) && at_2_q == made_one_q[one]);
    if (at_1_q) assert (low_1_q == turned_q[LOW_BITS-1:0] && account == turned_before_q);
    if (at_2_q) assert (new_q == (turned_q != turned_before_q));
    if (at_1_q || at_2_q) assert (turned_q - turned_before_q < LOW_COUNTS);
    if (had_q && !at_1_q && !at_2_q) assert (accounts[one] == turned_q);
    if (at_1_q) assert (ends_1_q == (fetched_last_q && fetched_part_q == slot)); else assert (!ends_1_q && !uses_1_q);
    if (at_2_q) assert (ends_2_q == (made_last_q && made_part_q == slot)); else assert (!ends_2_q && !uses_2_q);
    if (ends_1_q || ends_2_q) assert (ended_q && at_end_q == turned_q);
    if (ends_1_q) assert (uses_1_q);
    if (ends_2_q) assert (uses_2_q);
    if (uses_1_q) assert ((fetched_full_q ? oldest_q : {ACCOUNT_BITS{1'b0}}) == at_end_before_q);
    if (uses_2_q) base_is_an_end: assert (base_q == at_end_before_q);
    if (ended_q && !ends_1_q && !ends_2_q) end_is_kept: assert (made_by[{slot, one}] == at_end_q);
    every_part_has_an_end: assert (ended_q || (!parts_full_q && (part_q < slot || (part_q == slot && place <= end_place))));
    assert (!ended_q || !first_round_q);
    if (ended_q) assert (end_age_q + end_place == place + {27'd0, parts_since} * PART_TICKS);
end
