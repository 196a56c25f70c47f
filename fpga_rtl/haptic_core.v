// The gateware of a haptic panel but for its board: frames by SPI or UART, trigger and permits in, 32 channels out.
// Pin to pin: a trigger's first word is out 8 clocks after the first clock edge that samples the trigger high;
// a lost permit has the outputs low 2 clocks after the first edge that samples it low, which is 3 after the pin at most.
`default_nettype none
`include "registers.vh"

module haptic_core #(
    // of the board: controller/fpga/build_parameters.py makes them from its board.toml; without them nothing is built
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
    parameter [31:0] BAUD                = 32'd1_000_000
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
        if (CLOCK_HZ == 32'd0 || SLOTS == 32'd0 || SLOTS > 32'd16 || BIT_PERIOD_RESET == 32'd0 || RAMP_SAMPLES_RESET == 32'd0) begin : not_given
            clock_and_slots_of_the_board_are_missing from_the_parameters ();
        end
    endgenerate

    localparam BUFFER_BITS = $clog2(SLOTS + 1);
    localparam ALIVE_HALF_TICKS = CLOCK_HZ / 40_000 > 0 ? CLOCK_HZ / 40_000 : 1;

    // Registers' telemetry and settings. The lines between `generated` and `end of` come from controller/fpga/registers.py.
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

    // Pins that have no clock, through two flip-flops; a trigger is high for FILTER_TICKS, low as long before the next
    reg [3:0]  trigger_q;
    reg        triggered_q, command_q;
    reg [63:0] now_q, input_time_q;
    reg [1:0]  permits_q;
    wire       trigger_high    = trigger_q[3:1] == 3'b111;
    wire       trigger_low     = trigger_q[3:1] == 3'b000;
    wire       command;
    wire       trigger         = (trigger_high && !triggered_q) || command_q;
    wire       run_permit, temperature_ok;
    assign     inputs          = {trigger_q[1], temperature_ok, run_permit};
    assign     input_time      = input_time_q;

    always @(posedge clk_i) begin
        trigger_q        <= {trigger_q[2:0], trigger_i};
        triggered_q      <= trigger_high || (triggered_q && !trigger_low);
        command_q        <= command;
        permits_q        <= {temperature_ok, run_permit};
        now_q            <= now_q + 64'd1;
        if (permits_q != {temperature_ok, run_permit}) input_time_q <= now_q;
        if (rst_i) begin
            trigger_q        <= 4'b1111;   // high at reset is no edge
            triggered_q      <= 1'b1;
            command_q        <= 1'b0;
            permits_q        <= 2'b00;
            now_q            <= 64'd0;
            input_time_q     <= 64'd0;
        end
    end

    // Frames: each link has a decoder, an encoder of answers and a conversation of its own. What the SPI accepts is carried
    // out at once; a frame of the UART waits, whole and good, for a pause of the SPI.
    wire       spi_select, spi_active, spi_release, spi_partial, spi_byte_valid, spi_take;
    wire       uart_select, uart_release, uart_partial, uart_byte_valid, uart_take;
    wire [7:0] spi_byte, uart_byte, spi_answer, uart_answer;

    spi_peripheral spi_peripheral (
        .clk_i(clk_i), .rst_i(rst_i),
        .spi_sck_i(spi_sck_i), .spi_cs_n_i(spi_cs_n_i), .spi_mosi_i(spi_mosi_i), .spi_miso_o(spi_miso_o),
        .select_o(spi_select), .active_o(spi_active), .release_o(spi_release), .partial_o(spi_partial),
        .byte_valid_o(spi_byte_valid), .byte_o(spi_byte), .answer_i(spi_answer), .answer_take_o(spi_take)
    );

    uart_peripheral #(.CLOCK_HZ(CLOCK_HZ), .BAUD(BAUD)) uart_peripheral (
        .clk_i(clk_i), .rst_i(rst_i), .uart_rx_i(uart_rx_i), .uart_tx_o(uart_tx_o),
        .select_o(uart_select), .release_o(uart_release), .partial_o(uart_partial),
        .byte_valid_o(uart_byte_valid), .byte_o(uart_byte), .answer_i(uart_answer), .answer_take_o(uart_take)
    );

    wire         spi_accept, spi_refuse, spi_word_valid, spi_landing_busy, spi_landing_live, spi_fast;
    wire         uart_accept, uart_refuse, uart_damaged, uart_word_valid, uart_landing_busy, uart_landing_live;
    wire         relay_select, relay_release, relay_byte_valid, relay_refuse, relay_begin, relay_word_valid, relay_accept;
    wire [7:0]   spi_refusal, spi_kind, spi_sequence, spi_word_number;
    wire [7:0]   uart_refusal, uart_kind, uart_sequence, uart_word_number, relay_word_number;
    wire [15:0]  spi_argument, uart_argument;
    wire [31:0]  spi_word, uart_word, relay_word;
    wire [6:0]   spi_payload_words, uart_payload_words;
    wire         landing_busy, landing_live;
    wire         spi_load_word;

    frame_decoder spi_decoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .select_i(spi_select), .release_i(spi_release), .partial_i(spi_partial),
        .byte_valid_i(spi_byte_valid), .byte_i(spi_byte),
        .landing_busy_i(landing_busy), .landing_live_i(landing_live), .bit_period_i(bit_period),
        .accept_o(spi_accept), .refuse_o(spi_refuse), .refusal_o(spi_refusal),
        .type_o(spi_kind), .sequence_o(spi_sequence), .argument_o(spi_argument),
        .landing_busy_o(spi_landing_busy), .landing_live_o(spi_landing_live), .payload_words_o(spi_payload_words), .fast_o(spi_fast),
        .word_valid_o(spi_word_valid), .word_number_o(spi_word_number), .word_o(spi_word), .load_word_o(spi_load_word)
    );

    /* verilator lint_off PINCONNECTEMPTY */
    frame_decoder uart_decoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .select_i(relay_select), .release_i(relay_release), .partial_i(uart_partial),
        .byte_valid_i(relay_byte_valid), .byte_i(uart_byte),
        .landing_busy_i(1'b0), .landing_live_i(1'b0), .bit_period_i(32'd0),
        .accept_o(uart_accept), .refuse_o(uart_damaged), .refusal_o(uart_refusal),
        .type_o(uart_kind), .sequence_o(uart_sequence), .argument_o(uart_argument),
        .landing_busy_o(), .landing_live_o(), .payload_words_o(uart_payload_words), .fast_o(),
        .word_valid_o(uart_word_valid), .word_number_o(uart_word_number), .word_o(uart_word), .load_word_o()
    );
    /* verilator lint_on PINCONNECTEMPTY */

    wire from_uart;                        // whose frame the core is asked
    frame_relay frame_relay (
        .clk_i(clk_i), .rst_i(rst_i), .busy_i(spi_select || spi_active || spi_release || spi_accept || spi_refuse),
        .select_i(uart_select), .release_i(uart_release), .byte_valid_i(uart_byte_valid),
        .select_o(relay_select), .release_o(relay_release), .byte_valid_o(relay_byte_valid), .refuse_o(relay_refuse),
        .accept_i(uart_accept), .payload_words_i(uart_payload_words),
        .word_valid_i(uart_word_valid), .word_number_i(uart_word_number), .word_i(uart_word),
        .landing_busy_i(landing_busy), .landing_live_i(landing_live),
        .begin_o(relay_begin), .turn_o(from_uart), .word_valid_o(relay_word_valid), .word_number_o(relay_word_number),
        .word_o(relay_word), .accept_o(relay_accept), .landing_busy_o(uart_landing_busy), .landing_live_o(uart_landing_live)
    );

    wire         select            = spi_select || relay_begin;
    wire         accept            = spi_accept || relay_accept;
    wire         word_valid        = spi_word_valid || relay_word_valid;
    wire [7:0]   word_number       = from_uart ? relay_word_number : spi_word_number;
    wire [31:0]  word              = from_uart ? relay_word : spi_word;

    // What the frame asks rests long before it is accepted: chosen a clock early, it begins no long path. It is chosen, and found
    // out what it means, only in clocks in which it may have changed. Its first words are gathered as they come; every frame of the
    // UART brings them again in its turn.
    reg  [7:0]   kind, sequence_number;
    reg  [15:0]  argument;
    reg  [191:0] words;                    // first six of the payload, the first lowest
    reg  [6:0]   payload_words;
    reg  [1:0]   taken_q;                  // the SPI's decoder took something in one clock ago, two: a word comes a clock later
    reg          returned_q, chosen_q;
    wire         choose = taken_q != 2'b00 || relay_begin || from_uart || returned_q;
    always @(posedge clk_i) begin
        taken_q    <= {taken_q[0], spi_select || spi_byte_valid};
        returned_q <= from_uart;
        chosen_q   <= choose;
        if (choose && (relay_begin || from_uart)) begin
            kind            <= uart_kind;
            sequence_number <= uart_sequence;
            argument        <= uart_argument;
            payload_words   <= uart_payload_words;
        end else if (choose) begin
            kind            <= spi_kind;
            sequence_number <= spi_sequence;
            argument        <= spi_argument;
            payload_words   <= spi_payload_words;
        end
        if (word_valid && word_number < 8'd6) words[{word_number[2:0], 5'd0} +: 32] <= word;
        if (rst_i) begin
            kind            <= `TYPE_NOP;
            sequence_number <= 8'd0;
            argument        <= 16'd0;
            words           <= 192'd0;
            payload_words   <= 7'd0;
            taken_q         <= 2'b00;
            returned_q      <= 1'b0;
            chosen_q        <= 1'b0;
        end
    end

    reg          load_word, play_word;
    always @* begin
        load_word = 1'b0;
        play_word = 1'b0;
        if (word_valid) begin
            load_word = spi_load_word || (relay_word_valid && uart_kind == `TYPE_LOAD && uart_argument < {12'd0, `CHUNKS});
            play_word = kind == `TYPE_PLAY;
        end
    end
    wire         landing_was_busy  = from_uart ? uart_landing_busy : spi_landing_busy;
    wire         landing_was_live  = from_uart ? uart_landing_live : spi_landing_live;
    assign       uart_refuse       = uart_damaged || relay_refuse;

    // What becomes of them
    wire [7:0] register_result, write_result, load_result, store_result, play_result, memory_result, crc_result, queue_result;
    reg  [7:0] read_result, result;
    reg  [7:0] spi_result_q, spi_sequence_q, uart_result_q, uart_sequence_q;
    reg        fast_q;                     // of the last LOAD; never of one by the UART
    wire       play_accept = accept && kind == `TYPE_PLAY;
    wire       play_good;
    wire       push = play_accept && play_good;

    wire [31:0] register_data, memory_data, crc_data, queue_data;
    reg  [31:0] read_data, spi_data_q, uart_data_q;
    reg         gap, read;
`ifdef SYNTHESIS
    wire        judge = 1'b1;              // on an FPGA it costs nothing to find out what has not changed
`else
    wire        judge = chosen_q || accept;  // results hold in this clock
`endif
    always @* begin
        read_result = `RESULT_OK;
        read_data   = 32'd0;
        result      = `RESULT_OK;
        gap         = 1'b0;
        read        = 1'b0;
        if (accept) begin
            if (argument[15]) begin
                read_result = memory_result;
                read_data   = memory_data;
            end else if (argument[14:8] == 7'd1) begin
                read_result = crc_result;
                read_data   = crc_data;
            end else if (argument[14:8] == 7'd2) begin
                read_result = argument[7:6] != 2'd0 ? `RESULT_BAD_RANGE : queue_result;
                read_data   = queue_data;
            end else begin
                read_result = register_result;
                read_data   = register_data;
            end
            case (kind)
                `TYPE_NOP, `TYPE_TEST: result = `RESULT_OK;
                `TYPE_READ:  result = read_result;
                `TYPE_WRITE: result = write_result;
                `TYPE_LOAD:  result = load_result;
                `TYPE_STORE: result = store_result;
                `TYPE_PLAY:  result = play_result;
                default:     result = `RESULT_UNKNOWN_TYPE;
            endcase
            gap  = sequence_number != (from_uart ? uart_sequence_q : spi_sequence_q) + 8'd1;
            read = kind == `TYPE_READ && read_result == `RESULT_OK;
        end
    end

    always @(posedge clk_i) begin
        if (spi_refuse) spi_result_q <= spi_refusal;
        if (spi_accept) begin
            spi_result_q   <= result;
            spi_sequence_q <= sequence_number;
            if (read) spi_data_q <= read_data;
        end
        if (relay_accept) begin
            uart_result_q   <= result;
            uart_sequence_q <= sequence_number;
            if (read) uart_data_q <= read_data;
        end
        if (uart_damaged) uart_result_q <= uart_refusal;
        if (relay_refuse) uart_result_q <= `RESULT_BUSY;
        if (accept && kind == `TYPE_LOAD) fast_q <= spi_fast && !from_uart;
        if (rst_i) begin
            spi_result_q    <= `RESULT_OK;
            spi_sequence_q  <= 8'd0;
            spi_data_q      <= 32'd0;
            uart_result_q   <= `RESULT_OK;
            uart_sequence_q <= 8'd0;
            uart_data_q     <= 32'd0;
            fast_q          <= 1'b0;
        end
    end

    wire        arm, disarm, clear, stop;
    wire        off, settling, armed, ramp_up, ramp_down, stopping, alive, shut;
    wire        quiet, settled;

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
        .judge_i(judge), .accept_i(accept), .read_i(accept && kind == `TYPE_READ), .write_i(accept && kind == `TYPE_WRITE),
        .address_i(argument), .words_i(words[127:0]),
        .read_result_o(register_result), .write_result_o(write_result), .data_o(register_data),
        .off_i(off), .quiet_i((off || armed) && quiet && queue == 4'd0), .permitted_i(run_permit && temperature_ok),
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
    wire                   missing, underrun, play_read, play_polarity, play_live, head, head_live, head_polarity, head_delayed, head_delayed_one, pop;
    wire                   queue_full, queue_uses_landing, player_uses_landing, player_live;
    wire [15:0]            head_count;
    wire [1:0]             head_start;
    wire [31:0]            head_period, head_mask, play_data, drive;
    wire [63:0]            head_when;
    wire                   ramp_bit, ramp_done, playing, delayed, repeating, start, ended, waiting;

    assign landing_busy = (queue_uses_landing && !head_live) || player_uses_landing;
    assign landing_live = head_live || player_live;

    waveform_buffer #(.SLOTS(SLOTS), .BUFFER_BITS(BUFFER_BITS)) waveform_buffer (
        .clk_i(clk_i), .rst_i(rst_i), .judge_i(judge), .look_i(kind == `TYPE_STORE),
        .write_i(load_word), .write_word_i(word_number[6:0]), .write_data_i(word),
        .load_i(accept && kind == `TYPE_LOAD), .store_i(accept && kind == `TYPE_STORE),
        .argument_i(argument), .word0_i(words[31:0]), .word1_i(words[63:32]), .load_words_i(payload_words),
        .load_busy_i(landing_was_busy), .load_live_i(landing_was_live), .live_i(landing_live),
        .load_result_o(load_result), .store_result_o(store_result),
        .slot_good_o(slot_good), .slot_buffer_o(slot_buffer), .slot_words_o(slot_words),
        .slot_intact_o(slot_intact), .slot_checking_o(slot_checking), .loaded_o(slots_loaded), .checking_o(checking),
        .landing_o(landing), .chunks_o(chunks),
        .memory_result_o(memory_result), .memory_data_o(memory_data), .crc_result_o(crc_result), .crc_data_o(crc_data),
        .play_i(playing), .play_read_i(play_read), .play_polarity_i(play_polarity), .play_buffer_i(read_buffer), .play_word_i(read_word), .play_chunk_i(read_chunk),
        .play_within_i(read_within), .missing_o(missing), .play_data_o(play_data)
    );

    reg lengths_q;                         // words 0 to 2 of a PLAY are there
    always @(posedge clk_i) lengths_q <= play_word && word_number == 8'd2 && !rst_i;

    play_check #(.BUFFER_BITS(BUFFER_BITS)) play_check (
        .clk_i(clk_i), .rst_i(rst_i), .judge_i(judge), .begin_i(lengths_q), .accept_i(play_accept), .forget_i(stop || disarm || shut),
        .argument_i(argument), .first_i(words[15:0]), .asked_i(words[31:16]), .count_i(words[47:32]), .start_i(words[55:48]),
        .polarity_i(words[63:56]), .period_i(words[95:64]), .when_i(words[191:128]),
        .bit_period_i(bit_period), .emission_ticks_i(emission_ticks), .now_i(now_q),
        .slot_good_i(slot_good), .slot_buffer_i(slot_buffer), .slot_words_i(slot_words),
        .slot_intact_i(slot_intact), .slot_checking_i(slot_checking),
        .landing_i(landing), .arriving_i(chunks[0]), .fast_i(fast_q),
        .armed_i(armed), .faulted_i(fault != 16'd0), .queued_i(queue), .full_i(queue_full),
        .good_o(play_good), .result_o(play_result), .live_o(play_live), .buffer_o(play_buffer), .length_o(play_length)
    );

    play_queue #(.BUFFER_BITS(BUFFER_BITS)) play_queue (
        .clk_i(clk_i), .rst_i(rst_i), .select_i(select),
        .write_i(play_word), .write_word_i(word_number[2:0]), .write_data_i(word),
        .push_i(push), .buffer_i(play_buffer), .length_i(play_length), .live_i(play_live),
        .pop_i(pop), .drop_i(stop || disarm || shut),
        .valid_o(head), .buffer_o(head_buffer), .first_o(head_first), .length_o(head_length), .count_o(head_count),
        .start_o(head_start), .polarity_o(head_polarity), .period_ticks_o(head_period), .mask_o(head_mask),
        .when_o(head_when), .delayed_o(head_delayed), .delayed_one_o(head_delayed_one), .live_o(head_live), .landing_i(landing), .landing_used_o(queue_uses_landing),
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
        .armed_i(armed), .stop_i(stop), .disarm_i(disarm), .fault_i(shut), .trigger_i(trigger), .now_i(now_q),
        .head_i(head), .head_buffer_i(head_buffer), .head_first_i(head_first), .head_length_i(head_length),
        .head_count_i(head_count), .head_start_i(head_start), .head_polarity_i(head_polarity),
        .head_period_ticks_i(head_period), .head_mask_i(head_mask), .head_when_i(head_when), .head_delayed_i(head_delayed), .head_delayed_one_i(head_delayed_one), .head_live_i(head_live),
        .pop_o(pop), .landing_i(landing), .landing_used_o(player_uses_landing), .live_o(player_live),
        .read_o(play_read), .read_polarity_o(play_polarity), .read_buffer_o(read_buffer), .read_word_o(read_word), .read_chunk_o(read_chunk), .read_within_o(read_within),
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
        .clk_i(clk_i), .rst_i(rst_i), .clock_lost_i(clock_lost_i), .run_permit_i(run_permit_i), .temperature_ok_i(temperature_ok_i),
        .arm_i(arm), .disarm_i(disarm), .clear_i(clear), .heard_i(accept), .link_i(from_uart),
        .channel_mask_i(channel_mask), .heartbeat_ticks_i(heartbeat_ticks), .pulse_ticks_i(pulse_ticks),
        .channel_edges_i({8'd0, channel_edges}), .total_edges_i({3'd0, total_edges}), .emission_ticks_i(emission_ticks),
        .duty_share_i(duty_share), .duty_ticks_i(duty_ticks),
        .drive_i(drive), .bit_ticks_i(bit_period[31:16]), .playing_i(playing), .start_i(start), .ended_i(ended),
        .underrun_i(underrun), .ramp_done_i(ramp_done), .settled_i(settled), .now_i(now_q),
        .run_permit_o(run_permit), .temperature_ok_o(temperature_ok),
        .off_o(off), .settling_o(settling), .ramp_up_o(ramp_up), .armed_o(armed), .stopping_o(stopping), .ramp_down_o(ramp_down),
        .alive_o(alive), .shut_o(shut),
        .fault_o(fault), .fault_channels_o(fault_channels), .fault_count_o(fault_count), .fault_time_o(fault_time),
        .duty_level_o(duty_level), .underruns_o(underruns), .emissions_o(emissions),
        .channel_o(channel_o), .hv_enable_o(hv_enable_o), .hv_alive_o(hv_alive_o), .focus_o(focus_o)
    );

    reg waiting_q, fault_q;                  // pads: no glitch of the logic before them
    always @(posedge clk_i or posedge clock_lost_i) begin
        if (clock_lost_i) begin
            waiting_q <= 1'b0;
            fault_q <= 1'b0;
        end else begin
            waiting_q <= waiting && !rst_i;
            fault_q <= fault != 16'd0 && !rst_i;
        end
    end
    assign waiting_o = waiting_q;
    assign fault_o = fault_q;

    // The answer
    reg [15:0] state;                      // as a frame begins
    always @* begin
        state = 16'd0;
        if (spi_select || uart_select) begin
            state[`STATE_ARMED]             = armed;
            state[`STATE_RAMPING]           = settling || ramp_up || ramp_down || stopping;
            state[`STATE_PLAYING]           = playing;
            state[`STATE_REPEATING]         = repeating;
            state[`STATE_PENDING]           = queue != 4'd0;
            state[`STATE_LANDING_BUSY]      = landing_busy;
            state[`STATE_RUN_PERMIT]        = run_permit;
            state[`STATE_HEARTBEAT]         = alive;
            state[`STATE_HV_ENABLE]         = hv_enable_o;
            state[`STATE_TEMPERATURE_GOOD]  = temperature_ok;
            state[`STATE_CHECKING]          = checking;
            state[`STATE_DELAYED]           = delayed;
            state[`STATE_WAITING]           = waiting;
        end
    end

    status_encoder spi_encoder (
        .clk_i(clk_i), .rst_i(rst_i), .select_i(spi_select), .take_i(spi_take), .byte_o(spi_answer),
        .result_i(spi_result_q), .sequence_i(spi_sequence_q), .state_i(state), .fault_i(fault), .data_i(spi_data_q),
        .triggers_i(triggers), .timestamp_i(now_q), .emissions_i(emissions),
        .queued_i({4'd0, queue}), .chunks_i(chunks), .ignored_i(triggers_ignored[15:0]),
        .echo_i(spi_kind == `TYPE_TEST), .byte_valid_i(spi_byte_valid), .byte_i(spi_byte)
    );

    status_encoder uart_encoder (
        .clk_i(clk_i), .rst_i(rst_i), .select_i(uart_select), .take_i(uart_take), .byte_o(uart_answer),
        .result_i(uart_result_q), .sequence_i(uart_sequence_q), .state_i(state), .fault_i(fault), .data_i(uart_data_q),
        .triggers_i(triggers), .timestamp_i(now_q), .emissions_i(emissions),
        .queued_i({4'd0, queue}), .chunks_i(chunks), .ignored_i(triggers_ignored[15:0]),
        .echo_i(1'b0), .byte_valid_i(1'b0), .byte_i(8'd0)
    );
endmodule

`default_nettype wire
