// Protection of the 60 V stages: watches the register that drives the pins, whoever set it.
//
// c[t]: the pins in tick t, counted from reset; change[t] = c[t] ^ c[t - 1], c[-1] = 0. Edges are counted in parts of
// PART_TICKS: part k of all channels together is the ticks k * PART_TICKS to (k + 1) * PART_TICKS - 1, that of channel n alone
// begins 33 - n ticks earlier. What counts is the part that runs and the 15 before it. Fifteen parts are EDGE_WINDOW_TICKS at
// least, and an interval as long as that touches no more than 16: so no interval of EDGE_WINDOW_TICKS, wherever it begins, has
// more edges than the limit. A cause is looked for at changes only: pins at rest trip nothing.
//   short pulse    a channel changes less than pulse_ticks_i after the last change of anything, and has changed since
//                  the pins last rested that long: exact but for chains of close changes, where it is strict. Tick t + 2.
//   channel edges  channel n has changed since its turn before, and has more than channel_edges_i changes in its 16 parts.
//                  Tick T + 3, where T >= t + 2 is the tick of its turn, T modulo 32 = n: t + 5 to t + 36.
//   total edges    with this change all channels have more than total_edges_i together in 16 parts. Tick t + 3.
//   long emission  an emission has sounded for more than emission_ticks_i ticks, tick t the latest: level in t + 1.
//   duty           active in tick t with more than duty_ticks_i in the bucket, into which flow 65536 / 65536 in each active
//                  tick before t, and out of which, down to 0, duty_share_i / 65536 in every tick: level in t + 1.
//
// 32 counters and comparators would take 1500 LUTs for the edges alone. Instead each channel counts modulo 2**LOW_BITS, and one
// channel a clock has its turn: its account in a memory, the edges since reset, is brought up to date. Channels change
// PULSE_TICKS_MIN apart, or else a short pulse shuts them: a round of turns sees fewer than 2**LOW_BITS edges of a channel,
// that of the fault included, so that no edge is lost. At the last turn of a part a second memory keeps the account, in place of
// that of 16 parts before; an account less that is what counts.
`default_nettype none

module stage_limits #(
    // of the board: what the inputs are at least or at most
    parameter [31:0] EDGE_WINDOW_TICKS  = 32'd0,  // at most 2**26
    parameter [31:0] PULSE_TICKS_MIN    = 32'd0,
    parameter [31:0] CHANNEL_EDGES_MAX  = 32'd0,
    parameter [31:0] TOTAL_EDGES_MAX    = 32'd0,
    parameter [31:0] EMISSION_TICKS_MAX = 32'd0,
    parameter [31:0] DUTY_TICKS_MAX     = 32'd0
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire [31:0] channel_i,         // the output register
    input  wire        active_i,          // playing or ramping
    input  wire        emission_i,        // an emission sounds
    input  wire        start_i,           // pulse: an emission begins in the next clock
    input  wire        clear_i,           // pulse: forget channels_o
    input  wire [15:0] pulse_ticks_i,     // shortest time between two changes of one channel
    input  wire [$clog2((CHANNEL_EDGES_MAX | 32'd1) + 32'd1)-1:0]  channel_edges_i,   // most edges of one channel in EDGE_WINDOW_TICKS
    input  wire [$clog2((TOTAL_EDGES_MAX | 32'd1) + 32'd1)-1:0]    total_edges_i,     // most edges of all channels together in them
    input  wire [$clog2((EMISSION_TICKS_MAX | 32'd1) + 32'd1)-1:0] emission_ticks_i,  // longest emission
    input  wire [16:0] duty_share_i,      // 65536: always active allowed
    input  wire [$clog2((DUTY_TICKS_MAX | 32'd1) + 32'd1)-1:0]     duty_ticks_i,      // what the bucket holds
    output wire [4:0]  cause_o,           // duty, long emission, total edges, channel edges, short pulse
    output wire [31:0] channels_o,        // which made the first short pulse or edge too many since clear_i
    output wire [31:0] duty_level_o       // ticks in the bucket
);
    localparam [31:0] ROUNDS     = EDGE_WINDOW_TICKS == 32'd0 ? 32'd1 : (EDGE_WINDOW_TICKS + 32'd479) / 32'd480;
    localparam        ROUND_BITS = ROUNDS > 32'd1 ? $clog2(ROUNDS) : 1;
    localparam [31:0] LAST_ROUND = ROUNDS - 32'd1;
    // Counts have a bit more than their limit: the outputs are off long before they wrap
    localparam EDGE_BITS    = $clog2((CHANNEL_EDGES_MAX | 32'd1) + 32'd1);
    localparam ACCOUNT_BITS = $clog2(CHANNEL_EDGES_MAX + 32'd64) + 1;
    localparam ALL_BITS     = $clog2((TOTAL_EDGES_MAX | 32'd1) + 32'd1);
    localparam TOTAL_BITS   = $clog2(TOTAL_EDGES_MAX + 32'd320) + 2;  // and a sign
    localparam AGE_BITS     = $clog2((EMISSION_TICKS_MAX | 32'd1) + 32'd1);
    localparam DUTY_BITS    = $clog2((DUTY_TICKS_MAX | 32'd1) + 32'd1);
    localparam LEVEL_BITS   = DUTY_BITS + 17;
    // In 32 ticks a channel makes 31 / PULSE_TICKS_MIN + 1 edges, and four more where a short pulse shuts it 3 ticks later
    localparam LOW_BITS     = $clog2((PULSE_TICKS_MIN == 32'd0 ? 32'd31 : 32'd31 / PULSE_TICKS_MIN) + 32'd6);

    // Time: a turn for each channel is a round, ROUNDS of them are a part
    reg [4:0]            turn_q;
    reg [ROUND_BITS-1:0] round_q;
    reg                  last_round_q;           // of this part
    reg [3:0]            part_q;
    reg                  parts_full_q;           // 16 parts have passed since reset
    reg                  first_round_q;
    wire                 part_begins = turn_q == 5'd0 && round_q == {ROUND_BITS{1'b0}};

    always @(posedge clk_i) begin
        turn_q <= turn_q + 5'd1;
        if (turn_q == 5'd31) begin
            first_round_q <= 1'b0;
            round_q       <= last_round_q ? {ROUND_BITS{1'b0}} : round_q + 1'b1;
            last_round_q  <= ROUNDS == 32'd1 || (!last_round_q && round_q + 1'b1 == LAST_ROUND[ROUND_BITS-1:0]);
            if (last_round_q) begin
                part_q       <= part_q + 4'd1;
                parts_full_q <= parts_full_q || part_q == 4'd15;
            end
        end
        if (rst_i) begin
            turn_q        <= 5'd0;
            round_q       <= {ROUND_BITS{1'b0}};
            last_round_q  <= ROUNDS == 32'd1;
            part_q        <= 4'd0;
            parts_full_q  <= 1'b0;
            first_round_q <= 1'b1;
        end
    end

    // Changes, one clock late
    reg [31:0] pins_q, change_q;
    reg        moved_q;
    wire [31:0] change  = channel_i ^ pins_q;

    always @(posedge clk_i) begin
        pins_q   <= channel_i;
        change_q <= change;
        moved_q  <= change != 32'd0;
        if (rst_i) begin
            pins_q   <= 32'd0;
            change_q <= 32'd0;
            moved_q  <= 1'b0;
        end
    end

    // Short pulses
    reg [15:0] since_q;                          // ticks from the last change to the one in change_q
    reg        soon_q;                           // less than pulse_ticks_i
    reg [31:0] recent_q;                         // channels that changed since the pins last rested
    reg  [31:0] kept, short_pulse;
    always @* begin
        kept        = 32'd0;
        short_pulse = 32'd0;
        if (moved_q && soon_q) begin
            kept        = recent_q;
            short_pulse = change_q & recent_q;
        end
    end

    always @(posedge clk_i) begin
        soon_q <= moved_q ? pulse_ticks_i > 16'd1 : {1'b0, since_q} + 17'd1 < {1'b0, pulse_ticks_i};
        if (moved_q) begin
            since_q  <= 16'd1;
            recent_q <= kept | change_q;
        end else if (since_q != 16'hFFFF) since_q <= since_q + 16'd1;
        if (rst_i) begin
            soon_q   <= 1'b0;
            since_q  <= 16'hFFFF;
            recent_q <= 32'd0;
        end
    end

    // Edges of each channel, modulo 2**LOW_BITS: bit k of all 32 lies in the k-th word, so that one change of many is one addition
    wire [LOW_BITS-1:0] low;                     // of the channel whose turn it is
    generate
        genvar k;
        for (k = 0; k < LOW_BITS; k = k + 1) begin : low_bit
            reg  [31:0] count_q;
            wire [31:0] into;
            if (k == 0) begin : first
                assign into = change_q;
            end else begin : further
                assign into = low_bit[k-1].into & low_bit[k-1].count_q;
            end
            always @(posedge clk_i) begin
                if (moved_q) count_q <= count_q ^ into;
                if (rst_i) count_q <= 32'd0;
            end
            assign low[k] = count_q[turn_q];
        end
    endgenerate

    // Their accounts: fetched, brought up to date, judged. A turn finds nothing new unless its channel has changed, and then
    // nothing is too many: in the compiled library turns rest from a round behind the last change on, but for the last of a part
    reg [ACCOUNT_BITS-1:0] accounts [0:31];      // edges, not since reset until the first round is over
    (* no_rw_check *)
    reg [ACCOUNT_BITS-1:0] made_by [0:511];      // edges when the part began of which 15 more have begun: part modulo 16, channel
    reg [4:0]              fetched_q, made_turn_q;
    reg                    fetched_last_q, made_last_q;  // the part ends with this turn
    reg                    fetched_first_q, fetched_full_q;
    reg [3:0]              fetched_part_q, made_part_q;
    reg [LOW_BITS-1:0]     low_1_q;
    reg [ACCOUNT_BITS-1:0] account_q, oldest_q, made_q, base_q;
    reg                    new_q;                // the channel has changed since its turn before
    wire [ACCOUNT_BITS-1:0] account = fetched_first_q ? {ACCOUNT_BITS{1'b0}} : account_q;
    wire                    wraps   = low_1_q < account[LOW_BITS-1:0];
    wire [ACCOUNT_BITS-1:0] counts  = made_q - base_q;
    wire                    too_many = new_q && counts > {{ACCOUNT_BITS-EDGE_BITS{1'b0}}, channel_edges_i};
    reg  [31:0]             made_one_q;           // made_turn_q, one bit a channel

`ifdef SYNTHESIS
    wire awake = 1'b1;
