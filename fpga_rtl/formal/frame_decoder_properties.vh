// What frame_decoder promises of every frame, compared with a recording of its bytes; of one word of its payload, chosen freely.
// The register of the CRC has a proof of its own, crc32.sby: here it begins anew with each frame and takes each byte once.
(* anyconst *) reg [6:0] word;

reg         started_q = 0;
reg         open_q;                          // a frame has begun and not ended
reg  [63:0] header_q;                        // its first 8 bytes
reg  [31:0] bytes_q;                         // of that word
reg  [19:0] number_q;                        // bytes of the frame; no frame is a million bytes long
reg  [7:0]  delivered_q;                     // words
reg         ended_q, good_q;                 // a clock ago; as every frame has to be
wire [15:0] length = header_q[47:32];
wire        long   = header_q[23:16] == `TYPE_LOAD || header_q[23:16] == `TYPE_TEST;
wire        fits   = long ? length >= 20 && length <= 500 && length[1:0] == 0 : length == 24;
wire        good   = open_q && !partial_i && number_q == length + 20'd12 && number_q >= 8 && header_q[15:0] == 16'hA55A && fits
                     && crc == 32'hDEBB20E3;
integer     k;

// What both byte links keep to
always @* begin
    if (!started_q)   assume (rst_i);
    if (byte_valid_i) bytes_within_a_frame: assume (open_q && !select_i && !release_i && number_q != 20'hFFFFF);
    if (release_i)    an_end_within_a_frame: assume (open_q && !select_i && !word_valid_q);
end

always @(posedge clk_i) begin
    started_q <= 1;
    open_q    <= !rst_i && (select_i || (open_q && !release_i));
    ended_q   <= !rst_i && release_i;
    good_q    <= good;
    if (byte_valid_i) begin
        number_q <= number_q + 1;
        if (number_q < 8) header_q <= (header_q & ~(64'hFF << (8 * number_q))) | ({56'd0, byte_i} << (8 * number_q));
        for (k = 0; k < 4; k = k + 1)
            if (number_q == 8 + 4 * word + k) bytes_q[8 * k +: 8] <= byte_i;
    end
    if (word_valid_o) delivered_q <= delivered_q + 1;
    if (select_i || rst_i) begin
        number_q    <= 0;
        header_q    <= 0;
        delivered_q <= 0;
    end
end

reg differs;                                 // a word leaves with its last byte
always @* begin
    differs = 0;
    for (k = 0; k < 4; k = k + 1)
        if (number_q > 8 + 4 * word + k && number_q < 12 + 4 * word + k + 1)
            differs = differs || recent_q[8 * (4 - (number_q - 8 - 4 * word) + k) +: 8] != bytes_q[8 * k +: 8];
end

always @* if (started_q) begin
    accepts_only_good_frames: assert (!accept_o || (ended_q && good_q));
    accepts_all_good_frames:  assert (!(ended_q && good_q) || accept_o);
    answers_each_frame_once:  assert ((accept_o || refuse_o) == ended_q && !(accept_o && refuse_o));
    if (accept_o) begin
        fields_are_its:       assert (type_o == header_q[23:16] && sequence_o == header_q[31:24] && argument_o == header_q[63:48]
                                      && payload_words_o == length[8:2]);
        all_words_came:       assert (delivered_q == {1'b0, payload_words_o});
    end
    if (word_valid_o) begin
        words_in_order:       assert (word_number_o == delivered_q && word_number_o < {1'b0, payload_words_o});
        word_is_its:          assert (word_number_o != {1'b0, word} || word_o == bytes_q);
    end
    if (load_word_o)
        only_loads_are_kept:  assert (word_valid_o && type_o == `TYPE_LOAD && argument_o < 8 && header_q[15:0] == 16'hA55A);

    // what induction must know of the inside
    counts_bytes: assert (count_q == (number_q > 1023 ? 10'h3FF : number_q[9:0]));
    if (number_q > 1) sync_is_whole: assert (sync_good_q == (header_q[15:0] == 16'hA55A));
    if (number_q == 1) assert (sync_good_q == (header_q[7:0] == 8'h5A));
    if (number_q == 0) assert (!sync_good_q && !word_valid_q && length_q == 0);
    assert (type_q == (number_q > 2 ? header_q[23:16] : 8'd0));
    if (number_q > 3) assert (sequence_q == header_q[31:24]);
    if (number_q > 4) assert (length_q[7:0] == header_q[39:32]);
    if (number_q > 5) assert (length_q[15:8] == header_q[47:40]);
    if (number_q > 6) assert (argument_q[7:0] == header_q[55:48]);
    if (number_q > 7) assert (argument_q[15:8] == header_q[63:56]);
    if (number_q < 5) assert (header_q[39:32] == 0 && length_q[7:0] == 0);
    if (number_q < 6) assert (header_q[47:40] == 0 && length_q[15:8] == 0);
    if (number_q > 8) header_is_known: assert (length_good_q == fits && lands_q == (header_q[23:16] == `TYPE_LOAD && header_q[15:0] == 16'hA55A && header_q[63:48] < 8));
    if (number_q == 0) assert (!length_good_q);
    if (word_valid_q) word_is_of_the_payload: assert (word_number_q < {1'b0, length[8:2]});
    if (word_valid_q) assert (number_q > 11 && number_q[1:0] == 0 || number_q > 1023);
    if (word_valid_q && number_q < 1024) assert (word_number_q == number_q[9:2] - 8'd3);
    if (fits && number_q > 7 && number_q < 1024)
        delivers_all: assert (delivered_q == (number_q[9:2] - 8'd2 - word_valid_q > length[8:2] ? {1'b0, length[8:2]} : number_q[9:2] - 8'd2 - word_valid_q));
    if (!fits || number_q < 8) assert (delivered_q == 0);
    recent_bytes_are_its: assert (!differs);
end
