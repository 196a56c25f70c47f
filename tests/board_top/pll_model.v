// An FPGA's PLL for simulation: its output from the period of its input that it measures, with feedback from the output.
// It locks after LOCK_EDGES periods, if phase detector and VCO are within their ranges, and stops, as the worst that a PLL may do,
// when its input does; LOCK falls LOST periods later, or, with +lock_stays, never. With +clk_stops it is the PLL that stops, under
// its lock; with +lock_blinks its LOCK is lost once, for a nanosecond, between edges of the output.
`default_nettype none
`timescale 1ps / 1ps

module pll_model #(
    parameter DIVIDE = 1, parameter MULTIPLY = 1, parameter VCO_DIVIDE = 1,     // out = in * MULTIPLY / DIVIDE = VCO / VCO_DIVIDE
    parameter PFD_PS_MIN = 1, parameter PFD_PS_MAX = 1, parameter VCO_PS_MIN = 1, parameter VCO_PS_MAX = 1
) (
    input  wire in,
    output reg  out,
    output reg  lock
);
    localparam LOCK_EDGES = 16, LOST = 4;

    integer edges = 0, period_ps = 0, half_ps, vco_ps;
    reg     blinked = 1'b0;
    time    last_ps = 0;
    wire    in_range = period_ps * DIVIDE <= PFD_PS_MAX && period_ps * DIVIDE >= PFD_PS_MIN
                       && vco_ps >= VCO_PS_MIN && vco_ps <= VCO_PS_MAX;

    initial begin
        out  = 1'b0;
        lock = 1'b0;
    end

    always @(posedge in) begin
        period_ps = $time - last_ps;
        last_ps   = $time;
        half_ps   = period_ps * DIVIDE / MULTIPLY / 2;
        vco_ps    = period_ps * DIVIDE / MULTIPLY / VCO_DIVIDE;
        edges     = in_range ? edges + 1 : 0;
    end

    always begin
        if (edges > LOCK_EDGES && $time - last_ps <= 2 * period_ps && !$test$plusargs("clk_stops")) begin
            lock = 1'b1;
            if (!blinked && $test$plusargs("lock_blinks")) begin
                blinked = 1'b1;
                #1_000 lock = 1'b0;
                #1_000 lock = 1'b1;
                #(half_ps - 2_000) out = !out;
            end else #half_ps out = !out;
        end else if (lock && $time - last_ps > LOST * period_ps && edges != 0) begin
            lock  = $test$plusargs("lock_stays") != 0;
            edges = 0;
        end else #(lock && in_range ? period_ps : 1_000);
    end
endmodule

`default_nettype wire
