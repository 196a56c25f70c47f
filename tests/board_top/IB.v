// The ECP5's input buffer for simulation.
`default_nettype none

module IB (
    input  wire I,
    output wire O
);
    assign O = I;
endmodule

`default_nettype wire
