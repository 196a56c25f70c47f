// The ECP5's PLL for simulation: CLKOP from the period of CLKI that it measures, with feedback from CLKOP.
// It locks after LOCK_EDGES periods, if phase detector and VCO are within their ranges (data sheet FPGA-DS-02012), and
// stops, as the worst that a PLL may do, when CLKI does; LOCK falls LOST periods later, or, with +lock_stays, never. With +clk_stops
// it is the PLL that stops, under its lock; with +lock_blinks its LOCK is lost once, for a nanosecond, between edges of CLKOP.
`default_nettype none
`timescale 1ps / 1ps

module EHXPLLL #(
    parameter PLLRST_ENA = "", parameter INTFB_WAKE = "", parameter STDBY_ENABLE = "", parameter DPHASE_SOURCE = "",
    parameter OUTDIVIDER_MUXA = "", parameter OUTDIVIDER_MUXB = "", parameter OUTDIVIDER_MUXC = "",
    parameter OUTDIVIDER_MUXD = "", parameter CLKI_DIV = 1, parameter CLKFB_DIV = 1, parameter FEEDBK_PATH = "",
    parameter CLKOP_ENABLE = "", parameter CLKOP_DIV = 1, parameter CLKOP_CPHASE = 0, parameter CLKOP_FPHASE = 0
) (
    input  wire CLKI,
    output reg  CLKOP,
    input  wire CLKFB,
    output reg  LOCK,
    input  wire RST, STDBY, ENCLKOP, PLLWAKESYNC, PHASESEL0, PHASESEL1, PHASEDIR, PHASESTEP, PHASELOADREG
);
    localparam LOCK_EDGES = 16, LOST = 4;

    integer edges = 0, period_ps = 0, half_ps, vco_ps;
    reg     blinked = 1'b0;
    time    last_ps = 0;
    wire    in_range = period_ps * CLKI_DIV <= 320_000 && period_ps * CLKI_DIV >= 2_500   // 3.125 to 400 MHz
                       && vco_ps >= 1_250 && vco_ps <= 2_500;                             // 400 to 800 MHz

    initial begin
        CLKOP = 1'b0;
        LOCK  = 1'b0;
    end

    always @(posedge CLKI) begin
        period_ps = $time - last_ps;
        last_ps   = $time;
        half_ps   = period_ps * CLKI_DIV / CLKFB_DIV / 2;
        vco_ps    = period_ps * CLKI_DIV / CLKFB_DIV / CLKOP_DIV;
        edges     = in_range ? edges + 1 : 0;
    end

    always begin
        if (edges > LOCK_EDGES && $time - last_ps <= 2 * period_ps && !$test$plusargs("clk_stops")) begin
            LOCK = 1'b1;
            if (!blinked && $test$plusargs("lock_blinks")) begin
                blinked = 1'b1;
                #1_000 LOCK = 1'b0;
                #1_000 LOCK = 1'b1;
                #(half_ps - 2_000) CLKOP = !CLKOP;
            end else #half_ps CLKOP = !CLKOP;
        end else if (LOCK && $time - last_ps > LOST * period_ps && edges != 0) begin
            LOCK  = $test$plusargs("lock_stays") != 0;
            edges = 0;
        end else #(LOCK && in_range ? period_ps : 1_000);
    end
endmodule

`default_nettype wire
