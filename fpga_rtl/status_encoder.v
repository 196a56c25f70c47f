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
    localparam [5:0]  BYTES = 6'd32;  // before the CRC
    localparam [15:0] SYNC  = `STATUS_SYNC;

    reg         selected_q;
    reg [7:0]   result_q, sequence_q;
    reg [31:0]  data_q;
    reg [191:0] snapshot_q;
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

    // byte n + 1 of the status at place n
    reg [255:0] status;

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
        if (look) status = {8'd0, snapshot_q[191:32], data_q, snapshot_q[31:0], sequence_q, result_q, SYNC[15:8]};
        if (look) for (place = 0; place < 32; place = place + 1)
            following = following | (status[8*place +: 8] & {8{turn_q[place]}});
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
            snapshot_q <= {ignored_i, chunks_i, queued_i, emissions_i, timestamp_i, triggers_i, fault_i, state_i};
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
            snapshot_q <= 192'd0;
            count_q    <= 6'd0;
            turn_q     <= 32'd0;
            next_q     <= 8'd0;
            last_q     <= 8'd0;
        end
    end

    assign byte_o = answer;
endmodule

`default_nettype wire
