// A Gowin's input pad for simulation.
`default_nettype none
`timescale 1ps / 1ps

module IBUF (
    input  wire I,
    output wire O
);
    assign O = I;
endmodule

`default_nettype wire
