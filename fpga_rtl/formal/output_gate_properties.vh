// What output_gate promises, whatever the host, the player and stage_limits do: proven by induction for all time.
// Inputs of the clock before are `_1_q`: what they do is seen in the outputs now.
localparam SETTLED_BITS = $clog2(HV_SETTLE_TICKS + 32'd2);
localparam [SETTLED_BITS-1:0] SETTLED = HV_SETTLE_TICKS[SETTLED_BITS-1:0];

reg        started_q = 0;
reg        rst_1_q, permit_1_q, cool_1_q, silent_1_q, exists_1_q;
reg [31:0] mask_1_q;
reg [4:0]  limits_1_q, faults_1_q;           // causes of the limits that were kept
reg        hv_1_q, resting_1_q;
reg [SETTLED_BITS-1:0] age_q, age_1_q, age_2_q, age_3_q, age_4_q;  // clocks on before this one, up to SETTLED; as it goes to the pins
reg [SETTLED_BITS-1:0] up_q;                             // clocks that hv_enable_o was high before this one

function [SETTLED_BITS-1:0] longer(input [SETTLED_BITS-1:0] age);
    longer = age == SETTLED ? SETTLED : age + 1'b1;
endfunction

// Of the host and the limits, since reset:
reg        allowed_q;                        // armed, and no cause of a fault since
reg        disarmed_q;                       // disarmed, and not armed since
reg [31:0] fed_ticks_q, unfed_q;             // heartbeat_ticks_i of the last heartbeat, clocks since
reg        fed_q;                            // there was one
reg [31:0] since_limit_q;                    // clocks since a limit has shut, or edges were too many, up to REST_TICKS
wire [4:0] edges = limits_i & OF_EDGES[`FAULT_DUTY:`FAULT_SHORT_PULSE];      // too many
reg  [4:0] edges_1_q;
reg        arm_1_q, disarm_1_q, clear_1_q, underrun_1_q, shut_1_q;
reg [15:0] all_faults_1_q;
reg [31:0] drive_1_q, fault_count_1_q;
reg [63:0] now_1_q;

// What the gate takes for granted; safety_island makes arm_i and heartbeat_i so, and proves it where END_TO_END is defined
always @* begin
`ifdef END_TO_END
    if (arm_i && started_q) arm_is_as_taken: assert (off_o && fault_o == 0 && run_permit_i && temperature_good_i && heartbeat_i);
`else
    if (arm_i) arm_is_allowed: assume (off_o && fault_o == 0 && run_permit_i && temperature_good_i && heartbeat_i);
`endif
    clock_is_lost_in_reset: assume (!clock_lost_i || rst_i);         // as the boards' tops do
end
`ifndef ANY_STATE
initial assume (rst_i);
`endif

always @* if (clock_lost_i)
    no_clock_is_off:       assert (channel_o == 0 && !hv_enable_o && !hv_alive_o && !focus_o);

always @(posedge clk_i) begin
    started_q   <= 1;
    rst_1_q     <= rst_i;
    permit_1_q  <= run_permit_i;
    cool_1_q    <= temperature_good_i;
    silent_1_q  <= silent_q;
    exists_1_q  <= state_q <= SETTLING;      // the highest code there is
    mask_1_q    <= channel_mask_i;
    limits_1_q  <= limits_i;
    edges_1_q   <= edges;
    hv_1_q      <= hv_enable_o;
    faults_1_q  <= fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE];
    resting_1_q <= resting_q;
    age_q   <= rst_i || !stays || !on ? 0 : longer(age_q);
    age_1_q <= rst_i || !stays ? 0 : age_q;
    age_2_q <= rst_i || !stays ? 0 : age_1_q;
    age_3_q <= rst_i || !stays ? 0 : age_2_q;
    age_4_q <= rst_i || !stays ? 0 : age_3_q;
    up_q    <= rst_i || !hv_enable_o ? 0 : longer(up_q);
    arm_1_q         <= arm_i;
    disarm_1_q      <= disarm_i;
    clear_1_q       <= clear_i;
    underrun_1_q    <= underrun_i;
    shut_1_q        <= shut_o;
    all_faults_1_q  <= fault_o;
    drive_1_q       <= drive_i;
    fault_count_1_q <= fault_count_o;
    now_1_q         <= now_i;
    allowed_q   <= !rst_i && (arm_i || (allowed_q && run_permit_i && temperature_good_i && alive_o && limits_i == 0 && !underrun_i));
    disarmed_q  <= !rst_i && !arm_i && (disarmed_q || (disarm_i && !off_o));
    fed_q       <= !rst_i && (fed_q || heartbeat_i);
    fed_ticks_q <= heartbeat_i ? heartbeat_ticks_i : fed_ticks_q;
    unfed_q     <= heartbeat_i ? 1 : unfed_q == 32'hFFFFFFFF ? unfed_q : unfed_q + 1;
    since_limit_q <= rst_i ? REST_TICKS : (live_q && limits_i != 0) || edges != 0 ? 0 : since_limit_q == REST_TICKS ? REST_TICKS : since_limit_q + 1;
end

wire any = channel_o != 0 || hv_enable_o || hv_alive_o || focus_o;

always @* if (started_q) begin
    // off with the next clock
    if (rst_1_q)           reset_is_off:      assert (!any && state_q == OFF && fault_o == 0 && !alive_o);
    if (!permit_1_q)       stopped_is_off:    assert (!any);
    if (!cool_1_q)         hot_is_off:        assert (!any);
    if (silent_1_q)        silent_is_off:     assert (!any);
    if (limits_1_q != 0)   beyond_is_off:     assert (!any);
    if (underrun_1_q)      underrun_is_off:   assert (!any);
    if (!exists_1_q)       nonsense_is_off:   assert (!any);
    // and the mask and the word of the clock before decide about each channel
    mask_is_kept:          assert ((channel_o & ~mask_1_q) == 0);
    only_what_is_played:   assert ((channel_o & ~drive_1_q) == 0);
`ifndef ANY_STATE
    // and the cause is kept if anything was on
    if (hv_1_q && !rst_1_q) begin
        if (!permit_1_q)   stop_is_kept:      assert (fault_o[`FAULT_NO_PERMIT]);
        if (!cool_1_q)     heat_is_kept:      assert (fault_o[`FAULT_OVER_TEMPERATURE]);
        if (silent_1_q)    silence_is_kept:   assert (fault_o[`FAULT_HOST_SILENT]);
        limits_are_kept:   assert ((limits_1_q & ~fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE]) == 0);
        if (underrun_1_q)  underrun_is_kept:  assert (fault_o[`FAULT_UNDERRUN]);
    end
    if (!rst_1_q) begin
        if (!clear_1_q)    only_a_command_clears: assert ((all_faults_1_q & ~fault_o) == 0);
        // whatever is on: a channel has its turn when it may be off again
        edges_are_kept:    assert ((edges_1_q & ~fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE]) == 0);
        if (shut_1_q && all_faults_1_q == 0) a_fault_is_counted: assert (fault_count_o == fault_count_1_q + 32'd1 && fault_time_o == now_1_q);
        else               counted_once:          assert (fault_count_o == fault_count_1_q);
        if (!shut_1_q)     only_a_cause_is_kept:  assert ((fault_o & ~all_faults_1_q) == 0);
        if (disarm_1_q && !arm_1_q) disarm_is_obeyed:      assert (state_q == OFF || state_q == STOPPING || state_q == RAMP_DOWN);
    end
    // on only if armed since the last fault, fed since, and without a fault
    if (any)               on_once_armed:     assert (allowed_q);
    if (any)               on_without_fault:  assert (fault_o == 0);
    if (disarmed_q)        disarmed_for_good: assert (state_q == OFF || state_q == STOPPING || state_q == RAMP_DOWN);
    if (any)               on_while_fed:      assert (fed_q && (unfed_q <= fed_ticks_q + 33'd1 || unfed_q <= 2));
    // the fault of a limit stays for REST_TICKS, whatever is commanded
    if (since_limit_q < REST_TICKS) a_limit_rests: assert (fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE] != 0);
    if (resting_1_q && !rst_1_q) rest_is_kept: assert ((faults_1_q & ~fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE]) == 0);
    // never a channel without its supply, and settled
    no_channel_alone:      assert (channel_o == 0 || hv_enable_o);
    no_sign_of_life_alone: assert (hv_enable_o || (!hv_alive_o && !focus_o));
    supply_has_settled:    assert (channel_o == 0 || up_q >= SETTLED);

    // what induction must know of the inside
    if (!clock_lost_i) begin
        assert (age_q <= SETTLED && age_1_q <= SETTLED && age_2_q <= SETTLED && age_3_q <= SETTLED && age_4_q <= SETTLED);
        assert (up_q <= SETTLED);
        rest_has_its_time: assert (resting_q == (since_limit_q < REST_TICKS) && since_limit_q <= REST_TICKS);
        if (resting_q) rest_is_counted: assert (rest_left_q == REST_TICKS - since_limit_q);
        live_is_anything_on: assert (live_q == (on || on_later_q != 3'd0 || hv_enable_q));
        if (live_q) assert (fault_q == 0 && allowed_q);
        any_is_known: assert (faulted_o == (fault_o != 0));
        if (!silent_q) assert (fed_q && unfed_q != 0);
        if (!silent_q) silence_is_counted: assert (unfed_q == 1 ? silence_q == fed_ticks_q : {1'b0, silence_q} + unfed_q == {1'b0, fed_ticks_q} + 33'd1);
        if (!silent_q) silent_in_time: assert (unfed_q <= fed_ticks_q || unfed_q == 1);
        if (live_q) assert (fed_q && unfed_q != 0 && (unfed_q <= fed_ticks_q + 33'd1 || unfed_q <= 2));
        if (state_q == SETTLING) settling_is_counted: assert (age_q < SETTLED && settle_left_q == SETTLED - 1'b1 - age_q);
        if (moves)            moves_once_settled: assert (age_q == SETTLED);
        if (moves_later_q[0]) assert (on_later_q[0] && age_1_q == SETTLED);
        if (moves_later_q[1]) assert (on_later_q[1] && age_2_q == SETTLED);
        if (moves_later_q[2]) assert (on_later_q[2] && age_3_q == SETTLED);
        if (channel_q != 0)   edges_once_settled: assert (hv_enable_q && age_4_q == SETTLED);
        if (on && age_q != 0)              assert (on_later_q[0] && age_q == longer(age_1_q));
        if (on_later_q[0] && age_1_q != 0) assert (on_later_q[1] && age_1_q == longer(age_2_q));
        if (on_later_q[1] && age_2_q != 0) assert (on_later_q[2] && age_2_q == longer(age_3_q));
        if (on_later_q[2] && age_3_q != 0) assert (hv_enable_q && age_3_q == longer(age_4_q));
        if (hv_enable_q)      assert (up_q >= age_4_q);
    end
`endif
end
