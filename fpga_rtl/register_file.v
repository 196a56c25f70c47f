// Settings, identity and counters by address; CONTROL turns into pulses.
`default_nettype none
`include "registers.vh"

module register_file #(
    parameter [31:0] CLOCK_HZ            = 32'd80_000_000,
    parameter [31:0] SLOTS               = 32'd4,
    parameter [31:0] BUILD_HASH          = 32'd0,
    parameter [31:0] HEARTBEAT_TICKS_MAX = 32'd20_000_000
) (
    input  wire        clk_i,
    input  wire        rst_i,
    // accepted READ and WRITE frames
    input  wire        read_i,             // pulse
    input  wire        write_i,            // pulse
    input  wire [15:0] address_i,
    input  wire [31:0] word0_i,
    input  wire [31:0] word1_i,
    input  wire [31:0] word2_i,
    output wire [7:0]  read_result_o,
    output wire [7:0]  write_result_o,
    output wire [31:0] data_o,             // value of the last READ
    // state
    input  wire        off_i,
    input  wire        run_permit_i,
    input  wire        refused_i,          // pulse: a frame was refused
    input  wire [15:0] fault_i,
    input  wire [31:0] ignored_i,
    input  wire [31:0] emissions_i,
    input  wire [31:0] loaded_i,
    // settings and commands
    output wire [31:0] idle_word_o,
    output wire [15:0] bit_ticks_o,
    output wire [17:0] ramp_samples_o,
    output wire [31:0] heartbeat_ticks_o,
    output wire [31:0] channel_mask_o,
    output wire        arm_o,              // pulses
    output wire        disarm_o,
    output wire        clear_o,
    output wire        stop_o
);
    localparam [31:0] BIT_TICKS_WANTED = CLOCK_HZ / `BIT_CLOCK_HZ_RESET;
    localparam [31:0] BIT_TICKS_RESET  = BIT_TICKS_WANTED < `BIT_TICKS_MIN ? `BIT_TICKS_MIN : BIT_TICKS_WANTED;
    localparam [31:0] RAMP_RESET       = `RAMP_SAMPLES_RESET;
    localparam [31:0] GEOMETRY         = {`CHANNELS, 5'd0, `WAVEFORM_WORDS, SLOTS[7:0]};

    reg [31:0] data_q;
    reg [31:0] idle_word_q;
    reg [15:0] bit_ticks_q;
    reg [17:0] ramp_samples_q;
    reg [31:0] heartbeat_ticks_q;
    reg [31:0] channel_mask_q;
    reg [31:0] frame_errors_q;

    wire known = address_i <= `REGISTER_SLOTS_LOADED;

    reg [31:0] value;
    always @* begin
        case (address_i)
            `REGISTER_IDENTITY:         value = `IDENTITY_MAGIC;
            `REGISTER_PROTOCOL:         value = `PROTOCOL_VERSION;
            `REGISTER_BUILD_HASH:       value = BUILD_HASH;
            `REGISTER_CLOCK_HZ:         value = CLOCK_HZ;
            `REGISTER_GEOMETRY:         value = GEOMETRY;
            `REGISTER_IDLE_WORD:        value = idle_word_q;
            `REGISTER_BIT_TICKS:        value = {16'd0, bit_ticks_q};
            `REGISTER_RAMP_SAMPLES:     value = {14'd0, ramp_samples_q};
            `REGISTER_HEARTBEAT_TICKS:  value = heartbeat_ticks_q;
            `REGISTER_CHANNEL_MASK:     value = channel_mask_q;
            `REGISTER_FAULT:            value = {16'd0, fault_i};
            `REGISTER_TRIGGERS_IGNORED: value = ignored_i;
            `REGISTER_EMISSIONS:        value = emissions_i;
            `REGISTER_FRAME_ERRORS:     value = frame_errors_q;
            `REGISTER_SLOTS_LOADED:     value = loaded_i;
            default:                    value = 32'd0;
        endcase
    end

    wire key_good = word1_i == `PROTOCOL_VERSION && word2_i == BUILD_HASH;
    reg [7:0] control_result;
    always @* begin
        case (word0_i)
            `CONTROL_ARM: control_result = !key_good ? `RESULT_BAD_KEY : !off_i ? `RESULT_ARMED
                                         : fault_i != 16'd0 ? `RESULT_FAULTED
                                         : !run_permit_i ? `RESULT_NO_PERMIT : `RESULT_OK;
            `CONTROL_DISARM, `CONTROL_CLEAR, `CONTROL_STOP: control_result = `RESULT_OK;
            default: control_result = `RESULT_BAD_VALUE;
        endcase
    end

    reg setting, in_range;  // address_i is a setting; word0_i is a value for it
    always @* begin
        setting  = 1'b1;
        in_range = 1'b1;
        case (address_i)
            `REGISTER_IDLE_WORD, `REGISTER_CHANNEL_MASK: ;
            `REGISTER_BIT_TICKS:       in_range = word0_i >= `BIT_TICKS_MIN && word0_i <= `BIT_TICKS_MAX;
            `REGISTER_RAMP_SAMPLES:    in_range = word0_i != 32'd0 && word0_i <= `RAMP_SAMPLES_MAX;
            `REGISTER_HEARTBEAT_TICKS: in_range = word0_i != 32'd0 && word0_i <= HEARTBEAT_TICKS_MAX;
            default:                   setting = 1'b0;
        endcase
    end

    wire control = address_i == `REGISTER_CONTROL;
    wire command = write_i && control && control_result == `RESULT_OK;
    wire change  = write_i && setting && off_i && in_range;

    always @(posedge clk_i) begin
        if (read_i && known) data_q <= value;
        if (refused_i) frame_errors_q <= frame_errors_q + 32'd1;
        if (change) begin
            case (address_i)
                `REGISTER_IDLE_WORD:       idle_word_q       <= word0_i;
                `REGISTER_BIT_TICKS:       bit_ticks_q       <= word0_i[15:0];
                `REGISTER_RAMP_SAMPLES:    ramp_samples_q    <= word0_i[17:0];
                `REGISTER_HEARTBEAT_TICKS: heartbeat_ticks_q <= word0_i;
                default:                   channel_mask_q    <= word0_i;
            endcase
        end
        if (rst_i) begin
            data_q            <= 32'd0;
            idle_word_q       <= 32'd0;
            bit_ticks_q       <= BIT_TICKS_RESET[15:0];
            ramp_samples_q    <= RAMP_RESET[17:0];
            heartbeat_ticks_q <= HEARTBEAT_TICKS_MAX;
            channel_mask_q    <= 32'hFFFFFFFF;
            frame_errors_q    <= 32'd0;
        end
    end

    assign read_result_o  = known ? `RESULT_OK : `RESULT_UNKNOWN_REGISTER;
    assign write_result_o = !known ? `RESULT_UNKNOWN_REGISTER : control ? control_result : !setting ? `RESULT_READ_ONLY
                          : !off_i ? `RESULT_ARMED : !in_range ? `RESULT_BAD_VALUE : `RESULT_OK;
    assign data_o            = data_q;
    assign idle_word_o       = idle_word_q;
    assign bit_ticks_o       = bit_ticks_q;
    assign ramp_samples_o    = ramp_samples_q;
    assign heartbeat_ticks_o = heartbeat_ticks_q;
    assign channel_mask_o    = channel_mask_q;
    assign arm_o    = command && word0_i == `CONTROL_ARM;
    assign disarm_o = command && word0_i == `CONTROL_DISARM;
    assign clear_o  = command && word0_i == `CONTROL_CLEAR;
    assign stop_o   = command && word0_i == `CONTROL_STOP;
endmodule

`default_nettype wire
