// UART bytes in, 8N1: a start bit counts if the line is still low in its middle, every bit is sampled in its middle.
// BIT_TICKS_256 is the length of a bit in 256ths of a clock, at least 8 clocks; the fraction carries from bit to bit.
`default_nettype none

module uart_receiver #(
    parameter [31:0] BIT_TICKS_256 = 32'd2048
) (
    input  wire       clk_i,
    input  wire       rst_i,
    input  wire       uart_rx_i,
    output wire       byte_valid_o,  // pulse, in the middle of the stop bit
    output wire [7:0] byte_o,
    output wire       error_o        // with byte_valid_o: the stop bit was low; the next byte begins after the line was high
);
    localparam BITS = $clog2(BIT_TICKS_256 + 32'd1);
    localparam [31:0] HALF = BIT_TICKS_256 / 2 - 32'd256;  // from the clock after a fall to the middle of the start bit
    localparam [31:0] NEXT = BIT_TICKS_256 - 32'd256;

    reg [1:0]      rx_q;
    reg            high_q;   // the line as it was a clock ago; low after reset and after an error
    reg            busy_q;
    reg            valid_q;
    reg            error_q;
    reg [3:0]      bit_q;    // 0: start bit, 9: stop bit
    reg [7:0]      byte_q;
    reg [BITS-1:0] timer_q;  // to the next sample, in 256ths of a clock

    wire rx  = rx_q[1];
    wire due = timer_q[BITS-1:8] == 0;

    always @(posedge clk_i) begin
        rx_q    <= {rx_q[0], uart_rx_i};
        valid_q <= 1'b0;

        if (!busy_q) begin
            high_q <= rx;
            if (high_q && !rx) begin
                busy_q  <= 1'b1;
                bit_q   <= 4'd0;
                timer_q <= HALF[BITS-1:0];
            end
        end else if (!due) begin
            timer_q[BITS-1:8] <= timer_q[BITS-1:8] - 1'b1;
        end else begin
            timer_q <= timer_q + NEXT[BITS-1:0];
            bit_q   <= bit_q + 4'd1;
            high_q  <= rx;
            if (bit_q == 4'd0) begin
                busy_q <= !rx;       // a glitch is no start bit
            end else if (bit_q == 4'd9) begin
                busy_q  <= 1'b0;
                valid_q <= 1'b1;
                error_q <= !rx;
            end else begin
                byte_q <= {rx, byte_q[7:1]};
            end
        end

        if (rst_i) begin
            rx_q    <= 2'b00;
            high_q  <= 1'b0;         // a byte under way at reset is not one
            busy_q  <= 1'b0;
            valid_q <= 1'b0;
            error_q <= 1'b0;
            bit_q   <= 4'd0;
            byte_q  <= 8'd0;
            timer_q <= {BITS{1'b0}};
        end
    end

    assign byte_valid_o = valid_q;
    assign byte_o       = byte_q;
    assign error_o      = error_q;
endmodule

`default_nettype wire
