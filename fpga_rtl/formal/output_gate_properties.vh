// What output_gate promises, whatever the host, the player and stage_limits do: proven by induction for all time.
// Inputs of the clock before are `_1_q`: what they do is seen in the outputs now.
localparam [16:0] SETTLED = HV_SETTLE_TICKS[16:0];

reg        started_q = 0;
reg        rst_1_q, permit_1_q, cool_1_q, silent_1_q, exists_1_q;
reg [31:0] mask_1_q;
reg [4:0]  limits_1_q, faults_1_q;           // causes of the limits that were kept
reg        hv_1_q, resting_1_q;
reg [16:0] age_q, age_1_q, age_2_q, age_3_q, age_4_q;  // clocks on before this one, up to SETTLED; as it goes to the pins
reg [16:0] up_q;                             // clocks that hv_enable_o was high before this one

function [16:0] longer(input [16:0] age);
    longer = age == SETTLED ? SETTLED : age + 17'd1;
endfunction

`ifndef ANY_STATE
initial assume (rst_i);
`endif
always @* assume (!clock_lost_i || rst_i);   // as the boards' tops do

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
    hv_1_q      <= hv_enable_o;
    faults_1_q  <= fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE];
    resting_1_q <= resting_q;
    age_q   <= rst_i || !stays || !on ? 0 : longer(age_q);
    age_1_q <= rst_i || !stays ? 0 : age_q;
    age_2_q <= rst_i || !stays ? 0 : age_1_q;
    age_3_q <= rst_i || !stays ? 0 : age_2_q;
    age_4_q <= rst_i || !stays ? 0 : age_3_q;
    up_q    <= rst_i || !hv_enable_o ? 0 : longer(up_q);
end

always @* if (started_q) begin
    // off with the next clock
    if (rst_1_q)           reset_is_off:      assert (channel_o == 0 && !hv_enable_o && state_q == OFF);
    if (!permit_1_q)       stopped_is_off:    assert (channel_o == 0 && !hv_enable_o);
    if (!cool_1_q)         hot_is_off:        assert (channel_o == 0 && !hv_enable_o);
    if (silent_1_q)        silent_is_off:     assert (channel_o == 0 && !hv_enable_o);
    if (limits_1_q != 0)   beyond_is_off:     assert (channel_o == 0 && !hv_enable_o);
    if (!exists_1_q)       nonsense_is_off:   assert (channel_o == 0 && !hv_enable_o);
`ifndef ANY_STATE
    // and the cause is kept if anything was on
    if (hv_1_q && !rst_1_q) begin
        if (!permit_1_q)   stop_is_kept:      assert (fault_o[`FAULT_NO_PERMIT]);
        if (!cool_1_q)     heat_is_kept:      assert (fault_o[`FAULT_OVER_TEMPERATURE]);
        if (silent_1_q)    silence_is_kept:   assert (fault_o[`FAULT_HOST_SILENT]);
        limits_are_kept:   assert ((limits_1_q & ~fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE]) == 0);
    end
    if (resting_1_q && !rst_1_q) rest_is_kept: assert ((faults_1_q & ~fault_o[`FAULT_DUTY:`FAULT_SHORT_PULSE]) == 0);
    // never a channel without its supply, and settled
    no_channel_alone:      assert (channel_o == 0 || hv_enable_o);
    mask_is_kept:          assert ((channel_o & ~mask_1_q) == 0);
    supply_has_settled:    assert (channel_o == 0 || up_q >= SETTLED);

    // what induction must know of the inside
    if (!clock_lost_i) begin
        assert (age_q <= SETTLED && age_1_q <= SETTLED && age_2_q <= SETTLED && age_3_q <= SETTLED && age_4_q <= SETTLED);
        assert (up_q <= SETTLED);
        if (state_q == SETTLING) assert (age_q < SETTLED && settle_left_q == SETTLED - 17'd1 - age_q);
        if (moves)            moves_once_settled: assert (age_q == SETTLED);
        if (moves_later_q[0]) assert (on_later_q[0] && age_1_q == SETTLED);
        if (moves_later_q[1]) assert (on_later_q[1] && age_2_q == SETTLED);
        if (moves_later_q[2]) assert (on_later_q[2] && age_3_q == SETTLED);
        if (channel_q != 0)   assert (hv_enable_q && age_4_q == SETTLED);
        if (on && age_q != 0)              assert (on_later_q[0] && age_q == longer(age_1_q));
        if (on_later_q[0] && age_1_q != 0) assert (on_later_q[1] && age_1_q == longer(age_2_q));
        if (on_later_q[1] && age_2_q != 0) assert (on_later_q[2] && age_2_q == longer(age_3_q));
        if (on_later_q[2] && age_3_q != 0) assert (hv_enable_q && age_3_q == longer(age_4_q));
        if (hv_enable_q)      assert (up_q >= age_4_q);
    end
`endif
end
