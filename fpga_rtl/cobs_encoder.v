// One message of BYTES (1 to 126) bytes as COBS and a zero: taken one byte a clock, encoded where it lies, handed on
// as fast as it is taken. A zero's place gets the code of the block that it begins, when the next zero or the end is known;
// so each byte taken costs one write: itself, or at a zero the code of the block that ends there.
`default_nettype none

module cobs_encoder #(
    parameter [31:0] BYTES = 32'd36
) (
    input  wire       clk_i,
    input  wire       rst_i,
    input  wire       start_i,  // pulse: take a message from the next clock on; without effect while one is on its way
    input  wire [7:0] byte_i,
    output wire       take_o,   // pulse: byte_i is taken
    output wire       valid_o,
    output wire [7:0] byte_o,
    input  wire       ready_i   // with valid_o: taken
);
    localparam BITS = $clog2(BYTES + 32'd2);
    localparam [31:0] END = BYTES + 32'd1;  // a code before the bytes

    reg [7:0]      buffer_q [0:(1<<BITS)-1];
    reg [BITS-1:0] place_q;    // of the byte to take, from 1 on, or to hand on, from 0 on
    reg [BITS-1:0] code_q;     // place of the code of the block that is open
    reg            taking_q;
    reg            sending_q;
    reg            valid_q;    // a byte waits to be handed on
    reg            last_q;     // it is the zero
    reg [7:0]      out_q;

    wire at_end     = place_q == END[BITS-1:0];
    wire block_ends = at_end || byte_i == 8'd0;
    wire fetch      = sending_q && (!valid_q || ready_i);
    wire [BITS-1:0] code = place_q - code_q;

    always @(posedge clk_i) begin
        if (taking_q) buffer_q[block_ends ? code_q : place_q] <= block_ends ? {{8-BITS{1'b0}}, code} : byte_i;
        if (fetch) out_q <= buffer_q[place_q];
    end

    always @(posedge clk_i) begin
        if (taking_q) begin
            place_q <= place_q + 1'b1;
            if (block_ends) code_q <= place_q;
            if (at_end) begin
                place_q   <= {BITS{1'b0}};
                taking_q  <= 1'b0;
                sending_q <= 1'b1;
            end
        end else if (fetch) begin
            place_q <= place_q + 1'b1;
            valid_q <= !last_q;
            last_q  <= at_end;
            if (last_q) begin
                last_q    <= 1'b0;
                sending_q <= 1'b0;
            end
        end else if (start_i && !sending_q) begin
            taking_q <= 1'b1;
            place_q  <= {{BITS-1{1'b0}}, 1'b1};
            code_q   <= {BITS{1'b0}};
        end

        if (rst_i) begin
            place_q   <= {BITS{1'b0}};
            code_q    <= {BITS{1'b0}};
            taking_q  <= 1'b0;
            sending_q <= 1'b0;
            valid_q   <= 1'b0;
            last_q    <= 1'b0;
        end
    end

    assign take_o  = taking_q && !at_end;
    assign valid_o = valid_q;
    assign byte_o  = last_q ? 8'd0 : out_q;
endmodule

`default_nettype wire
