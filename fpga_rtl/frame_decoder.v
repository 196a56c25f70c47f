// Frames from bytes: a frame counts only when it ends with the right sync word, length and CRC.
// Words of a LOAD leave for the landing buffer as they come in; whoever takes them lets them count only with accept_o.
`default_nettype none
`include "registers.vh"

module frame_decoder (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        select_i,        // pulse: a frame begins
    input  wire        release_i,       // pulse: it has ended
    input  wire        partial_i,       // with release_i: the last byte is not whole
    input  wire        byte_valid_i,
    input  wire [7:0]  byte_i,
    input  wire        landing_busy_i,
    input  wire        landing_live_i,
    input  wire [31:0] bit_period_i,
    output wire        accept_o,        // pulse; the fields below hold until the next frame begins
    output wire        refuse_o,        // pulse, with refusal_o
    output wire [7:0]  refusal_o,
    output wire [7:0]  type_o,
    output wire [7:0]  sequence_o,
    output wire [15:0] argument_o,
    output wire        landing_busy_o,  // as they were when the frame began
    output wire        landing_live_o,
    output wire [6:0]  payload_words_o,
    output wire        fast_o,          // its words came at least as fast as they would play
    output wire        word_valid_o,    // pulse: a word of the payload, which counts only with accept_o
    output wire [7:0]  word_number_o,
    output wire [31:0] word_o,
    output wire        load_word_o      // pulse: it is one of a LOAD for the landing buffer
);
    localparam [15:0] SYNC = `FRAME_SYNC;

    reg        accept_q, refuse_q;
    reg [7:0]  refusal_q;
    reg        sync_good_q;
    reg [7:0]  type_q, sequence_q;
    reg [15:0] length_q, argument_q;
    reg        landing_busy_q, landing_live_q;
    reg [9:0]  count_q;                 // bytes so far, held at its highest: no frame is that long
    reg [31:0] recent_q;                // last four bytes
    reg        word_valid_q;            // recent_q is a word of the payload that the header promises
    reg        length_good_q, lands_q;  // of the header; it is one of a LOAD for the landing buffer
    reg [7:0]  word_number_q;
    reg signed [39:0] ahead_q;          // 65536ths of a clock by which the words would outlast the frame so far

    wire is_load = type_q == `TYPE_LOAD;
    wire is_long = is_load || type_q == `TYPE_TEST;
    reg  length_good, whole;
    always @* begin
        length_good = 1'b0;
        whole       = 1'b0;
        if (byte_valid_i) begin
            length_good = is_long
                ? length_q >= `LOAD_PAYLOAD_MIN_BYTES && length_q <= `LOAD_PAYLOAD_MAX_BYTES && length_q[1:0] == 2'b00
                : length_q == `SHORT_PAYLOAD_BYTES;
        end
        if (release_i) whole = length_good_q && !partial_i && {7'd0, count_q} == {1'b0, length_q} + `FRAME_OVERHEAD_BYTES;
    end

    wire [31:0] crc;
    crc32 crc32_frame (
        .clk_i(clk_i), .rst_i(rst_i), .clear_i(select_i), .valid_i(byte_valid_i), .byte_i(byte_i), .crc_o(crc)
    );

    always @(posedge clk_i) begin
        word_valid_q <= 1'b0;
        if (byte_valid_i) begin
            // the header rests since byte 7
            length_good_q <= length_good;
            lands_q       <= is_load && sync_good_q && argument_q < {12'd0, `CHUNKS};
            word_valid_q  <= count_q[9:3] != 7'd0 && count_q[1:0] == 2'd3 && count_q[9:2] - 8'd2 < {1'b0, length_q[8:2]};
            word_number_q <= count_q[9:2] - 8'd2;
            recent_q <= {byte_i, recent_q[31:8]};
            if (count_q != 10'h3FF) count_q <= count_q + 10'd1;
            case (count_q)
                `FRAME_SYNC_AT:             sync_good_q      <= byte_i == SYNC[7:0];
                `FRAME_SYNC_AT + 10'd1:     sync_good_q      <= sync_good_q && byte_i == SYNC[15:8];
                `FRAME_TYPE_AT:             type_q           <= byte_i;
                `FRAME_SEQUENCE_AT:         sequence_q       <= byte_i;
                `FRAME_LENGTH_AT:           length_q[7:0]    <= byte_i;
                `FRAME_LENGTH_AT + 10'd1:   length_q[15:8]   <= byte_i;
                `FRAME_ARGUMENT_AT:         argument_q[7:0]  <= byte_i;
                `FRAME_ARGUMENT_AT + 10'd1: argument_q[15:8] <= byte_i;
                default: ;
            endcase
        end

        if (ahead_q[39:38] != 2'b10)  // long behind: it stays so
            ahead_q <= ahead_q - 40'sd65536 + (word_valid_q ? $signed({8'd0, bit_period_i}) : 40'sd0);
        if (select_i) ahead_q <= 40'sd0;

        accept_q <= 1'b0;
        refuse_q <= 1'b0;
        if (release_i) begin
            accept_q <= sync_good_q && whole && crc == `CRC_RESIDUE;
            refuse_q <= !(sync_good_q && whole && crc == `CRC_RESIDUE);
            if (!sync_good_q) refusal_q <= `RESULT_BAD_SYNC;
            else if (!whole)  refusal_q <= `RESULT_BAD_LENGTH;
            else              refusal_q <= `RESULT_BAD_CRC;
        end

        if (select_i) begin
            sync_good_q    <= 1'b0;
            length_good_q  <= 1'b0;
            length_q       <= 16'd0;
            type_q         <= `TYPE_NOP;
            count_q        <= 10'd0;
            landing_busy_q <= landing_busy_i;
            landing_live_q <= landing_live_i;
        end

        if (rst_i) begin
            accept_q       <= 1'b0;
            refuse_q       <= 1'b0;
            refusal_q      <= `RESULT_OK;
            sync_good_q    <= 1'b0;
            type_q         <= `TYPE_NOP;
            sequence_q     <= 8'd0;
            length_q       <= 16'd0;
            argument_q     <= 16'd0;
            landing_busy_q <= 1'b0;
            landing_live_q <= 1'b0;
            ahead_q        <= 40'sd0;
            count_q        <= 10'd0;
            recent_q       <= 32'd0;
            length_good_q  <= 1'b0;
            lands_q        <= 1'b0;
            word_valid_q   <= 1'b0;
            word_number_q  <= 8'd0;
        end
    end

    assign accept_o        = accept_q;
    assign refuse_o        = refuse_q;
    assign refusal_o       = refusal_q;
    assign type_o          = type_q;
    assign sequence_o      = sequence_q;
    assign argument_o      = argument_q;
    assign landing_busy_o  = landing_busy_q;
    assign landing_live_o  = landing_live_q;
    assign payload_words_o = length_q[8:2];
    assign fast_o          = !ahead_q[39];
    assign word_valid_o    = word_valid_q && length_good_q;
    assign word_number_o   = word_number_q;
    assign word_o          = recent_q;
    assign load_word_o     = word_valid_q && length_good_q && lands_q;

`ifdef FORMAL
    `include "frame_decoder_properties.vh"
`endif
endmodule

`default_nettype wire
