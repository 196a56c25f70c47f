// The register is what the textbook's long division gives, for every frame of any length: bit by bit, lowest bit of a byte
// first, into a register that shifts left, by the polynomial as it is printed, 0x04C11DB7. The
// division itself gives the check value that every catalogue of CRCs lists, of "123456789".
reg        started_q = 0;
reg [31:0] remainder_q;

function [31:0] divided(input [31:0] remainder, input [7:0] data);
    integer k;
    begin
        divided = remainder;
        for (k = 0; k < 8; k = k + 1)
            divided = (divided << 1) ^ ((divided[31] != data[k]) ? 32'h04C11DB7 : 32'd0);
    end
endfunction

function [31:0] reversed(input [31:0] value);
    integer k;
    for (k = 0; k < 32; k = k + 1) reversed[k] = value[31 - k];
endfunction

always @* if (!started_q) assume (rst_i);

wire [31:0] check = divided(divided(divided(divided(divided(divided(divided(divided(divided(32'hFFFFFFFF, "1"), "2"), "3"), "4"), "5"), "6"), "7"), "8"), "9");

always @(posedge clk_i) begin
    started_q <= 1;
    if (rst_i || clear_i) begin
        remainder_q <= 32'hFFFFFFFF;
    end else if (valid_i) begin
        remainder_q <= divided(remainder_q, byte_i);
    end
end

always @* if (started_q) begin
    divides:     assert (crc_o == reversed(remainder_q));
    check_value: assert (~reversed(check) == 32'hCBF43926);
end
