// Every number that the host and the FPGA have to agree on. The numbers come from controller/device/fpga/registers.py, by
// `python -m controller.generate`; size, base and comment of a constant are written here.
`ifndef REGISTERS_VH
`define REGISTERS_VH

`define PROTOCOL_VERSION 32'd2
`define IDENTITY_MAGIC 32'h4C4E5048  // 'HPNL' as it lies in memory

`define FRAME_SYNC 16'hA55A
`define STATUS_SYNC 16'h5AA5
`define CRC_RESIDUE 32'hDEBB20E3     // what the register holds after a frame and its own CRC

`define SHORT_PAYLOAD_BYTES 16'd24   // of every frame but LOAD and TEST
`define LOAD_PAYLOAD_MIN_BYTES 16'd20
`define LOAD_PAYLOAD_MAX_BYTES 16'd500
`define CHUNKS 4'd8
`define CHUNK_WORDS 10'd125
`define WAVEFORM_WORDS 11'd1000      // longest waveform
`define CHANNELS 8'd32
`define QUEUE_PLAYS 8'd8             // accepted and not yet begun

// What else can be read, by the argument's upper bits
`define PLAY_LANDING 16'hFFFF        // PLAY what is still arriving
`define READ_SLOT_CRC 16'h100       // + slot
`define READ_QUEUE 16'h200          // + 8 play + word
`define READ_MEMORY 16'h8000         // + 1024 slot + word

// Limits of settings, and what they are after reset
`define BIT_TICKS_MIN 32'd4
`define BIT_CLOCK_HZ_MAX 32'd2000000
`define BIT_CLOCK_HZ_MIN 32'd100000
`define RAMP_SAMPLES_MAX 32'd262143
`define DUTY_FULL 32'd65536

