// What the channels should do: the idle word, the ramp to it, or the words of an emission.
// The play at the head of the queue begins with a trigger, when nothing sounds, or at its time; one trigger starts
// exactly one. Behind an emission the idle word is held for a bit period at least, so that no pulse is short.
// From state to drive_o it takes three clocks (memory, register, selection), to the pins four.
// What takes time is counted up from 2 and compared with its length a clock before it is over.
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
    input  wire                   head_triggered_i, head_scheduled_i, head_immediate_i,  // with head_i: what it begins with
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
    input  wire                   ramp_bit_i,      // two clocks later
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
    reg [15:0]            count_q;         // emissions to come, this one included, unless endless
    reg                   repeating_q;     // more than this one, or endless
    reg [BUFFER_BITS-1:0] buffer_q;
    reg                   live_q, polarity_q;
    reg [31:0]            mask_q;
    reg [9:0]             first_q, final_q;
    reg [9:0]             number_q;        // of the word being played: first, 0, to final_q
    reg                   last_q;          // it is that, as of a clock ago
    reg [2:0]             chunk_q;         // the same word, while it plays from the first
    reg [6:0]             within_q;
    reg [15:0]            hold_q;          // ticks of this word, or of the idle word behind an emission or a ramp
    reg                   hold_over_q;     // all: known a clock early
    reg [15:0]            fraction_q;      // of a tick by which it begins early
    reg [31:0]            delay_q, period_q;
    reg [31:0]            elapsed_q;       // of the delay, or of the period
    reg                   elapsed_over_q;
    reg                   resting_q;       // the idle word is younger than a bit period
    reg                   underrun_q;
    reg                   read_q;

    reg [63:0]            ahead_q;         // what now_i will be when a play decided on in the next clock is on the pins
    reg [63:0]            before_q;        // a tick less
    reg                   due_q, missed_q; // the time of the head has come; has passed
    reg                   playing_later_q;
    reg [1:0]             ramping_later_q;
    reg [31:0]            plays_q;         // channels whose word is read_data_i
    reg [31:0]            drive_q;
    reg [3:0]             ended_q;
    reg [31:0]            triggers_q, ignored_q, missed_count_q;
    reg [63:0]            trigger_time_q, emission_time_q;

    wire halted    = stop_i || disarm_i;     // nothing begins in this clock; what begins with a fault ends with it
    wire room      = armed_i && !playing_q && !delayed_q && !resting_q;
    reg  by_trigger, wants;                  // the head: begins unless halted
    wire begins    = wants && !halted;
    wire missed    = head_i && missed_q;
    wire delay     = head_delayed_i;

    wire boundary  = playing_q && hold_over_q;
    wire last      = boundary && last_q;
    wire due       = repeating_q && !delayed_q && elapsed_over_q && !wants;  // with the end of the last word, or later
    wire released  = delayed_q && elapsed_over_q;
    wire starts    = due || released || (wants && !delay);  // unless halted
    wire start     = starts && !halted;
    always @* begin
        by_trigger = 1'b0;
        wants      = 1'b0;
        if (head_i) begin
            by_trigger = head_triggered_i && trigger_i;
            wants      = room && (by_trigger || due_q || (head_immediate_i && (!repeating_q || endless_q)));
        end
    end
    wire [16:0] next_fraction = {1'b0, fraction_q} + {1'b0, bit_period_i[15:0]};
    wire        goes_on   = boundary && !last_q && !halting_q && !disarm_i;
    wire        hold_full = hold_q == bit_period_i[31:16];

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
        if (head_scheduled_i) begin
            due_q    <= head_when_i == ahead_q;
            missed_q <= head_when_i < ahead_q && !pop_o;
        end

        // words of an emission, and the idle word behind it
        if (playing_q || ramping_i) resting_q <= 1'b1;
        else if (hold_full)         resting_q <= 1'b0;
        if (playing_q) last_q <= number_q == final_q;
        hold_over_q <= playing_q && hold_full;
        if (boundary)                                    hold_q <= goes_on && next_fraction[16] ? 16'd1 : 16'd2;
        else if (playing_q || (resting_q && !hold_full)) hold_q <= hold_q + 16'd1;
        else                                             hold_q <= 16'd2;
        if (ramping_i && !playing_q) hold_q <= 16'd2;
        if (!playing_q || last) begin        // what plays next is a first word
            fraction_q <= bit_period_i[15:0];
            number_q   <= 10'd0;
            chunk_q    <= 3'd0;
            within_q   <= 7'd0;
        end else if (boundary) begin
            fraction_q <= next_fraction[15:0];
            number_q   <= number_q + 10'd1;
            within_q   <= within_q == 7'd124 ? 7'd0 : within_q + 7'd1;
            if (within_q == 7'd124) chunk_q <= chunk_q + 3'd1;
        end
        if (boundary && (last_q || halting_q)) begin
            playing_q <= 1'b0;
            halting_q <= 1'b0;
        end
        underrun_q <= playing_q && live_q && missing_i;
        read_q     <= start || boundary;

        if (delayed_q || repeating_q) begin
            elapsed_q      <= elapsed_q + 32'd1;
            elapsed_over_q <= elapsed_q == (delayed_q ? delay_q : period_q);
        end
        if (wants) begin                     // what stands in these counts only while something runs
            buffer_q     <= head_buffer_i;
            first_q      <= head_first_i;
            final_q      <= head_length_i - 10'd1;
            period_q     <= head_period_ticks_i;
            delay_q      <= head_when_i[31:0];
            mask_q       <= head_mask_i;
            polarity_q   <= head_polarity_i;
            live_q       <= head_live_i;
            endless_q    <= head_count_i == 16'd0;
            count_q      <= head_count_i;
            repeating_q  <= head_count_i != 16'd1;
            delayed_q    <= delay;
        end else if (due && !endless_q) begin
            count_q     <= count_q - 16'd1;
            repeating_q <= count_q != 16'd2;
        end
        if (released) delayed_q <= 1'b0;
        if (wants || starts) begin
            elapsed_q      <= 32'd2;
            elapsed_over_q <= wants && head_delayed_one_i;
        end
        if (start) begin
            playing_q       <= 1'b1;
            emission_time_q <= before_q;
        end
        if (halted) begin
            endless_q   <= 1'b0;
            repeating_q <= 1'b0;
            count_q     <= 16'd0;
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
            repeating_q <= 1'b0;
            count_q     <= 16'd0;
            resting_q   <= 1'b0;
        end

        playing_later_q <= playing_q;
        plays_q         <= playing_later_q && !ramping_later_q[0] ? mask_q : 32'd0;
        ramping_later_q <= {ramping_later_q[0], ramping_i};
        drive_q <= (plays_q & (read_data_i ^ {32{polarity_q}})) | (~plays_q & idle_word_i & {32{ramp_bit_i || !ramping_later_q[1]}});
        ended_q <= fault_i ? 4'b0000 : {ended_q[2:0], last};

        if (rst_i) begin
            playing_q       <= 1'b0;
            delayed_q       <= 1'b0;
            endless_q       <= 1'b0;
            repeating_q     <= 1'b0;
            halting_q       <= 1'b0;
            count_q         <= 16'd0;
            buffer_q        <= {BUFFER_BITS{1'b0}};
            live_q          <= 1'b0;
            polarity_q      <= 1'b0;
            mask_q          <= 32'd0;
            first_q         <= 10'd0;
            final_q         <= 10'd0;
            number_q        <= 10'd0;
            last_q          <= 1'b0;
            chunk_q         <= 3'd0;
            within_q        <= 7'd0;
            hold_q          <= 16'd2;
            hold_over_q     <= 1'b0;
            fraction_q      <= 16'd0;
            delay_q         <= 32'd0;
            period_q        <= 32'd0;
            elapsed_q       <= 32'd2;
            elapsed_over_q  <= 1'b0;
            resting_q       <= 1'b0;
            underrun_q      <= 1'b0;
            read_q          <= 1'b0;
            ahead_q         <= 64'd6;
            before_q        <= 64'd5;
            due_q           <= 1'b0;
            missed_q        <= 1'b0;
            playing_later_q <= 1'b0;
            ramping_later_q <= 2'b00;
            plays_q         <= 32'd0;
            drive_q         <= 32'd0;
            ended_q         <= 4'b0000;
            triggers_q      <= 32'd0;
            ignored_q       <= 32'd0;
            missed_count_q  <= 32'd0;
            trigger_time_q  <= 64'd0;
            emission_time_q <= 64'd0;
        end
    end

    wire running = playing_q || delayed_q || repeating_q;

    assign pop_o           = begins || missed;
    assign landing_used_o  = running && buffer_q == landing_i && !live_q;
    assign live_o          = running && live_q;
    assign read_o          = read_q;
    assign read_buffer_o   = buffer_q;
    assign read_word_o     = first_q + number_q;
    assign read_chunk_o    = chunk_q;
    assign read_within_o   = within_q;
    assign underrun_o      = underrun_q;
    assign drive_o         = drive_q;
    assign start_o         = start;
    assign ended_o         = ended_q[3];
    assign playing_o       = playing_q;
    assign delayed_o       = delayed_q;
    assign repeating_o     = repeating_q;
    assign settled_o       = !playing_q && !resting_q;
    assign quiet_o         = !running && !resting_q;
    assign waiting_o       = head_triggered_i && room;
    assign triggers_o      = triggers_q;
    assign ignored_o       = ignored_q;
    assign missed_o        = missed_count_q;
    assign trigger_time_o  = trigger_time_q;
    assign emission_time_o = emission_time_q;
`ifdef FORMAL
    `include "waveform_player_properties.vh"
`endif
endmodule

`default_nettype wire
