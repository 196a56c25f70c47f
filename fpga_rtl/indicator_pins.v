// The pads that tell, and drive nothing: no glitch of the logic before them; low at once without a clock.
`default_nettype none

module indicator_pins (
    input  wire clk_i,
    input  wire rst_i,
    input  wire clock_lost_i,
    input  wire waiting_i,
    input  wire fault_i,
    output wire waiting_o,
    output wire fault_o
);
    reg waiting_q, fault_q;

    always @(posedge clk_i or posedge clock_lost_i) begin
        if (clock_lost_i) begin
            waiting_q <= 1'b0;
            fault_q   <= 1'b0;
        end else begin
            waiting_q <= waiting_i && !rst_i;
            fault_q   <= fault_i && !rst_i;
        end
    end

    assign waiting_o = waiting_q;
    assign fault_o   = fault_q;
endmodule

`default_nettype wire
