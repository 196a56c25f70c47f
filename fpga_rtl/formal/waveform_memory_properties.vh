// What waveform_memory promises of any one word: it is what was written there last.
(* anyconst *) reg [BUFFER_BITS-1:0] buffer;
(* anyconst *) reg [9:0]             word;

reg        written_g;                    // the word has been, since the proof began to look
reg [31:0] last_g;                       // what
reg        shows_g;                      // it was in the pair of the last read
reg [31:0] shown_g;                      // as it was then
wire       writes_it = write_i && write_buffer_i == buffer && write_word_i == word;
wire       reads_it  = read_buffer_i == buffer && read_pair_i == word[9:1];

initial {written_g, shows_g} = 2'b00;
always @* place_is_there: assume (buffer < BUFFERS && (!write_i || write_buffer_i < BUFFERS) && (!read_i || read_buffer_i < BUFFERS));

always @(posedge clk_i) begin
    if (writes_it) begin
        written_g <= 1;
        last_g    <= write_data_i;
    end
    if (read_i) begin
        shows_g <= reads_it && written_g && !writes_it;
        shown_g <= last_g;
    end
end

always @* if (shows_g) word_is_the_last_written: assert ((word[0] ? odd_o : even_o) == shown_g);
