// What a link's next status says of its frames: the result of the last, the number of the last accepted one, the value of the last
// READ. Everything comes a clock after the frame has ended, and the encoder of the answer takes it a clock after a frame begins.
`default_nettype none
`include "registers.vh"

module link_reply (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        done_i,          // pulse: a frame was accepted
    input  wire        read_i,          // with done_i: data_i is what it read
    input  wire [7:0]  result_i,
    input  wire [7:0]  sequence_i,
    input  wire [31:0] data_i,
    input  wire        refuse_i,        // pulse: a frame was refused; it comes a clock earlier than done_i would
    input  wire [7:0]  refusal_i,       // with refuse_i
    output wire [7:0]  result_o,
    output wire [7:0]  sequence_o,
    output wire [31:0] data_o
);
    reg        refused_q;
    reg [7:0]  refusal_q, result_q, sequence_q;
    reg [31:0] data_q;

    always @(posedge clk_i) begin
        refused_q <= refuse_i;
        if (refuse_i) refusal_q <= refusal_i;
        if (done_i) begin
            result_q   <= result_i;
            sequence_q <= sequence_i;
            if (read_i) data_q <= data_i;
        end
        if (refused_q) result_q <= refusal_q;
        if (rst_i) begin
            refused_q  <= 1'b0;
            refusal_q  <= `RESULT_OK;
            result_q   <= `RESULT_OK;
            sequence_q <= 8'd0;
            data_q     <= 32'd0;
        end
    end

    assign result_o   = result_q;
    assign sequence_o = sequence_q;
    assign data_o     = data_q;
endmodule

`default_nettype wire
