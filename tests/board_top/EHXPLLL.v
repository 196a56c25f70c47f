// The ECP5's PLL for simulation, with feedback from CLKOP; ranges: data sheet FPGA-DS-02012.
`default_nettype none
`timescale 1ps / 1ps

module EHXPLLL #(
    parameter PLLRST_ENA = "", parameter INTFB_WAKE = "", parameter STDBY_ENABLE = "", parameter DPHASE_SOURCE = "",
    parameter OUTDIVIDER_MUXA = "", parameter OUTDIVIDER_MUXB = "", parameter OUTDIVIDER_MUXC = "",
    parameter OUTDIVIDER_MUXD = "", parameter CLKI_DIV = 1, parameter CLKFB_DIV = 1, parameter FEEDBK_PATH = "",
    parameter CLKOP_ENABLE = "", parameter CLKOP_DIV = 1, parameter CLKOP_CPHASE = 0, parameter CLKOP_FPHASE = 0
) (
    input  wire CLKI,
    output wire CLKOP,
    input  wire CLKFB,
    output wire LOCK,
    input  wire RST, STDBY, ENCLKOP, PLLWAKESYNC, PHASESEL0, PHASESEL1, PHASEDIR, PHASESTEP, PHASELOADREG
);
    pll_model #(
        .DIVIDE(CLKI_DIV), .MULTIPLY(CLKFB_DIV), .VCO_DIVIDE(CLKOP_DIV),
        .PFD_PS_MIN(2_500), .PFD_PS_MAX(320_000), .VCO_PS_MIN(1_250), .VCO_PS_MAX(2_500)  // 3.125 to 400, 400 to 800 MHz
    ) pll (.in(CLKI), .out(CLKOP), .lock(LOCK));
endmodule

`default_nettype wire
