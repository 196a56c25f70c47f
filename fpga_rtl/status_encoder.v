// The answer to every frame: a snapshot taken as it begins, its CRC, then zeros; behind a TEST what it brought,
// two bytes later.
`default_nettype none
`include "registers.vh"

module status_encoder (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        select_i,     // pulse: take the snapshot
    input  wire        take_i,       // pulse: byte_o was taken
    output wire [7:0]  byte_o,
    input  wire [7:0]  result_i,
    input  wire [7:0]  sequence_i,
    input  wire [15:0] state_i,
    input  wire [15:0] fault_i,
    input  wire [31:0] data_i,
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
    localparam BYTES = 32;           // before the CRC

    reg [8*BYTES-1:0] left_q;        // bytes to come, next one lowest
    reg [5:0]         count_q;       // bytes taken, held at 36
    reg [7:0]         last_q;        // byte that came in last

    wire in_snapshot = count_q < BYTES[5:0];
    wire in_status   = count_q < BYTES[5:0] + 6'd4;
    wire [31:0] crc;
    reg  [7:0]  next;

    crc32 crc32_status (
        .clk_i(clk_i), .rst_i(rst_i), .clear_i(select_i),
        .valid_i(take_i && in_snapshot), .byte_i(next), .crc_o(crc)
    );

    always @* begin
        case (count_q)
            6'd32:   next = ~crc[7:0];
            6'd33:   next = ~crc[15:8];
            6'd34:   next = ~crc[23:16];
            6'd35:   next = ~crc[31:24];
            default: next = in_snapshot ? left_q[7:0] : echo_i ? last_q : 8'd0;
        endcase
    end

    always @(posedge clk_i) begin
        if (byte_valid_i) last_q <= byte_i;
        if (take_i && in_status) begin
            count_q <= count_q + 6'd1;
            left_q  <= {8'd0, left_q[8*BYTES-1:8]};
        end
        if (select_i) begin
            count_q <= 6'd0;
            left_q  <= {ignored_i, chunks_i, queued_i, emissions_i, timestamp_i, triggers_i, data_i, fault_i, state_i,
                        sequence_i, result_i, `STATUS_SYNC};
        end
        if (rst_i) begin
            count_q <= 6'd0;
            left_q  <= {8*BYTES{1'b0}};
            last_q  <= 8'd0;
        end
    end

    assign byte_o = next;
endmodule

`default_nettype wire
