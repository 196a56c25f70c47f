// The only way from a waveform to a pin.
// Channels move only while armed, permitted, cool, within the limits and fed by the host; else they are low, as is
// the high-voltage enable.
// A fault is kept, with its cause, until it is cleared by command; a cause counts for as long as anything is on, the
// words on their way after a ramp down included, and edges too many, which are found out later, once all is off too. A state
// that does not exist counts as off.
// What a limit of the stages has shut stays so for REST_TICKS, whatever is commanded: to trip it again and again gains nothing.
// The high voltage has HV_SETTLE_TICKS before the first word of a ramp up. Without a clock the outputs are low too.
`default_nettype none
`include "registers.vh"

module output_gate #(
    parameter [31:0] ALIVE_HALF_TICKS = 32'd2_000,  // half a period of hv_alive_o; at least 10 kHz
    parameter [31:0] HV_SETTLE_TICKS  = 32'd0,  // of the board
    parameter [31:0] REST_TICKS       = 32'd0   // EDGE_WINDOW_TICKS of the board
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        clock_lost_i,       // at any time: the outputs are low at once, clock or not
    input  wire        arm_i,              // pulse, already checked
    input  wire        disarm_i,           // pulse
    input  wire        clear_i,            // pulse
    input  wire        heartbeat_i,        // pulse: the host that armed lives
    input  wire [31:0] heartbeat_ticks_i,
    input  wire        run_permit_i,       // synchronised; low stops
    input  wire        temperature_good_i, // synchronised; low stops
    input  wire        underrun_i,
    input  wire [4:0]  limits_i,           // causes from stage_limits
    input  wire        ramp_done_i,
    input  wire        settled_i,          // nothing sounds, and the idle word has been held long enough to leave it
    input  wire [31:0] channel_mask_i,
    input  wire [15:0] bit_ticks_i,
    input  wire [31:0] drive_i,            // three clocks after the state it belongs to
    input  wire [63:0] now_i,
    input  wire        ended_i,            // pulse: in the next clock the pins have ended an emission
    output wire        off_o,
    output wire        armed_o,
    output wire        settling_o,         // the high voltage settles, the channels are low
    output wire        ramp_up_o,
    output wire        ramp_down_o,
    output wire        stopping_o,         // disarming waits for the word that plays
    output wire        alive_o,            // the host was heard in time
    output wire        shut_o,             // a fault is shutting the outputs in this clock
    output wire [15:0] fault_o,            // causes, kept
    output wire        faulted_o,          // any of them
    output wire [31:0] fault_count_o,
    output wire [63:0] fault_time_o,
    output wire [31:0] underruns_o,
    output wire [31:0] emissions_o,
    output wire [31:0] channel_o,
    output wire        hv_enable_o,
    output wire        hv_alive_o,
    output wire        focus_o
);
    localparam [2:0] OFF = 3'd0, RAMP_UP = 3'd1, ON = 3'd2, STOPPING = 3'd3, RAMP_DOWN = 3'd4, SETTLING = 3'd5;
    localparam [15:0] OF_LIMITS = 16'b11111 << `FAULT_SHORT_PULSE;  // causes that come from limits_i
    localparam [15:0] OF_EDGES  = 16'b00110 << `FAULT_SHORT_PULSE;  // those of them that edges made before count for: total edges, channel edges
    localparam        SETTLE_BITS = $clog2(HV_SETTLE_TICKS + 32'd2);
    localparam [31:0] LAST_SETTLE = HV_SETTLE_TICKS == 32'd0 ? 32'd0 : HV_SETTLE_TICKS - 32'd1;
    localparam        ALIVE_BITS  = ALIVE_HALF_TICKS > 32'd1 ? $clog2(ALIVE_HALF_TICKS) : 1;
    localparam [31:0] LAST_ALIVE  = ALIVE_HALF_TICKS - 32'd1;

    reg [2:0]  state_q;
    reg [31:0] silence_q;                  // ticks left until the host counts as silent
    reg        silent_q;                   // none
    reg [`FAULT_CAUSES-1:0] fault_q;       // a new cause: a record in controller/device/fpga/registers.py, and its line below
    reg        faulted_q;                  // any
    reg [31:0] rest_left_q;                // ticks for which a fault by a limit cannot be cleared
    reg        resting_q;
    reg [31:0] fault_count_q, underruns_q;
    reg [63:0] fault_time_q;
    reg [SETTLE_BITS-1:0] settle_left_q;
    reg [2:0]  on_later_q, moves_later_q;  // state, until it is in step with drive_i
    reg        live_q;                     // anything of these is on, or hv_enable_q: known a clock early, as all faults wait for it
    reg [31:0] channel_q;
    reg        hv_enable_q;
    reg        focus_q;
    reg [15:0] focus_left_q;
    reg [31:0] emissions_q;
    reg [ALIVE_BITS-1:0] alive_left_q;
    reg        hv_alive_q;

    wire       settling    = state_q == SETTLING;
    wire       moves       = state_q == RAMP_UP || state_q == ON || state_q == STOPPING || state_q == RAMP_DOWN;
    wire       on          = settling || moves;
    wire       exists      = on || state_q == OFF;
    wire [`FAULT_CAUSES-1:0] wrong;
    assign wrong[`FAULT_NO_PERMIT]        = !run_permit_i;
    assign wrong[`FAULT_HOST_SILENT]      = silent_q;
    assign wrong[`FAULT_OVER_TEMPERATURE] = !temperature_good_i;
    assign wrong[`FAULT_UNDERRUN]         = underrun_i;
    assign wrong[`FAULT_DUTY:`FAULT_SHORT_PULSE] = limits_i;
    wire [`FAULT_CAUSES-1:0] cause = wrong & ({`FAULT_CAUSES{live_q}} | OF_EDGES[`FAULT_CAUSES-1:0]);
    wire       shut  = |cause;
    wire       stays = exists && wrong == {`FAULT_CAUSES{1'b0}};  // live or not: of nothing, nothing stays
    wire       open  = on_later_q[2] && stays;
    // what a clear leaves
    wire [`FAULT_CAUSES-1:0] rests = fault_q & OF_LIMITS[`FAULT_CAUSES-1:0] & {`FAULT_CAUSES{resting_q}};

    always @(posedge clk_i) begin
        if (heartbeat_i) begin
            silence_q <= heartbeat_ticks_i;
            silent_q  <= 1'b0;
        end else if (!silent_q) begin
            silence_q <= silence_q - 32'd1;
            silent_q  <= silence_q[31:1] == 31'd0;  // 0, which no host can ask for, is silence too and not 2^32 ticks
        end

        fault_q   <= (clear_i ? rests : fault_q) | cause;
        faulted_q <= (clear_i ? rests != {`FAULT_CAUSES{1'b0}} : faulted_q) || shut;
        if (cause[`FAULT_DUTY:`FAULT_SHORT_PULSE] != 5'd0) begin
            rest_left_q <= REST_TICKS;
            resting_q   <= 1'b1;
        end else if (resting_q) begin
            rest_left_q <= rest_left_q - 32'd1;
            resting_q   <= rest_left_q != 32'd1;
        end
        if (shut && !faulted_q) begin  // edges too many add to a fault that is there
            fault_count_q <= fault_count_q + 32'd1;
            fault_time_q  <= now_i;
        end
        if (live_q && underrun_i) underruns_q <= underruns_q + 32'd1;

        case (state_q)
            OFF:       if (arm_i) state_q <= SETTLING;
            SETTLING:  if (disarm_i) state_q <= OFF; else if (settle_left_q == {SETTLE_BITS{1'b0}}) state_q <= RAMP_UP;
            RAMP_UP:   if (disarm_i) state_q <= RAMP_DOWN; else if (ramp_done_i) state_q <= ON;
            ON:        if (disarm_i) state_q <= STOPPING;
            STOPPING:  if (settled_i) state_q <= RAMP_DOWN;
            RAMP_DOWN: if (ramp_done_i) state_q <= OFF;
            default:   state_q <= OFF;
        endcase
        if (shut) state_q <= OFF;

        settle_left_q <= settling ? settle_left_q - 1'b1 : LAST_SETTLE[SETTLE_BITS-1:0];
        on_later_q    <= {on_later_q[1:0], on} & {3{stays}};
        moves_later_q <= {moves_later_q[1:0], moves} & {3{stays}};
        live_q        <= (arm_i && !shut) || (stays && (on || on_later_q != 3'd0));

        if (ended_i && open) emissions_q <= emissions_q + 32'd1;
        if (!open)                        focus_left_q <= 16'd0;
        else if (ended_i)                 focus_left_q <= bit_ticks_i - 16'd1;
        else if (focus_left_q != 16'd0)   focus_left_q <= focus_left_q - 16'd1;
        if (!open)                                     alive_left_q <= {ALIVE_BITS{1'b0}};
        else if (alive_left_q == {ALIVE_BITS{1'b0}})   alive_left_q <= LAST_ALIVE[ALIVE_BITS-1:0];
        else                                           alive_left_q <= alive_left_q - 1'b1;

        if (rst_i) begin
            state_q      <= OFF;
            silence_q    <= 32'd0;
            silent_q     <= 1'b1;
            fault_q       <= {`FAULT_CAUSES{1'b0}};
            faulted_q     <= 1'b0;
            rest_left_q   <= 32'd0;
            resting_q     <= 1'b0;
            fault_count_q <= 32'd0;
            fault_time_q  <= 64'd0;
            underruns_q   <= 32'd0;
            settle_left_q <= {SETTLE_BITS{1'b0}};
            on_later_q    <= 3'b000;
            moves_later_q <= 3'b000;
            live_q        <= 1'b0;
            focus_left_q  <= 16'd0;
            emissions_q   <= 32'd0;
            alive_left_q  <= {ALIVE_BITS{1'b0}};
        end
    end

    // What leaves: low with the next clock of a fault or reset, low at once where there is no clock
    always @(posedge clk_i or posedge clock_lost_i) begin
        if (clock_lost_i) begin
            channel_q   <= 32'd0;
            hv_enable_q <= 1'b0;
            hv_alive_q  <= 1'b0;
            focus_q     <= 1'b0;
        end else begin
            channel_q   <= open && moves_later_q[2] && !rst_i ? drive_i & channel_mask_i : 32'd0;
            hv_enable_q <= open && !rst_i;
            hv_alive_q  <= open && !rst_i && (hv_alive_q ^ (alive_left_q == {ALIVE_BITS{1'b0}}));
            focus_q     <= open && !rst_i && (ended_i || focus_left_q != 16'd0);
        end
    end

    assign off_o       = state_q == OFF;
    assign armed_o     = state_q == ON;
    assign settling_o  = settling;
    assign ramp_up_o   = state_q == RAMP_UP;
    assign ramp_down_o = state_q == RAMP_DOWN;
    assign alive_o     = !silent_q;
    assign shut_o      = shut;
    assign stopping_o  = state_q == STOPPING;
    assign fault_o     = {{16-`FAULT_CAUSES{1'b0}}, fault_q};
    assign faulted_o   = faulted_q;
    assign fault_count_o = fault_count_q;
    assign fault_time_o  = fault_time_q;
    assign underruns_o   = underruns_q;
    assign emissions_o = emissions_q;
    assign channel_o   = channel_q;
    assign hv_enable_o = hv_enable_q;
    assign hv_alive_o  = hv_alive_q;
    assign focus_o     = focus_q;

`ifdef FORMAL
    `include "output_gate_properties.vh"
`endif
endmodule

`default_nettype wire
