// Frames from a stream of COBS bytes: zero ends a frame, every other byte is a code (how far the next zero of the
// frame is) or data. Up to the first zero after reset nothing counts; zeros in a row hold no frames between them.
`default_nettype none

module cobs_decoder (
    input  wire       clk_i,
    input  wire       rst_i,
    input  wire       byte_valid_i,  // pulse
    input  wire [7:0] byte_i,
    input  wire       error_i,       // with byte_valid_i: it came damaged; as a zero, the line's break, it ends a frame too
    output wire       select_o,      // pulse: a frame begins
    output wire       release_o,     // pulse: it has ended
    output wire       partial_o,     // with release_o: it ended within a block, or a byte of it was damaged
    output wire       byte_valid_o,  // pulse
    output wire [7:0] byte_o
);
    reg       synced_q;      // a zero was seen since reset
    reg       open_q;        // within a frame
    reg       damaged_q;
    reg       zero_q;        // the block stands for a zero at its end, unless the frame ends there
    reg [7:0] left_q;        // data bytes left in the block
    reg       select_q;
    reg       release_q;
    reg       partial_q;
    reg       byte_valid_q;
    reg [7:0] byte_q;

    wire in_block = open_q && left_q != 8'd0;

    always @(posedge clk_i) begin
        select_q     <= 1'b0;
        release_q    <= 1'b0;
        byte_valid_q <= 1'b0;

        if (byte_valid_i && byte_i == 8'd0) begin
            synced_q  <= 1'b1;
            open_q    <= 1'b0;
            release_q <= open_q;
            partial_q <= in_block || damaged_q || error_i;
        end else if (byte_valid_i && synced_q) begin
            open_q       <= 1'b1;
            select_q     <= !open_q;
            damaged_q    <= (open_q && damaged_q) || error_i;
            byte_valid_q <= in_block || (open_q && zero_q);
            byte_q       <= in_block ? byte_i : 8'd0;
            left_q       <= (in_block ? left_q : byte_i) - 8'd1;
            if (!in_block) zero_q <= byte_i != 8'hFF;
        end

        if (rst_i) begin
            synced_q     <= 1'b0;
            open_q       <= 1'b0;
            damaged_q    <= 1'b0;
            zero_q       <= 1'b0;
            left_q       <= 8'd0;
            select_q     <= 1'b0;
            release_q    <= 1'b0;
            partial_q    <= 1'b0;
            byte_valid_q <= 1'b0;
            byte_q       <= 8'd0;
        end
    end

    assign select_o     = select_q;
    assign release_o    = release_q;
    assign partial_o    = partial_q;
    assign byte_valid_o = byte_valid_q;
    assign byte_o       = byte_q;
endmodule

`default_nettype wire
