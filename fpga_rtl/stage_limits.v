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
    wire        close = since_q < pulse_ticks_i;
    wire [31:0] kept  = close ? recent_q : 32'd0;
    wire [31:0] short_pulse = change_q & kept;

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

    // Edges of each channel: purses
    wire [31:0]  edge_too_many;
    wire [191:0] purses;
    reg  [31:0]  filled_q;                       // whose purse is filled: all behind reset, then one after the other
    reg  [5:0]   given;                          // into them
    genvar number;

    generate
        for (number = 0; number < 32; number = number + 1) begin : channel
            reg  [5:0] purse_q;
            wire       zero_4 = purse_q[3:0] == 4'd0;        // by hand: an adder would take twice the LUTs
            wire       zero_5 = zero_4 && !purse_q[4];
            wire       empty  = zero_5 && !purse_q[5];
            wire [5:0] less   = purse_q ^ {zero_5, zero_4, purse_q[2:0] == 3'd0, purse_q[1:0] == 2'd0, !purse_q[0], 1'b1};
            always @(posedge clk_i)
                if (filled_q[number] || (change_q[number] && !empty)) purse_q <= filled_q[number] ? given : less;
            assign edge_too_many[number] = change_q[number] && empty;
            assign purses[6*number +: 6] = purse_q;
        end
    endgenerate

    // Their accounts: fetched, looked at, judged by the limit, settled; all modulo 2**24, which no difference reaches
    reg [23:0] accounts [0:31];                  // edges made and in the purse; not since reset until the first round is over
    (* no_rw_check *)
    reg [23:0] made_by [0:511];                  // edges made when a part began: part, channel
    reg [23:0] limit_q;
    reg [5:0]  first_q;                          // what the purses held behind reset
    reg [4:0]  fetched_q, looked_q, judged_q, settled_q;  // the channel in each step
    reg        fetched_first_q, looked_first_q;  // in the first round
    reg        fetched_valid_q, looked_valid_q;
    reg [3:0]  fetched_part_q, looked_part_q, judged_part_q, settled_part_q;
    reg        fetched_begins_q, looked_begins_q, judged_begins_q, settled_begins_q;  // first turn in a part
    reg        full_q;                           // parts_full_q, in step with fetched_q
    reg [23:0] oldest_q, base_q, account_q;
    reg        looked_change_q, judged_change_q; // its bit of change_q
    reg [23:0] judged_account_q, settled_account_q;
    reg [5:0]  judged_purse_q, settled_purse_q, settled_given_q;
    reg        plenty_q, nothing_q;
    reg [6:0]  more_q;                           // limit less what counts less one, signed, unless plenty or nothing

    wire [23:0] account = looked_first_q ? {18'd0, first_q} : account_q;
    wire [23:0] counts  = account - base_q;
    wire [24:0] more    = {1'b0, limit_q} + {1'b1, ~counts};
    wire [5:0]  purse   = purses[6*looked_q +: 6];
    wire        spent   = judged_change_q && judged_purse_q != 6'd0;
    wire [7:0]  allowed = {more_q[6], more_q} + {2'b00, judged_purse_q} + {7'd0, !spent};
    wire [5:0]  first   = limit_q > {18'd0, PURSE} ? PURSE : limit_q[5:0];
    wire [23:0] made    = settled_account_q - {18'd0, settled_purse_q};

    always @* begin
        if (begins_q)                     given = first;
        else if (plenty_q)                given = PURSE;
        else if (nothing_q || allowed[7]) given = 6'd0;
        else if (allowed[6])              given = PURSE;
        else                              given = allowed[5:0];
    end

    always @(posedge clk_i) begin
        limit_q <= channel_edges_i > {8'd0, MOST} ? MOST : channel_edges_i[23:0];
        if (begins_q) first_q <= first;
        filled_q <= {filled_q[30:0] & {31{!begins_q}}, looked_valid_q && looked_q == 5'd0};

        oldest_q         <= made_by[{oldest, turn_q}];
        fetched_q        <= turn_q;
        fetched_first_q  <= first_round_q;
        fetched_valid_q  <= 1'b1;
        fetched_part_q   <= part_q;
        fetched_begins_q <= round_q == {ROUND_BITS{1'b0}};
        full_q           <= parts_full_q;

        base_q          <= full_q ? oldest_q : 24'd0;
        account_q       <= accounts[fetched_q];
        looked_q        <= fetched_q;
        looked_first_q  <= fetched_first_q;
        looked_valid_q  <= fetched_valid_q;
        looked_part_q   <= fetched_part_q;
        looked_begins_q <= fetched_begins_q;
        looked_change_q <= change[fetched_q];

        judged_q         <= looked_q;
        judged_part_q    <= looked_part_q;
        judged_begins_q  <= looked_begins_q;
        judged_change_q  <= change[looked_q];
        judged_account_q <= account;
        judged_purse_q   <= purse - {5'd0, looked_change_q && purse != 6'd0};
        plenty_q         <= !more[24] && more[23:6] != 18'd0;
        nothing_q        <= more[24] && more[23:6] != {18{1'b1}};
        more_q           <= more[6:0];

        settled_q         <= judged_q;
        settled_part_q    <= judged_part_q;
        settled_begins_q  <= judged_begins_q;
        settled_account_q <= judged_account_q;
        settled_purse_q   <= judged_purse_q - {5'd0, spent};
        settled_given_q   <= given;
        accounts[settled_q] <= made + {18'd0, settled_given_q};
        if (settled_begins_q) made_by[{settled_part_q, settled_q}] <= made;
        if (rst_i) begin
            filled_q        <= {32{1'b1}};
            fetched_valid_q <= 1'b0;
            looked_valid_q  <= 1'b0;
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

    reg [4:0]  cause_q;
    reg [31:0] channels_q;
    wire [31:0] culprits = short_pulse | edge_too_many;

    always @(posedge clk_i) begin
        begun_q       <= part_begins;
        first_moves_q <= begun_q;
        if (begun_q) begin
            total_part_q <= part_q;
            total_full_q <= parts_full_q;
        end
        moves_q       <= ones_32(change_q);
        total_q       <= total;
        rest_q        <= total - expiring_q;
        part_moves_q  <= (first_moves_q ? 32'd0 : part_moves_q) + {26'd0, moves_q};
        if (first_moves_q) made_in[total_part_q - 4'd1] <= part_moves_q;
        expiring_q    <= total_full_q ? made_in[total_part_q + 4'd1] : 32'd0;

        age_q <= start_i || !emission_i ? 32'd0 : late ? age_q : age_q + 32'd1;
        level_q <= level[49] ? 48'd0 : level[48] ? {48{1'b1}} : level[47:0];

        cause_q[0] <= short_pulse != 32'd0;
        cause_q[1] <= edge_too_many != 32'd0;
        cause_q[2] <= moves_q != 6'd0 && total > total_edges_i;
        cause_q[3] <= late;
        cause_q[4] <= active_i && level_q > {duty_ticks_i, 16'd0};
        if (clear_i || channels_q == 32'd0) channels_q <= culprits;

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
            cause_q       <= 5'd0;
            channels_q    <= 32'd0;
        end
    end

    assign cause_o      = cause_q;
    assign channels_o   = channels_q;
    assign duty_level_o = level_q[47:16];
endmodule

`default_nettype wire
