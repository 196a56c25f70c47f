// SLOTS + 1 waveform buffers behind a map: a slot names a buffer, the odd one out is where uploads land.
// Storing exchanges the two, so loading never touches what plays or waits to play. What has been stored is read
// back from memory and its CRC taken, one word a clock; only a slot whose CRC matches counts as loaded.
`default_nettype none
`include "registers.vh"

module waveform_buffer #(
    parameter SLOTS = 4,             // 1 to 16
    parameter BUFFER_BITS = 3        // enough for SLOTS + 1
) (
    input  wire                   clk_i,
    input  wire                   rst_i,
    input  wire                   judge_i,        // results, slot_words_o and slot_checking_o hold only then
    input  wire                   look_i,         // the frame is a STORE: whether it finds its words is looked for
    // words of a LOAD as they arrive; its chunk counts once the frame is accepted
    input  wire                   write_i,
    input  wire [6:0]             write_word_i,
    input  wire [31:0]            write_data_i,
    // accepted frames
    input  wire                   load_i,         // pulse
    input  wire                   store_i,        // pulse
    input  wire [15:0]            argument_i,     // chunk, slot, or address of a READ
    input  wire [31:0]            word0_i,        // STORE: length in words
    input  wire [31:0]            word1_i,        // STORE: CRC of the slot
    input  wire [6:0]             load_words_i,
    input  wire                   load_busy_i,    // when the frame began, the landing buffer was used by what a slot held
    input  wire                   load_live_i,    // when the frame began, it was played while it arrives
    input  wire                   live_i,         // it is now, or waits to be
    output wire [7:0]             load_result_o,
    output wire [7:0]             store_result_o,
    // what a slot holds
    output wire                   slot_good_o,    // argument_i names a slot
    output wire [BUFFER_BITS-1:0] slot_buffer_o,
    output wire [9:0]             slot_words_o,   // 0: nothing
    output wire                   slot_intact_o,  // its CRC matches
    output wire                   slot_checking_o,
    output wire [15:0]            loaded_o,
    output wire                   checking_o,
    output wire [BUFFER_BITS-1:0] landing_o,
    output wire [7:0]             chunks_o,       // of the landing buffer that count
    // READ of memory and of a slot's CRC
    output wire [7:0]             memory_result_o,
    output wire [31:0]            memory_data_o,
    output wire [7:0]             crc_result_o,
    output wire [31:0]            crc_data_o,
    // player; data two clocks after its address
    input  wire                   play_i,         // it reads
    input  wire [BUFFER_BITS-1:0] play_buffer_i,
    input  wire [9:0]             play_word_i,
    input  wire [2:0]             play_chunk_i,   // the same word within its chunk
    input  wire [6:0]             play_within_i,
    output wire                   missing_o,      // that word of the landing buffer has not arrived
    output wire [31:0]            play_data_o
);
    localparam SLOT_BITS = SLOTS > 1 ? $clog2(SLOTS) : 1;

    reg [BUFFER_BITS-1:0] slot_buffer_q [0:SLOTS-1];
    reg [9:0]             slot_words_q  [0:SLOTS-1];
    reg [31:0]            slot_crc_q    [0:SLOTS-1];
    reg [SLOTS-1:0]       intact_q;
    reg [BUFFER_BITS-1:0] landing_q;
    reg [6:0]             chunk_words_q [0:7];  // 0: does not count
    reg [7:0]             chunks_q;             // which do

    reg                   check_q;
    reg [SLOT_BITS-1:0]   check_slot_q;
    reg [BUFFER_BITS-1:0] check_buffer_q;
    reg [9:0]             check_word_q, check_words_q;
    reg [31:0]            expected_q;
    reg [2:0]             reading_q;            // of the three clocks a word takes
    reg [31:0]            data_q;
    reg [2:0]             settled_q;            // clocks for which the address of a READ has had its way, up to 4

    // Memory: the player has the first word on a buffer's address, then the check, then a READ
    wire       read_memory = argument_i[15];
    wire [4:0] number      = read_memory ? argument_i[14:10] : argument_i[4:0];
    wire       slot_good   = (read_memory || argument_i[7:5] == 3'd0) && number < SLOTS[4:0];
    wire [SLOT_BITS-1:0]   slot        = slot_good ? number[SLOT_BITS-1:0] : {SLOT_BITS{1'b0}};
    wire [BUFFER_BITS-1:0] slot_buffer = slot_buffer_q[slot];
    wire [BUFFER_BITS-1:0] buffer      = check_q ? check_buffer_q : slot_buffer;
    wire [9:0]             word        = check_q ? check_word_q : argument_i[9:0];
    wire [2:0]             chunk       = argument_i[2:0];
    wire                   count_good  = load_live_i ? !chunks_q[chunk] : !load_busy_i;
    wire                   write       = write_i && !load_busy_i && count_good;
    wire [9:0]  write_word = {chunk, 7'd0} - {6'd0, chunk, 1'b0} - {7'd0, chunk} + {3'd0, write_word_i};
    wire [31:0] read_data [0:SLOTS];

    genvar index;
    generate
        for (index = 0; index <= SLOTS; index = index + 1) begin : buffers
            buffer_memory buffer_memory (
                .clk_i(clk_i),
                .write_i(write), .here_i(landing_q == index), .write_word_i(write_word), .write_data_i(write_data_i),
                .read_word_i(play_i && play_buffer_i == index ? play_word_i : word), .read_data_o(read_data[index])
            );
        end
        for (index = 0; index < 16; index = index + 1) begin : loaded
            if (index < SLOTS) begin : present
                assign loaded_o[index] = intact_q[index];
            end else begin : absent
                assign loaded_o[index] = 1'b0;
            end
        end
    endgenerate

    // Whether a STORE finds all its words: chunk by chunk, over and over, long before its frame ends
    reg [2:0]  look_q;
    reg [9:0]  left_q;               // words of the waveform from that chunk on
    reg        whole_q;              // so far
    reg        complete_q;
    wire [6:0] there = chunk_words_q[look_q];
    always @(posedge clk_i) begin
        if (look_i) begin
            look_q  <= look_q + 3'd1;
            left_q  <= left_q > 10'd125 ? left_q - 10'd125 : 10'd0;
            whole_q <= whole_q && there >= (left_q > 10'd125 ? 7'd125 : left_q[6:0]);
            if (look_q == 3'd7) begin
                left_q     <= word0_i[9:0];
                whole_q    <= 1'b1;
                complete_q <= whole_q && {3'd0, there} >= left_q;
            end
        end
        if (rst_i) begin
            look_q     <= 3'd0;
            left_q     <= 10'd0;
            whole_q    <= 1'b0;
            complete_q <= 1'b0;
        end
    end

    // Book-keeping
    wire store_slot = slot_good && argument_i[15:8] == 8'd0;
    reg  chunk_good, length_good, load_good, store_good, checking;
    reg  [9:0] slot_words;
    always @* begin
        {chunk_good, length_good, load_good, store_good, checking, slot_words} = 15'd0;
        if (judge_i) begin
            chunk_good  = argument_i < {12'd0, `CHUNKS};
            length_good = word0_i != 32'd0 && word0_i <= {21'd0, `WAVEFORM_WORDS};
            load_good   = chunk_good && !load_busy_i && count_good;
            store_good  = store_slot && length_good && !check_q && !live_i && complete_q;
            checking    = check_q && check_slot_q == slot;
            slot_words  = slot_words_q[slot];
        end
    end

    wire        reading  = check_q && check_word_q != check_words_q;
    wire        checked  = check_q && !reading && reading_q == 3'd0;
    wire [31:0] crc;
    crc32_word crc32_slot (
        .clk_i(clk_i), .rst_i(rst_i), .clear_i(store_i && store_good), .valid_i(reading_q[2]), .word_i(data_q), .crc_o(crc)
    );

    always @(posedge clk_i) begin : book
        integer piece;
        data_q <= read_data[buffer];
        reading_q <= {reading_q[1:0], reading};
        if (reading) check_word_q <= check_word_q + 10'd1;
        if (checked) begin
            check_q                  <= 1'b0;
            slot_crc_q[check_slot_q] <= crc;
            intact_q[check_slot_q]   <= crc == expected_q;
        end

        if (write) begin
            chunk_words_q[chunk] <= 7'd0;
            chunks_q[chunk]      <= 1'b0;
        end
        if (load_i && load_good) begin
            chunk_words_q[chunk] <= load_words_i;
            chunks_q[chunk]      <= load_words_i != 7'd0;
        end
        if (store_i && store_good) begin
            slot_buffer_q[slot] <= landing_q;
            slot_words_q[slot]  <= word0_i[9:0];
            intact_q[slot]      <= 1'b0;
            landing_q           <= slot_buffer;
            chunks_q            <= 8'd0;
            for (piece = 0; piece < 8; piece = piece + 1) chunk_words_q[piece] <= 7'd0;
            check_q        <= 1'b1;
            check_slot_q   <= slot;
            check_buffer_q <= landing_q;
            check_word_q   <= 10'd0;
            check_words_q  <= word0_i[9:0];
            expected_q     <= word1_i;
        end

        if (check_q || (play_i && play_buffer_i == slot_buffer)) settled_q <= 3'd0;
        else if (settled_q != 3'd4) settled_q <= settled_q + 3'd1;

        if (rst_i) begin
            landing_q <= SLOTS[BUFFER_BITS-1:0];
            chunks_q  <= 8'd0;
            for (piece = 0; piece < 8; piece = piece + 1) chunk_words_q[piece] <= 7'd0;
            for (piece = 0; piece < SLOTS; piece = piece + 1) begin
                slot_buffer_q[piece] <= piece[BUFFER_BITS-1:0];
                slot_words_q[piece]  <= 10'd0;
                slot_crc_q[piece]    <= 32'd0;
            end
            intact_q       <= {SLOTS{1'b0}};
            check_q        <= 1'b0;
            check_slot_q   <= {SLOT_BITS{1'b0}};
            check_buffer_q <= {BUFFER_BITS{1'b0}};
            check_word_q   <= 10'd0;
            check_words_q  <= 10'd0;
            expected_q     <= 32'd0;
            reading_q      <= 3'd0;
            data_q         <= 32'd0;
            settled_q      <= 3'd0;
        end
    end

    reg [7:0] load_result, store_result, memory_result, crc_result;
    always @* begin
        load_result   = `RESULT_OK;
        store_result  = `RESULT_OK;
        memory_result = `RESULT_OK;
        crc_result    = `RESULT_OK;
        if (judge_i) begin
            load_result   = !chunk_good ? `RESULT_BAD_CHUNK : !load_good ? `RESULT_BUSY : `RESULT_OK;
            store_result  = !store_slot ? `RESULT_BAD_SLOT : !length_good ? `RESULT_BAD_VALUE
                          : check_q || live_i ? `RESULT_BUSY : !complete_q ? `RESULT_INCOMPLETE : `RESULT_OK;
            memory_result = !slot_good ? `RESULT_BAD_SLOT : argument_i[9:0] >= slot_words ? `RESULT_BAD_RANGE
                          : settled_q != 3'd4 ? `RESULT_BUSY : `RESULT_OK;
            crc_result    = !slot_good ? `RESULT_BAD_SLOT : slot_words == 10'd0 ? `RESULT_EMPTY_SLOT
                          : checking ? `RESULT_BUSY : `RESULT_OK;
        end
    end

    assign load_result_o   = load_result;
    assign store_result_o  = store_result;
    assign memory_result_o = memory_result;
    assign memory_data_o   = data_q;
    assign crc_result_o    = crc_result;
    assign chunks_o        = chunks_q;
    assign crc_data_o      = slot_crc_q[slot];
    assign slot_good_o     = store_slot;
    assign slot_buffer_o   = slot_buffer;
    assign slot_words_o    = slot_words;
    assign slot_intact_o   = intact_q[slot];
    assign slot_checking_o = checking;
    assign checking_o      = check_q;
    assign landing_o       = landing_q;
    assign missing_o       = play_within_i >= chunk_words_q[play_chunk_i];
    assign play_data_o     = read_data[play_buffer_i];
endmodule

`default_nettype wire
