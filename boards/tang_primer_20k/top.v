// Haptic panel on a Tang Primer 20K in its Lite extension board: its pads. pins.cst says where each is, and what pulls it when nothing
// drives it; pins.sdc names the two buffers here, through which clocks come in.
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
    input  wire        clk_27mhz,
    input  wire        uart_rx,
    output wire        uart_tx,
    input  wire        spi_sck,
    input  wire        spi_cs_n,
    input  wire        spi_mosi,
    output wire        spi_miso,
    input  wire        trigger,
    output wire        configured,
    input  wire        run_permit,
    input  wire        temperature_ok,
    output wire [31:0] channel,
    output wire        hv_enable,
    output wire        hv_alive,
    output wire        focus,
    output wire        fault,
    output wire        waiting
);
    wire clk, running, clk_27mhz_in, spi_sck_in;
    IBUF clk_pad (.I(clk_27mhz), .O(clk_27mhz_in));
    IBUF sck_pad (.I(spi_sck), .O(spi_sck_in));
    gowin_clock clock (.clk_27mhz_i(clk_27mhz_in), .clk_o(clk), .running_o(running));

    board_core #(
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
        .BOARD("TP20"), .PLL_HZ(32'd63_000_000), .BAUD(1_000_000),
        .CLOCK_HZ(CLOCK_HZ), .SLOTS(SLOTS), .BUILD_HASH(BUILD_HASH)
    ) board (
        .clk_i(clk), .running_i(running), .configured_o(configured),
        .spi_sck_i(spi_sck_in), .spi_cs_n_i(spi_cs_n), .spi_mosi_i(spi_mosi), .spi_miso_o(spi_miso),
        .uart_rx_i(uart_rx), .uart_tx_o(uart_tx), .trigger_i(trigger),
        .run_permit_i(run_permit), .temperature_ok_i(temperature_ok),
        .channel_o(channel), .hv_enable_o(hv_enable), .hv_alive_o(hv_alive), .focus_o(focus),
        .waiting_o(waiting), .fault_o(fault)
    );
endmodule

`default_nettype wire
