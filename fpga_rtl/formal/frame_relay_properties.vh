// What frame_relay promises of a frame that waits for a pause of the SPI, and of one of its words, chosen freely.
(* anyconst *) reg [6:0] word;

reg         started_q = 0;
reg         owed_q;                          // the decoder accepted a frame that has not been carried out
reg         open_in_q;                       // the link is within a frame
reg         released_q;                      // pulse: the decoder was told the end of a frame
reg         link_released_q;                 // pulse: the link had an end of a frame
reg         wrote_q;                         // that word came in this frame
reg  [31:0] written_q;
reg  [7:0]  since_q;                         // clocks since begin_o, in a turn without a break
reg         busy_1_q, begin_1_q;
reg  [6:0]  payload_1_q;

// What the link and its decoder keep to
always @* begin
    if (!started_q)   assume (rst_i);
    if (select_i)     frames_are_apart: assume (!open_in_q && !link_released_q);          // a byte of the UART takes 80 clocks
    if (release_i || byte_valid_i) bytes_of_a_frame: assume (open_in_q && !select_i);
    if (accept_i)     accepted_whole: assume (released_q && (word >= payload_words_i || wrote_q));  // frame_decoder: all_words_came
    if (word_valid_i) words_of_a_frame: assume (open_q);
    if (owed_q)       fields_rest: assume (payload_words_i == payload_1_q);          // it changes with bytes
    words_fit: assume (payload_words_i <= 125);                                    // frame_decoder: fits
end

always @(posedge clk_i) begin
    started_q  <= 1;
    owed_q     <= !rst_i && (accept_i || (owed_q && !accept_o));
    open_in_q  <= !rst_i && (select_i || (open_in_q && !release_i));
    released_q <= !rst_i && release_o;
    link_released_q <= !rst_i && release_i;
    wrote_q    <= !select_o && (wrote_q || (word_valid_i && word_number_i == {1'b0, word}));
    if (word_valid_i && word_number_i == {1'b0, word}) written_q <= word_i;
    since_q    <= begin_o ? 1 : turn_o && !busy_i ? since_q + 1 : 0;
    busy_1_q   <= busy_i;
    begin_1_q  <= begin_o;
    payload_1_q <= payload_words_i;
end

always @* if (started_q) begin
    only_in_a_pause:       assert (!busy_i || (!begin_o && !word_valid_o && !accept_o));
    only_what_is_owed:     assert (owed_q || (!begin_o && !turn_o && !word_valid_o && !accept_o));
    one_at_a_time:         assert (!accept_i || !owed_q);
    rests_meanwhile:       assert (!owed_q || (!select_o && !release_o && !byte_valid_o));
    begins_in_each_pause:  assert (!owed_q || busy_i || turn_o || begin_o);
    breaks_off:            assert (!turn_o || begin_1_q || !busy_1_q);
    accepts_when_checked: assert (!accept_o || since_q == {1'b0, payload_words_i} + 8'd40);
    accepts_in_time:       assert (!turn_o || since_q <= {1'b0, payload_words_i} + 8'd40);
    words_in_order:        assert (word_valid_o == (turn_o && !busy_i && since_q <= {1'b0, payload_words_i})
                                   && (!word_valid_o || word_number_o == since_q - 8'd1));
    if (word_valid_o && word_number_o == {1'b0, word})
        word_is_its:       assert (word_o == written_q);
    refuses_or_takes:      assert (refuse_o == (link_released_q && !released_q));

    // what induction must know of the inside
    assert (full_q == owed_q && (!turn_q || full_q) && (!open_q || (open_in_q && !full_q)) && (!released_q || (!full_q && !open_q)));
    assert (link_released_q || !released_q);
    assert (!link_released_q || !open_in_q);
    if (turn_q)  counts_its_clocks: assert (step_q == since_q && since_q != 0 && due_q == (since_q == {1'b0, payload_words_i} + 8'd40));
    else         assert (step_q == 0 && !due_q);
    if ((open_q || released_q) && wrote_q) assert (words[word] == written_q);
    if (full_q && word < payload_words_i) assert (words[word] == written_q && payload_words_i == payload_1_q);
    if (full_q && turn_q && step_q == word + 8'd1 && word < payload_words_i) assert (word_q == written_q);
end
