// Every number the host and the FPGA have to agree on; controller/fpga/registers.py says the same,
// and tests/fpga/test_registers.py compares the two line by line.
`ifndef REGISTERS_VH
`define REGISTERS_VH

`define PROTOCOL_VERSION 32'd1
`define IDENTITY_MAGIC 32'h4C4E5048  // 'HPNL' as it lies in memory

`define FRAME_SYNC 16'hA55A
`define STATUS_SYNC 16'h5AA5
`define CRC_RESIDUE 32'hDEBB20E3     // what the register holds after a frame and its own CRC

`define SHORT_PAYLOAD_BYTES 16'd20   // of every frame but LOAD
`define LOAD_PAYLOAD_MIN_BYTES 16'd20
`define LOAD_PAYLOAD_MAX_BYTES 16'd500
`define CHUNKS 4'd8
`define CHUNK_WORDS 10'd125
`define WAVEFORM_WORDS 11'd1000      // longest waveform
`define CHANNELS 8'd32

// Frame types
`define TYPE_NOP 8'd0
`define TYPE_READ 8'd1
`define TYPE_WRITE 8'd2
`define TYPE_LOAD 8'd3
`define TYPE_STORE 8'd4
`define TYPE_PLAY 8'd5

// Results of a frame, reported in the next status
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

// Registers, 32 bits each
`define REGISTER_IDENTITY 16'd0
`define REGISTER_PROTOCOL 16'd1
`define REGISTER_BUILD_HASH 16'd2
`define REGISTER_CLOCK_HZ 16'd3
`define REGISTER_GEOMETRY 16'd4
`define REGISTER_CONTROL 16'd5
`define REGISTER_IDLE_WORD 16'd6
`define REGISTER_BIT_TICKS 16'd7
`define REGISTER_RAMP_SAMPLES 16'd8
`define REGISTER_HEARTBEAT_TICKS 16'd9
`define REGISTER_CHANNEL_MASK 16'd10
`define REGISTER_FAULT 16'd11
`define REGISTER_TRIGGERS_IGNORED 16'd12
`define REGISTER_EMISSIONS 16'd13
`define REGISTER_FRAME_ERRORS 16'd14
`define REGISTER_SLOTS_LOADED 16'd15

// Words for CONTROL
`define CONTROL_ARM 32'd1
`define CONTROL_DISARM 32'd2
`define CONTROL_CLEAR 32'd3
`define CONTROL_STOP 32'd4

// Bit numbers of the state and of the faults in the status
`define STATE_ARMED 0
`define STATE_RAMPING 1
`define STATE_PLAYING 2
`define STATE_REPEATING 3
`define STATE_PENDING 4
`define STATE_LANDING_BUSY 5
`define STATE_RUN_PERMIT 6
`define STATE_HEARTBEAT 7
`define STATE_HV_ENABLE 8
`define FAULT_NO_PERMIT 0
`define FAULT_HOST_SILENT 1

// Limits of settings, and what they are after reset
`define BIT_TICKS_MIN 32'd4
`define BIT_TICKS_MAX 32'd65535
`define RAMP_SAMPLES_MAX 32'd262143
`define RAMP_SAMPLES_RESET 32'd5000
`define BIT_CLOCK_HZ_RESET 32'd500000

// Clocks from an input pin to what it causes, for the timing tables and the model
`define TRIGGER_LATENCY_TICKS 5      // after the first clock that samples the trigger high

`endif
