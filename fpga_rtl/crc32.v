// CRC-32 as zlib computes it, one byte per clock.
`default_nettype none

module crc32 (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        clear_i,  // before the first byte
    input  wire        valid_i,
    input  wire [7:0]  byte_i,
    output wire [31:0] crc_o     // inverted, the CRC of the bytes so far
);
    reg [31:0] crc_q;

    function [31:0] following(input [31:0] crc, input [7:0] data);
        integer bit_number;
        begin
            following = crc ^ {24'd0, data};
            for (bit_number = 0; bit_number < 8; bit_number = bit_number + 1)
                following = {1'b0, following[31:1]} ^ (following[0] ? 32'hEDB88320 : 32'd0);
        end
    endfunction

    always @(posedge clk_i) begin
        if (valid_i) crc_q <= following(crc_q, byte_i);
        if (clear_i || rst_i) crc_q <= 32'hFFFFFFFF;
    end

    assign crc_o = crc_q;

`ifdef FORMAL
    `include "crc32_properties.vh"
`endif
endmodule

`default_nettype wire
