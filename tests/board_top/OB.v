// The ECP5's output buffer for simulation.
`default_nettype none

module OB (
    input  wire I,
    output wire O
);
    assign O = I;
endmodule

`default_nettype wire
