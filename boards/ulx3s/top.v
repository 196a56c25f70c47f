// Haptic panel on a ULX3S with an ECP5-25F: PLL, reset, and which header pin is what.
// Pin names are the schematic's; pins.lpf says where they are and what pulls them when nothing drives them.
`default_nettype none

module top #(
    parameter [31:0] BUILD_HASH = 32'd0             // CRC-32 of fpga_rtl, given by the Makefile
) (
    input  wire        clk_25mhz,
    input  wire        ftdi_txd,                    // from the FTDI to the FPGA
    output wire        ftdi_rxd,                    // from the FPGA to the FTDI
    output wire        wifi_gpio0,
    output wire [7:0]  led,
    inout  wire [27:0] gp,
    inout  wire [27:0] gn
);
    localparam [31:0] CLOCK_HZ = 32'd62_500_000;    // board.toml says the same

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

    // Reset from configuration until the PLL has been locked for 15 clocks; a lost lock resets at once
    reg [15:0] released_q = 16'd0;
    always @(posedge clk or negedge locked) begin
        if (!locked) released_q <= 16'd0;
        else         released_q <= {released_q[14:0], 1'b1};
    end

    wire [31:0] channel;
    wire        configured = released_q[15];        // falls with the lock, without a clock
    wire        hv_enable, hv_alive, focus, waiting, fault;

    haptic_core #(
        .CLOCK_HZ(CLOCK_HZ), .SLOTS(16), .BUILD_HASH(BUILD_HASH), .BOARD("ULX3"), .BAUD(1_000_000)
    ) core (
        .clk_i(clk), .rst_i(!configured),
        .spi_sck_i(gp[8]), .spi_cs_n_i(gn[8]), .spi_mosi_i(gp[9]), .spi_miso_o(gn[9]),
        .uart_rx_i(ftdi_txd), .uart_tx_o(ftdi_rxd),
        .trigger_i(gp[10]), .run_permit_i(gp[26]), .temperature_ok_i(gn[26]),
        .channel_o(channel), .hv_enable_o(hv_enable), .hv_alive_o(hv_alive), .focus_o(focus),
        .waiting_o(waiting), .fault_o(fault)
    );

    // J1: channels 0 to 15 on GP0, GN0 ... GP7, GN7; link on the six pins after them. GP/GN 11 to 13 belong to the ESP32.
    // J2: channels 16 to 31 on GP18, GN18 ... GP25, GN25; safety on the four pins after them. GP/GN 14 to 17 are also ADC inputs.
    genvar pair;
    generate
        for (pair = 0; pair < 8; pair = pair + 1) begin : channels
            assign gp[pair]      = channel[2*pair];
            assign gn[pair]      = channel[2*pair + 1];
            assign gp[pair + 18] = channel[2*pair + 16];
            assign gn[pair + 18] = channel[2*pair + 17];
        end
    endgenerate

    assign gn[10] = configured;
    assign gp[27] = hv_enable;
    assign gn[27] = hv_alive;
    assign gp[17] = focus;
    assign gn[17] = fault;
    assign gp[16] = waiting;

    assign wifi_gpio0 = 1'b1;                       // low would take the board back to its loader
    assign led = {fault, hv_enable, hv_alive, focus, waiting, gn[26], gp[26], configured};
endmodule

`default_nettype wire
