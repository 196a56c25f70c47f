// The frames of spi_peripheral over a UART, 8N1: each one COBS-encoded and ended by a zero, each answered likewise.
// The answer is what answer_i holds when a frame's first byte has come, sent while the rest of the frame comes in.
// A frame that begins before the last byte of the answer before has begun gets none.
// At least 8 clocks a bit; the rate is right to 1/512 of a clock per bit.
`default_nettype none

module uart_peripheral #(
    parameter [31:0] CLOCK_HZ     = 32'd80_000_000,
    parameter [31:0] BAUD         = 32'd1_000_000,
    parameter [31:0] STATUS_BYTES = 32'd36         // of an answer, up to 126
) (
    input  wire       clk_i,
    input  wire       rst_i,
    input  wire       uart_rx_i,
    output wire       uart_tx_o,
    output wire       select_o,       // pulse: the first byte of a frame has come
    output wire       release_o,      // pulse: the zero that ends it has come
    output wire       partial_o,      // with release_o: malformed, or a stop bit was missing
    output wire       byte_valid_o,   // pulse
    output wire [7:0] byte_o,
    input  wire [7:0] answer_i,       // next byte to send
    output wire       answer_take_o   // pulse: taken
);
    localparam [63:0] BIT_TICKS_512 = {32'd0, CLOCK_HZ} * 64'd512 / {32'd0, BAUD};
    localparam [63:0] BIT_TICKS_256 = (BIT_TICKS_512 + 64'd1) / 64'd2;

    wire       in_valid, in_error, out_valid, out_ready;
    wire [7:0] in_byte, out_byte;

    uart_receiver #(.BIT_TICKS_256(BIT_TICKS_256[31:0])) uart_receiver (
        .clk_i(clk_i), .rst_i(rst_i), .uart_rx_i(uart_rx_i),
        .byte_valid_o(in_valid), .byte_o(in_byte), .error_o(in_error)
    );

    cobs_decoder cobs_decoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .byte_valid_i(in_valid), .byte_i(in_byte), .error_i(in_error),
        .select_o(select_o), .release_o(release_o), .partial_o(partial_o),
        .byte_valid_o(byte_valid_o), .byte_o(byte_o)
    );

    cobs_encoder #(.BYTES(STATUS_BYTES)) cobs_encoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .start_i(select_o), .byte_i(answer_i), .take_o(answer_take_o),
        .valid_o(out_valid), .byte_o(out_byte), .ready_i(out_ready)
    );

    uart_transmitter #(.BIT_TICKS_256(BIT_TICKS_256[31:0])) uart_transmitter (
        .clk_i(clk_i), .rst_i(rst_i),
        .valid_i(out_valid), .byte_i(out_byte), .ready_o(out_ready), .uart_tx_o(uart_tx_o)
    );
endmodule

`default_nettype wire
