// Triggers: edges of the pin that last, and commands. The pin has no clock: it passes two flip-flops, and counts once it has been
// high for FILTER_TICKS, after it was low as long.
`default_nettype none

module trigger_input (
    input  wire clk_i,
    input  wire rst_i,
    input  wire trigger_i,   // the pin
    input  wire command_i,   // pulse
    output wire level_o,     // of the pin, behind two flip-flops
    output wire trigger_o    // pulse
);
    reg [3:0] trigger_q;     // pin, older samples higher
    reg       triggered_q;   // it was high for long, and has not been low for long since
    reg       command_q;

    wire high = trigger_q[3:1] == 3'b111;
    wire low  = trigger_q[3:1] == 3'b000;

    always @(posedge clk_i) begin
        trigger_q   <= {trigger_q[2:0], trigger_i};
        triggered_q <= high || (triggered_q && !low);
        command_q   <= command_i;
        if (rst_i) begin
            trigger_q   <= 4'b1111;   // high at reset is no edge
            triggered_q <= 1'b1;
            command_q   <= 1'b0;
        end
    end

    assign level_o   = trigger_q[1];
    assign trigger_o = (high && !triggered_q) || command_q;

`ifdef FORMAL
    `include "trigger_input_properties.vh"
`endif
endmodule

`default_nettype wire
