// What spi_peripheral promises about all that crosses between SCK and the clock, proven by induction for all time.
// Time goes in steps of a quarter of a clock. SCK is as fast as the clock and has any phase and any pauses, chip
// select moves at any step its contract allows, SCK is noisy between frames. A first flip-flop of a synchroniser
// takes either value when its input moves within a step of the clock edge.
localparam CLOCK = 4;                        // steps in a clock
localparam SCK_LEVEL = CLOCK / 2;            // SCK high, SCK low, at least
localparam SELECT_TO_SCK = 5 * CLOCK;
localparam SCK_TO_RELEASE = 3 * CLOCK;
localparam SELECT_HIGH = 4 * CLOCK;
localparam [5:0] LONG_AGO = 6'd63;

(* gclk *) reg step;

reg [1:0] phase_q = 0;
reg [2:0] started_q = 0;                     // steps so far, held at 7
reg [4:0] rises_q = 0;                       // of SCK, in this frame
reg [1:0] taken_q = 0, captured_q = 0;       // in this frame, answers and bytes
// Steps since ...
reg [5:0] since_sck_q = 0, since_select_q = 0;               // SCK, chip select moved
reg [5:0] since_rise_q = LONG_AGO, since_byte_q = LONG_AGO;  // SCK rose and it counted, a byte was whole
reg [5:0] since_capture_q = LONG_AGO;                        // it was captured
reg [5:0] since_even_q = LONG_AGO, since_odd_q = LONG_AGO;   // an answer was loaded
reg [5:0] since_even_used_q = LONG_AGO, since_odd_used_q = LONG_AGO; // MISO took a bit of it
reg [5:0] since_idle_q = LONG_AGO;                           // a frame began or ended

function [5:0] later(input [5:0] since);
    later = since == LONG_AGO ? LONG_AGO : since + 6'd1;
endfunction

reg sck_1_q, cs_n_1_q, clk_1_q, idle_1_q, landed_1_q, take_1_q, select_1_q, valid_1_q;
reg [7:0] even_1_q, odd_1_q;
wire running    = started_q == 7;
wire sck_rose   = running && spi_sck_i && !sck_1_q;
wire sck_fell   = running && !spi_sck_i && sck_1_q;
wire clk_rose   = started_q != 0 && clk_i && !clk_1_q;
wire cs_moved   = running && spi_cs_n_i != cs_n_1_q;
wire idle_moved = running && idle_q != idle_1_q;
wire even_moved = running && answer_even_q != even_1_q;
wire odd_moved  = running && answer_odd_q != odd_1_q;
wire counted    = sck_rose && !idle_q && !spi_cs_n_i;
wire used       = sck_fell && !idle_q && begun_q;

always @(posedge step) begin
    phase_q    <= phase_q + 1;
    started_q  <= running ? 7 : started_q + 1;
    sck_1_q    <= spi_sck_i;
    cs_n_1_q   <= spi_cs_n_i;
    clk_1_q    <= clk_i;
    idle_1_q   <= idle_q;
    landed_1_q <= landed;
    take_1_q   <= answer_take_o;
    select_1_q <= select_o;
    valid_1_q  <= byte_valid_o;
    even_1_q   <= answer_even_q;
    odd_1_q    <= answer_odd_q;
    since_sck_q     <= rst_i ? 0 : sck_rose || sck_fell ? 1 : later(since_sck_q);
    since_select_q  <= rst_i ? 0 : cs_moved ? 1 : later(since_select_q);
    since_idle_q    <= idle_moved ? 1 : later(since_idle_q);
    since_rise_q    <= counted ? 1 : later(since_rise_q);
    since_byte_q    <= idle_q ? LONG_AGO : counted && rises_q[2:0] == 7 ? 1 : later(since_byte_q);
    since_capture_q <= running && clk_rose && landed_1_q ? 1 : later(since_capture_q);
    since_even_q    <= even_moved ? 1 : later(since_even_q);
    since_odd_q     <= odd_moved ? 1 : later(since_odd_q);
    since_even_used_q <= idle_q ? LONG_AGO : used && !count_q[3] ? 1 : later(since_even_used_q);
    since_odd_used_q  <= idle_q ? LONG_AGO : used && count_q[3] ? 1 : later(since_odd_used_q);
    if (cs_moved && !spi_cs_n_i) rises_q <= 0;
    else if (counted)            rises_q <= rises_q + 1;
    if (clk_rose) begin
        taken_q    <= select_1_q ? 0 : taken_q + take_1_q;
        captured_q <= select_1_q ? 0 : captured_q + landed_1_q;
    end
end

// The contract
always @* begin
    quarters_of_a_clock: assume (clk_i == phase_q[1]);
    assume (rst_i == (started_q < 3));       // for one edge of the clock
    if (started_q != 0 && !running) spi_rests_until_reset: assume (spi_sck_i == sck_1_q && spi_cs_n_i == cs_n_1_q);
    if (sck_rose || sck_fell)    sck_is_slow_enough: assume (since_sck_q >= SCK_LEVEL);
    if (cs_moved)                select_beside_sck: assume (!sck_rose && !(spi_sck_i && since_sck_q < 2));  // nor does noise come
    if (sck_rose)                sck_beside_select: assume (since_select_q >= 2);                           // beside chip select's edges
    if (sck_rose && !spi_cs_n_i) sck_behind_select: assume (since_select_q >= SELECT_TO_SCK);
    if (cs_moved && spi_cs_n_i)  release_behind_sck: assume (since_rise_q >= SCK_TO_RELEASE);
    if (cs_moved && !spi_cs_n_i) select_stays_high: assume (since_select_q >= SELECT_HIGH);
