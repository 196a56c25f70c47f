// For a bench: UART, frame_decoder and status_encoder as haptic_core would join them, with nothing behind.
`default_nettype none
`include "registers.vh"

module uart_panel #(
    parameter [31:0] CLOCK_HZ     = 32'd80_000_000,
    parameter [31:0] BAUD         = 32'd1_000_000,
    parameter [31:0] STATUS_BYTES = 32'd36
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        uart_rx_i,
    output wire        uart_tx_o,
    output wire        accept_o,
    output wire        refuse_o,
    output wire        write_o,
    output wire [31:0] write_data_o
);
    wire       select, release_frame, partial, byte_valid, take;
    wire [7:0] byte_in, answer, refusal, sequence_number;
    reg  [7:0] result_q, sequence_q;
    reg [63:0] timestamp_q;

    uart_peripheral #(.CLOCK_HZ(CLOCK_HZ), .BAUD(BAUD), .STATUS_BYTES(STATUS_BYTES)) uart_peripheral (
        .clk_i(clk_i), .rst_i(rst_i), .uart_rx_i(uart_rx_i), .uart_tx_o(uart_tx_o),
        .select_o(select), .release_o(release_frame), .partial_o(partial),
        .byte_valid_o(byte_valid), .byte_o(byte_in), .answer_i(answer), .answer_take_o(take)
    );

    /* verilator lint_off PINCONNECTEMPTY */
    frame_decoder frame_decoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .select_i(select), .release_i(release_frame), .partial_i(partial),
        .byte_valid_i(byte_valid), .byte_i(byte_in),
        .landing_busy_i(1'b0), .landing_live_i(1'b0), .bit_period_i(32'd0),
        .accept_o(accept_o), .refuse_o(refuse_o), .refusal_o(refusal),
        .type_o(), .sequence_o(sequence_number), .argument_o(),
        .landing_busy_o(), .landing_live_o(), .payload_words_o(), .fast_o(),
        .word_valid_o(), .word_number_o(), .word_o(write_data_o), .load_word_o(write_o)
    );
    /* verilator lint_on PINCONNECTEMPTY */

    always @(posedge clk_i) begin
        timestamp_q <= timestamp_q + 64'd1;
        if (refuse_o) result_q <= refusal;
        if (accept_o) begin
            result_q   <= `RESULT_OK;
            sequence_q <= sequence_number;
        end
        if (rst_i) begin
            timestamp_q <= 64'd0;
            result_q    <= `RESULT_OK;
            sequence_q  <= 8'd0;
        end
    end

    status_encoder status_encoder (
        .clk_i(clk_i), .rst_i(rst_i), .select_i(select), .take_i(take), .byte_o(answer),
        .result_i(result_q), .sequence_i(sequence_q), .state_i(16'h0040), .fault_i(16'd0), .data_i(32'h00FF0001),
        .triggers_i(32'd0), .timestamp_i(timestamp_q), .emissions_i(32'd0),
        .queued_i(8'd0), .chunks_i(8'd0), .ignored_i(16'd0),
        .echo_i(1'b0), .byte_valid_i(byte_valid), .byte_i(byte_in)
    );
endmodule

`default_nettype wire
