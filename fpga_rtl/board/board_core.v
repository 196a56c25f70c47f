// All that lies between the pads of a board and its clock: reset, the permits' way to the pads without a clock, and the core.
// It has no cell of any FPGA; the clock is that of the board's FPGA (ecp5_clock.v), which also tells whether it is there.
`default_nettype none

module board_core #(
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
    parameter [31:0] BUILD_HASH          = 32'd0,
    parameter [31:0] PLL_HZ              = 32'd0,   // what the clock's PLL makes
    parameter [31:0] BOARD               = "NONE",
    parameter [31:0] BAUD                = 32'd1_000_000
) (
    input  wire        clk_i,
    input  wire        running_i,                   // the clock is there; falls without one
    output wire        configured_o,                // out of reset; falls with the clock, without one
    input  wire        spi_sck_i,
    input  wire        spi_cs_n_i,
    input  wire        spi_mosi_i,
    output wire        spi_miso_o,
    input  wire        uart_rx_i,
    output wire        uart_tx_o,
    input  wire        trigger_i,
    input  wire        run_permit_i,                // the pins: both must be driven high to run
    input  wire        temperature_ok_i,
    output wire [31:0] channel_o,
    output wire        hv_enable_o,
    output wire        hv_alive_o,
    output wire        focus_o,
    output wire        waiting_o,
    output wire        fault_o
);
    generate
        if (CLOCK_HZ != PLL_HZ) begin : not_given
            link_clock_hz_in_board_toml_is_not_the_pll_s from_the_parameters ();
        end
    endgenerate

    // Reset from configuration until the clock has been there for 16 clocks. A lost one has the outputs low at once, clock or
    // not (clock_lost_i); all else is reset when it is back.
    reset_release reset_release (.clk_i(clk_i), .running_i(running_i), .released_o(configured_o));

    // The permits stop the pins without a clock too
    wire permitted, run_permit_told, temperature_ok_told;
    permit_latch permit_latch (
        .clk_i(clk_i), .run_permit_i(run_permit_i), .temperature_ok_i(temperature_ok_i),
        .run_permit_o(run_permit_told), .temperature_ok_o(temperature_ok_told), .permitted_o(permitted)
    );
    wire [31:0] driven;
    wire        driven_enable, driven_alive, driven_focus;
    assign      {channel_o, hv_enable_o, hv_alive_o, focus_o} = {driven, driven_enable, driven_alive, driven_focus} & {35{permitted}};

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
        .BOARD(BOARD), .BAUD(BAUD), .CLOCK_HZ(CLOCK_HZ), .SLOTS(SLOTS), .BUILD_HASH(BUILD_HASH)
    ) core (
        .clk_i(clk_i), .rst_i(!configured_o), .clock_lost_i(!running_i),
        .spi_sck_i(spi_sck_i), .spi_cs_n_i(spi_cs_n_i), .spi_mosi_i(spi_mosi_i), .spi_miso_o(spi_miso_o),
        .uart_rx_i(uart_rx_i), .uart_tx_o(uart_tx_o),
        .trigger_i(trigger_i), .run_permit_i(run_permit_told), .temperature_ok_i(temperature_ok_told),
        .channel_o(driven), .hv_enable_o(driven_enable), .hv_alive_o(driven_alive), .focus_o(driven_focus),
        .waiting_o(waiting_o), .fault_o(fault_o)
    );
endmodule

`default_nettype wire
