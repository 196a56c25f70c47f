// SPI mode 0, most significant bit first: bytes in, bytes out, one chip-select assertion at a time.
// The shifters run on SCK itself, everything else on clk_i. MISO changes with the fall of SCK.
//
// Chip select falls 5 clocks or more before the first rise of SCK, rises 3 or more after the last, stays high 4 or
// more. What goes from one clock to the other, and why it is safe (formal/spi_crossing.sby proves it for SCK periods
// of one clock or more and a first flip-flop that takes either value when its input moves at the clock edge):
//   chip select      two flip-flops. Select_o comes two clocks after the pin, release_o three.
//   sck_reset_q      the asynchronous reset of all that SCK clocks: a flip-flop, so free of glitches. It ends within
//                    3 clocks of chip select's fall, two before the first rise of SCK, and comes back only after
//                    chip select's rise was seen, when SCK is silent. A chip select too short to be seen does
//                    nothing; SCK counts only while chip select is low as well, so noise between frames does nothing.
//   byte             held in landed_q for 8 SCK periods; count_q[3] changes with it and goes through two flip-flops.
//                    It is captured in the third clock after its last SCK rise, the fourth at most.
//   begun, part      one flip-flop each on SCK, two on clk_i; at rest for 3 clocks when chip select rises.
//   answer           byte k waits in the even or the odd register from 5 clocks at most after the end of byte k-2 till
//                    the fall of SCK between bytes k-1 and k, and is still there at the end of byte k.
// Answers are taken in this order: byte 0 the clock after select_o, byte 1 the clock after that, byte k the clock after
// byte_valid_o of byte k-2, which byte_o still shows. So two bytes are taken that are never sent.
`default_nettype none

module spi_peripheral (
    input  wire       clk_i,
    input  wire       rst_i,
    input  wire       spi_sck_i,
    input  wire       spi_cs_n_i,
    input  wire       spi_mosi_i,
    output wire       spi_miso_o,
    output wire       select_o,       // pulse: chip select fell
    output wire       stay_o,         // in the next clock it is low and was seen to have fallen, or release_o comes
    output wire       release_o,      // pulse: it rose, after one SCK edge at least and after the last byte
    output wire       partial_o,      // with release_o: bits left that make no byte
    output wire       byte_valid_o,   // pulse
    output wire [7:0] byte_o,         // holds until the next
    input  wire [7:0] answer_i,       // next byte to send
    output wire       answer_take_o   // pulse: taken
);
    // On SCK
    reg [3:0] count_q;                // rises in this frame
    reg       begun_q;                // one at least
    reg       part_q;                 // bits of a byte that is not whole
    reg [6:0] in_q;
    reg [7:0] landed_q;               // the last whole byte
    reg       miso_q;
    reg       launched_q;             // SCK has fallen: miso_q is valid

    // On clk_i
    reg       idle_q;                 // not within a chip-select assertion whose beginning was seen
    reg       sck_reset_q;            // the same, but low in reset: it rises then in simulation too, where only edges count
    reg       cs_n_meta_q, count_meta_q, begun_meta_q, part_meta_q;
    reg [1:0] cs_n_q;
    reg       count_sync_q, begun_sync_q, part_sync_q;
    reg       odd_q;                  // bytes captured in this frame, lowest bit
    reg       byte_valid_q;
    reg [7:0] byte_q;
    reg       release_q, partial_q;
    reg       take_first_q, take_second_q, take_next_q;
    reg [7:0] answer_even_q, answer_odd_q;

    wire [7:0] answer = count_q[3] ? answer_odd_q : answer_even_q;

    always @(posedge spi_sck_i or posedge sck_reset_q) begin
        if (sck_reset_q) begin
            count_q <= 4'd0;
            begun_q <= 1'b0;
            part_q  <= 1'b0;
        end else if (!spi_cs_n_i) begin
            count_q <= count_q + 4'd1;
            begun_q <= 1'b1;
            part_q  <= count_q[2:0] != 3'd7;
        end
    end

    always @(posedge spi_sck_i) begin
        in_q <= {in_q[5:0], spi_mosi_i};
        if (count_q[2:0] == 3'd7 && !spi_cs_n_i) landed_q <= {in_q, spi_mosi_i};
    end

    always @(negedge spi_sck_i or posedge sck_reset_q) begin
        if (sck_reset_q) begin
            miso_q     <= 1'b0;
            launched_q <= 1'b0;
        end else begin
            miso_q     <= answer[~count_q[2:0]];
            launched_q <= 1'b1;
        end
    end

    wire select = cs_n_q[1] && !cs_n_q[0];
    wire leave  = !idle_q && cs_n_q[0];
    wire idle   = (idle_q || leave) && !select;
    wire landed = !idle_q && count_sync_q != odd_q;

    always @(posedge clk_i) begin
        cs_n_meta_q  <= spi_cs_n_i;
        cs_n_q       <= {cs_n_q[0], cs_n_meta_q};
        count_meta_q <= count_q[3];
        begun_meta_q <= begun_q;
        part_meta_q  <= part_q;
        count_sync_q <= count_meta_q;
        begun_sync_q <= begun_meta_q;
        part_sync_q  <= part_meta_q;

        idle_q        <= idle;
        sck_reset_q   <= idle;
        byte_valid_q  <= landed;
        release_q     <= leave && begun_sync_q;
        partial_q     <= part_sync_q;
        take_first_q  <= select;
        take_second_q <= take_first_q;
        take_next_q   <= byte_valid_q;

        if (landed) begin
            byte_q <= landed_q;
            odd_q  <= !odd_q;
        end
        if (take_first_q || (take_next_q && odd_q))   answer_even_q <= answer_i;
        if (take_second_q || (take_next_q && !odd_q)) answer_odd_q  <= answer_i;
        if (leave) answer_even_q <= 8'd0;  // for MISO
        if (select) begin            // what these follow is still in reset
            count_meta_q <= 1'b0;
            begun_meta_q <= 1'b0;
            part_meta_q  <= 1'b0;
            count_sync_q <= 1'b0;
            begun_sync_q <= 1'b0;
            part_sync_q  <= 1'b0;
            odd_q        <= 1'b0;
        end

        if (rst_i) begin
            idle_q        <= 1'b1;
            sck_reset_q   <= 1'b0;
            cs_n_meta_q   <= 1'b0;   // a frame under way at reset is not one
            cs_n_q        <= 2'b00;
            count_meta_q  <= 1'b0;
            begun_meta_q  <= 1'b0;
            part_meta_q   <= 1'b0;
            count_sync_q  <= 1'b0;
            begun_sync_q  <= 1'b0;
            part_sync_q   <= 1'b0;
            odd_q         <= 1'b0;
            byte_valid_q  <= 1'b0;
            byte_q        <= 8'd0;
            release_q     <= 1'b0;
            partial_q     <= 1'b0;
            take_first_q  <= 1'b0;
            take_second_q <= 1'b0;
            take_next_q   <= 1'b0;
            answer_even_q <= 8'd0;
            answer_odd_q  <= 8'd0;
        end
    end

    assign spi_miso_o    = launched_q ? miso_q : answer_even_q[7];
    assign select_o      = select;
    assign stay_o        = !idle || (leave && begun_sync_q);
    assign release_o     = release_q;
    assign partial_o     = partial_q;
    assign byte_valid_o  = byte_valid_q;
    assign byte_o        = byte_q;
    assign answer_take_o = take_first_q || take_second_q || take_next_q;

`ifdef FORMAL
    `include "spi_crossing_properties.vh"
`endif
endmodule

`default_nettype wire
