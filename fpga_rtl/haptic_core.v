// The gateware of a haptic panel but for its board: SPI, trigger and run permit in, 32 channels out.
// Pin to pin: a trigger's first word is out 5 clocks after the first clock edge that samples the trigger high;
// a lost permit has the outputs low 2 clocks after the first edge that samples it low.
`default_nettype none
`include "registers.vh"

module haptic_core #(
    parameter [31:0] CLOCK_HZ            = 32'd80_000_000,
    parameter        SLOTS               = 4,              // 1 to 16
    parameter [31:0] BUILD_HASH          = 32'd0,
    parameter [31:0] HEARTBEAT_TICKS_MAX = CLOCK_HZ / 4    // 250 ms
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        spi_sck_i,
    input  wire        spi_cs_n_i,
    input  wire        spi_mosi_i,
    output wire        spi_miso_o,
    input  wire        trigger_i,
    input  wire        run_permit_i,    // driven high to run
    output wire [31:0] channel_o,
    output wire        hv_enable_o,
    output wire        hv_alive_o,
    output wire        focus_o          // high for one drive word from t = T
);
    localparam BUFFER_BITS = $clog2(SLOTS + 1);
    localparam ALIVE_HALF_TICKS = CLOCK_HZ / 40_000 > 0 ? CLOCK_HZ / 40_000 : 1;

    // Pins that have no clock, through two flip-flops; a third sees the trigger's edge
    reg [2:0]  trigger_q;
    reg [1:0]  run_permit_q;
    reg [63:0] timestamp_q;
    wire       trigger    = trigger_q[1] && !trigger_q[2];
    wire       run_permit = run_permit_q[1];

    always @(posedge clk_i) begin
        trigger_q    <= {trigger_q[1:0], trigger_i};
        run_permit_q <= {run_permit_q[0], run_permit_i};
        timestamp_q  <= timestamp_q + 64'd1;
        if (rst_i) begin
            trigger_q    <= 3'b111;     // high at reset is no edge
            run_permit_q <= 2'b00;
            timestamp_q  <= 64'd0;
        end
    end

    // Frames
    wire       select, release_frame, partial, byte_valid, answer_take;
    wire [7:0] byte_in, answer;
    wire       accept, refuse;
    wire [7:0] refusal, kind, sequence_number;
    wire [15:0] argument;
    wire [31:0] word0, word1, word2;
    wire        landing_busy, landing_was_busy;
    wire [6:0]  payload_words;
    wire        write;
    wire [2:0]  write_chunk;
    wire [6:0]  write_word;
    wire [31:0] write_data;

    spi_peripheral spi_peripheral (
        .clk_i(clk_i), .rst_i(rst_i),
        .spi_sck_i(spi_sck_i), .spi_cs_n_i(spi_cs_n_i), .spi_mosi_i(spi_mosi_i), .spi_miso_o(spi_miso_o),
        .select_o(select), .release_o(release_frame), .partial_o(partial),
        .byte_valid_o(byte_valid), .byte_o(byte_in), .answer_i(answer), .answer_take_o(answer_take)
    );

    frame_decoder frame_decoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .select_i(select), .release_i(release_frame), .partial_i(partial),
        .byte_valid_i(byte_valid), .byte_i(byte_in), .landing_busy_i(landing_busy),
        .accept_o(accept), .refuse_o(refuse), .refusal_o(refusal),
        .type_o(kind), .sequence_o(sequence_number), .argument_o(argument),
        .word0_o(word0), .word1_o(word1), .word2_o(word2),
        .landing_busy_o(landing_was_busy), .payload_words_o(payload_words),
        .write_o(write), .write_chunk_o(write_chunk), .write_word_o(write_word), .write_data_o(write_data)
    );

    // What becomes of them
    wire [7:0] read_result, write_result, load_result, store_result, play_result;
    reg  [7:0] result, result_q, sequence_q;

    always @* begin
        case (kind)
            `TYPE_NOP:   result = `RESULT_OK;
            `TYPE_READ:  result = read_result;
            `TYPE_WRITE: result = write_result;
            `TYPE_LOAD:  result = load_result;
            `TYPE_STORE: result = store_result;
            `TYPE_PLAY:  result = play_result;
            default:     result = `RESULT_UNKNOWN_TYPE;
        endcase
    end

    always @(posedge clk_i) begin
        if (refuse) result_q <= refusal;
        if (accept) begin
            result_q   <= result;
            sequence_q <= sequence_number;
        end
        if (rst_i) begin
            result_q   <= `RESULT_OK;
            sequence_q <= 8'd0;
        end
    end

    wire [31:0] data, ignored, triggers, emissions, loaded;
    wire [31:0] idle_word, heartbeat_ticks, channel_mask;
    wire [15:0] bit_ticks, fault;
    wire [17:0] ramp_samples;
    wire        arm, disarm, clear, stop;
    wire        off, armed, ramp_up, ramp_down, alive, shut;

    register_file #(
        .CLOCK_HZ(CLOCK_HZ), .SLOTS(SLOTS), .BUILD_HASH(BUILD_HASH), .HEARTBEAT_TICKS_MAX(HEARTBEAT_TICKS_MAX)
    ) register_file (
        .clk_i(clk_i), .rst_i(rst_i),
        .read_i(accept && kind == `TYPE_READ), .write_i(accept && kind == `TYPE_WRITE),
        .address_i(argument), .word0_i(word0), .word1_i(word1), .word2_i(word2),
        .read_result_o(read_result), .write_result_o(write_result), .data_o(data),
        .off_i(off), .run_permit_i(run_permit), .refused_i(refuse), .fault_i(fault),
        .ignored_i(ignored), .emissions_i(emissions), .loaded_i(loaded),
        .idle_word_o(idle_word), .bit_ticks_o(bit_ticks), .ramp_samples_o(ramp_samples),
        .heartbeat_ticks_o(heartbeat_ticks), .channel_mask_o(channel_mask),
        .arm_o(arm), .disarm_o(disarm), .clear_o(clear), .stop_o(stop)
    );

    // Waveforms
    wire                   slot_good;
    wire [BUFFER_BITS-1:0] slot_buffer, landing, read_buffer;
    wire [9:0]             slot_words, read_word;
    wire [31:0]            read_data, drive;
    wire                   ramp_bit, ramp_done, playing, repeating, pending, ended;

    waveform_buffer #(.SLOTS(SLOTS), .BUFFER_BITS(BUFFER_BITS)) waveform_buffer (
        .clk_i(clk_i), .rst_i(rst_i),
        .write_i(write), .write_chunk_i(write_chunk), .write_word_i(write_word), .write_data_i(write_data),
        .load_i(accept && kind == `TYPE_LOAD), .store_i(accept && kind == `TYPE_STORE),
        .argument_i(argument), .word0_i(word0), .load_words_i(payload_words), .landing_busy_i(landing_was_busy),
        .load_result_o(load_result), .store_result_o(store_result),
        .slot_good_o(slot_good), .slot_buffer_o(slot_buffer), .slot_words_o(slot_words),
        .loaded_o(loaded), .landing_o(landing),
        .read_buffer_i(read_buffer), .read_word_i(read_word), .read_data_o(read_data)
    );

    idle_ramp idle_ramp (
        .clk_i(clk_i), .rst_i(rst_i),
        .up_i(ramp_up), .down_i(ramp_down), .stay_i(armed),
        .bit_ticks_i(bit_ticks), .samples_i(ramp_samples), .bit_o(ramp_bit), .done_o(ramp_done)
    );

    waveform_player #(.BUFFER_BITS(BUFFER_BITS)) waveform_player (
        .clk_i(clk_i), .rst_i(rst_i), .idle_word_i(idle_word), .bit_ticks_i(bit_ticks),
        .play_i(accept && kind == `TYPE_PLAY), .count_i(word0), .period_ticks_i(word1),
        .slot_good_i(slot_good), .slot_buffer_i(slot_buffer), .slot_words_i(slot_words),
        .armed_i(armed), .faulted_i(fault != 16'd0), .play_result_o(play_result),
        .stop_i(stop), .drop_i(disarm || shut), .fault_i(shut), .trigger_i(trigger),
        .landing_i(landing), .landing_busy_o(landing_busy),
        .read_buffer_o(read_buffer), .read_word_o(read_word), .read_data_i(read_data),
        .ramping_i(ramp_up || ramp_down), .ramp_bit_i(ramp_bit),
        .drive_o(drive), .ended_o(ended), .playing_o(playing), .repeating_o(repeating), .pending_o(pending),
        .triggers_o(triggers), .ignored_o(ignored)
    );

    output_gate #(.ALIVE_HALF_TICKS(ALIVE_HALF_TICKS)) output_gate (
        .clk_i(clk_i), .rst_i(rst_i),
        .arm_i(arm), .disarm_i(disarm), .clear_i(clear), .heartbeat_i(accept), .heartbeat_ticks_i(heartbeat_ticks),
        .run_permit_i(run_permit), .ramp_done_i(ramp_done), .channel_mask_i(channel_mask), .bit_ticks_i(bit_ticks),
        .drive_i(drive), .ended_i(ended),
        .off_o(off), .armed_o(armed), .ramp_up_o(ramp_up), .ramp_down_o(ramp_down), .alive_o(alive), .shut_o(shut),
        .fault_o(fault), .emissions_o(emissions),
        .channel_o(channel_o), .hv_enable_o(hv_enable_o), .hv_alive_o(hv_alive_o), .focus_o(focus_o)
    );

    // The answer
    wire [15:0] state;
    assign state[`STATE_ARMED]        = armed;
    assign state[`STATE_RAMPING]      = ramp_up || ramp_down;
    assign state[`STATE_PLAYING]      = playing;
    assign state[`STATE_REPEATING]    = repeating;
    assign state[`STATE_PENDING]      = pending;
    assign state[`STATE_LANDING_BUSY] = landing_busy;
    assign state[`STATE_RUN_PERMIT]   = run_permit;
    assign state[`STATE_HEARTBEAT]    = alive;
    assign state[`STATE_HV_ENABLE]    = hv_enable_o;
    assign state[15:`STATE_HV_ENABLE+1] = 7'd0;

    status_encoder status_encoder (
        .clk_i(clk_i), .rst_i(rst_i), .select_i(select), .take_i(answer_take), .byte_o(answer),
        .result_i(result_q), .sequence_i(sequence_q), .state_i(state), .fault_i(fault), .data_i(data),
        .triggers_i(triggers), .timestamp_i(timestamp_q), .emissions_i(emissions)
    );
endmodule

`default_nettype wire
