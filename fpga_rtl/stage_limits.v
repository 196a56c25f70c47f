// Protection of the 60 V stages: watches the register that drives the pins, whoever set it.
//
// c[t]: the pins in tick t, counted from reset; change[t] = c[t] ^ c[t - 1], c[-1] = 0. Edges are counted in parts of
// PART_TICKS: part k of all channels together is the ticks k * PART_TICKS to (k + 1) * PART_TICKS - 1, that of channel n alone
// begins n + 3 ticks later. What counts is the part that runs and the 15 before it. Fifteen parts are EDGE_WINDOW_TICKS at
// least, and an interval as long as that touches no more than 16: so no interval of EDGE_WINDOW_TICKS, wherever it begins, has
// more edges than the limit. A cause is looked for at changes only: pins at rest trip nothing.
//   short pulse    a channel changes less than pulse_ticks_i after the last change of anything, and has changed since
//                  the pins last rested that long: exact but for chains of close changes, where it is strict. Tick t + 2.
//   channel edges  a channel changes that has channel_edges_i changes in its 16 parts already; such a change is
//                  not counted. Limits above 2**24 - 1 count as that. Tick t + 2.
//   total edges    with this change all channels have more than total_edges_i together in 16 parts. Tick t + 3.
//   long emission  an emission has sounded for more than emission_ticks_i ticks, tick t the latest: level in t + 1.
//   duty           active in tick t with more than duty_ticks_i in the bucket, into which flow 65536 / 65536 in each active
//                  tick before t, and out of which, down to 0, duty_share_i / 65536 in every tick: level in t + 1.
// A limit that is written holds from 40 ticks later on: the pins must rest meanwhile.
//
// 32 counters and comparators of 24 bits would take 1500 LUTs for the edges alone. Instead each channel has a purse
// of up to 63 edges it may still make, and an account in a memory: edges made and in the purse, since reset. One channel a
// clock has its turn: its purse is given what the limit still allows. A purse that lasts for 63 clocks never runs dry
// between turns. Behind the first turn in each part a second memory keeps what the channel had made by then; an
// account less what it was 15 parts ago is what counts.
// A turn finds the same as the one before unless the channel has changed, a part has begun or the limit was written: turns
// rest from 63 clocks after the last of these, with every purse as full as it may be, and go on in the clock in which the next
// change is counted; each purse is filled within 35 clocks of it. Changes are taken from the purses whether turns rest or not.
`default_nettype none

module stage_limits #(
    parameter [31:0] EDGE_WINDOW_TICKS = 32'd0  // at most 2**26; of the board
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire [31:0] channel_i,         // the output register
    input  wire        active_i,          // playing or ramping
    input  wire        emission_i,        // an emission sounds
    input  wire        start_i,           // pulse: an emission begins in the next clock
    input  wire        clear_i,           // pulse: forget channels_o
    input  wire [15:0] pulse_ticks_i,     // shortest time between two changes of one channel
    input  wire [31:0] channel_edges_i,   // most edges of one channel in EDGE_WINDOW_TICKS
    input  wire [31:0] total_edges_i,     // most edges of all channels together in them
    input  wire [31:0] emission_ticks_i,  // longest emission
    input  wire [16:0] duty_share_i,      // 65536: always active allowed
    input  wire [31:0] duty_ticks_i,      // what the bucket holds
    output wire [4:0]  cause_o,           // duty, long emission, total edges, channel edges, short pulse
    output wire [31:0] channels_o,        // which made the first short pulse or edge too many since clear_i
    output wire [31:0] duty_level_o       // ticks in the bucket
);
    localparam [31:0] ROUNDS     = EDGE_WINDOW_TICKS == 32'd0 ? 32'd1 : (EDGE_WINDOW_TICKS + 32'd479) / 32'd480;
    localparam        ROUND_BITS = ROUNDS > 32'd1 ? $clog2(ROUNDS) : 1;
    localparam [31:0] LAST_ROUND = ROUNDS - 32'd1;
    localparam [5:0]  PURSE      = 6'd63;
    localparam [23:0] MOST       = 24'hFFFFFF;

    // Time: a turn for each channel is a round, ROUNDS of them are a part
    reg [4:0]            turn_q;
    reg [ROUND_BITS-1:0] round_q;
    reg [3:0]            part_q;
    reg                  parts_full_q;           // 15 parts have passed since reset
    reg                  begins_q;               // the first clock behind reset
    reg                  first_round_q;
    wire                 part_begins = turn_q == 5'd0 && round_q == {ROUND_BITS{1'b0}};
    wire                 part_ends   = turn_q == 5'd31 && round_q == LAST_ROUND[ROUND_BITS-1:0];
    wire [3:0]           oldest      = part_q + 4'd1;  // of the 15 before this one; 15 behind is one ahead, modulo 16

    always @(posedge clk_i) begin
        turn_q   <= turn_q + 5'd1;
        begins_q <= 1'b0;
        if (turn_q == 5'd31) begin
            first_round_q <= 1'b0;
            round_q       <= round_q + 1'b1;
            if (round_q == LAST_ROUND[ROUND_BITS-1:0]) begin
                round_q      <= {ROUND_BITS{1'b0}};
                part_q       <= part_q + 4'd1;
                parts_full_q <= parts_full_q || part_q == 4'd14;
            end
        end
        if (rst_i) begin
            turn_q        <= 5'd0;
            round_q       <= {ROUND_BITS{1'b0}};
            part_q        <= 4'd0;
            parts_full_q  <= 1'b0;
            begins_q      <= 1'b1;
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
    reg [31:0] recent_q;                         // channels that changed since the pins last rested
    reg  [31:0] kept, short_pulse;
    always @* begin
        kept        = 32'd0;
        short_pulse = 32'd0;
        if (moved_q && since_q < pulse_ticks_i) begin
            kept        = recent_q;
            short_pulse = change_q & recent_q;
        end
    end

    always @(posedge clk_i) begin
        if (moved_q) begin
            since_q  <= 16'd1;
            recent_q <= kept | change_q;
        end else if (since_q != 16'hFFFF) since_q <= since_q + 16'd1;
        if (rst_i) begin
            since_q  <= 16'hFFFF;
            recent_q <= 32'd0;
        end
    end

    // Edges of each channel: purses. Bit k of all 32 lies in purse_k_q, so that one change of many channels is one subtraction
    reg  [31:0] purse_0_q, purse_1_q, purse_2_q, purse_3_q, purse_4_q, purse_5_q;
    reg  [31:0] filled;                          // whose purse is filled: all behind reset, then that of the turn that is judged
    reg  [5:0]  given;                           // into them
    reg  [31:0] edge_too_many, borrow_0, borrow_1, borrow_2, borrow_3, borrow_4, borrow_5;
    always @* begin
        edge_too_many = 32'd0;
        borrow_0 = 32'd0;
        borrow_1 = 32'd0;
        borrow_2 = 32'd0;
        borrow_3 = 32'd0;
        borrow_4 = 32'd0;
        borrow_5 = 32'd0;
        if (moved_q) begin
            borrow_0      = change_q & (purse_0_q | purse_1_q | purse_2_q | purse_3_q | purse_4_q | purse_5_q);
            edge_too_many = change_q & ~borrow_0;
            borrow_1      = borrow_0 & ~purse_0_q;
            borrow_2      = borrow_1 & ~purse_1_q;
            borrow_3      = borrow_2 & ~purse_2_q;
            borrow_4      = borrow_3 & ~purse_3_q;
            borrow_5      = borrow_4 & ~purse_4_q;
        end
    end

    function [31:0] refilled(input [31:0] left, input [31:0] whose, input into);
        refilled = into ? left | whose : left & ~whose;
    endfunction

    // Turns change nothing but behind a change, with a part or behind a limit that is written: they rest till then
    localparam [5:0] AWAKE = 6'd63;              // one round and the way of its last turn at least, and 3 for those under way to end
    reg  [5:0] stay_q;
    wire       awake = stay_q != 6'd0;

    always @(posedge clk_i) if (moved_q || awake) begin
        purse_0_q <= refilled(purse_0_q ^ borrow_0, filled, given[0]);
        purse_1_q <= refilled(purse_1_q ^ borrow_1, filled, given[1]);
        purse_2_q <= refilled(purse_2_q ^ borrow_2, filled, given[2]);
        purse_3_q <= refilled(purse_3_q ^ borrow_3, filled, given[3]);
        purse_4_q <= refilled(purse_4_q ^ borrow_4, filled, given[4]);
        purse_5_q <= refilled(purse_5_q ^ borrow_5, filled, given[5]);
    end

    // Their accounts: fetched, looked at, judged by the limit, settled; all modulo 2**24, which no difference reaches
    localparam TAG = 12;                         // of a turn: it counts, first round, first turn in a part, part, channel
    reg [23:0] accounts [0:31];                  // edges made and in the purse; not since reset until the first round is over
    (* no_rw_check *)
    reg [23:0] made_by [0:511];                  // edges made when a part began: part, channel
    reg [23:0] limit_q;
    reg [5:0]  first_q;                          // what the purses held behind reset
    reg [4*TAG-1:0] tags_q;                      // of the turns in each step, fetched lowest
    reg        full_q;                           // parts_full_q, in step with the turn that is fetched
    reg [23:0] oldest_q, base_q, account_q;
    reg        looked_change_q, judged_change_q; // its bit of change_q
    reg [23:0] judged_account_q, settled_account_q;
    reg [5:0]  judged_purse_q, settled_purse_q, settled_given_q;
    reg        plenty_q, nothing_q;
    reg [6:0]  more_q;                           // limit less what counts less one, signed, unless plenty or nothing

    wire [4:0]  fetched        = tags_q[4:0];    // the channel in each step
    wire [4:0]  looked         = tags_q[TAG+4:TAG];
    wire        looked_first   = tags_q[2*TAG-2];
    wire [4:0]  judged         = tags_q[2*TAG+4:2*TAG];
    wire        judged_counts  = tags_q[3*TAG-1];
    wire [4:0]  settled        = tags_q[3*TAG+4:3*TAG];
    wire [3:0]  settled_part   = tags_q[3*TAG+8:3*TAG+5];
    wire        settled_begins = tags_q[3*TAG+9];
    wire        settled_counts = tags_q[4*TAG-1];
    wire [23:0] limit          = channel_edges_i > {8'd0, MOST} ? MOST : channel_edges_i[23:0];

    reg [23:0]  account, counts, made;
    reg [24:0]  more;
    reg [5:0]   purse, first;
    reg         spent;
    reg [7:0]   allowed;
    always @* begin
        account = 24'd0;
        counts  = 24'd0;
        made    = 24'd0;
        more    = 25'd0;
        purse   = 6'd0;
        first   = 6'd0;
        spent   = 1'b0;
        allowed = 8'd0;
        given  = 6'd0;
        filled = 32'd0;
        if (awake) begin
            account = looked_first ? {18'd0, first_q} : account_q;
            counts  = account - base_q;
            more    = {1'b0, limit_q} + {1'b1, ~counts};
            purse   = {purse_5_q[looked], purse_4_q[looked], purse_3_q[looked], purse_2_q[looked], purse_1_q[looked],
                       purse_0_q[looked]};
            spent   = judged_change_q && judged_purse_q != 6'd0;
            allowed = {more_q[6], more_q} + {2'b00, judged_purse_q} + {7'd0, !spent};
            first   = limit_q > {18'd0, PURSE} ? PURSE : limit_q[5:0];
            made    = settled_account_q - {18'd0, settled_purse_q};
            if (begins_q)                     given = first;
            else if (plenty_q)                given = PURSE;
            else if (nothing_q || allowed[7]) given = 6'd0;
            else if (allowed[6])              given = PURSE;
            else                              given = allowed[5:0];
            filled = begins_q ? {32{1'b1}} : {31'd0, judged_counts} << judged;
        end
    end

    always @(posedge clk_i) begin
        limit_q <= limit;
        if (change != 32'd0)       stay_q <= AWAKE;
        else if (limit != limit_q) stay_q <= AWAKE;
        else if (part_ends)        stay_q <= AWAKE;
        else if (awake)            stay_q <= stay_q - 6'd1;

        if (awake) begin
            if (begins_q) first_q <= first;
            tags_q   <= {tags_q[3*TAG-1:0], stay_q > 6'd3, first_round_q, round_q == {ROUND_BITS{1'b0}}, part_q, turn_q};
            full_q   <= parts_full_q;
            oldest_q <= made_by[{oldest, turn_q}];

            base_q          <= full_q ? oldest_q : 24'd0;
            account_q       <= accounts[fetched];
            looked_change_q <= change[fetched];

            judged_change_q  <= change[looked];
            judged_account_q <= account;
            judged_purse_q   <= purse - {5'd0, looked_change_q && purse != 6'd0};
            plenty_q         <= !more[24] && more[23:6] != 18'd0;
            nothing_q        <= more[24] && more[23:6] != {18{1'b1}};
            more_q           <= more[6:0];

            settled_account_q <= judged_account_q;
            settled_purse_q   <= judged_purse_q - {5'd0, spent};
            settled_given_q   <= given;
            if (settled_counts) begin
                accounts[settled] <= made + {18'd0, settled_given_q};
                if (settled_begins) made_by[{settled_part, settled}] <= made;
            end
        end
        if (rst_i) begin
            stay_q <= AWAKE;
            tags_q <= {4*TAG{1'b0}};
        end
    end

    // Edges of all
    reg [5:0]  moves_q;
    reg        begun_q, first_moves_q;           // a part begins, in step with change_q and with moves_q
    reg [3:0]  total_part_q;
    reg        total_full_q;
    reg [31:0] made_in [0:15];                   // edges of each part
    reg [31:0] part_moves_q, expiring_q;         // of the part that runs; of the oldest that counts
    reg [31:0] total_q, rest_q;                  // of all that count; of these without the oldest part
    wire [31:0] total = (first_moves_q ? rest_q : total_q) + {26'd0, moves_q};

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
    reg [31:0] age_q;                            // ticks the emission has sounded before this one
    reg [47:0] level_q;                          // 16.16 ticks of activity
    wire        late    = emission_i && age_q >= emission_ticks_i;
    wire [17:0] flow    = {1'b0, active_i, 16'd0} - {1'b0, duty_share_i};
    wire [49:0] level   = {2'b00, level_q} + {{32{flow[17]}}, flow};

    reg        short_q, edges_q, total_edges_q, late_q, duty_q;
    reg [31:0] channels_q;

    always @(posedge clk_i) begin
        begun_q       <= part_begins;
        first_moves_q <= begun_q;
        if (begun_q) begin
            total_part_q <= part_q;
            total_full_q <= parts_full_q;
            rest_q       <= total - expiring_q;
        end
        if (first_moves_q) begin
            made_in[total_part_q - 4'd1] <= part_moves_q;
            expiring_q <= total_full_q ? made_in[total_part_q + 4'd1] : 32'd0;
        end
        if (first_moves_q || moves_q != 6'd0) begin
            total_q       <= total;
            part_moves_q  <= (first_moves_q ? 32'd0 : part_moves_q) + {26'd0, moves_q};
            total_edges_q <= moves_q != 6'd0 && total > total_edges_i;
        end else total_edges_q <= 1'b0;

        if (moved_q) begin
            moves_q <= ones_32(change_q);
            short_q <= short_pulse != 32'd0;
            edges_q <= edge_too_many != 32'd0;
            if (clear_i || channels_q == 32'd0) channels_q <= short_pulse | edge_too_many;
        end else begin
            moves_q <= 6'd0;
            short_q <= 1'b0;
            edges_q <= 1'b0;
            if (clear_i) channels_q <= 32'd0;
        end

        late_q <= late;
        if (start_i || !emission_i) age_q <= 32'd0;
        else if (!late)             age_q <= age_q + 32'd1;
        duty_q  <= active_i && level_q > {duty_ticks_i, 16'd0};
        level_q <= level[49] ? 48'd0 : level[48] ? {48{1'b1}} : level[47:0];

        if (rst_i) begin
            begun_q       <= 1'b0;
            first_moves_q <= 1'b0;
            total_part_q  <= 4'd0;
            total_full_q  <= 1'b0;
            moves_q       <= 6'd0;
            total_q       <= 32'd0;
            rest_q        <= 32'd0;
            part_moves_q  <= 32'd0;
            expiring_q    <= 32'd0;
            age_q         <= 32'd0;
            level_q       <= 48'd0;
            {duty_q, late_q, total_edges_q, edges_q, short_q} <= 5'd0;
            channels_q    <= 32'd0;
        end
    end

    assign cause_o      = {duty_q, late_q, total_edges_q, edges_q, short_q};
    assign channels_o   = channels_q;
    assign duty_level_o = level_q[47:16];
endmodule

`default_nettype wire
