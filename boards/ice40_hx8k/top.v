// Haptic panel on the iCE40-HX8K breakout board (iCE40HX8K-B-EVN): PLL, reset, and which header pin is what.
// Headers J1 to J4 have no signal names on the schematic: these are the core's, pins.pcf says where they are.
`default_nettype none

module top #(
    // From board.toml (controller/device/fpga/build_parameters.py); without them nothing is built
    // generated: parameters
    parameter [31:0] BIT_PERIOD_RESET    = 32'd0,
    parameter [31:0] RAMP_SAMPLES_RESET  = 32'd0,
    parameter [31:0] CHANNEL_MASK_MAX    = 32'd0,
    parameter [31:0] HV_SETTLE_TICKS     = 32'd0,
    parameter [31:0] HEARTBEAT_TICKS_MAX = 32'd0,
    parameter [31:0] EDGE_WINDOW_TICKS   = 32'd0,
    parameter [31:0] PULSE_TICKS_MIN     = 32'd0,
    parameter [31:0] CHANNEL_EDGES_MAX   = 32'd0,
    parameter [31:0] TOTAL_EDGES_MAX     = 32'd0,
    parameter [31:0] EMISSION_TICKS_MAX  = 32'd0,
    parameter [31:0] DUTY_SHARE_MAX      = 32'd0,
    parameter [31:0] DUTY_TICKS_MAX      = 32'd0,
    // end of parameters
    parameter [31:0] CLOCK_HZ            = 32'd0,
    parameter [31:0] SLOTS               = 32'd0,
    parameter [31:0] BUILD_HASH          = 32'd0
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
    localparam [31:0] PLL_HZ = 32'd30_000_000;
    generate
        if (CLOCK_HZ != PLL_HZ) begin : not_given
            link_clock_hz_in_board_toml_is_not_the_pll_s from_the_parameters ();
        end
    endgenerate

    // 12 MHz * 80 / 32: the recipe of `icepll -i 12 -o 30`; VCO at 960 MHz
    wire clk, locked;
    SB_PLL40_CORE #(
        .FEEDBACK_PATH("SIMPLE"), .DIVR(4'd0), .DIVF(7'd79), .DIVQ(3'd5), .FILTER_RANGE(3'd1)
    ) pll (
        .REFERENCECLK(iceclk), .PLLOUTGLOBAL(clk), .LOCK(locked), .RESETB(1'b1), .BYPASS(1'b0)
    );

    // Reset from configuration until the PLL has been locked for 16 clocks. A lost lock has the outputs low at once, clock or
    // not (clock_lost_i); all else is reset when the clock is back.
    reset_release reset_release (.clk_i(clk), .running_i(locked), .released_o(configured));

    // The permits stop the pins without a clock too. No second clock watches the first: hv_alive's pump must (README.md)
    wire permitted, run_permit_told, temperature_ok_told;
    permit_latch permit_latch (
        .clk_i(clk), .run_permit_i(run_permit), .temperature_ok_i(temperature_ok),
        .run_permit_o(run_permit_told), .temperature_ok_o(temperature_ok_told), .permitted_o(permitted)
    );

    wire [31:0] driven;
    wire        waiting, driven_enable, driven_alive, driven_focus;
    assign      {channel, hv_enable, hv_alive, focus} = {driven, driven_enable, driven_alive, driven_focus} & {35{permitted}};
    haptic_core #(
        // generated: built_in
        .BIT_PERIOD_RESET(BIT_PERIOD_RESET),
        .RAMP_SAMPLES_RESET(RAMP_SAMPLES_RESET),
        .CHANNEL_MASK_MAX(CHANNEL_MASK_MAX),
        .HV_SETTLE_TICKS(HV_SETTLE_TICKS),
        .HEARTBEAT_TICKS_MAX(HEARTBEAT_TICKS_MAX),
        .EDGE_WINDOW_TICKS(EDGE_WINDOW_TICKS),
        .PULSE_TICKS_MIN(PULSE_TICKS_MIN),
        .CHANNEL_EDGES_MAX(CHANNEL_EDGES_MAX),
        .TOTAL_EDGES_MAX(TOTAL_EDGES_MAX),
        .EMISSION_TICKS_MAX(EMISSION_TICKS_MAX),
        .DUTY_SHARE_MAX(DUTY_SHARE_MAX),
        .DUTY_TICKS_MAX(DUTY_TICKS_MAX),
        // end of built_in
        .BOARD("HX8K"), .UART(32'd0), .CLOCK_HZ(CLOCK_HZ), .SLOTS(SLOTS), .BUILD_HASH(BUILD_HASH)
    ) core (
        .clk_i(clk), .rst_i(!configured), .clock_lost_i(!locked),
        .spi_sck_i(spi_sck), .spi_cs_n_i(spi_cs_n), .spi_mosi_i(spi_mosi), .spi_miso_o(spi_miso),
        .uart_rx_i(rs232_rx), .uart_tx_o(rs232_tx),
        .trigger_i(trigger), .run_permit_i(run_permit_told), .temperature_ok_i(temperature_ok_told),
        .channel_o(driven), .hv_enable_o(driven_enable), .hv_alive_o(driven_alive), .focus_o(driven_focus),
        .waiting_o(waiting), .fault_o(fault)
    );

    assign led = {fault, hv_enable, hv_alive, focus, waiting, temperature_ok, run_permit, configured};
endmodule

`default_nettype wire
