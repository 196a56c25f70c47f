// SLOTS + 1 waveform buffers behind a map: a slot names a buffer, the odd one out is where uploads land.
// Storing exchanges the two, so loading never touches what plays or waits to play. What has been stored is read
// back from memory and its CRC taken, one word a clock; only a slot whose CRC matches counts as loaded.
// All buffers share one address to read. The player has it in the clock in which it comes to a word, and keeps what it read. The check
// reads two words at once, in the first of two clocks, or in the second if the player has the first; a READ has what is left.
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
    // player; data two clocks after play_read_i, until the next
    input  wire                   play_i,         // it plays
    input  wire                   play_read_i,    // pulse: it has come to another word; never in two clocks one behind the other
    input  wire [BUFFER_BITS-1:0] play_buffer_i,
    input  wire [9:0]             play_word_i,
    input  wire [2:0]             play_chunk_i,   // the same word within its chunk
    input  wire [6:0]             play_within_i,
    output wire                   missing_o,      // that word of the landing buffer has not arrived
    output wire [31:0]            play_data_o
);
    localparam [SLOTS-1:0] FIRST = 1;           // slot 0, a bit for each
    localparam SLOT_BITS = SLOTS > 1 ? $clog2(SLOTS) : 1;

    // Of each slot and chunk, in memories without a reset: what they hold counts where the bit beside them is set
    reg [BUFFER_BITS+9:0] slots [0:SLOTS-1];    // buffer, words
    reg [31:0]            slot_crcs [0:SLOTS-1];    // inverted, as the register of a CRC holds it
    reg [SLOTS-1:0]       stored_q, intact_q;
    reg [BUFFER_BITS-1:0] landing_q;
    reg [6:0]             chunk_words [0:7];
    reg [7:0]             chunks_q;

    reg                   check_q;
    reg [SLOT_BITS-1:0]   check_slot_q;
    reg [SLOTS-1:0]       checked_slot_q;       // the same, a bit for each
    reg [BUFFER_BITS-1:0] check_buffer_q;
    reg [9:0]             check_word_q, check_last_q;
    reg                   walks_q;              // a word of it is read in this clock, or owed
    reg [31:0]            expected_q;
    reg [2:0]             reading_q;            // of the three clocks a word takes
    reg                   owed_q;               // its pair is to be read in this clock, as the player had the one before
    reg                   fetched_q, played_q;  // a clock ago a pair was read, for the check or a READ; for the player
    reg                   play_odd_q;
    reg [31:0]            even_q, odd_q, odd_later_q, play_data_q;
    reg [2:0]             settled_q;            // clocks for which the address of a READ of memory has had its way, up to 4

    wire       read_memory = argument_i[15];
    // What the argument names rests long before its frame ends: found out a clock early, and whether it is a word of that slot two
    reg [SLOT_BITS-1:0]    slot;
    reg [SLOTS-1:0]        slot_q;              // the same, a bit for each
    reg                    slot_good_q, store_slot_q, within_q, chunk_good_q, length_good_q;
    reg [BUFFER_BITS-1:0]  slot_buffer;
    reg [9:0]              slot_words;
    always @(posedge clk_i) begin : names
        reg [4:0]           number;
        reg                 slot_good;
        reg [SLOT_BITS-1:0] named;
        if (judge_i || read_memory) begin
            number        = read_memory ? argument_i[14:10] : argument_i[4:0];
            slot_good     = (read_memory || argument_i[7:5] == 3'd0) && number < SLOTS[4:0];
            named         = slot_good ? number[SLOT_BITS-1:0] : {SLOT_BITS{1'b0}};
            slot          <= named;
            slot_q        <= FIRST << named;
            slot_good_q   <= slot_good;
            store_slot_q  <= slot_good && argument_i[15:8] == 8'd0;
            {slot_buffer, slot_words} <= stored_q[named] ? slots[named] : {{BUFFER_BITS-SLOT_BITS{1'b0}}, named, 10'd0};
            within_q      <= argument_i[9:0] < slot_words;
            chunk_good_q  <= argument_i[15:3] == 13'd0;       // CHUNKS is 8
            length_good_q <= word0_i[31:10] == 22'd0 && word0_i[9:0] != 10'd0 && {1'b0, word0_i[9:0]} <= `WAVEFORM_WORDS;
        end
        if (rst_i) begin
            slot          <= {SLOT_BITS{1'b0}};
            slot_q        <= FIRST;
            slot_good_q   <= 1'b0;
            store_slot_q  <= 1'b0;
            slot_buffer   <= {BUFFER_BITS{1'b0}};
            slot_words    <= 10'd0;
            within_q      <= 1'b0;
            chunk_good_q  <= 1'b0;
            length_good_q <= 1'b0;
        end
    end
    wire [2:0]             chunk       = argument_i[2:0];
    wire                   count_good  = load_live_i ? !chunks_q[chunk] : !load_busy_i;
    wire                   write       = write_i && !load_busy_i && count_good;
    wire [9:0]             write_word  = {chunk, 7'd0} - {6'd0, chunk, 1'b0} - {7'd0, chunk} + {3'd0, write_word_i};

    wire                   check_reads = (walks_q && !check_word_q[0]) || owed_q;
    wire                   fetch       = (check_q ? check_reads : read_memory) && !play_read_i;
    wire [31:0]            even, odd;
    // A word is written a clock later: its way to all blocks is a long one, and nothing reads it before its frame has ended
    reg                    writes_q;
    reg  [9:0]             write_word_q;
    reg  [BUFFER_BITS-1:0] write_buffer_q;
    reg  [31:0]            write_data_q;
    always @(posedge clk_i) begin
        writes_q <= write && !rst_i;
        if (write) begin
            write_word_q   <= write_word;
            write_buffer_q <= landing_q;
            write_data_q   <= write_data_i;
        end
    end
    waveform_memory #(.BUFFERS(SLOTS + 1), .BUFFER_BITS(BUFFER_BITS)) waveform_memory (
        .clk_i(clk_i),
        .write_i(writes_q), .write_buffer_i(write_buffer_q), .write_word_i(write_word_q), .write_data_i(write_data_q),
        .read_i(fetch || play_read_i),
        .read_buffer_i(play_read_i ? play_buffer_i : check_q ? check_buffer_q : slot_buffer),
        .read_pair_i(play_read_i ? play_word_i[9:1] : check_q ? check_word_q[9:1] : argument_i[9:1]),
        .even_o(even), .odd_o(odd)
    );

    always @(posedge clk_i) begin
        if (play_read_i || played_q) begin
            played_q <= play_read_i;
            if (play_read_i) play_odd_q <= play_word_i[0];
            if (played_q)    play_data_q <= play_odd_q ? odd : even;
        end
        if (check_q || read_memory || fetched_q) begin
            owed_q      <= check_q && check_reads && play_read_i;
            fetched_q   <= fetch;
            odd_later_q <= odd_q;
            if (fetched_q) begin
                even_q <= even;
                odd_q  <= odd;
            end
        end
        if (rst_i) begin
            owed_q    <= 1'b0;
            fetched_q <= 1'b0;
            played_q  <= 1'b0;
        end
    end

    genvar index;
    generate
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
    wire [6:0] there = chunks_q[look_q] ? chunk_words[look_q] : 7'd0;
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
    reg  load_good, store_good, checking;
    always @* begin
        {load_good, store_good, checking} = 3'd0;
        if (judge_i) begin
            load_good   = chunk_good_q && !load_busy_i && count_good;
            store_good  = store_slot_q && length_good_q && !check_q && !live_i && complete_q;
            checking    = check_q && check_slot_q == slot;
        end
    end

    wire        checked  = check_q && !walks_q && reading_q == 3'd0;
    reg         odd_now_q;               // the word whose CRC is taken in this clock is an odd one
    reg  [31:0] data;
    always @* begin
        data = 32'd0;
        if (check_q || read_memory) data = (check_q ? odd_now_q : argument_i[0]) ? odd_later_q : even_q;
    end
    wire [31:0] crc;
    crc32_word crc32_slot (
        .clk_i(clk_i), .rst_i(rst_i), .clear_i(store_i && store_good), .valid_i(reading_q[2]), .word_i(data), .crc_o(crc)
    );

    always @(posedge clk_i) begin
        if (store_i && store_good) slots[slot] <= {landing_q, word0_i[9:0]};
        if (checked)               slot_crcs[check_slot_q] <= ~crc;
        if (load_i && load_good)   chunk_words[chunk] <= load_words_i;
    end

    always @(posedge clk_i) begin
        if (check_q)      reading_q <= {reading_q[1:0], walks_q};
        if (reading_q[2]) odd_now_q <= !odd_now_q;
        if (walks_q) begin
            check_word_q <= check_word_q + 10'd1;
            walks_q      <= check_word_q != check_last_q;
        end
        if (checked) begin
            check_q <= 1'b0;
            if (crc == expected_q) intact_q <= intact_q | checked_slot_q;
        end

        if (write)               chunks_q[chunk] <= 1'b0;
        if (load_i && load_good) chunks_q[chunk] <= load_words_i != 7'd0;
        if (store_i && store_good) begin
            stored_q       <= stored_q | slot_q;
            intact_q       <= intact_q & ~slot_q;
            landing_q      <= slot_buffer;
            chunks_q       <= 8'd0;
            check_q        <= 1'b1;
            odd_now_q      <= 1'b0;
            check_slot_q   <= slot;
            checked_slot_q <= slot_q;
            check_buffer_q <= landing_q;
            check_word_q   <= 10'd0;
            check_last_q   <= word0_i[9:0] - 10'd1;
            walks_q        <= 1'b1;
            expected_q     <= word1_i;
        end

        if (!read_memory)                                             settled_q <= 3'd0;
        else if (check_q || (play_i && play_buffer_i == slot_buffer)) settled_q <= 3'd0;
        else if (settled_q != 3'd4) settled_q <= settled_q + 3'd1;

        if (rst_i) begin
            landing_q <= SLOTS[BUFFER_BITS-1:0];
            chunks_q  <= 8'd0;
            stored_q       <= {SLOTS{1'b0}};
            intact_q       <= {SLOTS{1'b0}};
            check_q        <= 1'b0;
            check_slot_q   <= {SLOT_BITS{1'b0}};
            checked_slot_q <= {SLOTS{1'b0}};
            check_buffer_q <= {BUFFER_BITS{1'b0}};
            check_word_q   <= 10'd0;
            check_last_q   <= 10'd0;
            walks_q        <= 1'b0;
            expected_q     <= 32'd0;
            reading_q      <= 3'd0;
            odd_now_q      <= 1'b0;
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
            load_result   = !chunk_good_q ? `RESULT_BAD_CHUNK : !load_good ? `RESULT_BUSY : `RESULT_OK;
            store_result  = !store_slot_q ? `RESULT_BAD_SLOT : !length_good_q ? `RESULT_BAD_VALUE
                          : check_q || live_i ? `RESULT_BUSY : !complete_q ? `RESULT_INCOMPLETE : `RESULT_OK;
            memory_result = !slot_good_q ? `RESULT_BAD_SLOT : !within_q ? `RESULT_BAD_RANGE
                          : settled_q != 3'd4 ? `RESULT_BUSY : `RESULT_OK;
            crc_result    = !slot_good_q ? `RESULT_BAD_SLOT : slot_words == 10'd0 ? `RESULT_EMPTY_SLOT
                          : checking ? `RESULT_BUSY : `RESULT_OK;
        end
    end

    assign load_result_o   = load_result;
    assign store_result_o  = store_result;
    assign memory_result_o = memory_result;
    assign memory_data_o   = data;
    assign crc_result_o    = crc_result;
    assign chunks_o        = chunks_q;
    assign crc_data_o      = ~slot_crcs[slot];
    assign slot_good_o     = store_slot_q;
    assign slot_buffer_o   = slot_buffer;
    assign slot_words_o    = slot_words;
    assign slot_intact_o   = |(intact_q & slot_q);
    assign slot_checking_o = checking;
    assign checking_o      = check_q;
    assign landing_o       = landing_q;
    assign missing_o       = !chunks_q[play_chunk_i] || play_within_i >= chunk_words[play_chunk_i];
    assign play_data_o     = play_data_q;

`ifdef FORMAL
    `include "waveform_buffer_properties.vh"
`endif
endmodule

`default_nettype wire
