// Haptic panel on a ULX3S with an ECP5-25F: PLL, reset, and which header pin is what.
// Pin names are the schematic's; pins.lpf says where they are and what pulls them when nothing drives them.
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
    input  wire        clk_25mhz,
    input  wire        ftdi_txd,                    // from the FTDI to the FPGA
    output wire        ftdi_rxd,                    // from the FPGA to the FTDI
    output wire        wifi_gpio0,
    output wire [7:0]  led,
    inout  wire [27:0] gp,
    inout  wire [27:0] gn
);
    localparam [31:0] PLL_HZ = 32'd62_500_000;
    generate
        if (CLOCK_HZ != PLL_HZ) begin : not_given
            link_clock_hz_in_board_toml_is_not_the_pll_s from_the_parameters ();
        end
    endgenerate

    // 25 MHz * 5 / 2: the recipe of `ecppll -i 25 -o 62.5`; phase detector at 12.5 MHz, VCO at 625 MHz
    wire clk, locked;
    (* FREQUENCY_PIN_CLKI="25", FREQUENCY_PIN_CLKOP="62.5", ICP_CURRENT="12", LPF_RESISTOR="8",
       MFG_ENABLE_FILTEROPAMP="1", MFG_GMCREF_SEL="2" *)
    EHXPLLL #(
        .PLLRST_ENA("DISABLED"), .INTFB_WAKE("DISABLED"), .STDBY_ENABLE("DISABLED"), .DPHASE_SOURCE("DISABLED"),
        .OUTDIVIDER_MUXA("DIVA"), .OUTDIVIDER_MUXB("DIVB"), .OUTDIVIDER_MUXC("DIVC"), .OUTDIVIDER_MUXD("DIVD"),
        .CLKI_DIV(2), .CLKFB_DIV(5), .FEEDBK_PATH("CLKOP"),
        .CLKOP_ENABLE("ENABLED"), .CLKOP_DIV(10), .CLKOP_CPHASE(4), .CLKOP_FPHASE(0)
    ) pll (
        .CLKI(clk_25mhz), .CLKOP(clk), .CLKFB(clk), .LOCK(locked),
        .RST(1'b0), .STDBY(1'b0), .ENCLKOP(1'b0), .PLLWAKESYNC(1'b0),
        .PHASESEL0(1'b0), .PHASESEL1(1'b0), .PHASEDIR(1'b1), .PHASESTEP(1'b1), .PHASELOADREG(1'b1)
    );

    // The FPGA's own oscillator, 310 MHz / 64 within 15 %, must see both clocks: the lock may stay where they stop (clock_watch.v)
    wire watch, input_lost, clk_lost;
    OSCG #(.DIV(64)) oscillator (.OSC(watch));
    clock_watch #(.TOGGLE_CLOCKS(16), .LIMIT(5)) input_watch (.clk_i(clk_25mhz), .watch_i(watch), .lost_o(input_lost));
    clock_watch #(.TOGGLE_CLOCKS(32), .LIMIT(5)) clk_watch (.clk_i(clk), .watch_i(watch), .lost_o(clk_lost));
    wire running = locked && !input_lost && !clk_lost;

    // Reset from configuration until the clock has been there for 16 clocks. A lost one has the outputs low at once, clock or
    // not (clock_lost_i); all else is reset when it is back.
    wire configured;                                // falls with the clock, without one
    reset_release reset_release (.clk_i(clk), .running_i(running), .released_o(configured));

    // The permits stop the pins without a clock too
    wire run_permit, temperature_ok, permitted, run_permit_told, temperature_ok_told;
    permit_latch permit_latch (
        .clk_i(clk), .run_permit_i(run_permit), .temperature_ok_i(temperature_ok),
        .run_permit_o(run_permit_told), .temperature_ok_o(temperature_ok_told), .permitted_o(permitted)
    );

    wire [31:0] driven, channel;
    wire        spi_sck, spi_cs_n, spi_mosi, trigger;
    wire        spi_miso, hv_enable, hv_alive, focus, waiting, fault, driven_enable, driven_alive, driven_focus;
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
        .BOARD("ULX3"), .BAUD(1_000_000), .CLOCK_HZ(CLOCK_HZ), .SLOTS(SLOTS), .BUILD_HASH(BUILD_HASH)
    ) core (
        .clk_i(clk), .rst_i(!configured), .clock_lost_i(!running),
        .spi_sck_i(spi_sck), .spi_cs_n_i(spi_cs_n), .spi_mosi_i(spi_mosi), .spi_miso_o(spi_miso),
        .uart_rx_i(ftdi_txd), .uart_tx_o(ftdi_rxd),
        .trigger_i(trigger), .run_permit_i(run_permit_told), .temperature_ok_i(temperature_ok_told),
        .channel_o(driven), .hv_enable_o(driven_enable), .hv_alive_o(driven_alive), .focus_o(driven_focus),
        .waiting_o(waiting), .fault_o(fault)
    );

    // J1: channels 0 to 15 on GP0, GN0 ... GP7, GN7; link on the six pins after them. GP/GN 11 to 13 belong to the ESP32.
    // J2: channels 16 to 31 on GP18, GN18 ... GP25, GN25; safety on the four pins after them. GP/GN 14 to 17 are also ADC inputs.
    // Each by a buffer, the unused too. Assigned to a pin of an inout bus, what the core reads of its outputs came back from the pad;
    // read from one of which other pins are driven, an input is a constant 0 for Yosys, and nextpnr drives its pin low.
    genvar pair;
    generate
        for (pair = 0; pair < 8; pair = pair + 1) begin : channels
            OB low_p  (.I(channel[2*pair]),      .O(gp[pair]));
            OB low_n  (.I(channel[2*pair + 1]),  .O(gn[pair]));
            OB high_p (.I(channel[2*pair + 16]), .O(gp[pair + 18]));
            OB high_n (.I(channel[2*pair + 17]), .O(gn[pair + 18]));
        end
    endgenerate

    IB spi_sck_pad        (.I(gp[8]),  .O(spi_sck));
    IB spi_cs_n_pad       (.I(gn[8]),  .O(spi_cs_n));
    IB spi_mosi_pad       (.I(gp[9]),  .O(spi_mosi));
    IB trigger_pad        (.I(gp[10]), .O(trigger));
    IB run_permit_pad     (.I(gp[26]), .O(run_permit));
    IB temperature_ok_pad (.I(gn[26]), .O(temperature_ok));

    wire [15:11] unused_gp;
    wire [16:11] unused_gn;
    genvar pin;
    generate
        for (pin = 11; pin <= 15; pin = pin + 1) begin : unused
            (* keep *) IB left_gp (.I(gp[pin]), .O(unused_gp[pin]));
            (* keep *) IB left_gn (.I(gn[pin]), .O(unused_gn[pin]));
        end
    endgenerate
    (* keep *) IB left_gn16 (.I(gn[16]), .O(unused_gn[16]));

    OB spi_miso_pad   (.I(spi_miso),   .O(gn[9]));
    OB configured_pad (.I(configured), .O(gn[10]));
    OB hv_enable_pad  (.I(hv_enable),  .O(gp[27]));
    OB hv_alive_pad   (.I(hv_alive),   .O(gn[27]));
    OB focus_pad      (.I(focus),      .O(gp[17]));
    OB fault_pad      (.I(fault),      .O(gn[17]));
    OB waiting_pad    (.I(waiting),    .O(gp[16]));

    assign wifi_gpio0 = 1'b1;                       // low would take the board back to its loader
    assign led = {fault, hv_enable, hv_alive, focus, waiting, temperature_ok, run_permit, configured};
endmodule

`default_nettype wire
