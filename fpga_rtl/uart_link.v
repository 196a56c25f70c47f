// The link by UART: bytes, frames, and the relay in which a frame, whole and good, waits for a pause of the SPI.
`default_nettype none
`include "registers.vh"

module uart_link #(
    parameter [31:0] CLOCK_HZ = 32'd80_000_000,
    parameter [31:0] BAUD     = 32'd1_000_000
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        uart_rx_i,
    output wire        uart_tx_o,
    // the answer's bytes
    output wire        select_o,        // pulse: a frame begins
    input  wire [7:0]  answer_i,
    output wire        take_o,          // pulse
    // state of the core
    input  wire        busy_i,          // with the SPI
    input  wire        landing_busy_i,
    input  wire        landing_live_i,
    // a frame was refused
    output wire        refuse_o,        // pulse
    output wire [7:0]  refusal_o,
    // a frame in its turn: as of frame_relay
    output wire        begin_o,
    output wire        turn_o,
    output wire        accept_o,
    output wire [7:0]  kind_o,
    output wire [7:0]  sequence_o,
    output wire [15:0] argument_o,
    output wire [6:0]  payload_words_o,
    output wire        landing_busy_o,
    output wire        landing_live_o,
    output wire        word_valid_o,
    output wire [7:0]  word_number_o,
    output wire [31:0] word_o,
    output wire        load_word_o
);
    wire        release_frame, partial, byte_valid;
    wire        taken_select, taken_release, taken_byte_valid;
    wire        accept, damaged, refuse_busy, word_valid;
    wire [7:0]  received, damage, word_number;
    wire [31:0] word;

    uart_peripheral #(.CLOCK_HZ(CLOCK_HZ), .BAUD(BAUD)) uart_peripheral (
        .clk_i(clk_i), .rst_i(rst_i), .uart_rx_i(uart_rx_i), .uart_tx_o(uart_tx_o),
        .select_o(select_o), .release_o(release_frame), .partial_o(partial),
        .byte_valid_o(byte_valid), .byte_o(received), .answer_i(answer_i), .answer_take_o(take_o)
    );

    /* verilator lint_off PINCONNECTEMPTY */
    frame_decoder frame_decoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .select_i(taken_select), .release_i(taken_release), .partial_i(partial),
        .byte_valid_i(taken_byte_valid), .byte_i(received),
        .landing_busy_i(1'b0), .landing_live_i(1'b0), .bit_period_i(32'd0),
        .accept_o(accept), .refuse_o(damaged), .refusal_o(damage),
        .type_o(kind_o), .sequence_o(sequence_o), .argument_o(argument_o),
        .landing_busy_o(), .landing_live_o(), .payload_words_o(payload_words_o), .fast_o(),
        .word_valid_o(word_valid), .word_number_o(word_number), .word_o(word), .load_word_o()
    );
    /* verilator lint_on PINCONNECTEMPTY */

    frame_relay frame_relay (
        .clk_i(clk_i), .rst_i(rst_i), .busy_i(busy_i),
        .select_i(select_o), .release_i(release_frame), .byte_valid_i(byte_valid),
        .select_o(taken_select), .release_o(taken_release), .byte_valid_o(taken_byte_valid), .refuse_o(refuse_busy),
        .accept_i(accept), .payload_words_i(payload_words_o),
        .word_valid_i(word_valid), .word_number_i(word_number), .word_i(word),
        .landing_busy_i(landing_busy_i), .landing_live_i(landing_live_i),
        .begin_o(begin_o), .turn_o(turn_o), .word_valid_o(word_valid_o), .word_number_o(word_number_o),
        .word_o(word_o), .accept_o(accept_o), .landing_busy_o(landing_busy_o), .landing_live_o(landing_live_o)
    );

    assign refuse_o    = damaged || refuse_busy;
    assign refusal_o   = refuse_busy ? `RESULT_BUSY : damage;
    assign load_word_o = word_valid_o && kind_o == `TYPE_LOAD && argument_o < {12'd0, `CHUNKS};
endmodule

`default_nettype wire