`else
    reg  [5:0] stay_q;
    wire       awake = stay_q != 6'd0 || last_round_q;
    always @(posedge clk_i) begin
        if (moved_q || last_round_q) stay_q <= 6'd35;  // a round and the way of its last turn
        else if (awake)              stay_q <= stay_q - 6'd1;
        if (rst_i)                   stay_q <= 6'd35;
    end
`endif

    always @(posedge clk_i) begin
        new_q <= 1'b0;
        if (awake) begin
            low_1_q         <= low;
            account_q       <= accounts[turn_q];
            oldest_q        <= made_by[{part_q, turn_q}];
            fetched_q       <= turn_q;
            fetched_part_q  <= part_q;
            fetched_last_q  <= last_round_q;
            fetched_first_q <= first_round_q;
            fetched_full_q  <= parts_full_q;

            new_q       <= low_1_q != account[LOW_BITS-1:0];
            made_q      <= {account[ACCOUNT_BITS-1:LOW_BITS] + {{ACCOUNT_BITS-LOW_BITS-1{1'b0}}, wraps}, low_1_q};
            base_q      <= fetched_full_q ? oldest_q : {ACCOUNT_BITS{1'b0}};
            made_turn_q <= fetched_q;
            made_one_q  <= 32'd1 << fetched_q;
            made_part_q <= fetched_part_q;
            made_last_q <= fetched_last_q;

            accounts[made_turn_q] <= made_q;
            if (made_last_q) made_by[{made_part_q, made_turn_q}] <= made_q;
        end
    end

    // Edges of all
    reg [5:0]            moves_q;
    reg                  begun_q, first_moves_q; // a part begins, in step with change_q and with moves_q
    reg [TOTAL_BITS-1:0] made_in [0:15];         // edges when a part began
    reg [TOTAL_BITS-1:0] all_q, all_base_q;      // edges since reset; those when the oldest part that counts began
    reg [TOTAL_BITS-1:0] all_limit_q;            // number of the last edge that is allowed
    wire [TOTAL_BITS-1:0] all       = all_q + {{TOTAL_BITS-6{1'b0}}, moves_q};
    wire [TOTAL_BITS-1:0] all_left  = all_limit_q - all;

    function [2:0] ones_4(input [3:0] bits);
        ones_4 = {2'd0, bits[0]} + {2'd0, bits[1]} + {2'd0, bits[2]} + {2'd0, bits[3]};
    endfunction

    function [3:0] ones_8(input [7:0] bits);
        ones_8 = {1'b0, ones_4(bits[7:4])} + {1'b0, ones_4(bits[3:0])};
    endfunction

    function [5:0] ones_32(input [31:0] bits);
        ones_32 = ({2'd0, ones_8(bits[31:24])} + {2'd0, ones_8(bits[23:16])}) + ({2'd0, ones_8(bits[15:8])} + {2'd0, ones_8(bits[7:0])});
    endfunction

    // Time
    reg [AGE_BITS-1:0]   age_q;                  // ticks the emission has sounded before this one, unless it begins with this
    reg                  begins_q;
    reg [LEVEL_BITS-1:0] level_q;                // 16.16 ticks of activity
    wire [AGE_BITS-1:0] age = begins_q ? {AGE_BITS{1'b0}} : age_q;
    wire        late    = emission_i && age >= emission_ticks_i;
    wire [17:0] flow    = {1'b0, active_i, 16'd0} - {1'b0, duty_share_i};
    wire [LEVEL_BITS-1:0] level = level_q + {{LEVEL_BITS-18{flow[17]}}, flow};
    wire        empty   = level_q < {{LEVEL_BITS-17{1'b0}}, duty_share_i};  // but for this tick: what flows out is more
    wire        full    = &level_q[LEVEL_BITS-1:17];                        // what flows in may be more; far beyond any limit
    wire        part_tick = level_q[15:0] != 16'd0;
    wire [DUTY_BITS+2:0] duty_left = {2'b00, duty_ticks_i, 1'b0} - {1'b0, level_q[LEVEL_BITS-1:16], part_tick};

    reg        short_q, edges_q, total_edges_q, late_q, duty_q;
    reg [31:0] channels_q;
    reg        none_q;                           // channels_q is 0

    always @(posedge clk_i) begin
        begun_q       <= part_begins;
        first_moves_q <= begun_q;
        if (part_begins) all_base_q <= parts_full_q || part_q == 4'd15 ? made_in[part_q + 4'd1] : {TOTAL_BITS{1'b0}};
        all_limit_q   <= all_base_q + {{TOTAL_BITS-ALL_BITS{1'b0}}, total_edges_i};
        if (first_moves_q) made_in[part_q] <= all_q;
        total_edges_q <= 1'b0;
        moves_q       <= 6'd0;
        if (moves_q != 6'd0) begin
            all_q         <= all;
            total_edges_q <= all_left[TOTAL_BITS-1];
        end
        if (moved_q) moves_q <= ones_32(change_q);

        short_q <= short_pulse != 32'd0;
        edges_q <= too_many;
        none_q  <= (clear_i || none_q) && short_pulse == 32'd0 && !too_many;
        if (clear_i || none_q) channels_q <= short_pulse | (made_one_q & {32{too_many}});

        late_q <= late;
        begins_q <= start_i;
        if (!emission_i) age_q <= {AGE_BITS{1'b0}};
        else             age_q <= late ? age : age + 1'b1;
        duty_q  <= active_i && duty_left[DUTY_BITS+2];  // negative
        if (!active_i && empty)       level_q <= {LEVEL_BITS{1'b0}};
        else if (!(active_i && full)) level_q <= level;

        if (rst_i) begin
            begun_q       <= 1'b0;
            first_moves_q <= 1'b0;
            moves_q       <= 6'd0;
            all_q         <= {TOTAL_BITS{1'b0}};
            all_base_q    <= {TOTAL_BITS{1'b0}};
            age_q         <= {AGE_BITS{1'b0}};
            begins_q      <= 1'b0;
            level_q       <= {LEVEL_BITS{1'b0}};
            {duty_q, late_q, total_edges_q, edges_q, short_q} <= 5'd0;
            channels_q    <= 32'd0;
            none_q        <= 1'b1;
        end
    end

    assign cause_o      = {duty_q, late_q, total_edges_q, edges_q, short_q};
    assign channels_o   = channels_q;
    assign duty_level_o = {{31-DUTY_BITS{1'b0}}, level_q[LEVEL_BITS-1:16]};
`ifdef FORMAL
    `include "stage_limits_properties.vh"
`endif
endmodule

`default_nettype wire
