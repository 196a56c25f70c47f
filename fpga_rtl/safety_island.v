// All that protects the stages, to be read alone: nothing outside decides whether a channel may move.
// Host, frames, memory and player are on the other side of drive_i and of the settings asked for. What they may ask at most is
// built in, and clamped here once more:
//   the permits' pins through two flip-flops each -> output_gate: off, unless armed, permitted, cool and fed
//   frames of the link that armed, from its ARM on, and of no other -> output_gate: off where they cease
//   the pins' register -> stage_limits -> output_gate: off, and the cause kept, where a limit is exceeded
// A limit that is missing leaves nothing to build: there are no defaults.
`default_nettype none
`include "registers.vh"

module safety_island #(
    parameter [31:0] ALIVE_HALF_TICKS    = 32'd2_000,
    // of the board
    parameter [31:0] CHANNEL_MASK_MAX    = 32'd0,  // channels that have a stage
    parameter [31:0] HV_SETTLE_TICKS     = 32'd0,
    parameter [31:0] HEARTBEAT_TICKS_MAX = 32'd0,
    parameter [31:0] EDGE_WINDOW_TICKS   = 32'd0,
    parameter [31:0] PULSE_TICKS_MIN     = 32'd0,
    parameter [31:0] CHANNEL_EDGES_MAX   = 32'd0,
    parameter [31:0] TOTAL_EDGES_MAX     = 32'd0,
    parameter [31:0] EMISSION_TICKS_MAX  = 32'd0,
    parameter [31:0] DUTY_SHARE_MAX      = 32'd0,
    parameter [31:0] DUTY_TICKS_MAX      = 32'd0
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        clock_lost_i,       // at any time: the outputs are low at once, clock or not
    // pins
    input  wire        run_permit_i,       // driven high to run
    input  wire        temperature_ok_i,   // driven high while cool
    // asked for
    input  wire        arm_i,              // pulse: the host has unlocked it
    input  wire        disarm_i,           // pulse
    input  wire        clear_i,            // pulse
    input  wire        heard_i,            // pulse: a frame was accepted, that of arm_i among them
    input  wire        link_i,             // by which link
    input  wire [31:0] channel_mask_i, heartbeat_ticks_i,
    input  wire [15:0] pulse_ticks_i,
    input  wire [31:0] channel_edges_i, total_edges_i, emission_ticks_i,
    input  wire [16:0] duty_share_i,
    input  wire [31:0] duty_ticks_i,
    // what would be played
    input  wire [31:0] drive_i,            // three clocks after the state it belongs to
    input  wire [15:0] bit_ticks_i,
    input  wire        playing_i,          // an emission sounds
    input  wire        start_i,            // pulse: an emission begins in the next clock
    input  wire        ended_i,            // pulse: in the next clock the pins have ended an emission
    input  wire        underrun_i,
    input  wire        ramp_done_i,
    input  wire        settled_i,          // nothing sounds, and the idle word has been held long enough to leave it
    input  wire [63:0] now_i,
    // state
    output wire        run_permit_o,       // synchronised
    output wire        temperature_ok_o,
    output wire        off_o,
    output wire        settling_o,
    output wire        ramp_up_o,
    output wire        armed_o,
    output wire        stopping_o,
    output wire        ramp_down_o,
    output wire        alive_o,            // the host was heard in time
    output wire        shut_o,             // a fault is shutting the outputs in this clock
    output wire [15:0] fault_o,            // causes, kept
    output wire        faulted_o,          // any of them
    output wire [31:0] fault_channels_o,   // of a short pulse or edges too many
    output wire [31:0] fault_count_o,
    output wire [63:0] fault_time_o,
    output wire [31:0] duty_level_o, underruns_o, emissions_o,
    // pins
    output wire [31:0] channel_o,
    output wire        hv_enable_o,
    output wire        hv_alive_o,
    output wire        focus_o
);
    generate
        if (CHANNEL_MASK_MAX == 32'd0 || HV_SETTLE_TICKS == 32'd0 || HEARTBEAT_TICKS_MAX == 32'd0 || EDGE_WINDOW_TICKS == 32'd0
            || PULSE_TICKS_MIN == 32'd0 || CHANNEL_EDGES_MAX == 32'd0 || TOTAL_EDGES_MAX == 32'd0 || EMISSION_TICKS_MAX == 32'd0
            || DUTY_SHARE_MAX == 32'd0 || DUTY_TICKS_MAX == 32'd0) begin : not_given
            the_limits_of_the_board_are_missing from_the_parameters ();
        end
    endgenerate

    // What a limit has at most
    localparam HEARTBEAT_BITS = $clog2((HEARTBEAT_TICKS_MAX | 32'd1) + 32'd1);
    localparam EDGE_BITS      = $clog2((CHANNEL_EDGES_MAX | 32'd1) + 32'd1);
    localparam TOTAL_BITS     = $clog2((TOTAL_EDGES_MAX | 32'd1) + 32'd1);
    localparam EMISSION_BITS  = $clog2((EMISSION_TICKS_MAX | 32'd1) + 32'd1);
    localparam DUTY_BITS      = $clog2((DUTY_TICKS_MAX | 32'd1) + 32'd1);

    wire most_heartbeat = heartbeat_ticks_i > HEARTBEAT_TICKS_MAX;
    wire most_edges     = channel_edges_i > CHANNEL_EDGES_MAX;
    wire most_total     = total_edges_i > TOTAL_EDGES_MAX;
    wire most_emission  = emission_ticks_i > EMISSION_TICKS_MAX;
    wire most_share     = duty_share_i > DUTY_SHARE_MAX[16:0];
    wire most_duty      = duty_ticks_i > DUTY_TICKS_MAX;
    wire least_pulse    = pulse_ticks_i < PULSE_TICKS_MIN[15:0];

    reg [1:0]  run_permit_q, temperature_ok_q;
    reg        link_q;                     // that armed
    reg [HEARTBEAT_BITS-1:0] heartbeat_ticks_q;
    reg [EDGE_BITS-1:0]      channel_edges_q;
    reg [TOTAL_BITS-1:0]     total_edges_q;
    reg [EMISSION_BITS-1:0]  emission_ticks_q;
    reg [DUTY_BITS-1:0]      duty_ticks_q;
    reg [15:0] pulse_ticks_q;
    reg [16:0] duty_share_q;

    wire [15:0] fault;
    wire        run_permit     = run_permit_q[1];
    wire        temperature_ok = temperature_ok_q[1];
    wire        arm            = arm_i && off_o && !faulted_o && run_permit && temperature_ok;
    wire        heartbeat      = arm || (heard_i && !off_o && link_i == link_q);  // the link that armed, from its ARM on

    always @(posedge clk_i) begin
        run_permit_q      <= {run_permit_q[0], run_permit_i};
        temperature_ok_q  <= {temperature_ok_q[0], temperature_ok_i};
        if (off_o) begin                   // what is asked for while anything is on does not count
            heartbeat_ticks_q <= most_heartbeat ? HEARTBEAT_TICKS_MAX[HEARTBEAT_BITS-1:0] : heartbeat_ticks_i[HEARTBEAT_BITS-1:0];
            emission_ticks_q  <= most_emission ? EMISSION_TICKS_MAX[EMISSION_BITS-1:0] : emission_ticks_i[EMISSION_BITS-1:0];
            duty_share_q      <= most_share ? DUTY_SHARE_MAX[16:0] : duty_share_i;
            duty_ticks_q      <= most_duty ? DUTY_TICKS_MAX[DUTY_BITS-1:0] : duty_ticks_i[DUTY_BITS-1:0];
            pulse_ticks_q     <= least_pulse ? PULSE_TICKS_MIN[15:0] : pulse_ticks_i;
        end
        if (arm) begin                     // edges are judged once all is off too: by what was allowed when they were made
            link_q          <= link_i;
            channel_edges_q <= most_edges ? CHANNEL_EDGES_MAX[EDGE_BITS-1:0] : channel_edges_i[EDGE_BITS-1:0];
            total_edges_q   <= most_total ? TOTAL_EDGES_MAX[TOTAL_BITS-1:0] : total_edges_i[TOTAL_BITS-1:0];
        end
        if (rst_i) begin
            link_q            <= 1'b0;
            run_permit_q      <= 2'b00;
            temperature_ok_q  <= 2'b00;
            heartbeat_ticks_q <= HEARTBEAT_TICKS_MAX[HEARTBEAT_BITS-1:0];
            channel_edges_q   <= CHANNEL_EDGES_MAX[EDGE_BITS-1:0];
            total_edges_q     <= TOTAL_EDGES_MAX[TOTAL_BITS-1:0];
            emission_ticks_q  <= EMISSION_TICKS_MAX[EMISSION_BITS-1:0];
            duty_share_q      <= DUTY_SHARE_MAX[16:0];
            duty_ticks_q      <= DUTY_TICKS_MAX[DUTY_BITS-1:0];
            pulse_ticks_q     <= PULSE_TICKS_MIN[15:0];
        end
    end

    wire [4:0]  limits;
    wire [31:0] culprits;
    wire        culprits_known = fault[`FAULT_SHORT_PULSE] || fault[`FAULT_CHANNEL_EDGES];

    stage_limits #(
        .EDGE_WINDOW_TICKS(EDGE_WINDOW_TICKS), .PULSE_TICKS_MIN(PULSE_TICKS_MIN), .CHANNEL_EDGES_MAX(CHANNEL_EDGES_MAX),
        .TOTAL_EDGES_MAX(TOTAL_EDGES_MAX), .EMISSION_TICKS_MAX(EMISSION_TICKS_MAX), .DUTY_TICKS_MAX(DUTY_TICKS_MAX)
    ) stage_limits (
        .clk_i(clk_i), .rst_i(rst_i), .channel_i(channel_o), .active_i(playing_i || ramp_up_o || ramp_down_o),
        .emission_i(playing_i), .start_i(start_i), .clear_i(clear_i),
        .pulse_ticks_i(pulse_ticks_q), .channel_edges_i(channel_edges_q), .total_edges_i(total_edges_q),
        .emission_ticks_i(emission_ticks_q), .duty_share_i(duty_share_q), .duty_ticks_i(duty_ticks_q),
        .cause_o(limits), .channels_o(culprits), .duty_level_o(duty_level_o)
    );

    output_gate #(.ALIVE_HALF_TICKS(ALIVE_HALF_TICKS), .HV_SETTLE_TICKS(HV_SETTLE_TICKS), .REST_TICKS(EDGE_WINDOW_TICKS)) output_gate (
        .clk_i(clk_i), .rst_i(rst_i), .clock_lost_i(clock_lost_i),
        .arm_i(arm), .disarm_i(disarm_i), .clear_i(clear_i),
        .heartbeat_i(heartbeat), .heartbeat_ticks_i({{32-HEARTBEAT_BITS{1'b0}}, heartbeat_ticks_q}),
        .run_permit_i(run_permit), .temperature_good_i(temperature_ok), .underrun_i(underrun_i), .limits_i(limits),
        .ramp_done_i(ramp_done_i), .settled_i(settled_i), .channel_mask_i(channel_mask_i & CHANNEL_MASK_MAX),
        .bit_ticks_i(bit_ticks_i), .drive_i(drive_i), .now_i(now_i), .ended_i(ended_i),
        .off_o(off_o), .settling_o(settling_o), .ramp_up_o(ramp_up_o), .armed_o(armed_o), .stopping_o(stopping_o),
        .ramp_down_o(ramp_down_o), .alive_o(alive_o), .shut_o(shut_o),
        .fault_o(fault), .faulted_o(faulted_o), .fault_count_o(fault_count_o), .fault_time_o(fault_time_o), .underruns_o(underruns_o),
        .emissions_o(emissions_o),
        .channel_o(channel_o), .hv_enable_o(hv_enable_o), .hv_alive_o(hv_alive_o), .focus_o(focus_o)
    );

    assign run_permit_o     = run_permit;
    assign temperature_ok_o = temperature_ok;
    assign fault_o          = fault;
    assign fault_channels_o = culprits_known ? culprits : 32'd0;
`ifdef END_TO_END
    `include "safety_island_end_to_end_properties.vh"
`endif
`ifdef FORMAL
    `include "safety_island_properties.vh"
`ifdef END_TO_END
    `include "safety_island_end_to_end_links.vh"
`endif
`endif
endmodule

`default_nettype wire
