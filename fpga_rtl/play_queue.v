// Accepted plays, first come first played. Words of a PLAY go into memory as they arrive and count once its frame is
// accepted; the play at the head is fetched word by word, 8 clocks after it was accepted or the one before was taken.
`default_nettype none
`include "registers.vh"

module play_queue #(
    parameter BUFFER_BITS = 3
) (
    input  wire                   clk_i,
    input  wire                   rst_i,
    input  wire                   select_i,        // pulse: a frame begins
    input  wire                   write_i,         // pulse: a word of a PLAY frame
    input  wire [2:0]             write_word_i,
    input  wire [31:0]            write_data_i,
    input  wire                   push_i,          // pulse: that frame is accepted and its play is good
    input  wire [BUFFER_BITS-1:0] buffer_i,
    input  wire [9:0]             length_i,        // words, resolved
    input  wire                   live_i,          // it plays the landing buffer while that arrives
    input  wire                   pop_i,           // pulse: the head is taken
    input  wire                   drop_i,          // pulse: forget all
    // the head
    output wire                   valid_o,
    output wire [BUFFER_BITS-1:0] buffer_o,
    output wire [9:0]             first_o,
    output wire [9:0]             length_o,
    output wire [15:0]            count_o,
    output wire                   triggered_o, scheduled_o, immediate_o,  // with valid_o: what it begins with
    output wire                   polarity_o,
    output wire [31:0]            period_ticks_o,
    output wire [31:0]            mask_o,
    output wire [63:0]            when_o,          // delay or time
    output wire                   delayed_o,       // it has a delay
    output wire                   delayed_one_o,   // of one tick
    output wire                   live_o,
    // who uses the landing buffer
    input  wire [BUFFER_BITS-1:0] landing_i,
    output wire                   landing_used_o,
    output wire [3:0]             queued_o,
    output wire                   full_o,          // when the frame began
    // READ
    input  wire [5:0]             address_i,       // play from the head, word
    output wire [7:0]             read_result_o,
    output wire [31:0]            read_data_o
);
    localparam PLAYS = 8;

    (* no_rw_check *)                      // a play is read only once it is written
    reg [31:0] memory [0:8*PLAYS-1];
    reg [31:0] data_q;

    reg [BUFFER_BITS-1:0] buffer_q [0:PLAYS-1];
    reg [9:0]             length_q [0:PLAYS-1];
    reg [PLAYS-1:0]       used_q;
    reg [2:0]             head_q, tail_q;
    reg [3:0]             count_q;
    reg                   live_q;          // of the only play there is
    reg                   valid_q;
    reg                   fetch_q, fetched_q, moved_q;
    reg                   full_q;
    reg [2:0]             index_q, index_later_q;
    reg [9:0]             first_q;
    reg [15:0]            repeats_q;
    reg [1:0]             start_q;
    reg                   triggered_q, scheduled_q, immediate_q;
    reg                   polarity_q;
    reg [31:0]            period_q, mask_q;
    reg [63:0]            when_q;
    reg                   delayed_q, delayed_one_q;

    wire [5:0] address = fetch_q ? {head_q, index_q} : {head_q + address_i[5:3], address_i[2:0]};

    always @(posedge clk_i) begin
        if (write_i && !full_q) memory[{tail_q, write_word_i}] <= write_data_i;
        if (push_i || count_q != 4'd0) data_q <= memory[address];
    end

    always @(posedge clk_i) begin : queue
        integer index;
        // the head, word 0 to 5, each a clock after its address
        index_later_q <= index_q;
        fetched_q     <= fetch_q;
        moved_q       <= pop_i;
        if (select_i) full_q <= count_q == 4'd8;
        if (!valid_q && !fetch_q && !fetched_q && count_q != 4'd0) begin
            fetch_q <= 1'b1;
            index_q <= 3'd0;
        end
        if (fetch_q) begin
            index_q <= index_q + 3'd1;
            if (index_q == 3'd5) fetch_q <= 1'b0;
        end
        if (fetched_q) begin
            case (index_later_q)
                3'd0: first_q <= data_q[9:0];
                3'd1: {polarity_q, start_q, repeats_q} <= {data_q[24], data_q[17:0]};
                3'd2: period_q      <= data_q;
                3'd3: mask_q        <= data_q;
                3'd4: when_q[31:0]  <= data_q;
                default: when_q[63:32] <= data_q;
            endcase
            if (index_later_q == 3'd5) begin
                valid_q       <= 1'b1;
                triggered_q   <= start_q == `START_TRIGGER;
                scheduled_q   <= start_q == `START_TIME;
                immediate_q   <= start_q == `START_NOW;
                delayed_q     <= start_q != `START_TIME && when_q[31:0] != 32'd0;
                delayed_one_q <= when_q[31:0] == 32'd1;
            end
        end

        if (pop_i) begin
            valid_q         <= 1'b0;
            {triggered_q, scheduled_q, immediate_q} <= 3'b000;
            used_q[head_q]  <= 1'b0;
            head_q          <= head_q + 3'd1;
            live_q          <= 1'b0;
        end
        if (push_i) begin
            used_q[tail_q]   <= 1'b1;
            buffer_q[tail_q] <= buffer_i;
            length_q[tail_q] <= length_i;
            tail_q           <= tail_q + 3'd1;
            if (live_i) live_q <= 1'b1;
        end
        count_q <= count_q + {3'd0, push_i} - {3'd0, pop_i};
        if (drop_i || rst_i) begin
            valid_q   <= 1'b0;
            {triggered_q, scheduled_q, immediate_q} <= 3'b000;
            fetch_q   <= 1'b0;
            fetched_q <= 1'b0;
            used_q    <= {PLAYS{1'b0}};
            head_q    <= 3'd0;
            tail_q    <= 3'd0;
            count_q   <= 4'd0;
            live_q    <= 1'b0;
        end
        if (rst_i) begin
            for (index = 0; index < PLAYS; index = index + 1) begin
                buffer_q[index] <= {BUFFER_BITS{1'b0}};
                length_q[index] <= 10'd0;
            end
            moved_q       <= 1'b0;
            full_q        <= 1'b0;
            index_q       <= 3'd0;
            index_later_q <= 3'd0;
            first_q       <= 10'd0;
            repeats_q     <= 16'd0;
            start_q       <= 2'd0;
            polarity_q    <= 1'b0;
            period_q      <= 32'd0;
            mask_q        <= 32'd0;
            when_q        <= 64'd0;
            delayed_q     <= 1'b0;
            delayed_one_q <= 1'b0;
        end
    end

    reg landing_used;
    always @* begin : uses
        integer index;
        landing_used = 1'b0;
        index        = 0;
        if (used_q != {PLAYS{1'b0}}) for (index = 0; index < PLAYS; index = index + 1)
            if (used_q[index] && buffer_q[index] == landing_i) landing_used = 1'b1;
    end

    assign valid_o        = valid_q;
    assign buffer_o       = buffer_q[head_q];
    assign length_o       = length_q[head_q];
    assign first_o        = first_q;
    assign count_o        = repeats_q;
    assign triggered_o    = triggered_q;
    assign scheduled_o    = scheduled_q;
    assign immediate_o    = immediate_q;
    assign polarity_o     = polarity_q;
    assign period_ticks_o = period_q;
    assign mask_o         = mask_q;
    assign when_o         = when_q;
    assign delayed_o      = delayed_q;
    assign delayed_one_o  = delayed_one_q;
    assign live_o         = live_q;
    assign landing_used_o = landing_used;
    assign queued_o       = count_q;
    assign full_o         = full_q;
    assign read_result_o  = {1'b0, address_i[5:3]} >= count_q || address_i[2:0] > 3'd5 ? `RESULT_BAD_RANGE
                          : moved_q || fetch_q || fetched_q ? `RESULT_BUSY : `RESULT_OK;
    assign read_data_o    = data_q;

`ifdef FORMAL
    `include "play_queue_properties.vh"
`endif
endmodule

`default_nettype wire
