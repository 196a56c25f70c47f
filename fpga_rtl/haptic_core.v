// The gateware of a haptic panel but for its board: frames by SPI or UART, trigger and permits in, 32 channels out.
// Pin to pin: a trigger's first word is out 8 clocks after the first clock edge that samples the trigger high;
// a lost permit has the outputs low 2 clocks after the first edge that samples it low, which is 3 after the pin at most.
`default_nettype none
`include "registers.vh"

module haptic_core #(
    // of the board: controller/device/fpga/build_parameters.py makes them from its board.toml; without them nothing is built
    parameter [31:0] CLOCK_HZ            = 32'd0,
    parameter [31:0] SLOTS               = 32'd0,          // 1 to 16
    parameter [31:0] BUILD_HASH          = 32'd0,
    parameter [31:0] BOARD               = 32'h204D4953,   // 'SIM '
    // values after reset, and the hard limits: safety_island.v
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
    parameter [31:0] BAUD                = 32'd1_000_000,
    parameter [31:0] UART                = 32'd1           // 0: no link by UART is built; its line rests
) (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        clock_lost_i,       // at any time: the outputs are low at once, clock or not
    input  wire        spi_sck_i,
    input  wire        spi_cs_n_i,
    input  wire        spi_mosi_i,
    output wire        spi_miso_o,
    input  wire        uart_rx_i,
    output wire        uart_tx_o,
    input  wire        trigger_i,
    input  wire        run_permit_i,       // driven high to run
    input  wire        temperature_ok_i,   // driven high while cool
    output wire [31:0] channel_o,
    output wire        hv_enable_o,
    output wire        hv_alive_o,
    output wire        focus_o,            // high for one drive word from t = T
    output wire        waiting_o,          // a play waits for the trigger
    output wire        fault_o
);
    generate
        if (CLOCK_HZ == 32'd0 || SLOTS == 32'd0 || SLOTS > 32'd16 || BIT_PERIOD_RESET == 32'd0
            || RAMP_SAMPLES_RESET == 32'd0) begin : not_given
            clock_and_slots_of_the_board_are_missing from_the_parameters ();
        end
    endgenerate

    localparam BUFFER_BITS = $clog2(SLOTS + 1);
    localparam ALIVE_HALF_TICKS = CLOCK_HZ / 40_000 > 0 ? CLOCK_HZ / 40_000 : 1;

    // Registers' telemetry and settings. The lines between `generated` and `end of` come from controller/device/fpga/registers.py.
    // generated: wires
    wire [31:0] idle_word;
    wire [31:0] channel_mask;
    wire [31:0] bit_period;
    wire [17:0] ramp_samples;
    wire [31:0] heartbeat_ticks;
    wire [15:0] pulse_ticks;
    wire [23:0] channel_edges;
    wire [28:0] total_edges;
    wire [31:0] emission_ticks;
    wire [16:0] duty_share;
    wire [31:0] duty_ticks;
    wire [15:0] fault;
    wire [31:0] fault_channels;
    wire [31:0] fault_count;
    wire [63:0] fault_time;
    wire [2:0]  inputs;
    wire [63:0] input_time;
    wire [31:0] triggers;
    wire [31:0] triggers_ignored;
    wire [63:0] trigger_time;
    wire [31:0] emissions;
    wire [63:0] emission_time;
    wire [31:0] plays_missed;
    wire [31:0] underruns;
    wire [15:0] slots_loaded;
    wire [3:0]  queue;
    wire [31:0] duty_level;
    // end of wires

    wire [63:0] now;
    wire        command, trigger, trigger_level, run_permit, temperature_ok;
    wire        arm, disarm, clear, stop;
    wire        off, settling, armed, ramp_up, ramp_down, stopping, alive, shut, faulted;
    wire        quiet, settled;
    assign      inputs = {trigger_level, temperature_ok, run_permit};

    trigger_input trigger_input (
        .clk_i(clk_i), .rst_i(rst_i), .trigger_i(trigger_i), .command_i(command), .level_o(trigger_level), .trigger_o(trigger)
    );

    tick_counter tick_counter (
        .clk_i(clk_i), .rst_i(rst_i), .permits_i({temperature_ok, run_permit}), .now_o(now), .change_time_o(input_time)
    );

    // Frames: each link has a decoder, an encoder of answers and a conversation of its own. What the SPI accepts is carried
    // out at once; a frame of the UART waits, whole and good, for a pause of the SPI.
    wire         spi_busy, spi_select, spi_take, spi_byte_valid, spi_accept, spi_refuse, spi_word_valid, spi_load_word;
    wire         spi_landing_busy, spi_landing_live, spi_fast;
    wire [7:0]   spi_byte, spi_answer, spi_refusal, spi_kind, spi_sequence, spi_word_number;
    wire [15:0]  spi_argument;
    wire [31:0]  spi_word;
    wire [6:0]   spi_payload_words;
    wire         uart_select, uart_begin, from_uart, uart_accept, uart_refuse, uart_word_valid, uart_load_word;
    wire         uart_landing_busy, uart_landing_live;
    wire [7:0]   uart_kind, uart_sequence, uart_word_number;
    wire [15:0]  uart_argument;
    wire [31:0]  uart_word;
    wire [6:0]   uart_payload_words;
    wire         landing_busy, landing_live;

    spi_link spi_link (
        .clk_i(clk_i), .rst_i(rst_i),
        .spi_sck_i(spi_sck_i), .spi_cs_n_i(spi_cs_n_i), .spi_mosi_i(spi_mosi_i), .spi_miso_o(spi_miso_o),
        .answer_i(spi_answer), .take_o(spi_take),
        .landing_busy_i(landing_busy), .landing_live_i(landing_live), .bit_period_i(bit_period),
        .busy_o(spi_busy), .select_o(spi_select), .byte_valid_o(spi_byte_valid), .byte_o(spi_byte),
        .accept_o(spi_accept), .refuse_o(spi_refuse), .refusal_o(spi_refusal),
        .kind_o(spi_kind), .sequence_o(spi_sequence), .argument_o(spi_argument), .payload_words_o(spi_payload_words),
        .landing_busy_o(spi_landing_busy), .landing_live_o(spi_landing_live), .fast_o(spi_fast),
        .word_valid_o(spi_word_valid), .word_number_o(spi_word_number), .word_o(spi_word), .load_word_o(spi_load_word)
    );

    wire         judge, accept, read, write, load, store, play;
    wire         load_word, play_word, lengths, fast, landing_was_busy, landing_was_live;
    wire [7:0]   kind, sequence_number;
    wire [15:0]  argument;
    wire [191:0] words;
    wire [31:0]  word;
    wire [6:0]   payload_words, word_number;
    frame_select frame_select (
        .clk_i(clk_i), .rst_i(rst_i),
        .spi_taken_i(spi_select || spi_byte_valid), .spi_accept_i(spi_accept), .spi_kind_i(spi_kind),
        .spi_sequence_i(spi_sequence), .spi_argument_i(spi_argument), .spi_payload_words_i(spi_payload_words),
        .spi_landing_busy_i(spi_landing_busy), .spi_landing_live_i(spi_landing_live), .spi_fast_i(spi_fast),
        .spi_word_valid_i(spi_word_valid), .spi_load_word_i(spi_load_word), .spi_word_number_i(spi_word_number),
        .spi_word_i(spi_word),
        .uart_begin_i(uart_begin), .uart_turn_i(from_uart), .uart_accept_i(uart_accept),
        .uart_kind_i(uart_kind), .uart_sequence_i(uart_sequence), .uart_argument_i(uart_argument),
        .uart_payload_words_i(uart_payload_words),
        .uart_landing_busy_i(uart_landing_busy), .uart_landing_live_i(uart_landing_live),
        .uart_word_valid_i(uart_word_valid), .uart_load_word_i(uart_load_word), .uart_word_number_i(uart_word_number),
        .uart_word_i(uart_word),
        .judge_o(judge), .accept_o(accept),
        .read_o(read), .write_o(write), .load_o(load), .store_o(store), .play_o(play),
        .kind_o(kind), .sequence_o(sequence_number), .argument_o(argument),
        .payload_words_o(payload_words), .words_o(words), .landing_busy_o(landing_was_busy), .landing_live_o(landing_was_live),
        .fast_o(fast), .load_word_o(load_word), .play_word_o(play_word), .lengths_o(lengths),
        .word_number_o(word_number), .word_o(word)
    );

    wire [7:0]   register_result, write_result, load_result, store_result, play_result, memory_result, crc_result, queue_result;
    wire [31:0]  register_data, memory_data, crc_data, queue_data;
    wire         gap, done_read, play_good;
    wire [1:0]   done;                       // by UART (1), by SPI (0)
    wire [7:0]   done_result, done_sequence, spi_result, spi_last, uart_last;
    wire [31:0]  done_data, spi_data;
    frame_result frame_result (
        .clk_i(clk_i), .rst_i(rst_i), .accept_i(accept), .uart_i(from_uart),
        .kind_i(kind), .sequence_i(sequence_number), .page_i(argument[15:6]),
        .spi_sequence_i(spi_last), .uart_sequence_i(uart_last), .gap_o(gap),
        .write_result_i(write_result), .load_result_i(load_result), .store_result_i(store_result), .play_result_i(play_result),
        .register_result_i(register_result), .memory_result_i(memory_result), .crc_result_i(crc_result),
        .queue_result_i(queue_result),
        .register_data_i(register_data), .memory_data_i(memory_data), .crc_data_i(crc_data), .queue_data_i(queue_data),
        .done_o(done), .read_o(done_read), .result_o(done_result), .sequence_o(done_sequence), .data_o(done_data)
    );

    link_reply spi_reply (
        .clk_i(clk_i), .rst_i(rst_i), .done_i(done[0]), .read_i(done_read),
        .result_i(done_result), .sequence_i(done_sequence), .data_i(done_data), .refuse_i(spi_refuse), .refusal_i(spi_refusal),
        .result_o(spi_result), .sequence_o(spi_last), .data_o(spi_data)
    );

    register_file #(
        // generated: built_in
        .BIT_PERIOD_RESET(BIT_PERIOD_RESET),
        .RAMP_SAMPLES_RESET(RAMP_SAMPLES_RESET),
        .CHANNEL_MASK_MAX(CHANNEL_MASK_MAX),
        .HV_SETTLE_TICKS(HV_SETTLE_TICKS),
        .HEARTBEAT_TICKS_MAX(HEARTBEAT_TICKS_MAX),
        .EDGE_WINDOW_TICKS(EDGE_WINDOW_TICKS),
        .PULSE_TICKS_MIN(PULSE_TICKS_MIN),
        .CHANNEL_EDGES_MAX(CHANNEL_EDGES_MAX),
        .TOTAL_EDGES_MAX(TOTAL_EDGES_MAX),
        .EMISSION_TICKS_MAX(EMISSION_TICKS_MAX),
        .DUTY_SHARE_MAX(DUTY_SHARE_MAX),
        .DUTY_TICKS_MAX(DUTY_TICKS_MAX),
        // end of built_in
        .CLOCK_HZ(CLOCK_HZ), .SLOTS(SLOTS), .BUILD_HASH(BUILD_HASH), .BOARD(BOARD)
    ) register_file (
        .clk_i(clk_i), .rst_i(rst_i),
        .judge_i(judge), .accept_i(accept), .read_i(read), .write_i(write),
        .address_i(argument), .words_i(words[127:0]),
        .read_result_o(register_result), .write_result_o(write_result), .data_o(register_data),
        .off_i(off), .faulted_i(faulted), .quiet_i((off || armed) && quiet && queue == 4'd0),
        .permitted_i(run_permit && temperature_ok),
        .uart_i(from_uart), .refused_i({uart_refuse, spi_refuse}), .gap_i(gap),
        // generated: connections
        .fault_i(fault),
        .fault_channels_i(fault_channels),
        .fault_count_i(fault_count),
        .fault_time_i(fault_time),
        .inputs_i(inputs),
        .input_time_i(input_time),
        .triggers_i(triggers),
        .triggers_ignored_i(triggers_ignored),
        .trigger_time_i(trigger_time),
        .emissions_i(emissions),
        .emission_time_i(emission_time),
        .plays_missed_i(plays_missed),
        .underruns_i(underruns),
        .slots_loaded_i(slots_loaded),
        .queue_i(queue),
        .duty_level_i(duty_level),
        .idle_word_o(idle_word),
        .channel_mask_o(channel_mask),
        .bit_period_o(bit_period),
        .ramp_samples_o(ramp_samples),
        .heartbeat_ticks_o(heartbeat_ticks),
        .pulse_ticks_o(pulse_ticks),
        .channel_edges_o(channel_edges),
        .total_edges_o(total_edges),
        .emission_ticks_o(emission_ticks),
        .duty_share_o(duty_share),
        .duty_ticks_o(duty_ticks),
        // end of connections
        .arm_o(arm), .disarm_o(disarm), .clear_o(clear), .stop_o(stop), .trigger_o(command)
    );

    // Waveforms
    wire                   slot_good, slot_intact, slot_checking, checking;
    wire [BUFFER_BITS-1:0] slot_buffer, landing, read_buffer, play_buffer, head_buffer;
    wire [9:0]             slot_words, read_word, play_length, head_first, head_length;
    wire [7:0]             chunks;
    wire [2:0]             read_chunk;
    wire [6:0]             read_within;
    wire                   missing, underrun, play_read, play_live, pop;
    wire                   head, head_live, head_polarity, head_delayed, head_delayed_one;
    wire                   queue_full, queue_uses_landing, player_uses_landing, player_live;
    wire [15:0]            head_count;
    wire                   head_triggered, head_scheduled, head_immediate;
    wire [31:0]            head_period, head_mask, play_data, drive;
    wire [63:0]            head_when;
    wire                   ramp_bit, ramp_done, playing, delayed, repeating, start, ended, waiting;

    assign landing_busy = (queue_uses_landing && !head_live) || player_uses_landing;
    assign landing_live = head_live || player_live;

    waveform_buffer #(.SLOTS(SLOTS), .BUFFER_BITS(BUFFER_BITS)) waveform_buffer (
        .clk_i(clk_i), .rst_i(rst_i), .judge_i(judge), .look_i(kind == `TYPE_STORE),
        .write_i(load_word), .write_word_i(word_number), .write_data_i(word),
        .load_i(load), .store_i(store),
        .argument_i(argument), .word0_i(words[`STORE_LENGTH_WORDS_BITS]), .word1_i(words[`STORE_CRC_BITS]),
        .load_words_i(payload_words),
        .load_busy_i(landing_was_busy), .load_live_i(landing_was_live), .live_i(landing_live),
        .load_result_o(load_result), .store_result_o(store_result),
        .slot_good_o(slot_good), .slot_buffer_o(slot_buffer), .slot_words_o(slot_words),
        .slot_intact_o(slot_intact), .slot_checking_o(slot_checking), .loaded_o(slots_loaded), .checking_o(checking),
        .landing_o(landing), .chunks_o(chunks),
        .memory_result_o(memory_result), .memory_data_o(memory_data), .crc_result_o(crc_result), .crc_data_o(crc_data),
        .play_i(playing), .play_read_i(play_read), .play_buffer_i(read_buffer), .play_word_i(read_word), .play_chunk_i(read_chunk),
        .play_within_i(read_within), .missing_o(missing), .play_data_o(play_data)
    );

    play_check #(.BUFFER_BITS(BUFFER_BITS)) play_check (
        .clk_i(clk_i), .rst_i(rst_i), .judge_i(judge), .begin_i(lengths), .accept_i(play), .forget_i(stop || disarm || shut),
        .argument_i(argument), .first_i(words[`PLAY_FIRST_BITS]), .asked_i(words[`PLAY_LENGTH_BITS]),
        .count_i(words[`PLAY_EMISSIONS_BITS]), .start_i(words[`PLAY_START_BITS]), .polarity_i(words[`PLAY_INVERTED_BITS]),
        .period_i(words[`PLAY_PERIOD_TICKS_BITS]), .when_i(words[`PLAY_WHEN_TICKS_BITS]),
        .bit_period_i(bit_period), .emission_ticks_i(emission_ticks), .now_i(now),
        .slot_good_i(slot_good), .slot_buffer_i(slot_buffer), .slot_words_i(slot_words),
        .slot_intact_i(slot_intact), .slot_checking_i(slot_checking),
        .landing_i(landing), .arriving_i(chunks[0]), .fast_i(fast),
        .armed_i(armed), .faulted_i(faulted), .queued_i(queue), .full_i(queue_full),
        .good_o(play_good), .result_o(play_result), .live_o(play_live), .buffer_o(play_buffer), .length_o(play_length)
    );

    play_queue #(.BUFFER_BITS(BUFFER_BITS)) play_queue (
        .clk_i(clk_i), .rst_i(rst_i), .select_i(spi_select || uart_begin),
        .write_i(play_word), .write_word_i(word_number[2:0]), .write_data_i(word),
        .push_i(play && play_good), .buffer_i(play_buffer), .length_i(play_length), .live_i(play_live),
        .pop_i(pop), .drop_i(stop || disarm || shut),
        .valid_o(head), .buffer_o(head_buffer), .first_o(head_first), .length_o(head_length), .count_o(head_count),
        .triggered_o(head_triggered), .scheduled_o(head_scheduled), .immediate_o(head_immediate),
        .polarity_o(head_polarity), .period_ticks_o(head_period), .mask_o(head_mask),
        .when_o(head_when), .delayed_o(head_delayed), .delayed_one_o(head_delayed_one), .live_o(head_live),
        .landing_i(landing), .landing_used_o(queue_uses_landing),
        .queued_o(queue), .full_o(queue_full),
        .address_i(argument[5:0]), .read_result_o(queue_result), .read_data_o(queue_data)
    );

    idle_ramp idle_ramp (
        .clk_i(clk_i), .rst_i(rst_i),
        .up_i(ramp_up), .down_i(ramp_down), .stay_i(armed || stopping),
        .bit_ticks_i(bit_period[31:16]), .samples_i(ramp_samples), .bit_o(ramp_bit), .done_o(ramp_done)
    );

    waveform_player #(.BUFFER_BITS(BUFFER_BITS)) waveform_player (
        .clk_i(clk_i), .rst_i(rst_i), .idle_word_i(idle_word), .bit_period_i(bit_period),
        .armed_i(armed), .stop_i(stop), .disarm_i(disarm), .fault_i(shut), .trigger_i(trigger), .now_i(now),
        .head_i(head), .head_buffer_i(head_buffer), .head_first_i(head_first), .head_length_i(head_length),
        .head_triggered_i(head_triggered), .head_scheduled_i(head_scheduled), .head_immediate_i(head_immediate),
        .head_count_i(head_count), .head_polarity_i(head_polarity),
        .head_period_ticks_i(head_period), .head_mask_i(head_mask), .head_when_i(head_when),
        .head_delayed_i(head_delayed), .head_delayed_one_i(head_delayed_one), .head_live_i(head_live),
        .pop_o(pop), .landing_i(landing), .landing_used_o(player_uses_landing), .live_o(player_live),
        .read_o(play_read), .read_buffer_o(read_buffer), .read_word_o(read_word), .read_chunk_o(read_chunk),
        .read_within_o(read_within),
        .missing_i(missing), .read_data_i(play_data), .underrun_o(underrun),
        .ramping_i(ramp_up || ramp_down), .ramp_bit_i(ramp_bit),
        .drive_o(drive), .start_o(start), .ended_o(ended), .playing_o(playing), .delayed_o(delayed),
        .repeating_o(repeating), .settled_o(settled), .quiet_o(quiet), .waiting_o(waiting),
        .triggers_o(triggers), .ignored_o(triggers_ignored), .missed_o(plays_missed),
        .trigger_time_o(trigger_time), .emission_time_o(emission_time)
    );

    // The way to the pins
    safety_island #(
        .ALIVE_HALF_TICKS(ALIVE_HALF_TICKS), .CHANNEL_MASK_MAX(CHANNEL_MASK_MAX), .HV_SETTLE_TICKS(HV_SETTLE_TICKS),
        .HEARTBEAT_TICKS_MAX(HEARTBEAT_TICKS_MAX), .EDGE_WINDOW_TICKS(EDGE_WINDOW_TICKS), .PULSE_TICKS_MIN(PULSE_TICKS_MIN),
        .CHANNEL_EDGES_MAX(CHANNEL_EDGES_MAX), .TOTAL_EDGES_MAX(TOTAL_EDGES_MAX), .EMISSION_TICKS_MAX(EMISSION_TICKS_MAX),
        .DUTY_SHARE_MAX(DUTY_SHARE_MAX), .DUTY_TICKS_MAX(DUTY_TICKS_MAX)
    ) safety_island (
        .clk_i(clk_i), .rst_i(rst_i), .clock_lost_i(clock_lost_i),
        .run_permit_i(run_permit_i), .temperature_ok_i(temperature_ok_i),
        .arm_i(arm), .disarm_i(disarm), .clear_i(clear), .heard_i(accept), .link_i(from_uart),
        .channel_mask_i(channel_mask), .heartbeat_ticks_i(heartbeat_ticks), .pulse_ticks_i(pulse_ticks),
        .channel_edges_i({8'd0, channel_edges}), .total_edges_i({3'd0, total_edges}), .emission_ticks_i(emission_ticks),
        .duty_share_i(duty_share), .duty_ticks_i(duty_ticks),
        .drive_i(drive), .bit_ticks_i(bit_period[31:16]), .playing_i(playing), .start_i(start), .ended_i(ended),
        .underrun_i(underrun), .ramp_done_i(ramp_done), .settled_i(settled), .now_i(now),
        .run_permit_o(run_permit), .temperature_ok_o(temperature_ok),
        .off_o(off), .settling_o(settling), .ramp_up_o(ramp_up), .armed_o(armed), .stopping_o(stopping), .ramp_down_o(ramp_down),
        .alive_o(alive), .shut_o(shut),
        .fault_o(fault), .faulted_o(faulted), .fault_channels_o(fault_channels), .fault_count_o(fault_count),
        .fault_time_o(fault_time),
        .duty_level_o(duty_level), .underruns_o(underruns), .emissions_o(emissions),
        .channel_o(channel_o), .hv_enable_o(hv_enable_o), .hv_alive_o(hv_alive_o), .focus_o(focus_o)
    );

    indicator_pins indicator_pins (
        .clk_i(clk_i), .rst_i(rst_i), .clock_lost_i(clock_lost_i), .waiting_i(waiting), .fault_i(faulted),
        .waiting_o(waiting_o), .fault_o(fault_o)
    );

    // The answers
    wire [15:0] state;
    status_flags status_flags (
        .sample_i(spi_select || uart_select), .armed_i(armed), .ramping_i(settling || ramp_up || ramp_down || stopping),
        .playing_i(playing), .repeating_i(repeating), .pending_i(queue != 4'd0), .landing_busy_i(landing_busy),
        .run_permit_i(run_permit), .alive_i(alive), .hv_enable_i(hv_enable_o), .temperature_ok_i(temperature_ok),
        .checking_i(checking), .delayed_i(delayed), .waiting_i(waiting), .state_o(state)
    );

    status_encoder spi_encoder (
        .clk_i(clk_i), .rst_i(rst_i), .select_i(spi_select), .take_i(spi_take), .byte_o(spi_answer),
        .result_i(spi_result), .sequence_i(spi_last), .data_i(spi_data), .state_i(state), .fault_i(fault),
        .triggers_i(triggers), .timestamp_i(now), .emissions_i(emissions),
        .queued_i({4'd0, queue}), .chunks_i(chunks), .ignored_i(triggers_ignored[15:0]),
        .echo_i(spi_kind == `TYPE_TEST), .byte_valid_i(spi_byte_valid), .byte_i(spi_byte)
    );

    generate
        if (UART != 32'd0) begin : uart
            wire        uart_take;
            wire [7:0]  uart_answer, uart_refusal, uart_result;
            wire [31:0] uart_data;
            uart_link #(.CLOCK_HZ(CLOCK_HZ), .BAUD(BAUD)) uart_link (
                .clk_i(clk_i), .rst_i(rst_i), .uart_rx_i(uart_rx_i), .uart_tx_o(uart_tx_o),
                .select_o(uart_select), .answer_i(uart_answer), .take_o(uart_take),
                .busy_i(spi_busy), .landing_busy_i(landing_busy), .landing_live_i(landing_live),
                .refuse_o(uart_refuse), .refusal_o(uart_refusal), .begin_o(uart_begin), .turn_o(from_uart), .accept_o(uart_accept),
                .kind_o(uart_kind), .sequence_o(uart_sequence), .argument_o(uart_argument), .payload_words_o(uart_payload_words),
                .landing_busy_o(uart_landing_busy), .landing_live_o(uart_landing_live),
                .word_valid_o(uart_word_valid), .word_number_o(uart_word_number), .word_o(uart_word), .load_word_o(uart_load_word)
            );

            link_reply uart_reply (
                .clk_i(clk_i), .rst_i(rst_i), .done_i(done[1]), .read_i(done_read),
                .result_i(done_result), .sequence_i(done_sequence), .data_i(done_data),
                .refuse_i(uart_refuse), .refusal_i(uart_refusal),
                .result_o(uart_result), .sequence_o(uart_last), .data_o(uart_data)
            );

            status_encoder uart_encoder (
                .clk_i(clk_i), .rst_i(rst_i), .select_i(uart_select), .take_i(uart_take), .byte_o(uart_answer),
                .result_i(uart_result), .sequence_i(uart_last), .data_i(uart_data), .state_i(state), .fault_i(fault),
                .triggers_i(triggers), .timestamp_i(now), .emissions_i(emissions),
                .queued_i({4'd0, queue}), .chunks_i(chunks), .ignored_i(triggers_ignored[15:0]),
                .echo_i(1'b0), .byte_valid_i(1'b0), .byte_i(8'd0)
            );
        end else begin : no_uart
            /* verilator lint_off UNUSEDSIGNAL */
            wire unused = uart_rx_i || done[1] || spi_busy;
            /* verilator lint_on UNUSEDSIGNAL */
            assign uart_tx_o = 1'b1;
            assign {uart_select, uart_begin, from_uart, uart_accept, uart_refuse, uart_word_valid, uart_load_word} = 7'd0;
            assign {uart_landing_busy, uart_landing_live, uart_kind, uart_sequence, uart_argument, uart_payload_words} = 41'd0;
            assign {uart_word_number, uart_word, uart_last} = 48'd0;
        end
    endgenerate

`ifdef FORMAL
    `include "haptic_core_properties.vh"
`endif
endmodule

`default_nettype wire
