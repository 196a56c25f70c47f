// Is there a clock? A second one, of an oscillator of its own, must see the first one toggle: a PLL's lock may stay where its input
// has stopped (Lattice's note 793 on sysCLOCK PLLs: LOCK is registered by that input).
// lost_o is high from configuration until the first is seen, and again LIMIT clocks of the second, and two, behind its last toggle.
`default_nettype none

module clock_watch #(
    parameter TOGGLE_CLOCKS = 64,   // of clk_i from a toggle to the next
    parameter LIMIT         = 8     // clocks of watch_i without one
) (
    input  wire clk_i,
    input  wire watch_i,            // the second clock: faster than two for each toggle
    output wire lost_o
);
    localparam COUNT_BITS = $clog2(TOGGLE_CLOCKS) + 1;
    localparam LEFT_BITS  = $clog2(LIMIT + 1);

    // There is no reset before there is a clock: all begin with the configuration. The highest bit is the toggle
    /* verilator lint_off PROCASSINIT */
    reg [COUNT_BITS-1:0] count_q = {COUNT_BITS{1'b0}};
    always @(posedge clk_i) count_q <= count_q + 1'b1;

    (* keep *) reg [2:0] seen_q = 3'b000;        // two flip-flops, and the one before
    reg [LEFT_BITS-1:0]  left_q = {LEFT_BITS{1'b0}};
    reg                  lost_q = 1'b1;
    /* verilator lint_on PROCASSINIT */
    wire                 toggled = seen_q[2] != seen_q[1];
    always @(posedge watch_i) begin
        seen_q <= {seen_q[1:0], count_q[COUNT_BITS-1]};
        lost_q <= !toggled && left_q == {LEFT_BITS{1'b0}};
        if (toggled)                            left_q <= LIMIT[LEFT_BITS-1:0];
        else if (left_q != {LEFT_BITS{1'b0}})   left_q <= left_q - 1'b1;
    end
    assign lost_o = lost_q;
endmodule

`default_nettype wire
