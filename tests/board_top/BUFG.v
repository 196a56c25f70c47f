// A Gowin's way of a signal into the network of clocks, for simulation.
`default_nettype none
`timescale 1ps / 1ps

module BUFG (
    input  wire I,
    output wire O
);
    assign O = I;
endmodule

`default_nettype wire
