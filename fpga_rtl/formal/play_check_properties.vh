// What play_check promises of a play that it finds good when its frame is accepted: it is armed for, has its place, its words are
// there, proven and within the waveform. Its times are products, which the bench compares with sums of its own.
reg         started_q = 0;
reg  [2:0]  rested_g;                    // clocks for which all that is asked, and what the slot holds, have rested, 7 at most
reg  [255:0] asked_1_q;
wire [255:0] asked = {argument_i, first_i, asked_i, count_i, start_i, polarity_i, period_i, when_i, slot_good_i, slot_buffer_i, slot_words_i, bit_period_i};
wire        live  = argument_i == `PLAY_LANDING;
wire [10:0] words = live ? 11'd1000 : {1'b0, slot_words_i};  // that there are, or will be

initial assume (rst_i);
always @* begin
    judged_always: assume (judge_i);                                        // frame_select: always, where it is synthesised
    slot_is_a_waveform: assume (slot_words_i <= 10'd1000);                       // waveform_buffer: stores_only_what_is_there
    if (started_q && accept_i) frame_has_rested: assume (rested_g >= 3'd4 && asked == asked_1_q);
end

always @(posedge clk_i) begin
    started_q <= 1;
    asked_1_q <= asked;
    rested_g  <= rst_i || asked != asked_1_q ? 3'd0 : rested_g == 3'd7 ? 3'd7 : rested_g + 3'd1;
end

always @* if (started_q && accept_i && good_o) begin
    only_while_armed:          assert (armed_i && !faulted_i);
    only_where_there_is_room:  assert (!full_i);
    only_a_slot:               assert (live || slot_good_i);
    only_what_is_intact:       assert (live || (slot_intact_i && !slot_checking_i && slot_words_i != 10'd0));
    live_only_alone_and_fast:  assert (!live || (arriving_i && fast_i && queued_i == 4'd0 && first_i == 16'd0));
    words_are_within:          assert (length_o != 10'd0 && {1'b0, first_i[9:0]} + {1'b0, length_o} <= words && first_i < 16'd1000);
    as_many_as_asked:          assert (asked_i == 16'd0 ? {1'b0, first_i[9:0]} + {1'b0, length_o} == words : length_o == asked_i);
    begins_as_it_can:          assert (start_i == `START_TRIGGER || start_i == `START_NOW || start_i == `START_TIME);
    buffer_is_its:             assert (buffer_o == (live ? landing_i : slot_buffer_i) && live_o == live);
    not_longer_than_allowed:   assert (!long_q);
    not_into_the_one_before:   assert (count_i == 16'd1 || back_to_back_q || roomy_q);
    not_too_late:              assert (start_i != `START_TIME || (!late_q && !overlap_q));
end
always @* if (started_q && accept_i) good_is_ok: assert (good_o == (result_o == `RESULT_OK));
