// What waveform_buffer promises of any one buffer, chunk, slot and word, whatever the host uploads, stores, plays and reads.
// What is kept here beside the module is `_g`; inputs and registers of clocks before are `_1_q` to `_3_q`.
(* anyconst *) reg [BUFFER_BITS-1:0] buffer;   // a buffer,
(* anyconst *) reg [9:0]             number;   // a word of it
(* anyconst *) reg [2:0]             one;      // a chunk
(* anyconst *) reg [SLOT_BITS-1:0]   here;     // a slot
always @* place_is_there: assume (buffer <= SLOTS && number < 1000);

reg        started_q = 0;
reg        rst_1_q;
reg        known_g;                      // the word has been written since reset
reg [31:0] last_g;                       // what
reg        shows_g;                      // it was in the pair of the last read of the memory
reg [31:0] shown_g;                      // as it was then
reg        there_g;                      // the chunk's LOAD was accepted, and nothing has come for it since
reg [6:0]  words_g;                      // that it brought
reg [4:0]  rested_g;                     // clocks for which a STORE's words, and what has landed, have rested
reg [9:0]  stored_g;                     // words of the STORE that is checked
reg [10:0] taken_g;                      // of them whose CRC has been taken
reg        proven_g;                     // what the slot holds was read back whole since its STORE, and its CRC was that of the STORE
reg [4:0]  pause_g;                      // clocks since a frame was accepted, 31 at most
reg [2:0]  still_g;                      // clocks for which the argument has rested, 7 at most
reg        load_1_q, store_1_q, load_good_1_q, store_good_1_q, checked_1_q, write_1_q, write_2_q, play_read_1_q, play_read_2_q, look_1_q;
reg [15:0] argument_1_q;
reg [31:0] word0_1_q, play_1_q, play_2_q;
reg        plays_it_1_q, plays_it_2_q, load_busy_1_q, load_live_1_q;
reg [BUFFER_BITS-1:0] landing_1_q;
reg [7:0]  chunks_1_q;
reg [SLOTS-1:0] stored_1_q, intact_1_q;
reg        check_1_q;
reg [BUFFER_BITS-1:0] check_buffer_1_q;