end

// The promises
always @* if (running) begin
    if (clk_rose && landed_1_q) // two clocks: for the synchroniser to see it and settle
        byte_is_still:          assert (since_byte_q >= 2 * CLOCK);
    if (counted && rises_q[2:0] == 7)
        byte_was_taken:         assert (since_capture_q >= CLOCK && captured_q == rises_q[4:3]);
    if (used) begin
        answer_is_still:        assert ((count_q[3] ? since_odd_q : since_even_q) >= CLOCK);
        answer_is_the_right:    assert (taken_q - rises_q[4:3] == 2'd1 || taken_q - rises_q[4:3] == 2'd2);
    end
    if (counted) begin
        reset_is_long_over:     assert (since_idle_q >= CLOCK);
        first_bit_is_there:     assert (begun_q || (since_even_q >= CLOCK - 1 && !launched_q));
    end
    if (!idle_q && even_moved)  even_was_used: assert (since_even_used_q >= CLOCK);
    if (!idle_q && odd_moved)   odd_was_used:  assert (since_odd_used_q >= CLOCK);
    if (idle_moved && idle_q)   sck_is_silent: assert (since_rise_q >= 4 * CLOCK);
    if (release_o && clk_rose) begin
        every_byte_came_before: assert (captured_q == rises_q[4:3] && !byte_valid_o);
        rest_is_reported:       assert (partial_o == (rises_q[2:0] != 0));
    end
end

// First flip-flops: any value when the input moved in the step before the clock edge or in the one after
reg [3:0] input_1_q, input_2_q, meta_1_q;
reg       clear_1_q, reset_1_q;
wire [3:0] inputs = {spi_cs_n_i, count_q[3], begun_q, part_q};
wire [3:0] meta   = {cs_n_meta_q, count_meta_q, begun_meta_q, part_meta_q};
wire [3:0] moved  = (inputs ^ input_1_q) | (input_1_q ^ input_2_q);
always @(posedge step) begin
    input_1_q <= inputs;
    input_2_q <= input_1_q;
    meta_1_q  <= meta;
    clear_1_q <= select;
    reset_1_q <= rst_i;
end
always @* if (started_q > 1) begin
    if (!clk_rose)                   sampled_by_the_clock: assume (meta == meta_1_q);
    else if (reset_1_q)              sampled_by_reset: assume (meta == 0);
    else begin
        sampled_of_count: assume (((meta[3] ^ input_1_q[3]) & ~moved[3]) == 0);
        if (clear_1_q) sampled_clear: assume (meta[2:0] == 0);
        else           sampled_or_before: assume (((meta[2:0] ^ input_1_q[2:0]) & ~moved[2:0]) == 0);
    end
end

// What induction must know of the inside
wire       cs_n_1  = input_1_q[3];           // a step ago, as everything "since" is
wire       count_1 = input_1_q[2];
wire       begun_1 = input_1_q[1];
wire [1:0] since_edge = phase_q - 2'd2;      // of the clock
reg        odd_parity_1_q, next_1_q, first_1_q, second_1_q;
always @(posedge step) begin
    odd_parity_1_q <= odd_q;
    next_1_q       <= take_next_q;
    first_1_q      <= take_first_q;
    second_1_q     <= take_second_q;
