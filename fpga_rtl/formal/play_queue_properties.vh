// What play_queue promises for one word of one place in it, chosen freely and kept: so for all words of all places.
// Plays are numbered as they are pushed; what is shown at the head is what was pushed with the number that is due.
(* anyconst *) reg [2:0] place;
(* anyconst *) reg [2:0] word;

reg        started_q = 0;
reg        open_q;                           // a frame has begun, and nothing was pushed since
reg        good_q;                           // nor dropped: its words lie where they will be looked for
reg        wrote_q;                          // with this word
reg [31:0] written_q;                        // last word written there
reg        held_q;                           // a play is there: its word, its number, buffer and length
reg [31:0] held_word_q;
reg [7:0]  held_number_q;
reg [BUFFER_BITS-1:0] held_buffer_q;
reg [9:0]  held_length_q;
reg [7:0]  pushed_q, popped_q;               // how many

wire       arrives = push_i && tail_q == place;
wire       leaves  = pop_i && head_q == place;
wire [2:0] ahead   = place - head_q;         // how many plays come before

// What the frames, play_check and the player keep to. Words of a play that is dropped while it arrives may lie elsewhere: it
// is not pushed.
always @* begin
    words_of_a_play: assume (word <= 5);
    if (!started_q) assume (rst_i);
    if (push_i)  push_is_whole: assume (good_q && wrote_q && !full_o && !select_i && !write_i);
    if (write_i) writes_in_a_frame: assume (open_q);
    if (pop_i)   pop_what_is_shown: assume (valid_o);
end

always @(posedge clk_i) begin
    started_q <= 1;
    open_q    <= !rst_i && (select_i || (open_q && !push_i));
    good_q    <= !rst_i && (select_i || (good_q && !push_i && !drop_i));
    wrote_q   <= !select_i && (wrote_q || (write_i && write_word_i == word));
    if (write_i && !full_q && tail_q == place && write_word_i == word) written_q <= write_data_i;
    if (leaves) held_q <= 0;
    if (arrives) begin
        held_q        <= 1;
        held_word_q   <= written_q;
        held_number_q <= pushed_q;
        held_buffer_q <= buffer_i;
        held_length_q <= length_i;
    end
    pushed_q <= pushed_q + push_i;
    popped_q <= popped_q + pop_i;
    if (rst_i || drop_i) begin
        held_q   <= 0;
        pushed_q <= 0;
        popped_q <= 0;
    end
end

// The word as it is shown, and which of its bits count
reg [31:0] shown, counts;
always @* begin
    counts = 32'hFFFFFFFF;
    case (word)
        0: begin shown = {22'd0, first_o}; counts = 32'h3FF; end
        1: begin shown = {7'd0, polarity_o, 6'd0, start_q, count_o}; counts = 32'h103FFFF; end
        2: shown = period_ticks_o;
        3: shown = mask_o;
        4: shown = when_o[31:0];
        default: shown = when_o[63:32];
    endcase
end

always @* if (started_q) begin
    never_overflows:   assert (queued_o <= 8 && (!push_i || queued_o < 8));
    counts_all:        assert (pushed_q - popped_q == queued_o);
    shows_what_is:     assert (!valid_o || queued_o != 0);
    if (valid_o && ahead == 0) begin
        was_pushed:    assert (held_q);
        first_come:    assert (held_number_q == popped_q);
        word_is_its:   assert (((shown ^ held_word_q) & counts) == 0);
        buffer_is_its: assert (buffer_o == held_buffer_q && length_o == held_length_q);
    end
    if (held_q)        in_order: assert (held_number_q == popped_q + ahead);
    if (held_q)        uses_its_buffer: assert (held_buffer_q != landing_i || landing_used_o);
    if (valid_o)       delay_is_its: assert (delayed_o == (start_q != `START_TIME && when_o[31:0] != 0) && delayed_one_o == (when_o[31:0] == 1));
    begins_as_it_says: assert ({triggered_o, scheduled_o, immediate_o}
                               == {valid_o && start_q == `START_TRIGGER, valid_o && start_q == `START_TIME, valid_o && start_q == `START_NOW});

    // what induction must know of the inside
    tail_follows: assert (tail_q == head_q + count_q[2:0]);
    assert (held_q == (ahead < count_q) && used_q[place] == held_q);
    if (held_q) memory_is_its: assert (memory[{place, word}] == held_word_q && buffer_q[place] == held_buffer_q && length_q[place] == held_length_q);
    assert (!good_q || open_q);
    if (open_q && !full_q) full_in_time: assert (count_q < 8);
    if (good_q && wrote_q && !full_q && tail_q == place && !held_q) assert (memory[{place, word}] == written_q);
    assert (!(valid_q && (fetch_q || fetched_q)));
    assert (!(fetch_q || fetched_q) || count_q != 0);
    if (fetch_q) fetches_in_order: assert (index_q <= 5 && index_q == (fetched_q ? index_later_q + 3'd1 : 3'd0));
    if (fetched_q) assert (index_later_q <= 5 && (fetch_q || index_later_q == 5));
    if (fetched_q && index_later_q == word && ahead == 0) assert (data_q == held_word_q);
    if (fetched_q && index_later_q > word && ahead == 0) assert (((shown ^ held_word_q) & counts) == 0);
end
