// SLOTS + 1 waveform buffers in one block of memory behind a map: a slot names a buffer, the odd one out is where
// uploads land. Storing exchanges the two, so loading never touches what plays or waits to play.
`default_nettype none
`include "registers.vh"

module waveform_buffer #(
    parameter SLOTS = 4,             // 1 to 16
    parameter BUFFER_BITS = 3        // enough for SLOTS + 1
) (
    input  wire                   clk_i,
    input  wire                   rst_i,
    // words of a LOAD as they arrive; its chunk counts once the frame is accepted
    input  wire                   write_i,
    input  wire [2:0]             write_chunk_i,
    input  wire [6:0]             write_word_i,
    input  wire [31:0]            write_data_i,
    // accepted frames
    input  wire                   load_i,         // pulse
    input  wire                   store_i,        // pulse
    input  wire [15:0]            argument_i,     // chunk or slot
    input  wire [31:0]            word0_i,        // STORE: length in words
    input  wire [6:0]             load_words_i,
    input  wire                   landing_busy_i, // when the frame began
    output wire [7:0]             load_result_o,
    output wire [7:0]             store_result_o,
    // what a slot holds
    output wire                   slot_good_o,    // argument_i names a slot
    output wire [BUFFER_BITS-1:0] slot_buffer_o,
    output wire [9:0]             slot_words_o,   // 0: nothing
    output wire [31:0]            loaded_o,
    output wire [BUFFER_BITS-1:0] landing_o,
    // player; data_o one clock after its address
    input  wire [BUFFER_BITS-1:0] read_buffer_i,
    input  wire [9:0]             read_word_i,
    output wire [31:0]            read_data_o
);
    localparam SLOT_BITS = SLOTS > 1 ? $clog2(SLOTS) : 1;

    reg [31:0] memory [0:(SLOTS+1)*1024-1];
    reg [31:0] read_data_q;

    reg [BUFFER_BITS-1:0] slot_buffer_q [0:SLOTS-1];
    reg [9:0]             slot_words_q  [0:SLOTS-1];
    reg [BUFFER_BITS-1:0] landing_q;
    reg [6:0]             chunk_words_q [0:7];  // 0: does not count

    wire [9:0] write_word = {write_chunk_i, 7'd0} - {6'd0, write_chunk_i, 1'b0} - {7'd0, write_chunk_i} + {3'd0, write_word_i};

    always @(posedge clk_i) begin
        if (write_i) memory[{landing_q, write_word}] <= write_data_i;
        read_data_q <= memory[{read_buffer_i, read_word_i}];
    end

    wire                 slot_good = argument_i < SLOTS[15:0];
    wire [SLOT_BITS-1:0] slot      = slot_good ? argument_i[SLOT_BITS-1:0] : {SLOT_BITS{1'b0}};

    reg  complete;
    always @* begin : check
        integer chunk;
        complete = 1'b1;
        for (chunk = 0; chunk < 8; chunk = chunk + 1)
            // a whole chunk is asked for where the waveform reaches beyond it, else what is left
            if (word0_i[10:0] >= 11'd125 * (chunk[10:0] + 11'd1)) begin
                if (chunk_words_q[chunk] != 7'd125) complete = 1'b0;
            end else if ({4'd0, chunk_words_q[chunk]} + 11'd125 * chunk[10:0] < word0_i[10:0]) complete = 1'b0;
    end

    wire chunk_good  = argument_i < {12'd0, `CHUNKS};
    wire length_good = word0_i != 32'd0 && word0_i <= {21'd0, `WAVEFORM_WORDS};
    wire load_good   = chunk_good && !landing_busy_i;
    wire store_good  = slot_good && length_good && complete;

    always @(posedge clk_i) begin : book
        integer index;
        if (write_i)             chunk_words_q[write_chunk_i]   <= 7'd0;
        if (load_i && load_good) chunk_words_q[argument_i[2:0]] <= load_words_i;
        if (store_i && store_good) begin
            slot_buffer_q[slot] <= landing_q;
            slot_words_q[slot]  <= word0_i[9:0];
            landing_q           <= slot_buffer_q[slot];
            for (index = 0; index < 8; index = index + 1) chunk_words_q[index] <= 7'd0;
        end
        if (rst_i) begin
            landing_q <= SLOTS[BUFFER_BITS-1:0];
            for (index = 0; index < 8; index = index + 1) chunk_words_q[index] <= 7'd0;
            for (index = 0; index < SLOTS; index = index + 1) begin
                slot_buffer_q[index] <= index[BUFFER_BITS-1:0];
                slot_words_q[index]  <= 10'd0;
            end
        end
    end

    genvar number;
    generate
        for (number = 0; number < 32; number = number + 1) begin : loaded
            if (number < SLOTS) begin : present
                assign loaded_o[number] = slot_words_q[number] != 10'd0;
            end else begin : absent
                assign loaded_o[number] = 1'b0;
            end
        end
    endgenerate

    assign load_result_o  = !chunk_good ? `RESULT_BAD_CHUNK : landing_busy_i ? `RESULT_BUSY : `RESULT_OK;
    assign store_result_o = !slot_good ? `RESULT_BAD_SLOT : !length_good ? `RESULT_BAD_VALUE
                          : !complete ? `RESULT_INCOMPLETE : `RESULT_OK;
    assign slot_good_o    = slot_good;
    assign slot_buffer_o  = slot_buffer_q[slot];
    assign slot_words_o   = slot_words_q[slot];
    assign landing_o      = landing_q;
    assign read_data_o    = read_data_q;
endmodule

`default_nettype wire
