// What waveform_player promises, whatever the queue and the host do: an emission is exactly its words, each for its bits' time, and
// idle around them. Numbers that are counted here are `_g`, inputs and registers of clocks before are `_1_q` to `_3_q`.
reg        started_q = 0;
reg        rst_1_q;
reg [9:0]  words_g;                          // that have ended since the emission began
reg [9:0]  ended_words_g;                    // of the emission that ended last
reg [9:0]  asked_g, asked_first_g;           // its length and first word, as the queue gave them
reg [15:0] ticks_g;                          // this word has been held for, this clock included
reg [41:0] begun_g, ends_g;                  // 65536ths of a tick: words before it, and it, times the bit period
reg [16:0] idle_g;                           // clocks since anything sounded or ramped, held at the highest
reg [15:0] rest_g;                           // whole ticks of a bit while anything last did
reg        sounded_g;                        // anything has since the last reset or fault
reg        playing_1_q, playing_2_q, playing_3_q, ramping_1_q, ramping_2_q, ramping_3_q, start_1_q, boundary_1_q;
reg        missing_1_q, disarm_1_q, fault_1_q, halting_1_q;
reg [31:0] idle_1_q, data_1_q, mask_2_q, mask_1_q, period_1_q;
reg        bit_1_q, polarity_1_q;
reg        settled_1_q;

always @(posedge clk_i) begin
    started_q    <= 1;
    rst_1_q      <= rst_i;
    playing_1_q  <= playing_q && !rst_i;
    playing_2_q  <= playing_1_q && !rst_i;
    playing_3_q  <= playing_2_q && !rst_i;
    ramping_1_q  <= ramping_i && !rst_i;
    ramping_2_q  <= ramping_1_q && !rst_i;
    ramping_3_q  <= ramping_2_q && !rst_i;
    start_1_q    <= start;
    boundary_1_q <= boundary;
    missing_1_q  <= playing_q && live_q && missing_i;
    disarm_1_q   <= disarm_i;
    fault_1_q    <= fault_i;
    halting_1_q  <= halting_q;
    idle_1_q     <= idle_word_i;
    data_1_q     <= read_data_i;
    polarity_1_q <= polarity_q;
    mask_1_q     <= mask_q;
    mask_2_q     <= mask_1_q;
    bit_1_q      <= ramp_bit_i;
    period_1_q   <= bit_period_i;
    settled_1_q  <= settled_o && !ramping_i;
    if (begins) begin
        asked_g       <= head_length_i;
        asked_first_g <= head_first_i;
    end
    if (last) ended_words_g <= words_g + 1;
    if (boundary) begin
        words_g <= words_g + 1;
        begun_g <= ends_g;
        ends_g  <= ends_g + bit_period_i;
    end
    ticks_g <= boundary || start ? 1 : ticks_g + 1;
    if (start) begin
        words_g <= 0;
        begun_g <= 0;
        ends_g  <= bit_period_i;
    end
    if (playing_q || ramping_i) begin
        idle_g    <= 0;
        rest_g    <= bit_period_i[31:16];
        sounded_g <= 1;
    end else if (!idle_g[16]) idle_g <= idle_g + 1;
    if (fault_i || rst_i) sounded_g <= 0;
end

// The contract
initial assume (rst_i);
always @* begin
    bits_are_long_enough: assume (bit_period_i[31:16] >= 4 && bit_period_i[31:16] != 16'hFFFF);              // register_file: 2 MHz to 100 kHz
    if (started_q && (!settled_1_q || start_1_q)) bits_rest: assume (bit_period_i == period_1_q);                  // and written while nothing plays or waits
    if (head_i) lengths_are_within: assume (head_length_i != 0 && {1'b0, head_first_i} + head_length_i <= 1000);   // play_check: within the waveform
    if (due) repeats_in_time: assume (playing_q ? last : !resting_q);                                           // play_check: the period is that of the emission, or a bit longer
    one_state_at_a_time: assume (!(ramping_i && (armed_i || playing_q || delayed_q || repeating_q)));          // output_gate: armed or gliding, down behind a DISARM
end

// The promises
always @* if (started_q && !rst_1_q) begin
    if (playing_q) begin
        words_are_those_asked:   assert (words_g < asked_g && read_word_o == asked_first_g + words_g);
        words_are_in_the_memory: assert (read_word_o < 1000);
    end
    if (ended_q[0])              ends_with_the_last_word: assert (ended_words_g == asked_g);
    if (boundary)                word_has_its_time:       assert (begun_g[41:16] + ticks_g == ends_g[41:16]);
    if (playing_q)               word_is_no_longer:       assert (begun_g[41:16] + ticks_g <= ends_g[41:16]);
    if (playing_1_q && !playing_q) no_word_is_cut:        assert (fault_1_q || (boundary_1_q && (ended_q[0] || disarm_1_q || halting_1_q)));
    if (missing_1_q)             missing_is_underrun:     assert (underrun_o);
    if (start && !due && sounded_g) idle_is_a_bit_long:   assert (idle_g + 1 >= rest_g && !playing_q);
    if (fault_1_q)               fault_ends_it:           assert (!playing_q && !delayed_q && !repeating_q && !ended_o);
    // three clocks later
    if (ramping_3_q)             ramp_is_the_bit:         assert (drive_o == (bit_1_q ? idle_1_q : 0));
    else if (playing_3_q)        word_is_read_and_masked: assert (drive_o == ((mask_2_q & (data_1_q ^ {32{polarity_1_q}})) | (~mask_2_q & idle_1_q)));
    else                         rest_is_idle:            assert (drive_o == idle_1_q);
end

// What induction must know of the inside
always @* if (started_q && !rst_1_q) begin
    assert (playing_later_q == playing_1_q && ramping_later_q == {ramping_2_q, ramping_1_q});
    assert (plays_q == (playing_2_q && !ramping_2_q ? mask_1_q : 0));
    if (playing_q || delayed_q || repeating_q) length_is_kept: assert (final_q == asked_g - 10'd1 && first_q == asked_first_g && asked_g != 0 && {1'b0, asked_first_g} + asked_g <= 1000);
    if (playing_q) begin
        assert (number_q == words_g && words_g <= final_q && ticks_g != 0);
        assert (ends_g == begun_g + bit_period_i && begun_g[15:0] + bit_period_i[15:0] == {ends_g[15:0] < bit_period_i[15:0], ends_g[15:0]});
        assert (fraction_q == ends_g[15:0] && begun_g <= {words_g, 32'd0});
        hold_counts_ticks: assert (hold_q == ticks_g + 16'd1 - ({1'b0, begun_g[15:0]} + bit_period_i[15:0] > 17'hFFFF));
        assert (hold_q != 0 && hold_q <= bit_period_i[31:16] + 16'd1 && hold_over_q == (hold_q == bit_period_i[31:16] + 16'd1));
        if (hold_q > 2) assert (last_q == (number_q == final_q));
        idle_is_owed: assert (resting_q || start_1_q);
    end else assert (!halting_q);
    if (!playing_q && sounded_g && !resting_q) rest_is_whole: assert (idle_g + 1 >= rest_g);
    if (!playing_q && resting_q && sounded_g) assert (rest_g == bit_period_i[31:16]);
    if (!playing_q && resting_q && sounded_g) assert (hold_q == idle_g + 16'd2 && hold_q <= bit_period_i[31:16]);
    if (!playing_q && resting_q) assert (sounded_g);
    more_is_known: assert (repeating_q == (endless_q || count_q[15:1] != 0));
    if (delayed_q) assert (!playing_q && !resting_q);
end
