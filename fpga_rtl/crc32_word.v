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
    // Each bit of the register after a word is the parity of some bits of the register and the word: written so, it takes two
    // thirds of the logic that 32 shifts in a row do.
    localparam [1023:0] PARITIES = parities(32'hEDB88320);

    reg [31:0] crc_q;
    reg [31:0] next;

    function [1023:0] parities(input [31:0] polynomial);
        integer    from, shift, to;
        reg [31:0] image;
        for (from = 0; from < 32; from = from + 1) begin
            image = 32'd1 << from;
            for (shift = 0; shift < 32; shift = shift + 1) image = {1'b0, image[31:1]} ^ (image[0] ? polynomial : 32'd0);
            for (to = 0; to < 32; to = to + 1) parities[32 * to + from] = image[to];
        end
    endfunction

    always @* begin : parity
        integer to;
        next = 32'd0;
        to   = 0;
        if (valid_i) for (to = 0; to < 32; to = to + 1) next[to] = ^((crc_q ^ word_i) & PARITIES[32 * to +: 32]);
    end

    always @(posedge clk_i) begin
        if (valid_i) crc_q <= next;
        if (clear_i || rst_i) crc_q <= 32'hFFFFFFFF;
    end

    assign crc_o = ~crc_q;

`ifdef FORMAL
    `include "crc32_word_properties.vh"
`endif
endmodule

`default_nettype wire
