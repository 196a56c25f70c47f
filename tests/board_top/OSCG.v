// The ECP5's internal oscillator for simulation: 310 MHz / DIV (data sheet FPGA-DS-02012: within 15 %).
`default_nettype none
`timescale 1ps / 1ps

module OSCG #(
    parameter DIV = 128
) (
    output reg OSC
);
    initial OSC = 1'b0;
    always #(DIV * 1_000_000 / 310 / 2) OSC = !OSC;
endmodule

`default_nettype wire
