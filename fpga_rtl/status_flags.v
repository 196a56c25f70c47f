// State bits of a status, as its frame begins.
`default_nettype none
`include "registers.vh"

module status_flags (
    input  wire        sample_i,         // the flags are asked for
    input  wire        armed_i,
    input  wire        ramping_i,        // to idle or from there, or about to
    input  wire        playing_i,
    input  wire        repeating_i,
    input  wire        pending_i,        // a play is in the queue
    input  wire        landing_busy_i,
    input  wire        run_permit_i,
    input  wire        alive_i,          // the link that armed has sent a frame in time
    input  wire        hv_enable_i,
    input  wire        temperature_ok_i,
    input  wire        checking_i,       // STORE compares a CRC
    input  wire        delayed_i,
    input  wire        waiting_i,
    output reg  [15:0] state_o
);
    always @* begin
        state_o = 16'd0;
        if (sample_i) begin
            state_o[`STATE_ARMED]            = armed_i;
            state_o[`STATE_RAMPING]          = ramping_i;
            state_o[`STATE_PLAYING]          = playing_i;
            state_o[`STATE_REPEATING]        = repeating_i;
            state_o[`STATE_PENDING]          = pending_i;
            state_o[`STATE_LANDING_BUSY]     = landing_busy_i;
            state_o[`STATE_RUN_PERMIT]       = run_permit_i;
            state_o[`STATE_HEARTBEAT]        = alive_i;
            state_o[`STATE_HV_ENABLE]        = hv_enable_i;
            state_o[`STATE_TEMPERATURE_GOOD] = temperature_ok_i;
            state_o[`STATE_CHECKING]         = checking_i;
            state_o[`STATE_DELAYED]          = delayed_i;
            state_o[`STATE_WAITING]          = waiting_i;
        end
    end
endmodule

`default_nettype wire
