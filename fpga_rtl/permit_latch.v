// The permits from their pins: what they stop is low at once, clock or not (permitted_o gates the pins), and what the core is told
// lasts for clocks, however short it was. So a permit that is lost for a moment is lost for the core as well, and its outputs
// have been shut, with their cause, before permitted_o lets them through again: only an ARM has them back.
`default_nettype none

module permit_latch (
    input  wire clk_i,
    input  wire run_permit_i,       // the pins
    input  wire temperature_ok_i,
    output wire run_permit_o,       // for the core, which has its own synchronisers
    output wire temperature_ok_o,
    output wire permitted_o         // low with either pin, without a clock; high HELD clocks after both are
);
    localparam HELD = 10, TOLD = 2;  // the core sees a low of TOLD clocks or more, and has shut 4 clocks behind its first

    (* keep *) reg [HELD-1:0] run_q, cool_q;
    always @(posedge clk_i or negedge run_permit_i) begin
        if (!run_permit_i) run_q <= {HELD{1'b0}};
        else               run_q <= {run_q[HELD-2:0], 1'b1};
    end
    always @(posedge clk_i or negedge temperature_ok_i) begin
        if (!temperature_ok_i) cool_q <= {HELD{1'b0}};
        else                   cool_q <= {cool_q[HELD-2:0], 1'b1};
    end

    assign run_permit_o     = run_q[TOLD];
    assign temperature_ok_o = cool_q[TOLD];
    assign permitted_o      = run_q[HELD-1] && cool_q[HELD-1];
`ifdef FORMAL
    `include "permit_latch_properties.vh"
`endif
endmodule

`default_nettype wire
