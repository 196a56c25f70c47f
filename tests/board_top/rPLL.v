// A Gowin's PLL for simulation, with feedback from CLKOUT; ranges: those of apycula's gowin_pll for a GW2A of speed C8/I7.
`default_nettype none
`timescale 1ps / 1ps

module rPLL #(
    parameter FCLKIN = "", parameter DEVICE = "", parameter IDIV_SEL = 0, parameter FBDIV_SEL = 0, parameter ODIV_SEL = 8,
    parameter CLKFB_SEL = "", parameter DYN_IDIV_SEL = "", parameter DYN_FBDIV_SEL = "", parameter DYN_ODIV_SEL = "",
    parameter DYN_DA_EN = "", parameter PSDA_SEL = "", parameter DUTYDA_SEL = ""
) (
    input  wire       CLKIN, CLKFB, RESET, RESET_P,
    input  wire [5:0] FBDSEL, IDSEL, ODSEL,
    input  wire [3:0] PSDA, DUTYDA, FDLY,
    output wire       CLKOUT, LOCK
);
    pll_model #(
        .DIVIDE(IDIV_SEL + 1), .MULTIPLY(FBDIV_SEL + 1), .VCO_DIVIDE(ODIV_SEL),
        .PFD_PS_MIN(2_000), .PFD_PS_MAX(333_333), .VCO_PS_MIN(800), .VCO_PS_MAX(2_000)  // 3 to 500, 500 to 1250 MHz
    ) pll (.in(CLKIN), .out(CLKOUT), .lock(LOCK));
endmodule

`default_nettype wire
