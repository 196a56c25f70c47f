// UART bytes out, 8N1, one behind the other without a gap as long as valid_i is high when ready_o is.
// BIT_TICKS_256 is the length of a bit in 256ths of a clock; the fraction carries from bit to bit and byte to byte.
`default_nettype none

module uart_transmitter #(
    parameter [31:0] BIT_TICKS_256 = 32'd2048
) (
    input  wire       clk_i,
    input  wire       rst_i,
    input  wire       valid_i,
    input  wire [7:0] byte_i,
    output wire       ready_o,   // with valid_i: taken
    output wire       uart_tx_o
);
    localparam BITS = $clog2(BIT_TICKS_256 + 32'd1);
    localparam [31:0] NEXT = BIT_TICKS_256 - 32'd256;

    reg [9:0]      shift_q;  // what is to come, on the pin the lowest; ones are the line at rest
    reg [3:0]      left_q;   // bits of it
    reg [BITS-1:0] timer_q;  // to the next bit, in 256ths of a clock; below 256 at rest

    wire due   = timer_q[BITS-1:8] == 0;
    wire ready = left_q == 4'd0 || (left_q == 4'd1 && due);

    always @(posedge clk_i) begin
        if (ready) begin
            left_q  <= valid_i ? 4'd10 : 4'd0;
            shift_q <= valid_i ? {1'b1, byte_i, 1'b0} : 10'h3FF;
            if (valid_i) timer_q <= timer_q + NEXT[BITS-1:0];
        end else if (!due) begin
            timer_q[BITS-1:8] <= timer_q[BITS-1:8] - 1'b1;
        end else begin
            left_q  <= left_q - 4'd1;
            shift_q <= {1'b1, shift_q[9:1]};
            timer_q <= timer_q + NEXT[BITS-1:0];
        end

        if (rst_i) begin
            left_q  <= 4'd0;
            shift_q <= 10'h3FF;
            timer_q <= {BITS{1'b0}};
        end
    end

    assign ready_o   = ready;
    assign uart_tx_o = shift_q[0];
endmodule

`default_nettype wire
