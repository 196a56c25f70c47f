// From configuration, and from a lost clock on: reset until the clock has been there for CLOCKS clocks. It begins without a clock.
`default_nettype none

module reset_release #(
    parameter CLOCKS = 16
) (
    input  wire clk_i,
    input  wire running_i,          // the clock is there
    output wire released_o
);
    /* verilator lint_off PROCASSINIT */
    reg [CLOCKS-1:0] released_q = {CLOCKS{1'b0}};  // begins with the configuration: what would reset it?
    /* verilator lint_on PROCASSINIT */
    always @(posedge clk_i or negedge running_i) begin
        if (!running_i) released_q <= {CLOCKS{1'b0}};
        else            released_q <= {released_q[CLOCKS-2:0], 1'b1};
    end
    assign released_o = released_q[CLOCKS-1];
`ifdef FORMAL
    `include "reset_release_properties.vh"
`endif
endmodule

`default_nettype wire
