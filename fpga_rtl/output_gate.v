// The only way from a waveform to a pin.
// Channels move only while armed, permitted and fed by the host; else they are low, as is the high-voltage enable.
// A fault is kept, with its cause, until it is cleared by command; arming is refused until then.
`default_nettype none
`include "registers.vh"

module output_gate #(
    parameter ALIVE_HALF_TICKS = 2500  // half a period of hv_alive_o; at least 10 kHz
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        arm_i,              // pulse, already checked
    input  wire        disarm_i,           // pulse
    input  wire        clear_i,            // pulse
    input  wire        heartbeat_i,        // pulse for every accepted frame
    input  wire [31:0] heartbeat_ticks_i,
    input  wire        run_permit_i,       // synchronised; low stops
    input  wire        ramp_done_i,
    input  wire [31:0] channel_mask_i,
    input  wire [15:0] bit_ticks_i,
    input  wire [31:0] drive_i,            // two clocks after the state it belongs to
    input  wire        ended_i,            // pulse: in the next clock the pins have ended an emission
    output wire        off_o,
    output wire        armed_o,
    output wire        ramp_up_o,
    output wire        ramp_down_o,
    output wire        alive_o,            // the host was heard in time
    output wire        shut_o,             // a fault is shutting the outputs in this clock
    output wire [15:0] fault_o,            // causes, kept
    output wire [31:0] emissions_o,
    output wire [31:0] channel_o,
    output wire        hv_enable_o,
    output wire        hv_alive_o,
    output wire        focus_o
);
    localparam [1:0] OFF = 2'd0, RAMP_UP = 2'd1, ON = 2'd2, RAMP_DOWN = 2'd3;

    reg [1:0]  state_q;
    reg [31:0] silence_q;                  // ticks left until the host counts as silent
    reg [1:0]  fault_q;
    reg        on_later_q, on_latest_q;    // state, in step with drive_i
    reg [31:0] channel_q;
    reg        hv_enable_q;
    reg        focus_q;
    reg [15:0] focus_left_q;
    reg [31:0] emissions_q;
    reg [31:0] alive_left_q;
    reg        hv_alive_q;

    wire       host_silent = silence_q == 32'd0;
    wire [1:0] cause;
    assign cause[`FAULT_NO_PERMIT]   = state_q != OFF && !run_permit_i;
    assign cause[`FAULT_HOST_SILENT] = state_q != OFF && host_silent;
    wire       shut = cause != 2'b00;
    wire       open = on_latest_q && !shut;

    always @(posedge clk_i) begin
        if (heartbeat_i)       silence_q <= heartbeat_ticks_i;
        else if (!host_silent) silence_q <= silence_q - 32'd1;

        fault_q <= (clear_i ? 2'b00 : fault_q) | cause;

        case (state_q)
            OFF:       if (arm_i) state_q <= RAMP_UP;
            RAMP_UP:   if (disarm_i) state_q <= RAMP_DOWN; else if (ramp_done_i) state_q <= ON;
            ON:        if (disarm_i) state_q <= RAMP_DOWN;
            RAMP_DOWN: if (ramp_done_i) state_q <= OFF;
        endcase
        if (shut) state_q <= OFF;

        on_later_q  <= state_q != OFF && !shut;
        on_latest_q <= on_later_q && !shut;
        channel_q   <= open ? drive_i & channel_mask_i : 32'd0;
        hv_enable_q <= open;

        if (ended_i && open) emissions_q <= emissions_q + 32'd1;
        if (focus_left_q == 16'd0) focus_q <= 1'b0;
        else focus_left_q <= focus_left_q - 16'd1;
        if (ended_i) begin
            focus_q      <= 1'b1;
            focus_left_q <= bit_ticks_i - 16'd1;
        end
        if (!open) begin
            focus_q      <= 1'b0;
            focus_left_q <= 16'd0;
        end

        if (alive_left_q == 32'd0) begin
            alive_left_q <= ALIVE_HALF_TICKS - 1;
            hv_alive_q   <= !hv_alive_q;
        end else alive_left_q <= alive_left_q - 32'd1;
        if (!open) begin
            alive_left_q <= 32'd0;
            hv_alive_q   <= 1'b0;
        end

        if (rst_i) begin
            state_q      <= OFF;
            silence_q    <= 32'd0;
            fault_q      <= 2'b00;
            on_later_q   <= 1'b0;
            on_latest_q  <= 1'b0;
            channel_q    <= 32'd0;
            hv_enable_q  <= 1'b0;
            focus_q      <= 1'b0;
            focus_left_q <= 16'd0;
            emissions_q  <= 32'd0;
            alive_left_q <= 32'd0;
            hv_alive_q   <= 1'b0;
        end
    end

    assign off_o       = state_q == OFF;
    assign armed_o     = state_q == ON;
    assign ramp_up_o   = state_q == RAMP_UP;
    assign ramp_down_o = state_q == RAMP_DOWN;
    assign alive_o     = !host_silent;
    assign shut_o      = shut;
    assign fault_o     = {14'd0, fault_q};
    assign emissions_o = emissions_q;
    assign channel_o   = channel_q;
    assign hv_enable_o = hv_enable_q;
    assign hv_alive_o  = hv_alive_q;
    assign focus_o     = focus_q;
endmodule

`default_nettype wire
