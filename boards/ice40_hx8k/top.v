// Haptic panel on the iCE40-HX8K breakout board (iCE40HX8K-B-EVN): PLL, reset, and which header pin is what.
// Headers J1 to J4 have no signal names on the schematic: these are the core's, pins.pcf says where they are.
`default_nettype none

module top #(
    parameter [31:0] BUILD_HASH = 32'd0             // CRC-32 of fpga_rtl, given by the Makefile
) (
    input  wire        iceclk,                      // 12 MHz
    input  wire        rs232_rx,                    // from the FTDI's channel B to the FPGA
    output wire        rs232_tx,                    // from the FPGA to the FTDI
    output wire [7:0]  led,
    input  wire        spi_sck,
    input  wire        spi_cs_n,
    input  wire        spi_mosi,
    output wire        spi_miso,
    input  wire        trigger,
    input  wire        run_permit,
    input  wire        temperature_ok,
    output wire [31:0] channel,
    output wire        hv_enable,
    output wire        hv_alive,
    output wire        focus,
    output wire        configured,                  // has its clock and is out of reset
    output wire        fault
);
    localparam [31:0] CLOCK_HZ = 32'd30_000_000;    // board.toml says the same

    // 12 MHz * 80 / 32: the recipe of `icepll -i 12 -o 30`; VCO at 960 MHz
    wire clk, locked;
    SB_PLL40_CORE #(
        .FEEDBACK_PATH("SIMPLE"), .DIVR(4'd0), .DIVF(7'd79), .DIVQ(3'd5), .FILTER_RANGE(3'd1)
    ) pll (
        .REFERENCECLK(iceclk), .PLLOUTGLOBAL(clk), .LOCK(locked), .RESETB(1'b1), .BYPASS(1'b0)
    );

    // Reset from configuration until the PLL has been locked for 15 clocks; a lost lock resets at once
    reg [15:0] released_q = 16'd0;
    always @(posedge clk or negedge locked) begin
        if (!locked) released_q <= 16'd0;
        else         released_q <= {released_q[14:0], 1'b1};
    end

    wire waiting;
    haptic_core #(
        .CLOCK_HZ(CLOCK_HZ), .SLOTS(2), .BUILD_HASH(BUILD_HASH), .BOARD("HX8K"), .BAUD(1_000_000)
    ) core (
        .clk_i(clk), .rst_i(!configured),
        .spi_sck_i(spi_sck), .spi_cs_n_i(spi_cs_n), .spi_mosi_i(spi_mosi), .spi_miso_o(spi_miso),
        .uart_rx_i(rs232_rx), .uart_tx_o(rs232_tx),
        .trigger_i(trigger), .run_permit_i(run_permit), .temperature_ok_i(temperature_ok),
        .channel_o(channel), .hv_enable_o(hv_enable), .hv_alive_o(hv_alive), .focus_o(focus),
        .waiting_o(waiting), .fault_o(fault)
    );

    assign configured = released_q[15];             // falls with the lock, without a clock
    assign led = {fault, hv_enable, hv_alive, focus, waiting, temperature_ok, run_permit, configured};
endmodule

`default_nettype wire
