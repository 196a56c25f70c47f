// Clocks since reset, and when the permits changed last.
`default_nettype none

module tick_counter (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire [1:0]  permits_i,       // behind their synchronisers
    output wire [63:0] now_o,
    output wire [63:0] change_time_o
);
    reg [63:0] now_q, change_time_q;
    reg [1:0]  permits_q;

    always @(posedge clk_i) begin
        now_q     <= now_q + 64'd1;
        permits_q <= permits_i;
        if (permits_q != permits_i) change_time_q <= now_q;
        if (rst_i) begin
            now_q         <= 64'd0;
            permits_q     <= 2'b00;
            change_time_q <= 64'd0;
        end
    end

    assign now_o         = now_q;
    assign change_time_o = change_time_q;
endmodule

`default_nettype wire
