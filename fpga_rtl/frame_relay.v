// Hands a frame of the UART to the core, once its own decoder has accepted it, in a pause of the SPI.
// The SPI is never kept waiting: where chip select falls during the few clocks that it takes, it is done again from its
// beginning behind that frame. A frame that begins while the one before still waits for its pause is refused as BUSY.
// From begin_o on: word k in clock k + 1, accept_o payload_words_i + 40 clocks later, as play_check needs 36.
`default_nettype none
`include "registers.vh"

module frame_relay (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        busy_i,           // a frame of the SPI is on its way to the core, or being carried out
    // between the byte link and the UART's decoder
    input  wire        select_i,         // pulses
    input  wire        release_i,
    input  wire        byte_valid_i,
    output wire        select_o,         // the same, but for frames that are refused here
    output wire        release_o,
    output wire        byte_valid_o,
    output wire        refuse_o,         // pulse: one of them has ended
    // from the decoder
    input  wire        accept_i,
    input  wire [6:0]  payload_words_i,
    input  wire        word_valid_i,
    input  wire [7:0]  word_number_i,
    input  wire [31:0] word_i,
    input  wire        landing_busy_i,
    input  wire        landing_live_i,
    // to the core
    output wire        begin_o,          // pulse
    output wire        turn_o,           // from the clock behind begin_o on: what the decoder holds is what the core is asked
    output wire        word_valid_o,
    output wire [7:0]  word_number_o,
    output wire [31:0] word_o,
    output wire        accept_o,         // pulse
    output wire        landing_busy_o,   // as they were with begin_o
    output wire        landing_live_o
);
    reg        open_q;                   // a frame is coming in, and is taken
    reg        refuse_q;
    reg        full_q;                   // one waits for its turn, or has it
    reg        turn_q;
    reg [7:0]  step_q;                   // clocks since begin_o
    reg        due_q;                    // they are as many as it takes
    reg        landing_busy_q, landing_live_q;
    reg [31:0] words [0:127];
    reg [31:0] word_q;

    wire       start = full_q && !turn_q && !busy_i;
    wire       run   = turn_q && !busy_i;
    wire       last  = due_q && !busy_i;  // due_q only while turn_q

    always @(posedge clk_i) begin
        if (word_valid_i && !word_number_i[7]) words[word_number_i[6:0]] <= word_i;
        if (full_q) word_q <= words[step_q[6:0]];
    end

    always @(posedge clk_i) begin
        if (select_o) open_q <= 1'b1;
        else if (release_i) open_q <= 1'b0;
        refuse_q <= release_i && !open_q;

        if (accept_i) full_q <= 1'b1;
        else if (last) full_q <= 1'b0;
        if (full_q) begin
            turn_q <= start || (run && !last);
            step_q <= start || (run && !last) ? step_q + 8'd1 : 8'd0;
            due_q  <= run && step_q == {1'b0, payload_words_i} + 8'd39;
        end
        if (start) begin
            landing_busy_q <= landing_busy_i;
            landing_live_q <= landing_live_i;
        end

        if (rst_i) begin
            open_q         <= 1'b0;
            refuse_q       <= 1'b0;
            full_q         <= 1'b0;
            turn_q         <= 1'b0;
            step_q         <= 8'd0;
            due_q          <= 1'b0;
            landing_busy_q <= 1'b0;
            landing_live_q <= 1'b0;
        end
    end

    assign select_o       = select_i && !full_q;
    assign release_o      = release_i && open_q;
    assign byte_valid_o   = byte_valid_i && open_q;
    assign refuse_o       = refuse_q;
    assign begin_o        = start;
    assign turn_o         = turn_q;
    assign word_valid_o   = run && step_q <= {1'b0, payload_words_i};
    assign word_number_o  = step_q - 8'd1;
    assign word_o         = word_q;
    assign accept_o       = last;
    assign landing_busy_o = landing_busy_q;
    assign landing_live_o = landing_live_q;

`ifdef FORMAL
    `include "frame_relay_properties.vh"
`endif
endmodule

`default_nettype wire
