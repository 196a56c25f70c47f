// The answer to every frame: a snapshot taken as it begins, its CRC, then zeros; behind a TEST what it brought,
// two bytes later.
`default_nettype none
`include "registers.vh"

module status_encoder (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        select_i,     // pulse: take the snapshot
    input  wire        take_i,       // pulse: byte_o was taken, a clock behind select_i at the earliest
    output wire [7:0]  byte_o,
    // what the frames before brought: taken a clock later than all else
    input  wire [7:0]  result_i,
    input  wire [7:0]  sequence_i,
    input  wire [31:0] data_i,
    // state
    input  wire [15:0] state_i,
    input  wire [15:0] fault_i,
    input  wire [31:0] triggers_i,
    input  wire [63:0] timestamp_i,
    input  wire [31:0] emissions_i,
    input  wire [7:0]  queued_i,
    input  wire [7:0]  chunks_i,
    input  wire [15:0] ignored_i,
    input  wire        echo_i,       // send back what comes in
    input  wire        byte_valid_i,
    input  wire [7:0]  byte_i
);
    localparam [5:0]  BYTES = `STATUS_COVERED_BYTES;
    localparam [15:0] SYNC  = `STATUS_SYNC;

    reg         selected_q;
    reg [7:0]   result_q, sequence_q;
    reg [31:0]  data_q;
    reg [15:0]  state_q, fault_q, ignored_q;
    reg [31:0]  triggers_q, emissions_q;
    reg [63:0]  timestamp_q;
    reg [7:0]   queued_q, chunks_q;
    reg [5:0]   count_q;             // bytes taken, held at 36
    reg [31:0]  turn_q;              // one bit: the byte that was taken last
    reg [7:0]   next_q;              // next byte of the snapshot
    reg [7:0]   last_q;              // byte that came in last

    wire        in_snapshot = count_q < BYTES;
    wire        in_status   = count_q < BYTES + 6'd4;
    wire [31:0] crc;
    reg  [7:0]  answer;

    crc32 crc32_status (
        .clk_i(clk_i), .rst_i(rst_i), .clear_i(select_i),
        .valid_i(take_i && in_snapshot), .byte_i(next_q), .crc_o(crc)
    );

    // its first byte is sent without it; a byte of zeros behind
    reg [263:8] status;

`ifdef SYNTHESIS
    wire look = 1'b1;                // on an FPGA it costs nothing to choose what nobody takes
`else
    wire look = take_i;
`endif
    reg [7:0] following;
    always @* begin : choose
        integer place;
        status    = 256'd0;
        following = 8'd0;
        place     = 0;
        if (look) begin
            status[15:8]                         = SYNC[15:8];
            status[`STATUS_RESULT_BITS]          = result_q;
            status[`STATUS_SEQUENCE_BITS]        = sequence_q;
            status[`STATUS_STATE_BITS]           = state_q;
            status[`STATUS_FAULTS_BITS]          = fault_q;
            status[`STATUS_DATA_BITS]            = data_q;
            status[`STATUS_TRIGGER_COUNT_BITS]   = triggers_q;
            status[`STATUS_TIMESTAMP_TICKS_BITS] = timestamp_q;
            status[`STATUS_EMISSIONS_BITS]       = emissions_q;
            status[`STATUS_QUEUED_BITS]          = queued_q;
            status[`STATUS_CHUNKS_BITS]          = chunks_q;
            status[`STATUS_IGNORED_BITS]         = ignored_q;
        end
        if (look) for (place = 0; place < 32; place = place + 1)
            following = following | (status[8*place + 8 +: 8] & {8{turn_q[place]}});
    end

    always @* begin
        case (count_q)
            6'd32:   answer = ~crc[7:0];
            6'd33:   answer = ~crc[15:8];
            6'd34:   answer = ~crc[23:16];
            6'd35:   answer = ~crc[31:24];
            default: answer = in_snapshot ? next_q : echo_i ? last_q : 8'd0;
        endcase
    end

    always @(posedge clk_i) begin
        if (byte_valid_i) last_q <= byte_i;
        if (take_i && in_status) begin
            count_q <= count_q + 6'd1;
            turn_q  <= {turn_q[30:0], 1'b0};
            next_q  <= following;
        end
        selected_q <= select_i;
        if (select_i) begin
            count_q    <= 6'd0;
            next_q     <= SYNC[7:0];
            turn_q     <= 32'd1;
            {state_q, fault_q, ignored_q} <= {state_i, fault_i, ignored_i};
            {triggers_q, emissions_q}     <= {triggers_i, emissions_i};
            timestamp_q                   <= timestamp_i;
            {queued_q, chunks_q}          <= {queued_i, chunks_i};
        end
        if (selected_q) begin
            result_q   <= result_i;
            sequence_q <= sequence_i;
            data_q     <= data_i;
        end
        if (rst_i) begin
            selected_q <= 1'b0;
            result_q   <= 8'd0;
            sequence_q <= 8'd0;
            data_q     <= 32'd0;
            {state_q, fault_q, ignored_q} <= 48'd0;
            {triggers_q, emissions_q}     <= 64'd0;
            timestamp_q                   <= 64'd0;
            {queued_q, chunks_q}          <= 16'd0;
            count_q    <= 6'd0;
            turn_q     <= 32'd0;
            next_q     <= 8'd0;
            last_q     <= 8'd0;
        end
    end

    assign byte_o = answer;
endmodule

`default_nettype wire
