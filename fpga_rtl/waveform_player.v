// What the channels should do: the idle word, the ramp to it, or the words of an emission.
// The play at the head of the queue begins with a trigger, when nothing sounds, or at its time; one trigger starts
// exactly one. Behind an emission the idle word is held for a bit period at least, so that no pulse is short.
// From state to drive_o it takes three clocks (memory, register, selection), to the pins four.
`default_nettype none
`include "registers.vh"

module waveform_player #(
    parameter BUFFER_BITS = 3
) (
    input  wire                   clk_i,
    input  wire                   rst_i,
    // settings
    input  wire [31:0]            idle_word_i,
    input  wire [31:0]            bit_period_i,
    // commands
    input  wire                   armed_i,
    input  wire                   stop_i,          // pulse: drop what waits, end with this emission
    input  wire                   disarm_i,        // pulse: drop what waits, end with this word
    input  wire                   fault_i,         // outputs are being shut: nothing on its way counts
    input  wire                   trigger_i,       // pulse
    input  wire [63:0]            now_i,
    // the head of the queue
    input  wire                   head_i,
    input  wire [BUFFER_BITS-1:0] head_buffer_i,
    input  wire [9:0]             head_first_i,
    input  wire [9:0]             head_length_i,
    input  wire [15:0]            head_count_i,    // 0: endless
    input  wire [1:0]             head_start_i,
    input  wire                   head_polarity_i,
    input  wire [31:0]            head_period_ticks_i,
    input  wire [31:0]            head_mask_i,
    input  wire [63:0]            head_when_i,     // delay or time
    input  wire                   head_delayed_i, head_delayed_one_i,
    input  wire                   head_live_i,
    output wire                   pop_o,
    // buffers
    input  wire [BUFFER_BITS-1:0] landing_i,
    output wire                   landing_used_o,  // and not live
    output wire                   live_o,          // what plays is still arriving
    output wire                   read_o,          // pulse: it has come to another word, and reads it
    output wire [BUFFER_BITS-1:0] read_buffer_o,
    output wire [9:0]             read_word_o,
    output wire [2:0]             read_chunk_o,
    output wire [6:0]             read_within_o,
    input  wire                   missing_i,       // that word has not arrived
    input  wire [31:0]            read_data_i,     // two clocks later
    output wire                   underrun_o,
    // ramp
    input  wire                   ramping_i,
    input  wire                   ramp_bit_i,      // one clock later
    // out
    output wire [31:0]            drive_o,
    output wire                   start_o,         // pulse: an emission begins in the next clock
    output wire                   ended_o,         // pulse: in the next clock the pins have ended an emission
    output wire                   playing_o,
    output wire                   delayed_o,
    output wire                   repeating_o,
    output wire                   settled_o,       // nothing sounds, and the idle word is a bit period old
    output wire                   quiet_o,         // nor waits in a delay or repeats
    output wire                   waiting_o,       // the head waits for a trigger
    output wire [31:0]            triggers_o,
    output wire [31:0]            ignored_o,
    output wire [31:0]            missed_o,
    output wire [63:0]            trigger_time_o,
    output wire [63:0]            emission_time_o
);
    reg                   playing_q, delayed_q, endless_q, halting_q;
    reg [15:0]            remaining_q;     // emissions after this one
    reg [BUFFER_BITS-1:0] buffer_q;
    reg                   live_q, polarity_q;
    reg [31:0]            mask_q;
    reg [9:0]             first_q, length_q;
    reg [9:0]             word_q, left_q;  // being played; behind it
    reg [2:0]             chunk_q;         // the same word, while it plays from the first
    reg [6:0]             within_q;
    reg [15:0]            hold_q;          // ticks left of it
    reg                   hold_over_q;     // none: as for the others named so, known a clock early
    reg [15:0]            fraction_q;      // of a tick by which it begins early
    reg [31:0]            period_q, until_next_q, delay_left_q;
    reg                   until_next_over_q, delay_over_q;
    reg [15:0]            rest_q;
    reg                   resting_q;       // rest_q is not 0
    reg                   underrun_q;
    reg                   read_q;

    reg [63:0]            ahead_q;         // what now_i will be when a play decided on in the next clock is on the pins
    reg [63:0]            before_q;        // a tick less
    reg                   due_q, missed_q; // the time of the head has come; has passed
    reg [1:0]             playing_later_q, ramping_later_q;
    reg                   ramp_bit_q;
    reg [31:0]            drive_q;
    reg [3:0]             ended_q;
    reg [31:0]            triggers_q, ignored_q, missed_count_q;
    reg [63:0]            trigger_time_q, emission_time_q;

    wire repeating = endless_q || remaining_q != 16'd0;
    wire resting   = resting_q;
    wire halted    = stop_i || disarm_i;     // nothing begins in this clock; what begins with a fault ends with it
    wire room      = armed_i && !playing_q && !delayed_q && !resting;
    wire free      = room && !halted;
    reg  by_trigger, begins;
    wire missed    = head_i && missed_q;
    wire delay     = head_delayed_i;

    wire boundary  = playing_q && hold_over_q;
    wire last      = boundary && left_q == 10'd0;
    wire due       = repeating && !delayed_q && until_next_over_q && !begins && !halted;
    wire released  = delayed_q && delay_over_q && !halted;
    wire from_head = begins && !delay;
    wire start     = due || released || from_head;
    always @* begin
        by_trigger = 1'b0;
        begins     = 1'b0;
        if (head_i) begin
            by_trigger = head_start_i == `START_TRIGGER && trigger_i;
            begins     = free && (by_trigger || (head_start_i == `START_TIME && due_q)
                                  || (head_start_i == `START_NOW && remaining_q == 16'd0));
        end
    end
    wire [16:0] next_fraction = {1'b0, fraction_q} + {1'b0, bit_period_i[15:0]};

    always @(posedge clk_i) begin
        if (trigger_i) begin
            triggers_q     <= triggers_q + 32'd1;
            trigger_time_q <= now_i;
            if (!(begins && by_trigger)) ignored_q <= ignored_q + 32'd1;
        end
        if (missed) missed_count_q <= missed_count_q + 32'd1;
        ahead_q  <= ahead_q + 64'd1;
        before_q <= ahead_q;
        due_q    <= 1'b0;
        missed_q <= 1'b0;
        if (head_i && head_start_i == `START_TIME) begin
            due_q    <= head_when_i == ahead_q;
            missed_q <= head_when_i < ahead_q && !pop_o;
        end

        // words of an emission
        if (playing_q) begin
            hold_over_q <= !boundary && hold_q == 16'd1;
            hold_q      <= hold_q - 16'd1;
        end
        if (boundary) begin
            hold_q     <= bit_period_i[31:16] - 16'd1 + {15'd0, next_fraction[16]};
            fraction_q <= next_fraction[15:0];
            word_q     <= word_q + 10'd1;
            left_q     <= left_q - 10'd1;
            within_q   <= within_q == 7'd124 ? 7'd0 : within_q + 7'd1;
            if (within_q == 7'd124) chunk_q <= chunk_q + 3'd1;
            if (last || halting_q) begin
                playing_q <= 1'b0;
                halting_q <= 1'b0;
            end
        end
        if (!until_next_over_q) begin
            until_next_q      <= until_next_q - 32'd1;
            until_next_over_q <= until_next_q == 32'd1;
        end
        if (delayed_q) begin
            delay_left_q <= delay_left_q - 32'd1;
            delay_over_q <= delay_left_q == 32'd1;
        end
        if (playing_q || ramping_i) begin
            rest_q    <= bit_period_i[31:16] - 16'd1;
            resting_q <= 1'b1;
        end else if (resting) begin
            rest_q    <= rest_q - 16'd1;
            resting_q <= rest_q != 16'd1;
        end
        underrun_q <= playing_q && live_q && missing_i;
        read_q     <= start || boundary;

        if (begins) begin
            buffer_q     <= head_buffer_i;
            first_q      <= head_first_i;
            length_q     <= head_length_i;
            period_q     <= head_period_ticks_i;
            mask_q       <= head_mask_i;
            polarity_q   <= head_polarity_i;
            live_q       <= head_live_i;
            endless_q    <= head_count_i == 16'd0;
            remaining_q  <= head_count_i == 16'd0 ? 16'd0 : head_count_i - 16'd1;
            delayed_q    <= delay;
            delay_left_q <= head_when_i[31:0] - 32'd1;
            delay_over_q <= head_delayed_one_i;
        end else if (due && !endless_q) remaining_q <= remaining_q - 16'd1;
        if (released) delayed_q <= 1'b0;
        if (start) begin
            playing_q       <= 1'b1;
            word_q          <= from_head ? head_first_i : first_q;
            left_q          <= (from_head ? head_length_i : length_q) - 10'd1;
            chunk_q         <= 3'd0;
            within_q        <= 7'd0;
            hold_q          <= bit_period_i[31:16] - 16'd1;
            hold_over_q     <= 1'b0;
            fraction_q      <= bit_period_i[15:0];
            until_next_q    <= (from_head ? head_period_ticks_i : period_q) - 32'd1;
            until_next_over_q <= 1'b0;
            emission_time_q <= before_q;
        end
        if (stop_i || disarm_i) begin
            endless_q   <= 1'b0;
            remaining_q <= 16'd0;
            delayed_q   <= 1'b0;
        end
        if (disarm_i && playing_q) begin
            halting_q <= !boundary;
            if (boundary) playing_q <= 1'b0;
        end
        if (fault_i) begin
            playing_q   <= 1'b0;
            halting_q   <= 1'b0;
            delayed_q   <= 1'b0;
            endless_q   <= 1'b0;
            remaining_q <= 16'd0;
            resting_q   <= 1'b0;
        end

        playing_later_q <= {playing_later_q[0], playing_q};
        ramping_later_q <= {ramping_later_q[0], ramping_i};
        ramp_bit_q      <= ramp_bit_i;
        drive_q <= ramping_later_q[1] ? idle_word_i & {32{ramp_bit_q}}
                 : playing_later_q[1] ? (mask_q & (read_data_i ^ {32{polarity_q}})) | (~mask_q & idle_word_i) : idle_word_i;
        ended_q <= fault_i ? 4'b0000 : {ended_q[2:0], last};

        if (rst_i) begin
            playing_q       <= 1'b0;
            delayed_q       <= 1'b0;
            endless_q       <= 1'b0;
            halting_q       <= 1'b0;
            remaining_q     <= 16'd0;
            buffer_q        <= {BUFFER_BITS{1'b0}};
            live_q          <= 1'b0;
            polarity_q      <= 1'b0;
            mask_q          <= 32'd0;
            first_q         <= 10'd0;
            length_q        <= 10'd0;
            word_q          <= 10'd0;
            left_q          <= 10'd0;
            chunk_q         <= 3'd0;
            within_q        <= 7'd0;
            hold_q          <= 16'd0;
            fraction_q      <= 16'd0;
            period_q        <= 32'd0;
            until_next_q    <= 32'd0;
            delay_left_q    <= 32'd0;
            hold_over_q       <= 1'b0;
            until_next_over_q <= 1'b1;
            delay_over_q      <= 1'b0;
            rest_q          <= 16'd0;
            resting_q       <= 1'b0;
            underrun_q      <= 1'b0;
            read_q          <= 1'b0;
            ahead_q         <= 64'd6;
            before_q        <= 64'd5;
            due_q           <= 1'b0;
            missed_q        <= 1'b0;
            playing_later_q <= 2'b00;
            ramping_later_q <= 2'b00;
            ramp_bit_q      <= 1'b0;
            drive_q         <= 32'd0;
            ended_q         <= 4'b0000;
            triggers_q      <= 32'd0;
            ignored_q       <= 32'd0;
            missed_count_q  <= 32'd0;
            trigger_time_q  <= 64'd0;
            emission_time_q <= 64'd0;
        end
    end

    wire running = playing_q || delayed_q || repeating;

    assign pop_o           = begins || missed;
    assign landing_used_o  = running && buffer_q == landing_i && !live_q;
    assign live_o          = running && live_q;
    assign read_o          = read_q;
    assign read_buffer_o   = buffer_q;
    assign read_word_o     = word_q;
    assign read_chunk_o    = chunk_q;
    assign read_within_o   = within_q;
    assign underrun_o      = underrun_q;
    assign drive_o         = drive_q;
    assign start_o         = start;
    assign ended_o         = ended_q[3];
    assign playing_o       = playing_q;
    assign delayed_o       = delayed_q;
    assign repeating_o     = repeating;
    assign settled_o       = !playing_q && !resting;
    assign quiet_o         = !running && !resting;
    assign waiting_o       = head_i && head_start_i == `START_TRIGGER && room;
    assign triggers_o      = triggers_q;
    assign ignored_o       = ignored_q;
    assign missed_o        = missed_count_q;
    assign trigger_time_o  = trigger_time_q;
    assign emission_time_o = emission_time_q;
endmodule

`default_nettype wire