end
always @* begin
    if (!running) assert (phase_q == started_q[1:0] && since_sck_q == (started_q < 3 ? 0 : started_q - 3) && since_select_q == since_sck_q);
    if (!running) assert (since_capture_q == LONG_AGO && since_idle_q == LONG_AGO && since_rise_q == LONG_AGO && rises_q == 0);
    if (started_q > 2 && !running)           // reset
        assert (idle_q && cs_n_q == 0 && !release_q && !byte_valid_q && !take_first_q && !take_second_q && !take_next_q);
    if (running) begin
        assert (sck_reset_q == idle_q);
        if (sck_reset_q) assert (count_q == 0 && !begun_q && !part_q && !launched_q);
        assert (since_sck_q != 0 && since_select_q != 0 && since_idle_q != 0 && since_rise_q != 0);
        assert (valid_1_q == (since_capture_q <= CLOCK));
        assert (next_1_q == (since_capture_q > CLOCK && since_capture_q <= 2 * CLOCK));
        assert (first_1_q == (!idle_1_q && since_idle_q <= CLOCK));
        if (idle_1_q) assert (!second_1_q || since_idle_q <= CLOCK);
        else          assert (second_1_q == (since_idle_q > CLOCK && since_idle_q <= 2 * CLOCK));
        if (idle_1_q || !begun_1) assert (since_rise_q >= 4 * CLOCK && (since_rise_q == LONG_AGO || since_rise_q >= since_idle_q + 2 * CLOCK));
        if (idle_1_q && (!cs_n_1 || !cs_n_q[0] || (!cs_n_meta_q && !(cs_moved && clk_rose)))) assert (rises_q == 0);
        if (idle_1_q) assert (since_capture_q == LONG_AGO || since_capture_q >= since_idle_q + CLOCK);
        if (idle_1_q && since_idle_q != LONG_AGO) begin
            if (since_select_q >= since_idle_q) assert (cs_n_1 && since_select_q <= since_idle_q + 3 * CLOCK + 1);
            else                                assert (since_idle_q >= since_select_q + 3);
            if (!cs_n_meta_q)                   assert (since_idle_q >= 3);
            if (!cs_n_q[0])                     assert (since_idle_q >= CLOCK + 3);
            if (!cs_n_q[1] && idle_q)           assert (since_idle_q >= 2 * CLOCK + 3);
        end
        // chip select goes through
        if (since_select_q >= 2 + since_edge && !(cs_moved && clk_rose)) assert (cs_n_meta_q == cs_n_1);
        if (since_select_q >= 2 + CLOCK + since_edge) assert (cs_n_q[0] == cs_n_1);
        if (since_select_q >= 2 + 2 * CLOCK + since_edge) assert (cs_n_q[1] == cs_n_1);
        if (since_select_q >= 2 + 2 * CLOCK + since_edge && cs_n_1) assert (idle_q);
        assert (cs_n_1 || !cs_n_meta_q || (cs_moved && clk_rose) || cs_n_q[0] == cs_n_meta_q);
        assert (cs_n_1 || !cs_n_q[0] || cs_n_q[1] == cs_n_q[0]);
        assert (idle_q || !cs_n_q[1]);
        // the frame
        if (!idle_q && !idle_1_q) begin
            assert (count_q == rises_q[3:0] + counted && part_q == (count_q[2:0] != 0));
            assert (begun_q || count_q == 0);
            // the count goes through
            if (since_byte_q >= 2 + since_edge && !(counted && clk_rose)) assert (count_meta_q == count_1);
            if (since_byte_q >= 2 + CLOCK + since_edge) assert (count_sync_q == count_1);
            if (since_byte_q >= 2 + 2 * CLOCK + since_edge) assert (odd_q == count_1);
            if (since_byte_q < since_edge)             assert (count_meta_q != count_1);
            if (since_byte_q < CLOCK + since_edge)     assert (count_sync_q != count_1);
            if (since_byte_q < 2 * CLOCK + since_edge) assert (odd_q != count_1);
            if (since_rise_q >= 2 + since_edge && !(counted && clk_rose)) assert (begun_meta_q == input_1_q[1] && part_meta_q == input_1_q[0]);
            if (since_rise_q >= 2 + CLOCK + since_edge) assert (begun_sync_q == input_1_q[1] && part_sync_q == input_1_q[0]);
            assert (captured_q == rises_q[4:3] - (odd_parity_1_q != count_1));
            if (begun_q && cs_n_1) assert (since_rise_q == LONG_AGO || since_rise_q >= since_select_q + SCK_TO_RELEASE);
            // bytes and captures in time
            assert (begun_1 || rises_q == 0);
            assert (since_idle_q == LONG_AGO || begun_1 == (rises_q != 0));
            if (since_idle_q != LONG_AGO && rises_q != 0) assert (since_idle_q >= since_rise_q + CLOCK * (rises_q - 7'd1) + 6);
            if (since_byte_q != LONG_AGO) begin
                assert (begun_1);
                if (odd_parity_1_q == count_1)
                    assert (since_byte_q >= since_capture_q + 2 * CLOCK && since_byte_q <= since_capture_q + 3 * CLOCK + 2);
                else
                    assert (since_capture_q == LONG_AGO || since_capture_q >= since_byte_q + 4 * CLOCK);
            end else assert (since_capture_q >= LONG_AGO - 3 * CLOCK - 2 || since_capture_q >= since_idle_q + 3 * CLOCK);
            // answers
            assert (taken_q == (since_idle_q <= CLOCK ? 2'd0 : since_idle_q <= 2 * CLOCK ? 2'd1 :
                                captured_q + 2'd2 - (since_capture_q <= 2 * CLOCK)) || idle_1_q);
            if (count_1) assert (since_even_used_q >= since_byte_q);
            else         assert (since_odd_used_q >= since_byte_q);
            if (!cs_n_1) assert (since_idle_q >= LONG_AGO - 3 * CLOCK - 2 || since_select_q <= since_idle_q + 3 * CLOCK + 1);
            assert (since_even_q > CLOCK || since_idle_q <= 2 * CLOCK + 1 || (since_capture_q <= 3 * CLOCK + 1 && odd_q));
            assert (since_odd_q > CLOCK || since_idle_q <= 3 * CLOCK + 1 || (since_capture_q <= 3 * CLOCK + 1 && !odd_q));
            assert (since_byte_q >= LONG_AGO || since_byte_q >= since_rise_q + CLOCK * rises_q[2:0]);
        end
    end
end
