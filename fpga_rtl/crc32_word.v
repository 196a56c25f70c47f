// CRC-32 as zlib computes it, one little-endian word of four bytes per clock.
`default_nettype none

module crc32_word (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        clear_i,  // before the first word
    input  wire        valid_i,
    input  wire [31:0] word_i,
    output wire [31:0] crc_o     // of the words so far
);
    reg [31:0] crc_q;

    function [31:0] following(input [31:0] crc);
        integer bit_number;
        begin
            following = crc;
            for (bit_number = 0; bit_number < 32; bit_number = bit_number + 1)
                following = {1'b0, following[31:1]} ^ (following[0] ? 32'hEDB88320 : 32'd0);
        end
    endfunction

    always @(posedge clk_i) begin
        if (valid_i) crc_q <= following(crc_q ^ word_i);
        if (clear_i || rst_i) crc_q <= 32'hFFFFFFFF;
    end

    assign crc_o = ~crc_q;
endmodule

`default_nettype wire
