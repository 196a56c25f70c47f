// The glide of all idle channels between 0 and their idle level: one bit stream whose density rises or falls
// linearly, made by second-order error feedback so that its noise lies above the driver's corner.
// Levels count to samples_i, which is full scale: no division, and the model does the same integers.
// Errors are kept within 1.5 full scales: near both ends one bit has no headroom, and the loop would ring.
`default_nettype none

module idle_ramp #(
    parameter SAMPLES_BITS = 18
) (
    input  wire                    clk_i,
    input  wire                    rst_i,
    input  wire                    up_i,         // gliding up: levels 1, 2 ... samples_i
    input  wire                    down_i,       // gliding down from wherever it is, to 0
    input  wire                    stay_i,       // armed: the level stays
    input  wire [15:0]             bit_ticks_i,  // at least 4
    input  wire [SAMPLES_BITS-1:0] samples_i,
    output wire                    bit_o,        // one clock after the tick it is for
    output wire                    done_o        // last tick of the glide
);
    localparam BITS = SAMPLES_BITS + 4;          // |level + 2 error - error| <= 5.5 full scales, with sign

    reg [15:0]             wait_q;               // ticks until the next sample
    reg [SAMPLES_BITS-1:0] level_q;
    reg signed [BITS-1:0]  base_q;               // level + 2 recent - older, as of the sample before
    reg signed [BITS-1:0]  value_q;
    reg signed [BITS-1:0]  recent_q, older_q;    // errors of the last two samples
    reg                    bit_q;
    reg                    fresh_q;              // value_q and bit_q are new

    wire active = up_i || down_i;
    wire sample = active && wait_q == 16'd0;
    wire done   = active && wait_q == 16'd1 && level_q == (up_i ? samples_i : {SAMPLES_BITS{1'b0}});

    wire signed [BITS-1:0] full_scale = $signed({4'd0, samples_i});
    wire signed [BITS-1:0] level      = $signed({4'd0, level_q});
    reg  signed [BITS-1:0] half, limit, value, error;
    always @* begin
        half  = {BITS{1'b0}};
        limit = {BITS{1'b0}};
        value = {BITS{1'b0}};
        error = {BITS{1'b0}};
        if (sample || fresh_q) begin
            half  = (full_scale + 1) >>> 1;
            limit = full_scale + (full_scale >>> 1);
            value = up_i ? base_q + 1 : base_q - 1;
            error = bit_q ? value_q - full_scale : value_q;
        end
    end

    always @(posedge clk_i) begin
        if (active) begin
            fresh_q <= sample;
            base_q  <= level + (recent_q <<< 1) - older_q;
            wait_q  <= sample ? bit_ticks_i - 16'd1 : wait_q - 16'd1;
            if (sample) begin
                level_q <= up_i ? level_q + 1'b1 : level_q - 1'b1;
                value_q <= value;
                bit_q   <= value >= half;
            end
            if (fresh_q) begin
                older_q  <= recent_q;
                recent_q <= error > limit ? limit : error < -limit ? -limit : error;
            end
            if (done) begin
                recent_q <= {BITS{1'b0}};
                older_q  <= {BITS{1'b0}};
                base_q   <= level;
            end
        end else begin
            wait_q   <= 16'd0;
            recent_q <= {BITS{1'b0}};
            older_q  <= {BITS{1'b0}};
            fresh_q  <= 1'b0;
            base_q   <= level;
            if (!stay_i) level_q <= {SAMPLES_BITS{1'b0}};
        end
        if (rst_i) begin
            wait_q   <= 16'd0;
            recent_q <= {BITS{1'b0}};
            older_q  <= {BITS{1'b0}};
            fresh_q  <= 1'b0;
            level_q  <= {SAMPLES_BITS{1'b0}};
            base_q  <= {BITS{1'b0}};
            value_q <= {BITS{1'b0}};
            bit_q   <= 1'b0;
        end
    end

    assign bit_o  = bit_q;
    assign done_o = done;
endmodule

`default_nettype wire
