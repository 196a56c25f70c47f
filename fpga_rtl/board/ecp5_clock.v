// The clock of an ECP5 with an oscillator of 25 MHz: its PLL, and the FPGA's own oscillator, which watches input and output.
`default_nettype none

module ecp5_clock (
    input  wire clk_25mhz_i,
    output wire clk_o,              // 62.5 MHz
    output wire running_o           // it is there; falls without a clock
);
    // 25 MHz * 5 / 2: the recipe of `ecppll -i 25 -o 62.5`; phase detector at 12.5 MHz, VCO at 625 MHz
    wire locked;
    (* FREQUENCY_PIN_CLKI="25", FREQUENCY_PIN_CLKOP="62.5", ICP_CURRENT="12", LPF_RESISTOR="8",
       MFG_ENABLE_FILTEROPAMP="1", MFG_GMCREF_SEL="2" *)
    EHXPLLL #(
        .PLLRST_ENA("DISABLED"), .INTFB_WAKE("DISABLED"), .STDBY_ENABLE("DISABLED"), .DPHASE_SOURCE("DISABLED"),
        .OUTDIVIDER_MUXA("DIVA"), .OUTDIVIDER_MUXB("DIVB"), .OUTDIVIDER_MUXC("DIVC"), .OUTDIVIDER_MUXD("DIVD"),
        .CLKI_DIV(2), .CLKFB_DIV(5), .FEEDBK_PATH("CLKOP"),
        .CLKOP_ENABLE("ENABLED"), .CLKOP_DIV(10), .CLKOP_CPHASE(4), .CLKOP_FPHASE(0)
    ) pll (
        .CLKI(clk_25mhz_i), .CLKOP(clk_o), .CLKFB(clk_o), .LOCK(locked),
        .RST(1'b0), .STDBY(1'b0), .ENCLKOP(1'b0), .PLLWAKESYNC(1'b0),
        .PHASESEL0(1'b0), .PHASESEL1(1'b0), .PHASEDIR(1'b1), .PHASESTEP(1'b1), .PHASELOADREG(1'b1)
    );

    // The FPGA's own oscillator, 310 MHz / 64 within 15 %, must see both clocks: the lock may stay where they stop (clock_watch.v)
    wire watch, input_lost, clk_lost;
    OSCG #(.DIV(64)) oscillator (.OSC(watch));
    clock_watch #(.TOGGLE_CLOCKS(16), .LIMIT(5)) input_watch (.clk_i(clk_25mhz_i), .watch_i(watch), .lost_o(input_lost));
    clock_watch #(.TOGGLE_CLOCKS(32), .LIMIT(5)) clk_watch (.clk_i(clk_o), .watch_i(watch), .lost_o(clk_lost));
    assign running_o = locked && !input_lost && !clk_lost;
endmodule

`default_nettype wire