// Clocks, for the timing tables and the model
`define FILTER_TICKS 8'd3            // the trigger is high at least that long, or it is a glitch
`define TRIGGER_LATENCY_TICKS 8'd8   // from the first clock that samples the trigger high to the first word
`define TIME_LEAD_TICKS 64'd30       // a scheduled play begins so long behind the time of two clocks before it is accepted, or later

// generated: codes
// What a frame asks for
`define TYPE_NOP 8'd0
`define TYPE_READ 8'd1
`define TYPE_WRITE 8'd2
`define TYPE_LOAD 8'd3
`define TYPE_STORE 8'd4
`define TYPE_PLAY 8'd5
`define TYPE_TEST 8'd6
// What a play waits for, once it is at the head of the queue
`define START_TRIGGER 2'd0
`define START_NOW 2'd1
`define START_TIME 2'd2
// What became of the frame before
`define RESULT_OK 8'd0
`define RESULT_BAD_SYNC 8'd1
`define RESULT_BAD_LENGTH 8'd2
`define RESULT_BAD_CRC 8'd3
`define RESULT_UNKNOWN_TYPE 8'd4
`define RESULT_UNKNOWN_REGISTER 8'd5
`define RESULT_READ_ONLY 8'd6
`define RESULT_BAD_VALUE 8'd7
`define RESULT_BAD_SLOT 8'd8
`define RESULT_BAD_CHUNK 8'd9
`define RESULT_INCOMPLETE 8'd10
`define RESULT_EMPTY_SLOT 8'd11
`define RESULT_BUSY 8'd12
`define RESULT_NOT_ARMED 8'd13
`define RESULT_ARMED 8'd14
`define RESULT_FAULTED 8'd15
`define RESULT_NO_PERMIT 8'd16
`define RESULT_BAD_KEY 8'd17
`define RESULT_LOCKED 8'd18
`define RESULT_QUEUE_FULL 8'd19
`define RESULT_BAD_RANGE 8'd20
`define RESULT_BAD_PERIOD 8'd21
`define RESULT_TOO_LONG 8'd22
`define RESULT_TOO_LATE 8'd23
`define RESULT_OVERLAP 8'd24
`define RESULT_SLOT_DAMAGED 8'd25
`define RESULT_LINK_SLOW 8'd26
// Words that the CONTROL register understands
`define CONTROL_ARM 32'd1
`define CONTROL_DISARM 32'd2
`define CONTROL_CLEAR 32'd3
`define CONTROL_STOP 32'd4
`define CONTROL_UNLOCK 32'd5
`define CONTROL_TRIGGER 32'd6
// Addresses of the registers, and how many there are
`define REGISTER_IDENTITY 16'd0
`define REGISTER_PROTOCOL 16'd1
`define REGISTER_BUILD_HASH 16'd2
`define REGISTER_BOARD 16'd3
`define REGISTER_CLOCK_HZ 16'd4
`define REGISTER_GEOMETRY 16'd5
`define REGISTER_PARAMETERS 16'd6
`define REGISTER_EDGE_WINDOW_TICKS 16'd7
`define REGISTER_CONTROL 16'd8
`define REGISTER_IDLE_WORD 16'd9
`define REGISTER_CHANNEL_MASK 16'd10
`define REGISTER_BIT_PERIOD 16'd11
`define REGISTER_RAMP_SAMPLES 16'd12
`define REGISTER_HEARTBEAT_TICKS 16'd13
`define REGISTER_PULSE_TICKS 16'd14
`define REGISTER_CHANNEL_EDGES 16'd15
`define REGISTER_TOTAL_EDGES 16'd16
`define REGISTER_EMISSION_TICKS 16'd17
`define REGISTER_DUTY_SHARE 16'd18
`define REGISTER_DUTY_TICKS 16'd19
`define REGISTER_FAULT 16'd20
`define REGISTER_FAULT_CHANNELS 16'd21
`define REGISTER_FAULT_COUNT 16'd22
`define REGISTER_FAULT_TIME_LOW 16'd23
`define REGISTER_FAULT_TIME_HIGH 16'd24
`define REGISTER_INPUTS 16'd25
`define REGISTER_INPUT_TIME_LOW 16'd26
`define REGISTER_INPUT_TIME_HIGH 16'd27
`define REGISTER_TRIGGERS 16'd28
`define REGISTER_TRIGGERS_IGNORED 16'd29
`define REGISTER_TRIGGER_TIME_LOW 16'd30
`define REGISTER_TRIGGER_TIME_HIGH 16'd31
`define REGISTER_EMISSIONS 16'd32
`define REGISTER_EMISSION_TIME_LOW 16'd33
`define REGISTER_EMISSION_TIME_HIGH 16'd34
`define REGISTER_PLAYS_MISSED 16'd35
`define REGISTER_UNDERRUNS 16'd36
`define REGISTER_FRAME_ERRORS 16'd37
`define REGISTER_SEQUENCE_GAPS 16'd38
`define REGISTER_SLOTS_LOADED 16'd39
`define REGISTER_QUEUE 16'd40
`define REGISTER_DUTY_LEVEL 16'd41
`define REGISTER_HV_SETTLE_TICKS 16'd42
`define REGISTER_CHANNEL_MASK_MAX 16'd43
`define REGISTER_HEARTBEAT_TICKS_MAX 16'd44
`define REGISTER_PULSE_TICKS_MIN 16'd45
`define REGISTER_CHANNEL_EDGES_MAX 16'd46
`define REGISTER_TOTAL_EDGES_MAX 16'd47
`define REGISTER_EMISSION_TICKS_MAX 16'd48
`define REGISTER_DUTY_SHARE_MAX 16'd49
`define REGISTER_DUTY_TICKS_MAX 16'd50
`define REGISTER_COUNT 16'd51
// State bits of a status frame: numbers of the bits
`define STATE_ARMED 0
`define STATE_RAMPING 1
`define STATE_PLAYING 2
`define STATE_REPEATING 3
`define STATE_PENDING 4
`define STATE_LANDING_BUSY 5
`define STATE_RUN_PERMIT 6
`define STATE_HEARTBEAT 7
`define STATE_HV_ENABLE 8
`define STATE_TEMPERATURE_GOOD 9
`define STATE_CHECKING 10
`define STATE_DELAYED 11
`define STATE_WAITING 12
// Causes for which the FPGA has shut its outputs off: numbers of the bits
`define FAULT_NO_PERMIT 0
`define FAULT_HOST_SILENT 1
`define FAULT_OVER_TEMPERATURE 2
`define FAULT_UNDERRUN 3
`define FAULT_SHORT_PULSE 4
`define FAULT_CHANNEL_EDGES 5
`define FAULT_TOTAL_EDGES 6
`define FAULT_LONG_EMISSION 7
`define FAULT_DUTY 8
`define FAULT_CAUSES 9
// Bytes at which the fields of a frame's header begin, and all that is not payload
`define FRAME_SYNC_AT 10'd0
`define FRAME_TYPE_AT 10'd2
`define FRAME_SEQUENCE_AT 10'd3
`define FRAME_LENGTH_AT 10'd4
`define FRAME_ARGUMENT_AT 10'd6
`define FRAME_OVERHEAD_BYTES 17'd12
// Bits of the payload of a WRITE
`define WRITE_VALUE_BITS 31:0
`define WRITE_IDENTITY_BITS 63:32
`define WRITE_PROTOCOL_BITS 95:64
`define WRITE_BUILD_HASH_BITS 127:96
// Bits of the payload of a STORE
`define STORE_LENGTH_WORDS_BITS 31:0
`define STORE_CRC_BITS 63:32
// Bits of the payload of a PLAY
`define PLAY_FIRST_BITS 15:0
`define PLAY_LENGTH_BITS 31:16
`define PLAY_EMISSIONS_BITS 47:32
`define PLAY_START_BITS 55:48
`define PLAY_INVERTED_BITS 63:56
`define PLAY_PERIOD_TICKS_BITS 95:64
`define PLAY_MASK_BITS 127:96
`define PLAY_WHEN_TICKS_BITS 191:128
// Bits of a status, and its bytes
`define STATUS_SYNC_BITS 15:0
`define STATUS_RESULT_BITS 23:16
`define STATUS_SEQUENCE_BITS 31:24
`define STATUS_STATE_BITS 47:32
`define STATUS_FAULTS_BITS 63:48
`define STATUS_DATA_BITS 95:64
`define STATUS_TRIGGER_COUNT_BITS 127:96
`define STATUS_TIMESTAMP_TICKS_BITS 191:128
`define STATUS_EMISSIONS_BITS 223:192
`define STATUS_QUEUED_BITS 231:224
`define STATUS_CHUNKS_BITS 239:232
`define STATUS_IGNORED_BITS 255:240
`define STATUS_COVERED_BYTES 6'd32  // before the CRC
// end of codes

`endif
