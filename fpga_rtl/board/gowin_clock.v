// The clock of a Gowin GW2A with an oscillator of 27 MHz: its PLL, and the FPGA's own oscillator, which watches input and output.
`default_nettype none

module gowin_clock (
    input  wire clk_27mhz_i,
    output wire clk_o,              // 63 MHz
    output wire running_o           // it is there; falls without a clock
);
    // 27 MHz * 7 / 3: phase detector at 9 MHz, VCO at 1008 MHz
    wire locked;
    rPLL #(
        .FCLKIN("27"), .DEVICE("GW2A-18"), .IDIV_SEL(2), .FBDIV_SEL(6), .ODIV_SEL(16), .CLKFB_SEL("internal"),
        .DYN_IDIV_SEL("false"), .DYN_FBDIV_SEL("false"), .DYN_ODIV_SEL("false"), .DYN_DA_EN("false"),
        .PSDA_SEL("0000"), .DUTYDA_SEL("1000")
    ) pll (
        .CLKIN(clk_27mhz_i), .CLKFB(1'b0), .CLKOUT(clk_o), .LOCK(locked), .RESET(1'b0), .RESET_P(1'b0),
        .FBDSEL(6'd0), .IDSEL(6'd0), .ODSEL(6'd0), .PSDA(4'd0), .DUTYDA(4'd0), .FDLY(4'd0)
    );

    // The FPGA's own oscillator, 250 MHz / 50 within 5 %, must see both clocks: the lock may stay where they stop (clock_watch.v)
    wire oscillating, watch, input_lost, clk_lost;
    OSC #(.FREQ_DIV(50), .DEVICE("GW2A-18")) oscillator (.OSCOUT(oscillating));
    BUFG watch_buffer (.I(oscillating), .O(watch));  // or it would clock by ordinary wires, each flip-flop at another time
    clock_watch #(.TOGGLE_CLOCKS(16), .LIMIT(5)) input_watch (.clk_i(clk_27mhz_i), .watch_i(watch), .lost_o(input_lost));
    clock_watch #(.TOGGLE_CLOCKS(32), .LIMIT(5)) clk_watch (.clk_i(clk_o), .watch_i(watch), .lost_o(clk_lost));
    assign running_o = locked && !input_lost && !clk_lost;
endmodule

`default_nettype wire