wire       reads      = fetch || play_read_i;
wire [BUFFER_BITS-1:0] read_buffer = play_read_i ? play_buffer_i : check_q ? check_buffer_q : slot_buffer;
wire [8:0] read_pair  = play_read_i ? play_word_i[9:1] : check_q ? check_word_q[9:1] : argument_i[9:1];
wire       writes_it  = writes_q && write_buffer_q == buffer && write_word_q == number;
wire [9:0] before     = 10'd125 * one;          // words of chunks before
wire [9:0] left       = word0_1_q[9:0] > before ? word0_1_q[9:0] - before : 10'd0;  // of the waveform of a STORE from the chunk on
wire [9:0] looked     = 10'd125 * look_q;
wire       enough     = (left > 10'd125 ? 10'd125 : left) <= (there_g ? {3'd0, words_g} : 10'd0);

// The contract: frames come one at a time, and what they ask rests before they are accepted
initial assume (rst_i);
always @* begin
    judged_always: assume (judge_i);                                                          // frame_select: always, where it is synthesised
    if (started_q) begin
        loads_or_stores: assume (!(load_i && store_i));
        if (load_i || store_i) frames_are_apart: assume (pause_g == 5'd31 || pause_g > 5'd24);   // a frame takes 40 clocks and more
        if (load_i || store_i) load_has_rested: assume (still_g >= 3'd3 && argument_i == argument_1_q && !write_i && !write_1_q);
        if (store_i)           store_has_rested: assume (rested_g >= 5'd18 && look_i && word0_i == word0_1_q);
        if (write_i)           words_within_chunks: assume (argument_i < 16'd8 && write_word_i < 7'd125);  // frame_decoder: only_loads_are_kept
        if (load_i)            load_is_a_chunk: assume (load_words_i <= 7'd125);
        if (play_read_i)       reads_are_apart: assume (!play_read_1_q && play_buffer_i <= SLOTS && play_word_i < 10'd1000);
    end
end
always @* if (started_q && shows_g) memory_keeps_words: assume ((number[0] ? odd : even) == shown_g);  // waveform_memory: word_is_the_last_written

always @(posedge clk_i) begin
    started_q <= 1;
    rst_1_q   <= rst_i;
    if (writes_it) begin
        known_g <= 1;
        last_g  <= write_data_q;
    end
    if (reads) begin
        shows_g <= read_buffer == buffer && read_pair == number[9:1] && known_g && !writes_it;
        shown_g <= last_g;
    end
    if (load_i && load_good && chunk == one) begin
        there_g <= load_words_i != 7'd0;
        words_g <= load_words_i;
    end
    if (write && chunk == one) there_g <= 0;
    rested_g <= look_i && look_1_q && word0_i == word0_1_q && !write_i && !load_i && !store_i ? (rested_g == 5'd31 ? 5'd31 : rested_g + 5'd1) : 5'd0;
    if (reading_q[2]) taken_g <= taken_g + 11'd1;
    if (checked && check_slot_q == here) proven_g <= proven_g || (taken_g == stored_g && crc == expected_q);
    if (store_i && store_good) begin
        there_g  <= 0;
        taken_g  <= 0;
        stored_g <= word0_i[9:0];
        if (slot == here) proven_g <= 0;
    end
    pause_g <= load_i || store_i ? 5'd0 : pause_g == 5'd31 ? 5'd31 : pause_g + 5'd1;
    still_g <= argument_i != argument_1_q ? 3'd0 : still_g == 3'd7 ? 3'd7 : still_g + 3'd1;
    {load_1_q, store_1_q, load_good_1_q, store_good_1_q} <= {load_i, store_i, load_good, store_good};
    {write_2_q, write_1_q}         <= {write_1_q, write_i};
    {play_read_2_q, play_read_1_q} <= {play_read_1_q, play_read_i};
    plays_it_1_q <= play_read_i && play_buffer_i == buffer && play_word_i == number && known_g && !writes_it;
    plays_it_2_q <= plays_it_1_q;
    play_1_q     <= last_g;
    play_2_q     <= play_1_q;
    argument_1_q <= argument_i;
    word0_1_q    <= word0_i;
    look_1_q     <= look_i;
    landing_1_q  <= landing_q;
    chunks_1_q   <= chunks_q;
    {load_busy_1_q, load_live_1_q} <= {load_busy_i, load_live_i};
    stored_1_q   <= stored_q;
    intact_1_q   <= intact_q;
    check_1_q    <= check_q;
    checked_1_q  <= checked;
    check_buffer_1_q <= check_buffer_q;
    if (rst_i) begin
        {known_g, shows_g, there_g, proven_g, load_1_q, store_1_q, write_1_q, write_2_q, play_read_1_q, play_read_2_q, plays_it_1_q, plays_it_2_q, look_1_q} <= 13'd0;
        rested_g <= 0;
        taken_g  <= 0;
        stored_g <= 0;
        pause_g  <= 0;
        still_g  <= 0;
    end
end

// Where the buffer is: in one slot, or where uploads land
wire [SLOTS-1:0] holds_it;
generate
    for (index = 0; index < SLOTS; index = index + 1) begin : slot_g
        wire [BUFFER_BITS+9:0] kept = slots[index];
        assign holds_it[index] = (stored_q[index] ? kept[BUFFER_BITS+9:10] : index) == buffer;
    end
endgenerate
wire [SLOTS:0] places = {landing_q == buffer, holds_it};
wire [BUFFER_BITS+9:0] kept_here = slots[here];

wire [4:0] named      = argument_1_q[15] ? argument_1_q[14:10] : argument_1_q[4:0];
wire       named_good = (argument_1_q[15] || argument_1_q[7:5] == 3'd0) && named < SLOTS;

always @* if (started_q && !rst_1_q) begin
    buffer_is_in_one_place:  assert (places != 0 && (places & (places - 1)) == 0);
    if (writes_q)            only_the_landing_buffer_is_written: assert (write_buffer_q == landing_q && !store_1_q);
    if (writes_q)            nothing_goes_into_what_plays: assert (!load_busy_1_q && !(load_live_1_q && chunks_1_q[argument_1_q[2:0]]));
    if (there_g)             chunk_is_there: assert (chunks_o[one] && chunk_words[one] == words_g);
    else                     only_what_was_accepted_is_there: assert (!chunks_o[one]);
    if (play_chunk_i == one && !missing_o) only_what_arrived_plays: assert (there_g && play_within_i < words_g);
    if (store_i && store_result_o == `RESULT_OK) stores_only_what_is_there: assert (enough && word0_i[9:0] != 0 && word0_i <= 1000 && argument_i < SLOTS);
    if (store_i && store_result_o == `RESULT_OK) stores_only_what_rests: assert (!live_i && !checking_o);
    if (load_i && load_result_o == `RESULT_OK)   loads_only_where_nothing_plays: assert (!load_busy_i && argument_i < 8 && !(load_live_i && chunks_o[argument_i[2:0]]));
    if (loaded_o[here])      loaded_is_proven: assert (proven_g);
    if (checked)             whole_slot_is_read_back: assert (taken_g == {1'b0, stored_g});
    if (reading_q[2] && taken_g == number && check_buffer_q == buffer && known_g)
                             what_is_read_back_is_the_word: assert (data == last_g);
    if (plays_it_2_q)        what_plays_is_the_word: assert (play_data_o == play_2_q);
    if (read_memory && memory_result_o == `RESULT_OK && still_g == 3'd7 && argument_i == argument_1_q && argument_i[9:0] == number && slot_buffer == buffer && known_g)
                             what_is_read_is_the_word: assert (memory_data_o == last_g && number < slot_words);
    // what is refused changes nothing, nor does what is not asked
    if (store_1_q && !store_good_1_q)  refused_store_changes_nothing: assert (landing_o == landing_1_q && stored_q == stored_1_q && chunks_q == chunks_1_q && (checked_1_q || intact_q == intact_1_q));
    if (load_1_q && !load_good_1_q)    refused_load_changes_nothing: assert (chunks_q == chunks_1_q);
    if (!store_1_q)                    only_a_store_exchanges: assert (landing_o == landing_1_q && stored_q == stored_1_q);
    if ((store_i && store_result_o != `RESULT_OK)) refused_is_not_good: assert (!store_good);
    if ((load_i && load_result_o != `RESULT_OK))   refused_load_is_not_good: assert (!load_good);
end

// What induction must know of the inside
always @* if (started_q && !rst_1_q) begin
    if (check_q) assert (check_word_q <= check_last_q + 10'd1 && check_last_q < 10'd1000 && check_last_q + 10'd1 == stored_g);
    if (check_q) walk_is_known: assert (walks_q == (check_word_q != check_last_q + 10'd1));
    if (!check_q) assert (!walks_q && reading_q == 0);
    if (check_q) taken_are_walked: assert (taken_g + reading_q[0] + reading_q[1] + reading_q[2] == {1'b0, check_word_q});
    if (check_q) assert (odd_now_q == taken_g[0]);
    if (check_q) assert (checked_slot_q == (FIRST << check_slot_q) && slots[check_slot_q][BUFFER_BITS+9:10] == check_buffer_q && stored_q[check_slot_q]);
    if (rested_g > look_q)        assert (left_q == (word0_1_q[9:0] > looked ? word0_1_q[9:0] - looked : 10'd0) && (!whole_q || one >= look_q || enough));
    if (rested_g > look_q + 5'd8) complete_is_enough: assert (!complete_q || enough);
    assert (play_read_1_q == played_q && !(play_read_1_q && play_read_2_q));
    assert (slot_q == (FIRST << slot));
    assert (slot_good_q == named_good && slot == (named_good ? named[SLOT_BITS-1:0] : {SLOT_BITS{1'b0}}));
    assert (store_slot_q == (named_good && argument_1_q[15:8] == 0) && chunk_good_q == (argument_1_q[15:3] == 0));
    assert (length_good_q == (word0_1_q != 0 && word0_1_q <= 32'd1000));
    if (!store_1_q) map_is_known: assert ({slot_buffer, slot_words} == (stored_q[slot] ? slots[slot] : {{BUFFER_BITS-SLOT_BITS{1'b0}}, slot, 10'd0}));
end
