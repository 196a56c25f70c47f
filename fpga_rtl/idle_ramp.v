// The glide of all idle channels between 0 and their idle level: one bit stream whose density rises or falls
// linearly, made by second-order error feedback so that its noise lies above the driver's corner.
// Levels count to samples_i, which is full scale: no division, and the model does the same integers.
// Errors are kept within 1.5 full scales: near both ends one bit has no headroom, and the loop would ring.
// With F full scale, half = (F + 1) >> 1: value = level + 2 recent - older; bit = value >= half; error = value - bit F, kept within
// F + (F >> 1). What is held are value - half, whose sign is the bit, and error - (F >> 1) - 1: then what is compared and put in for an
// error beyond its bounds are bits of F, and no sums. One addition a clock, in the four clocks that a sample lasts at least.
`default_nettype none

module idle_ramp #(
    parameter SAMPLES_BITS = 18
) (
    input  wire                    clk_i,
    input  wire                    rst_i,
    input  wire                    up_i,         // gliding up: levels 1, 2 ... samples_i
    input  wire                    down_i,       // gliding down from wherever it is, to 0
    input  wire                    stay_i,       // armed: the level stays, and so does samples_i
    input  wire [15:0]             bit_ticks_i,  // at least 4
    input  wire [SAMPLES_BITS-1:0] samples_i,    // at least 1
    output wire                    bit_o,        // two clocks after the tick it is for
    output wire                    done_o        // last tick of the glide
);
    localparam ERROR_BITS = SAMPLES_BITS + 2;    // -2 F - 1 to F - 1
    localparam VALUE_BITS = SAMPLES_BITS + 4;    // within 5.5 F, with sign

    reg [15:0]             tick_q;               // of this sample, from 2
    reg                    last_q;               // its last: as for the others named so, known a clock early
    reg                    top_q, bottom_q;      // level_q is there
    reg [2:0]              step_q;               // clocks since the sample began: 1, 2, 3
    reg                    active_q;
    reg [SAMPLES_BITS-1:0] level_q;
    reg [VALUE_BITS-1:0]   base_q;               // 2 recent - older
    reg [VALUE_BITS-1:0]   value_q;              // less half
    reg                    beyond_q;             // its error is out of bounds
    reg [ERROR_BITS-1:0]   recent_q, older_q;    // errors of the last two samples, less (F >> 1) + 1

    wire active = up_i || down_i;
    wire sample = active && tick_q == 16'd2;
    wire done   = active && last_q && (up_i ? top_q : bottom_q);

    wire                    negative = value_q[VALUE_BITS-1];
    wire                    odd      = samples_i[0];
    wire [SAMPLES_BITS-2:0] halved   = samples_i[SAMPLES_BITS-1:1];
    wire [ERROR_BITS-1:0]   no_error = {3'b111, ~halved};
    wire [VALUE_BITS-1:0]   twice    = {recent_q[ERROR_BITS-1], recent_q, 1'b0};
    wire [VALUE_BITS-1:0]   older    = {{2{older_q[ERROR_BITS-1]}}, older_q};
    wire [VALUE_BITS-1:0]   value;                                                              // what next to them is unused carries in
    wire [ERROR_BITS-1:0]   error;
    wire                    unused_value, unused_error;
    assign {value, unused_value} = {base_q, 1'b1} + {4'd0, level_q, !odd};
    wire [VALUE_BITS-1:0]   bound    = negative ? {3'd0, samples_i, 1'b0} : ~{3'd0, halved, 1'b0, odd};
    wire [VALUE_BITS-1:0]   excess   = value_q + bound;                                         // has its sign: beyond
    wire [ERROR_BITS-1:0]   minuend  = !beyond_q ? value_q[ERROR_BITS-1:0] : {2'd0, negative ? {SAMPLES_BITS-1{1'b0}} : halved, 1'b0};
    wire [ERROR_BITS-1:0]   less     = negative ? (beyond_q ? ~{1'b0, samples_i, 1'b0} : {ERROR_BITS{1'b1}})
                                                : (beyond_q ? {ERROR_BITS{1'b1}} : ~{2'd0, samples_i});
    assign {error, unused_error} = {minuend, 1'b1} + {less, odd};
    wire                    fresh    = !active || done;

    always @(posedge clk_i) begin
        active_q <= active;
        if (active || active_q || !stay_i) begin
            tick_q   <= last_q || !active ? 16'd2 : tick_q + 16'd1;
            last_q   <= active && tick_q == bit_ticks_i;
            top_q    <= level_q == samples_i;
            bottom_q <= level_q == {SAMPLES_BITS{1'b0}};
            step_q   <= fresh ? 3'b000 : {step_q[1:0], sample};
            base_q   <= twice - older;
            if (sample)    level_q  <= level_q + {{SAMPLES_BITS-1{!up_i}}, 1'b1};
            if (step_q[0]) value_q  <= value;
            if (step_q[1]) beyond_q <= excess[VALUE_BITS-1] == negative;
            if (fresh || step_q[2]) begin
                recent_q <= fresh ? no_error : error;
                older_q  <= fresh ? no_error : recent_q;
            end
            if (!active && !stay_i) level_q <= {SAMPLES_BITS{1'b0}};
        end
        if (rst_i) begin
            active_q <= 1'b1;                    // so that the errors come to be those of samples_i
            tick_q   <= 16'd2;
            last_q   <= 1'b0;
            top_q    <= 1'b0;
            bottom_q <= 1'b0;
            step_q   <= 3'b000;
            level_q  <= {SAMPLES_BITS{1'b0}};
            value_q  <= {VALUE_BITS{1'b1}};
            beyond_q <= 1'b0;
        end
    end

    assign bit_o  = !negative;
    assign done_o = done;
`ifdef FORMAL
    `include "idle_ramp_properties.vh"
`endif
endmodule

`default_nettype wire
