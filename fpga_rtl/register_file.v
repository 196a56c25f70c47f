// Settings, identity and telemetry by address; CONTROL turns into pulses.
// A 64-bit time is read LOW first, which keeps its HIGH.
// The lines between `generated` and `end of` come from controller/device/fpga/registers.py: python -m controller.generate
`default_nettype none
`include "registers.vh"

module register_file #(
    // of the board
    // generated: parameters
    parameter [31:0] BIT_PERIOD_RESET    = 32'd0,
    parameter [31:0] RAMP_SAMPLES_RESET  = 32'd0,
    parameter [31:0] CHANNEL_MASK_MAX    = 32'd0,
    parameter [31:0] HV_SETTLE_TICKS     = 32'd0,
    parameter [31:0] HEARTBEAT_TICKS_MAX = 32'd0,
    parameter [31:0] EDGE_WINDOW_TICKS   = 32'd0,
    parameter [31:0] PULSE_TICKS_MIN     = 32'd0,
    parameter [31:0] CHANNEL_EDGES_MAX   = 32'd0,
    parameter [31:0] TOTAL_EDGES_MAX     = 32'd0,
    parameter [31:0] EMISSION_TICKS_MAX  = 32'd0,
    parameter [31:0] DUTY_SHARE_MAX      = 32'd0,
    parameter [31:0] DUTY_TICKS_MAX      = 32'd0,
    // end of parameters
    parameter [31:0] CLOCK_HZ            = 32'd80_000_000,
    parameter [31:0] SLOTS               = 32'd4,
    parameter [31:0] BUILD_HASH          = 32'd0,
    parameter [31:0] BOARD               = 32'd0
) (
    input  wire        clk_i,
    input  wire        rst_i,
    // accepted READ and WRITE frames
    input  wire        judge_i,            // address and words may have changed a clock ago, or are accepted: results hold only then
    input  wire        accept_i,           // pulse: any frame
    input  wire        uart_i,             // it came by the UART
    input  wire        read_i,             // pulse
    input  wire        write_i,            // pulse
    input  wire [15:0] address_i,
    input  wire [127:0] words_i,
    output wire [7:0]  read_result_o,
    output wire [7:0]  write_result_o,
    output wire [31:0] data_o,             // of the register that is asked for
    // state
    input  wire        faulted_i,          // fault_i is not 0
    input  wire        off_i,
    input  wire        quiet_i,            // nothing plays or waits
    input  wire        permitted_i,        // run permit and temperature
    input  wire [1:0]  refused_i,          // pulses: a frame was refused, by SPI (0), by UART (1)
    input  wire        gap_i,              // with accept_i: its number does not follow that of the one before by its link
    // telemetry
    // generated: inputs
    input  wire [15:0] fault_i,
    input  wire [31:0] fault_channels_i,
    input  wire [31:0] fault_count_i,
    input  wire [63:0] fault_time_i,
    input  wire [2:0]  inputs_i,
    input  wire [63:0] input_time_i,
    input  wire [31:0] triggers_i,
    input  wire [31:0] triggers_ignored_i,
    input  wire [63:0] trigger_time_i,
    input  wire [31:0] emissions_i,
    input  wire [63:0] emission_time_i,
    input  wire [31:0] plays_missed_i,
    input  wire [31:0] underruns_i,
    input  wire [15:0] slots_loaded_i,
    input  wire [3:0]  queue_i,
    input  wire [31:0] duty_level_i,
    // end of inputs
    // settings and commands
    // generated: outputs
    output wire [31:0] idle_word_o,
    output wire [31:0] channel_mask_o,
    output wire [31:0] bit_period_o,
    output wire [17:0] ramp_samples_o,
    output wire [31:0] heartbeat_ticks_o,
    output wire [15:0] pulse_ticks_o,
    output wire [23:0] channel_edges_o,
    output wire [28:0] total_edges_o,
    output wire [31:0] emission_ticks_o,
    output wire [16:0] duty_share_o,
    output wire [31:0] duty_ticks_o,
    // end of outputs
    output wire        arm_o,              // pulses
    output wire        disarm_o,
    output wire        clear_o,
    output wire        stop_o,
    output wire        trigger_o
);
    localparam [31:0] BIT_TICKS_FASTEST = CLOCK_HZ / `BIT_CLOCK_HZ_MAX;
    localparam [31:0] BIT_TICKS_LOW     = BIT_TICKS_FASTEST < `BIT_TICKS_MIN ? `BIT_TICKS_MIN : BIT_TICKS_FASTEST;
    localparam [31:0] BIT_TICKS_SLOWEST = CLOCK_HZ / `BIT_CLOCK_HZ_MIN;
    localparam [31:0] BIT_TICKS_HIGH    = BIT_TICKS_SLOWEST < BIT_TICKS_LOW ? BIT_TICKS_LOW : BIT_TICKS_SLOWEST;
    localparam [31:0] BIT_PERIOD_LOW   = {BIT_TICKS_LOW[15:0], 16'd0};
    localparam [31:0] BIT_PERIOD_HIGH  = {BIT_TICKS_HIGH[15:0], 16'd0};
    localparam [31:0] GEOMETRY         = {`CHANNELS, 5'd0, `WAVEFORM_WORDS, SLOTS[7:0]};
    localparam [31:0] PARAMETERS       = {8'd0, `FILTER_TICKS, `TRIGGER_LATENCY_TICKS, `QUEUE_PLAYS};

    wire [31:0] word0 = words_i[`WRITE_VALUE_BITS];
    wire [31:0] word1 = words_i[`WRITE_IDENTITY_BITS];
    wire [31:0] word2 = words_i[`WRITE_PROTOCOL_BITS];
    wire [31:0] word3 = words_i[`WRITE_BUILD_HASH_BITS];

    reg [1:0]  unlocked_q;         // by the frame before, of each link

    localparam ADDRESS_BITS = $clog2(`REGISTER_COUNT);
    wire [15:0] register = {{16-ADDRESS_BITS{1'b0}}, address_i[ADDRESS_BITS-1:0]};  // where known_q
    wire        change;            // the register is a setting, and takes word0

    // generated: settings
    localparam SETTINGS = 11, KEPT_BITS = 4;
    reg [31:0] kept [0:SETTINGS-1];  // for a READ, by their place in this list
    reg [SETTINGS-1:0] written_q;
    reg [31:0] idle_word_q;
    reg [31:0] channel_mask_q;
    reg [31:0] bit_period_q;
    reg [17:0] ramp_samples_q;
    reg [31:0] heartbeat_ticks_q;
    reg [15:0] pulse_ticks_q;
    reg [23:0] channel_edges_q;
    reg [28:0] total_edges_q;
    reg [31:0] emission_ticks_q;
    reg [16:0] duty_share_q;
    reg [31:0] duty_ticks_q;
    always @(posedge clk_i) begin
        if (change) begin
            case (register)
                `REGISTER_IDLE_WORD: idle_word_q <= word0;
                `REGISTER_CHANNEL_MASK: channel_mask_q <= word0;
                `REGISTER_BIT_PERIOD: bit_period_q <= word0;
                `REGISTER_RAMP_SAMPLES: ramp_samples_q <= word0[17:0];
                `REGISTER_HEARTBEAT_TICKS: heartbeat_ticks_q <= word0;
                `REGISTER_PULSE_TICKS: pulse_ticks_q <= word0[15:0];
                `REGISTER_CHANNEL_EDGES: channel_edges_q <= word0[23:0];
                `REGISTER_TOTAL_EDGES: total_edges_q <= word0[28:0];
                `REGISTER_EMISSION_TICKS: emission_ticks_q <= word0;
                `REGISTER_DUTY_SHARE: duty_share_q <= word0[16:0];
                default: duty_ticks_q <= word0;
            endcase
        end
        if (rst_i) begin
            idle_word_q <= 32'd0;
            channel_mask_q <= CHANNEL_MASK_MAX;
            bit_period_q <= BIT_PERIOD_RESET;
            ramp_samples_q <= RAMP_SAMPLES_RESET[17:0];
            heartbeat_ticks_q <= HEARTBEAT_TICKS_MAX;
            pulse_ticks_q <= PULSE_TICKS_MIN[15:0];
            channel_edges_q <= CHANNEL_EDGES_MAX[23:0];
            total_edges_q <= TOTAL_EDGES_MAX[28:0];
            emission_ticks_q <= EMISSION_TICKS_MAX;
            duty_share_q <= DUTY_SHARE_MAX[16:0];
            duty_ticks_q <= DUTY_TICKS_MAX;
        end
    end
    assign idle_word_o = idle_word_q;
    assign channel_mask_o = channel_mask_q;
    assign bit_period_o = bit_period_q;
    assign ramp_samples_o = ramp_samples_q;
    assign heartbeat_ticks_o = heartbeat_ticks_q;
    assign pulse_ticks_o = pulse_ticks_q;
    assign channel_edges_o = channel_edges_q;
    assign total_edges_o = total_edges_q;
    assign emission_ticks_o = emission_ticks_q;
    assign duty_share_o = duty_share_q;
    assign duty_ticks_o = duty_ticks_q;
    // end of settings

    wire [31:0] bit_ticks     = {16'd0, bit_period_q[31:16]};
    wire        hold;
    reg  [31:0] high;              // the other half of a time
    wire [31:0] own;               // of this link
    reg  [1:0]  which_q;
    wire [31:0] frame_errors = own, sequence_gaps = own, held = own;
    link_counters link_counters (
        .clk_i(clk_i), .rst_i(rst_i), .accept_i(accept_i), .uart_i(uart_i), .gap_i(gap_i), .refused_i(refused_i),
        .hold_i(hold), .high_i(high),
        .which_i(which_q), .value_o(own)
    );

    reg [31:0] value;              // of the register
    reg        low;                // whose LOW the register is
    reg        setting;            // it is a setting, which takes words from least to most without a bit of barred
    reg [31:0] least, most, barred;
    reg [KEPT_BITS-1:0] place;     // of the setting
    reg        below, above, apart; // what speaks against a word
    always @* begin
        value    = 32'd0;
        high     = 32'd0;
        low      = 1'b0;
        setting  = 1'b0;
        least    = 32'd0;
        most     = 32'hFFFFFFFF;
        barred   = 32'd0;
        place    = {KEPT_BITS{1'b0}};
        {below, above, apart} = 3'd0;
        if (judge_i) case (register)
            // generated: read
            `REGISTER_IDENTITY: value = `IDENTITY_MAGIC;
            `REGISTER_PROTOCOL: value = `PROTOCOL_VERSION;
            `REGISTER_BUILD_HASH: value = BUILD_HASH;
            `REGISTER_BOARD: value = BOARD;
            `REGISTER_CLOCK_HZ: value = CLOCK_HZ;
            `REGISTER_GEOMETRY: value = GEOMETRY;
            `REGISTER_PARAMETERS: value = PARAMETERS;
            `REGISTER_EDGE_WINDOW_TICKS: value = EDGE_WINDOW_TICKS;
            `REGISTER_IDLE_WORD: begin
                value   = 32'd0;
                setting = 1'b1;
            end
            `REGISTER_CHANNEL_MASK: begin
                value   = CHANNEL_MASK_MAX;
                setting = 1'b1;
                place   = 1;
                barred  = ~CHANNEL_MASK_MAX;
            end
            `REGISTER_BIT_PERIOD: begin
                value   = BIT_PERIOD_RESET;
                setting = 1'b1;
                place   = 2;
                least   = BIT_PERIOD_LOW;
                most    = BIT_PERIOD_HIGH;
            end
            `REGISTER_RAMP_SAMPLES: begin
                value   = RAMP_SAMPLES_RESET;
                setting = 1'b1;
                place   = 3;
                least   = 32'd1;
                most    = `RAMP_SAMPLES_MAX;
            end
            `REGISTER_HEARTBEAT_TICKS: begin
                value   = HEARTBEAT_TICKS_MAX;
                setting = 1'b1;
                place   = 4;
                least   = 32'd1;
                most    = HEARTBEAT_TICKS_MAX;
            end
            `REGISTER_PULSE_TICKS: begin
                value   = PULSE_TICKS_MIN;
                setting = 1'b1;
                place   = 5;
                least   = PULSE_TICKS_MIN;
                most    = bit_ticks;
            end
            `REGISTER_CHANNEL_EDGES: begin
                value   = CHANNEL_EDGES_MAX;
                setting = 1'b1;
                place   = 6;
                most    = CHANNEL_EDGES_MAX;
            end
            `REGISTER_TOTAL_EDGES: begin
                value   = TOTAL_EDGES_MAX;
                setting = 1'b1;
                place   = 7;
                most    = TOTAL_EDGES_MAX;
            end
            `REGISTER_EMISSION_TICKS: begin
                value   = EMISSION_TICKS_MAX;
                setting = 1'b1;
                place   = 8;
                most    = EMISSION_TICKS_MAX;
            end
            `REGISTER_DUTY_SHARE: begin
                value   = DUTY_SHARE_MAX;
                setting = 1'b1;
                place   = 9;
                most    = DUTY_SHARE_MAX;
            end
            `REGISTER_DUTY_TICKS: begin
                value   = DUTY_TICKS_MAX;
                setting = 1'b1;
                place   = 10;
                most    = DUTY_TICKS_MAX;
            end
            `REGISTER_FAULT: value = {16'd0, fault_i};
            `REGISTER_FAULT_CHANNELS: value = fault_channels_i;
            `REGISTER_FAULT_COUNT: value = fault_count_i;
            `REGISTER_FAULT_TIME_LOW: begin value = fault_time_i[31:0]; high = fault_time_i[63:32]; low = 1'b1; end
            `REGISTER_FAULT_TIME_HIGH: value = held;
            `REGISTER_INPUTS: value = {29'd0, inputs_i};
            `REGISTER_INPUT_TIME_LOW: begin value = input_time_i[31:0]; high = input_time_i[63:32]; low = 1'b1; end
            `REGISTER_INPUT_TIME_HIGH: value = held;
            `REGISTER_TRIGGERS: value = triggers_i;
            `REGISTER_TRIGGERS_IGNORED: value = triggers_ignored_i;
            `REGISTER_TRIGGER_TIME_LOW: begin value = trigger_time_i[31:0]; high = trigger_time_i[63:32]; low = 1'b1; end
            `REGISTER_TRIGGER_TIME_HIGH: value = held;
            `REGISTER_EMISSIONS: value = emissions_i;
            `REGISTER_EMISSION_TIME_LOW: begin value = emission_time_i[31:0]; high = emission_time_i[63:32]; low = 1'b1; end
            `REGISTER_EMISSION_TIME_HIGH: value = held;
            `REGISTER_PLAYS_MISSED: value = plays_missed_i;
            `REGISTER_UNDERRUNS: value = underruns_i;
            `REGISTER_FRAME_ERRORS: value = frame_errors;
            `REGISTER_SEQUENCE_GAPS: value = sequence_gaps;
            `REGISTER_SLOTS_LOADED: value = {16'd0, slots_loaded_i};
            `REGISTER_QUEUE: value = {28'd0, queue_i};
            `REGISTER_DUTY_LEVEL: value = duty_level_i;
            `REGISTER_HV_SETTLE_TICKS: value = HV_SETTLE_TICKS;
            `REGISTER_CHANNEL_MASK_MAX: value = CHANNEL_MASK_MAX;
            `REGISTER_HEARTBEAT_TICKS_MAX: value = HEARTBEAT_TICKS_MAX;
            `REGISTER_PULSE_TICKS_MIN: value = PULSE_TICKS_MIN;
            `REGISTER_CHANNEL_EDGES_MAX: value = CHANNEL_EDGES_MAX;
            `REGISTER_TOTAL_EDGES_MAX: value = TOTAL_EDGES_MAX;
            `REGISTER_EMISSION_TICKS_MAX: value = EMISSION_TICKS_MAX;
            `REGISTER_DUTY_SHARE_MAX: value = DUTY_SHARE_MAX;
            `REGISTER_DUTY_TICKS_MAX: value = DUTY_TICKS_MAX;
            // end of read
            default: ;
        endcase
        if (judge_i && setting) begin
            if (written_q[place]) value = kept[place];
            below = word0 < least;
            above = word0 > most;
            apart = (word0 & barred) != 32'd0 || (register == `REGISTER_BIT_PERIOD && word0[31:16] < pulse_ticks_q);
        end
    end
    reg known_q;                   // there is such a register
    assign hold = read_i && known_q && low;

    always @(posedge clk_i) begin
        if (change) kept[place] <= word0;
    end

    // Address and words rest long before their frame ends: what they mean is found out a clock early, whether a word fits two
    reg arm_q, disarm_q, clear_q, stop_q, unlock_q, trigger_q, key_good_q, control_q, setting_q, below_q, above_q, apart_q, takes_q, idle_q;

    wire in_range = !below_q && !above_q && !apart_q;
    wire command = address_i == `REGISTER_CONTROL;
    wire known   = address_i < `REGISTER_COUNT;
    always @(posedge clk_i) begin
        if (judge_i) begin
            known_q    <= known;
            control_q  <= command;
            idle_q     <= register == `REGISTER_BIT_PERIOD;
            arm_q      <= command && word0 == `CONTROL_ARM;
            disarm_q   <= command && word0 == `CONTROL_DISARM;
            clear_q    <= command && word0 == `CONTROL_CLEAR;
            stop_q     <= command && word0 == `CONTROL_STOP;
            unlock_q   <= command && word0 == `CONTROL_UNLOCK;
            trigger_q  <= command && word0 == `CONTROL_TRIGGER;
            key_good_q <= word1 == `IDENTITY_MAGIC && word2 == `PROTOCOL_VERSION && word3 == BUILD_HASH;
            setting_q  <= setting;
            below_q    <= below;
            above_q    <= above;
            apart_q    <= apart;
            takes_q    <= setting_q && known_q && in_range;
            which_q    <= register == `REGISTER_FRAME_ERRORS ? 2'd0 : register == `REGISTER_SEQUENCE_GAPS ? 2'd1 : 2'd2;
        end
        if (rst_i) {known_q, control_q, idle_q, arm_q, disarm_q, clear_q, stop_q, unlock_q, trigger_q, key_good_q, setting_q,
                    below_q, above_q, apart_q, takes_q, which_q} <= 17'd0;
    end

    wire unlocked = unlocked_q[uart_i];
    wire arm_good = unlocked && off_i && !faulted_i && permitted_i;
    reg [7:0] control_result;
    always @* begin
        if (!judge_i)   control_result = `RESULT_OK;
        else if (unlock_q)   control_result = key_good_q ? `RESULT_OK : `RESULT_BAD_KEY;
        else if (arm_q) control_result = !unlocked ? `RESULT_LOCKED : !off_i ? `RESULT_ARMED
                                       : faulted_i ? `RESULT_FAULTED : !permitted_i ? `RESULT_NO_PERMIT : `RESULT_OK;
        else            control_result = disarm_q || clear_q || stop_q || trigger_q ? `RESULT_OK : `RESULT_BAD_VALUE;
    end

    wire free     = idle_q ? quiet_i : off_i;            // BIT_PERIOD is written while nothing plays or waits, all others while disarmed
    assign change = write_i && takes_q && free;

    always @(posedge clk_i) begin
        if (refused_i != 2'b00) unlocked_q <= unlocked_q & ~refused_i;
        if (accept_i) unlocked_q[uart_i] <= write_i && unlock_q && key_good_q;
        if (change) written_q[place] <= 1'b1;
        if (rst_i) begin
            unlocked_q <= 2'b00;
            written_q  <= {SETTINGS{1'b0}};
        end
    end

    reg [7:0] write_result;
    always @* begin
        if (!judge_i)        write_result = `RESULT_OK;
        else if (!known_q)   write_result = `RESULT_UNKNOWN_REGISTER;
        else if (control_q)  write_result = control_result;
        else if (!setting_q) write_result = `RESULT_READ_ONLY;
        else if (!free)      write_result = idle_q ? `RESULT_BUSY : `RESULT_ARMED;
        else                 write_result = in_range ? `RESULT_OK : `RESULT_BAD_VALUE;
    end

    assign read_result_o  = known_q ? `RESULT_OK : `RESULT_UNKNOWN_REGISTER;
    assign write_result_o = write_result;
    assign data_o    = value;
    reg arm, disarm, clear, stop, trigger;
    always @* begin
        {arm, disarm, clear, stop, trigger} = 5'd0;
        if (write_i) begin
            arm     = arm_q && arm_good;
            disarm  = disarm_q;
            clear   = clear_q;
            stop    = stop_q;
            trigger = trigger_q;
        end
    end

    assign arm_o     = arm;
    assign disarm_o  = disarm;
    assign clear_o   = clear;
    assign stop_o    = stop;
    assign trigger_o = trigger;

`ifdef FORMAL
    `include "register_file_properties.vh"
`endif
endmodule

`default_nettype wire
