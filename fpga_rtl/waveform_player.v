// What the channels should do: the idle word, the ramp to it, or the words of an emission.
// One accepted play command waits for the trigger; one trigger starts exactly one.
// From state to drive_o it takes two clocks (memory, selection), to the pins three.
`default_nettype none
`include "registers.vh"

module waveform_player #(
    parameter BUFFER_BITS = 3
) (
    input  wire                   clk_i,
    input  wire                   rst_i,
    // settings
    input  wire [31:0]            idle_word_i,
    input  wire [15:0]            bit_ticks_i,
    // commands
    input  wire                   play_i,          // pulse: accepted PLAY frame, judged here
    input  wire [31:0]            count_i,         // 0: endless
    input  wire [31:0]            period_ticks_i,
    input  wire                   slot_good_i,
    input  wire [BUFFER_BITS-1:0] slot_buffer_i,
    input  wire [9:0]             slot_words_i,
    input  wire                   armed_i,
    input  wire                   faulted_i,
    output wire [7:0]             play_result_o,
    input  wire                   stop_i,          // pulse
    input  wire                   drop_i,          // disarming or a fault
    input  wire                   fault_i,         // outputs are being shut: nothing on its way counts
    input  wire                   trigger_i,       // pulse
    // buffers
    input  wire [BUFFER_BITS-1:0] landing_i,
    output wire                   landing_busy_o,
    output wire [BUFFER_BITS-1:0] read_buffer_o,
    output wire [9:0]             read_word_o,
    input  wire [31:0]            read_data_i,     // one clock later
    // ramp
    input  wire                   ramping_i,
    input  wire                   ramp_bit_i,      // one clock later
    // out
    output wire [31:0]            drive_o,
    output wire                   ended_o,         // pulse: in the next clock the pins have ended an emission
    output wire                   playing_o,
    output wire                   repeating_o,
    output wire                   pending_o,
    output wire [31:0]            triggers_o,
    output wire [31:0]            ignored_o
);
    reg                   pending_q;
    reg [BUFFER_BITS-1:0] pending_buffer_q;
    reg [9:0]             pending_words_q;
    reg [31:0]            pending_count_q, pending_period_q;

    reg                   playing_q;
    reg                   endless_q;
    reg [31:0]            remaining_q;     // emissions after this one
    reg [BUFFER_BITS-1:0] buffer_q;
    reg [9:0]             words_q;         // of the waveform
    reg [9:0]             word_q;          // being played
    reg [15:0]            hold_q;          // ticks left of it
    reg [31:0]            period_q;
    reg [31:0]            until_next_q;    // ticks left until the next emission may begin

    reg [9:0]             asked_words_q;
    reg [25:0]            shortest_q;      // ticks of the emission asked for; settled long before its frame ends

    reg                   playing_later_q, ramping_later_q;
    reg [31:0]            drive_q;
    reg [2:0]             ended_q;
    reg [31:0]            triggers_q, ignored_q;

    wire repeating = endless_q || remaining_q != 32'd0;
    wire last      = playing_q && hold_q == 16'd0 && word_q == words_q - 10'd1;
    wire due       = repeating && until_next_q == 32'd0;
    wire start     = trigger_i && pending_q && !playing_q;
    wire too_short = count_i != 32'd1 && period_ticks_i < {6'd0, shortest_q};
    wire play_good = slot_good_i && !faulted_i && armed_i && slot_words_i != 10'd0 && !pending_q && !too_short;

    always @(posedge clk_i) begin
        asked_words_q <= slot_words_i;
        shortest_q    <= asked_words_q * bit_ticks_i;

        if (trigger_i)           triggers_q <= triggers_q + 32'd1;
        if (trigger_i && !start) ignored_q  <= ignored_q + 32'd1;

        if (hold_q == 16'd0) begin
            hold_q <= bit_ticks_i - 16'd1;
            word_q <= word_q + 10'd1;
        end else hold_q <= hold_q - 16'd1;
        if (until_next_q != 32'd0) until_next_q <= until_next_q - 32'd1;

        if (last) playing_q <= 1'b0;
        if (due) remaining_q <= endless_q ? 32'd0 : remaining_q - 32'd1;
        if (start) begin
            pending_q   <= 1'b0;
            buffer_q    <= pending_buffer_q;
            words_q     <= pending_words_q;
            period_q    <= pending_period_q;
            endless_q   <= pending_count_q == 32'd0;
            remaining_q <= pending_count_q == 32'd0 ? 32'd0 : pending_count_q - 32'd1;
        end
        if (due || start) begin
            playing_q    <= 1'b1;
            word_q       <= 10'd0;
            hold_q       <= bit_ticks_i - 16'd1;
            until_next_q <= (start ? pending_period_q : period_q) - 32'd1;
        end
        if (play_i && play_good) begin
            pending_q        <= 1'b1;
            pending_buffer_q <= slot_buffer_i;
            pending_words_q  <= slot_words_i;
            pending_count_q  <= count_i;
            pending_period_q <= period_ticks_i;
        end
        if (stop_i || drop_i) begin
            pending_q   <= 1'b0;
            endless_q   <= 1'b0;
            remaining_q <= 32'd0;
        end
        if (drop_i) playing_q <= 1'b0;

        playing_later_q <= playing_q;
        ramping_later_q <= ramping_i;
        drive_q <= ramping_later_q ? idle_word_i & {32{ramp_bit_i}} : playing_later_q ? read_data_i : idle_word_i;
        ended_q <= fault_i ? 3'b000 : {ended_q[1:0], last};

        if (rst_i) begin
            pending_q        <= 1'b0;
            pending_buffer_q <= {BUFFER_BITS{1'b0}};
            pending_words_q  <= 10'd0;
            pending_count_q  <= 32'd0;
            pending_period_q <= 32'd0;
            playing_q        <= 1'b0;
            endless_q        <= 1'b0;
            remaining_q      <= 32'd0;
            buffer_q         <= {BUFFER_BITS{1'b0}};
            words_q          <= 10'd0;
            word_q           <= 10'd0;
            hold_q           <= 16'd0;
            period_q         <= 32'd0;
            until_next_q     <= 32'd0;
            asked_words_q    <= 10'd0;
            shortest_q       <= 26'd0;
            playing_later_q  <= 1'b0;
            ramping_later_q  <= 1'b0;
            drive_q          <= 32'd0;
            ended_q          <= 3'b000;
            triggers_q       <= 32'd0;
            ignored_q        <= 32'd0;
        end
    end

    assign play_result_o  = !slot_good_i ? `RESULT_BAD_SLOT : faulted_i ? `RESULT_FAULTED : !armed_i ? `RESULT_NOT_ARMED
                          : slot_words_i == 10'd0 ? `RESULT_EMPTY_SLOT : pending_q ? `RESULT_BUSY
                          : too_short ? `RESULT_BAD_VALUE : `RESULT_OK;
    assign landing_busy_o = ((playing_q || repeating) && buffer_q == landing_i)
                         || (pending_q && pending_buffer_q == landing_i);
    assign read_buffer_o  = buffer_q;
    assign read_word_o    = word_q;
    assign drive_o        = drive_q;
    assign ended_o        = ended_q[2];
    assign playing_o      = playing_q;
    assign repeating_o    = repeating;
    assign pending_o      = pending_q;
    assign triggers_o     = triggers_q;
    assign ignored_o      = ignored_q;
endmodule

`default_nettype wire
