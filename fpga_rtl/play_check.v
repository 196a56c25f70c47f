// Whether a PLAY may be accepted. Its lengths in ticks are multiplied out bit by bit while its frame arrives, from the
// word with the period on; that takes 28 clocks, and 16 bytes are still to come.
`default_nettype none
`include "registers.vh"

module play_check #(
    parameter BUFFER_BITS = 3
) (
    input  wire                   clk_i,
    input  wire                   rst_i,
    input  wire                   judge_i,          // slot and words may have changed a clock ago, or are accepted: results hold only then
    input  wire                   begin_i,          // pulse: words 0 to 2 of the frame are there; argument, slot and word 0 for 2 clocks
    input  wire                   accept_i,         // pulse: the frame is accepted, and a PLAY; its words rest for a clock more
    input  wire                   forget_i,         // pulse: nothing scheduled counts any more
    input  wire [15:0]            argument_i,
    input  wire [15:0]            first_i, asked_i, // words of the waveform; 0: to its end
    input  wire [15:0]            count_i,
    input  wire [7:0]             start_i, polarity_i,
    input  wire [31:0]            period_i,
    input  wire [63:0]            when_i,
    input  wire [31:0]            bit_period_i,
    input  wire [31:0]            emission_ticks_i, // longest
    input  wire [63:0]            now_i,
    // what the slot holds
    input  wire                   slot_good_i,
    input  wire [BUFFER_BITS-1:0] slot_buffer_i,
    input  wire [9:0]             slot_words_i,
    input  wire                   slot_intact_i,
    input  wire                   slot_checking_i,
    input  wire [BUFFER_BITS-1:0] landing_i,
    input  wire                   arriving_i,       // its first chunk is there
    input  wire                   fast_i,           // the last chunk came as fast as it would play
    // state
    input  wire                   armed_i,
    input  wire                   faulted_i,
    input  wire [3:0]             queued_i,
    input  wire                   full_i,
    output wire                   good_o,           // result_o is OK
    output wire [7:0]             result_o,
    output wire                   live_o,
    output wire [BUFFER_BITS-1:0] buffer_o,
    output wire [9:0]             length_o
);
    localparam [63:0] TIME_LEAD_TICKS = `TIME_LEAD_TICKS;  // below 32
    // What is asked rests long before its frame ends: what it means is found out in two clocks, from register to register
    reg         live_q, scheduled_q;
    reg [10:0]  left_q;              // words from the first on; negative: it is behind the end
    wire [9:0]  held   = live_q ? 10'd1000 : slot_words_i;
    wire [9:0]  length = asked_i == 16'd0 ? left_q[9:0] : asked_i[9:0];
    wire        range_good = first_i[15:10] == 6'd0 && !left_q[10] && left_q[9:0] != 10'd0
                             && asked_i[15:10] == 6'd0 && asked_i[9:0] <= left_q[9:0] && !(live_q && first_i != 16'd0);

    // length x BIT_PERIOD, then (count - 1) x period
    reg [5:0]  step_q;               // 63: done
    reg [15:0] bits_q;               // of the multiplier, highest first
    reg [47:0] product_q;
    reg [31:0] sounding_q;           // ticks from the first word to the end of the last
    reg [32:0] rested_q;             // and to the end of the idle word behind it
    // Two ticks more, so that the next can be fetched: each the carry into a sum, from a bit below it
    /* verilator lint_off UNUSEDSIGNAL */
    reg [49:0] span_q;               // ticks from the first word of all to where another play may begin, but for the last
    reg [64:0] free_q;               // earliest time that is not taken
    /* verilator lint_on UNUSEDSIGNAL */
    reg [9:0]  length_q;
    reg        unnamed_q, empty_q, range_good_q, start_good_q, long_q, back_to_back_q, roomy_q;
    reg        open_q;               // from then on, until it is accepted
    reg [64:0] ahead_q;              // ticks until its time; negative: it has passed
    reg        late_q, overlap_q;
    reg        taken_q;              // a clock ago a play with a time was accepted

    wire [31:0] rest    = {16'd0, bit_period_i[31:16]};
    wire [47:0] doubled = {product_q[46:0], 1'b0};
    wire        second  = step_q >= 6'd12;

    always @(posedge clk_i) begin
        if (begin_i) begin
            step_q    <= 6'd0;
            bits_q    <= {length, 6'd0};
            product_q <= 48'd0;
        end else if (step_q == 6'd10) begin
            step_q     <= 6'd12;
            sounding_q <= product_q[47:16];
            bits_q     <= count_i == 16'd0 ? 16'd0 : count_i - 16'd1;
            product_q  <= 48'd0;
        end else if (step_q == 6'd28) begin
            step_q <= 6'd63;
            span_q <= {1'b0, product_q, 1'b1} + {16'd0, rested_q, 1'b1};
        end else if (step_q != 6'd63) begin
            step_q    <= step_q + 6'd1;
            bits_q    <= {bits_q[14:0], 1'b0};
            product_q <= doubled + (bits_q[15] ? {16'd0, second ? period_i : bit_period_i} : 48'd0);
        end
        if (step_q != 6'd63) begin
            rested_q       <= {1'b0, sounding_q} + {1'b0, rest};
            long_q         <= sounding_q > emission_ticks_i;
            back_to_back_q <= period_i == sounding_q;
            roomy_q        <= {1'b0, period_i} >= rested_q;
        end

        if (judge_i) begin
            live_q       <= argument_i == `PLAY_LANDING;
            scheduled_q  <= start_i == {6'd0, `START_TIME};
            left_q       <= {1'b0, held} - {1'b0, first_i[9:0]};
            length_q     <= length;
            unnamed_q    <= !live_q && !slot_good_i;
            empty_q      <= !live_q && slot_words_i == 10'd0;
            range_good_q <= range_good;
            start_good_q <= start_i <= {6'd0, `START_TIME} && polarity_i <= 8'd1;
        end
        if (begin_i)       open_q <= 1'b1;
        else if (accept_i) open_q <= 1'b0;
        if (open_q) begin
            ahead_q   <= {1'b0, when_i} - {1'b0, now_i};
            late_q    <= ahead_q[64] || (ahead_q[63:5] == 59'd0 && ahead_q[4:0] < TIME_LEAD_TICKS[4:0]);
            overlap_q <= when_i < free_q[64:1];
        end

        taken_q <= accept_i && good_o && scheduled_q && !forget_i;
        if (taken_q)  free_q <= {when_i, 1'b1} + {15'd0, span_q[49:1], 1'b1};
        if (forget_i) free_q <= 65'd0;
        if (rst_i) begin
            step_q         <= 6'd63;
            bits_q         <= 16'd0;
            product_q      <= 48'd0;
            sounding_q     <= 32'd0;
            rested_q       <= 33'd0;
            span_q         <= 50'd0;
            length_q       <= 10'd0;
            live_q         <= 1'b0;
            scheduled_q    <= 1'b0;
            left_q         <= 11'd0;
            unnamed_q      <= 1'b0;
            empty_q        <= 1'b0;
            range_good_q   <= 1'b0;
            start_good_q   <= 1'b0;
            rested_q       <= {1'b0, sounding_q} + {1'b0, rest};
            long_q         <= 1'b0;
            back_to_back_q <= 1'b0;
            roomy_q        <= 1'b0;
            open_q         <= 1'b0;
            ahead_q        <= 65'd0;
            free_q         <= 65'd0;
            late_q         <= 1'b0;
            overlap_q      <= 1'b0;
            taken_q        <= 1'b0;
        end
    end

    // All that speaks against it, the first to be named highest: only its name takes long to find out
    reg [15:0] against;
    reg [7:0]  result;
    always @* begin
        if (!judge_i) against = 16'd0;
        else against = {
            unnamed_q, faulted_i, !armed_i, empty_q, !live_q && slot_checking_i, !live_q && !slot_intact_i,
            live_q && !arriving_i, live_q && !fast_i, live_q && queued_i != 4'd0,
            !range_good_q, !start_good_q, long_q, count_i != 16'd1 && !back_to_back_q && !roomy_q,
            full_i, scheduled_q && late_q, scheduled_q && overlap_q
        };
        casez (against)
            16'b1???_????_????_????: result = `RESULT_BAD_SLOT;
            16'b01??_????_????_????: result = `RESULT_FAULTED;
            16'b001?_????_????_????: result = `RESULT_NOT_ARMED;
            16'b0001_????_????_????: result = `RESULT_EMPTY_SLOT;
            16'b0000_1???_????_????: result = `RESULT_BUSY;
            16'b0000_01??_????_????: result = `RESULT_SLOT_DAMAGED;
            16'b0000_001?_????_????: result = `RESULT_INCOMPLETE;
            16'b0000_0001_????_????: result = `RESULT_LINK_SLOW;
            16'b0000_0000_1???_????: result = `RESULT_BUSY;
            16'b0000_0000_01??_????: result = `RESULT_BAD_RANGE;
            16'b0000_0000_001?_????: result = `RESULT_BAD_VALUE;
            16'b0000_0000_0001_????: result = `RESULT_TOO_LONG;
            16'b0000_0000_0000_1???: result = `RESULT_BAD_PERIOD;
            16'b0000_0000_0000_01??: result = `RESULT_QUEUE_FULL;
            16'b0000_0000_0000_001?: result = `RESULT_TOO_LATE;
            16'b0000_0000_0000_0001: result = `RESULT_OVERLAP;
            default:                 result = `RESULT_OK;
        endcase
    end

    assign good_o   = against == 16'd0;
    assign result_o = result;
    assign live_o   = live_q;
    assign buffer_o = live_q ? landing_i : slot_buffer_i;
    assign length_o = length_q;

`ifdef FORMAL
    `include "play_check_properties.vh"
`endif
endmodule

`default_nettype wire
