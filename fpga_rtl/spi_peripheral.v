// SPI mode 0, most significant bit first, oversampled: bytes in, bytes out, one chip-select assertion at a time.
// SCK up to a sixth of the clock. The next bit of MISO is launched on the detected RISING edge of SCK, three to
// four clocks after the pin: the controller has sampled the bit before by then and finds the next a period later.
// Chip select falls at least 5 clocks before the first SCK edge and stays high at least 4 clocks between frames.
`default_nettype none

module spi_peripheral (
    input  wire       clk_i,
    input  wire       rst_i,
    input  wire       spi_sck_i,
    input  wire       spi_cs_n_i,
    input  wire       spi_mosi_i,
    output wire       spi_miso_o,
    output wire       select_o,       // pulse: chip select fell
    output wire       release_o,      // pulse: it rose, after one SCK edge at least and after the last byte
    output wire       partial_o,      // with release_o: bits left that make no byte
    output wire       byte_valid_o,   // pulse
    output wire [7:0] byte_o,
    input  wire [7:0] answer_i,       // next byte to send
    output wire       answer_take_o   // pulse: taken
);
    reg [2:0] sck_q;
    reg [2:0] cs_n_q;
    reg [1:0] mosi_q;
    reg       active_q;      // within a chip-select assertion whose beginning was seen
    reg       edge_seen_q;
    reg       select_q;
    reg       release_q;
    reg       byte_valid_q;
    reg [2:0] bit_q;         // bits of the byte so far
    reg [7:0] in_q;
    reg [7:0] out_q;

    wire select  = cs_n_q[2] && !cs_n_q[1];
    wire leave   = active_q && cs_n_q[1];
    wire rise    = active_q && !cs_n_q[1] && sck_q[1] && !sck_q[2];
    wire take    = select_q || (rise && bit_q == 3'd7);

    always @(posedge clk_i) begin
        sck_q  <= {sck_q[1:0], spi_sck_i};
        cs_n_q <= {cs_n_q[1:0], spi_cs_n_i};
        mosi_q <= {mosi_q[0], spi_mosi_i};

        select_q     <= select;
        release_q    <= leave && edge_seen_q;
        byte_valid_q <= rise && bit_q == 3'd7;

        if (rise) begin
            in_q        <= {in_q[6:0], mosi_q[1]};
            bit_q       <= bit_q + 3'd1;
            edge_seen_q <= 1'b1;
            out_q       <= {out_q[6:0], 1'b0};
        end
        if (take) out_q <= answer_i;
        if (leave) begin
            active_q <= 1'b0;
            out_q    <= 8'd0;
        end
        if (select) begin
            active_q    <= 1'b1;
            edge_seen_q <= 1'b0;
            bit_q       <= 3'd0;
        end

        if (rst_i) begin
            sck_q        <= 3'b000;
            cs_n_q       <= 3'b000;  // a frame under way at reset is not one
            mosi_q       <= 2'b00;
            active_q     <= 1'b0;
            edge_seen_q  <= 1'b0;
            select_q     <= 1'b0;
            release_q    <= 1'b0;
            byte_valid_q <= 1'b0;
            bit_q        <= 3'd0;
            in_q         <= 8'd0;
            out_q        <= 8'd0;
        end
    end

    assign spi_miso_o    = out_q[7];
    assign select_o      = select;
    assign release_o     = release_q;
    assign partial_o     = bit_q != 3'd0;
    assign byte_valid_o  = byte_valid_q;
    assign byte_o        = in_q;
    assign answer_take_o = take;
endmodule

`default_nettype wire
