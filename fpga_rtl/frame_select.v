// Which link's frame the core is asked. What it asks rests long before it is accepted: chosen a clock early, it begins no long
// path. It is chosen, and found out what it means, only in clocks in which it may have changed. Its first words are gathered as
// they come; every frame of the UART brings them again in its turn.
`default_nettype none
`include "registers.vh"

module frame_select (
    input  wire         clk_i,
    input  wire         rst_i,
    // the SPI's frame
    input  wire         spi_taken_i,          // pulse: its decoder takes something in: a word comes a clock later
    input  wire         spi_accept_i,
    input  wire [7:0]   spi_kind_i, spi_sequence_i,
    input  wire [15:0]  spi_argument_i,
    input  wire [6:0]   spi_payload_words_i,
    input  wire         spi_landing_busy_i, spi_landing_live_i,
    input  wire         spi_fast_i,
    input  wire         spi_word_valid_i, spi_load_word_i,
    input  wire [7:0]   spi_word_number_i,
    input  wire [31:0]  spi_word_i,
    // the UART's, in its turn
    input  wire         uart_begin_i, uart_turn_i,
    input  wire         uart_accept_i,
    input  wire [7:0]   uart_kind_i, uart_sequence_i,
    input  wire [15:0]  uart_argument_i,
    input  wire [6:0]   uart_payload_words_i,
    input  wire         uart_landing_busy_i, uart_landing_live_i,
    input  wire         uart_word_valid_i, uart_load_word_i,
    input  wire [7:0]   uart_word_number_i,
    input  wire [31:0]  uart_word_i,
    // the one chosen
    output wire         judge_o,              // it may have changed a clock ago, or is accepted: results hold only then
    output wire         accept_o,             // pulse
    output wire [7:0]   kind_o, sequence_o,
    output wire         read_o, write_o, load_o, store_o, play_o,  // pulses: it is accepted, and of this kind
    output wire [15:0]  argument_o,
    output wire [6:0]   payload_words_o,
    output wire [191:0] words_o,              // first six of the payload, the first lowest
    output wire         landing_busy_o, landing_live_o,
    output wire         fast_o,               // the last LOAD's words came as fast as they would play; never by the UART
    output wire         load_word_o, play_word_o,  // pulse: a word of a LOAD, of a PLAY
    output wire         lengths_o,            // pulse: words 0 to 2 of a PLAY are there
    output wire [6:0]   word_number_o,
    output wire [31:0]  word_o
);
    reg  [7:0]   kind_q, sequence_q;
    reg  [15:0]  argument_q;
    reg  [191:0] words_q;
    reg  [6:0]   payload_words_q;
    reg  [1:0]   taken_q;
    reg          returned_q, fast_q, lengths_q;
    reg          is_read_q, is_write_q, is_load_q, is_store_q, is_play_q;

    wire         from_uart = uart_begin_i || uart_turn_i;
    wire [7:0]   kind      = from_uart ? uart_kind_i : spi_kind_i;
    wire         choose    = taken_q != 2'b00 || from_uart || returned_q;

    wire         word_valid  = spi_word_valid_i || uart_word_valid_i;
    wire [7:0]   word_number = uart_turn_i ? uart_word_number_i : spi_word_number_i;

    reg          load_word, play_word;
    always @* begin
        load_word = 1'b0;
        play_word = 1'b0;
        if (word_valid) begin
            load_word = spi_load_word_i || uart_load_word_i;
            play_word = is_play_q;
        end
    end

    always @(posedge clk_i) begin
        taken_q    <= {taken_q[0], spi_taken_i};
        returned_q <= uart_turn_i;
        if (choose) begin
            kind_q          <= kind;
            is_read_q       <= kind == `TYPE_READ;
            is_write_q      <= kind == `TYPE_WRITE;
            is_load_q       <= kind == `TYPE_LOAD;
            is_store_q      <= kind == `TYPE_STORE;
            is_play_q       <= kind == `TYPE_PLAY;
            sequence_q      <= from_uart ? uart_sequence_i      : spi_sequence_i;
            argument_q      <= from_uart ? uart_argument_i      : spi_argument_i;
            payload_words_q <= from_uart ? uart_payload_words_i : spi_payload_words_i;
        end
        if (word_valid && word_number < 8'd6) words_q[{word_number[2:0], 5'd0} +: 32] <= word_o;
        lengths_q <= play_word && word_number == 8'd2;
        if (load_o) fast_q <= spi_fast_i && !uart_turn_i;
        if (rst_i) begin
            kind_q          <= `TYPE_NOP;
            {is_read_q, is_write_q, is_load_q, is_store_q, is_play_q} <= 5'd0;
            sequence_q      <= 8'd0;
            argument_q      <= 16'd0;
            words_q         <= 192'd0;
            payload_words_q <= 7'd0;
            taken_q         <= 2'b00;
            returned_q      <= 1'b0;
            fast_q          <= 1'b0;
            lengths_q       <= 1'b0;
        end
    end

`ifdef SYNTHESIS
    assign judge_o         = 1'b1;            // on an FPGA it costs nothing to find out what has not changed
`else
    reg          chosen_q;
    always @(posedge clk_i) chosen_q <= choose && !rst_i;
    assign judge_o         = chosen_q || accept_o;
`endif
    assign accept_o        = spi_accept_i || uart_accept_i;
    assign kind_o          = kind_q;
    assign read_o          = accept_o && is_read_q;
    assign write_o         = accept_o && is_write_q;
    assign load_o          = accept_o && is_load_q;
    assign store_o         = accept_o && is_store_q;
    assign play_o          = accept_o && is_play_q;
    assign sequence_o      = sequence_q;
    assign argument_o      = argument_q;
    assign payload_words_o = payload_words_q;
    assign words_o         = words_q;
    assign landing_busy_o  = uart_turn_i ? uart_landing_busy_i : spi_landing_busy_i;
    assign landing_live_o  = uart_turn_i ? uart_landing_live_i : spi_landing_live_i;
    assign fast_o          = fast_q;
    assign load_word_o     = load_word;
    assign play_word_o     = play_word;
    assign lengths_o       = lengths_q;
    assign word_number_o   = word_number[6:0];
    assign word_o          = uart_turn_i ? uart_word_i : spi_word_i;
endmodule

`default_nettype wire
