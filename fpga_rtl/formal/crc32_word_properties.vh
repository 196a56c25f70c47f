// The register is what the textbook's long division gives, for any number of words: bit by bit, lowest bit of a word first, into
// a register that shifts left, by the polynomial as it is printed, 0x04C11DB7. A word is 32 of its steps at once. A step is linear
// (shown here), so 32 are too: what they make of any value is the sum of what they make of its bits. These sums, from the long
// division of each bit by itself, are what the register takes.
reg          started_q = 0;
reg  [31:0]  expected_q;
(* anyseq *) reg [31:0] one, other;          // any two values
localparam [1023:0] SUMS = sums(0);          // row k: which bits have a share in bit k

function [31:0] divided(input [31:0] remainder, input bit_in);
    divided = (remainder << 1) ^ (remainder[31] != bit_in ? 32'h04C11DB7 : 32'd0);
endfunction

function [31:0] reversed(input [31:0] value);
    integer k;
    for (k = 0; k < 32; k = k + 1) reversed[k] = value[31 - k];
endfunction

function [1023:0] sums(input unused);
    integer    k, step;
    reg [31:0] remainder;
    for (k = 0; k < 32; k = k + 1) begin
        remainder = 32'd0;                   // the long division of a word of which only bit k is set
        for (step = 0; step < 32; step = step + 1) remainder = divided(remainder, step == k);
        remainder = reversed(remainder);
        for (step = 0; step < 32; step = step + 1) sums[32 * step + k] = remainder[step];
    end
endfunction

integer k;
always @* if (!started_q) assume (rst_i);

always @(posedge clk_i) begin
    started_q <= 1;
    if (rst_i || clear_i) expected_q <= 32'hFFFFFFFF;
    else if (valid_i) for (k = 0; k < 32; k = k + 1) expected_q[k] <= ^(SUMS[32 * k +: 32] & (~crc_o ^ word_i));
end

always @* if (started_q) begin
    divides:         assert (crc_o == ~expected_q);
    steps_are_linear: assert ((divided(one, 0) ^ divided(other, 0)) == divided(one ^ other, 0));
    // the bit that comes in counts like the highest of the register: a word may be added before its first step
    bits_come_in:    assert (divided(one, other[0]) == divided(one ^ {other[0], 31'd0}, 0));
end
