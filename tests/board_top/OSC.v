// A Gowin's internal oscillator for simulation: 250 MHz / FREQ_DIV.
`default_nettype none
`timescale 1ps / 1ps

module OSC #(
    parameter FREQ_DIV = 100, parameter DEVICE = ""
) (
    output reg OSCOUT
);
    initial OSCOUT = 1'b0;
    always #(FREQ_DIV * 2_000) OSCOUT = !OSCOUT;
endmodule

`default_nettype wire
