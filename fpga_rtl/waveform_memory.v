// The words of all waveform buffers in two banks, of even and of odd words: a read brings the two of a pair, a clock later.
// As many words as a power of two need no multiplexer behind their blocks: the buffers beyond have blocks of their own.
`default_nettype none

module waveform_memory #(
    parameter BUFFERS = 5,              // 2 or more
    parameter BUFFER_BITS = 3           // enough for them
) (
    input  wire                   clk_i,
    input  wire                   write_i,
    input  wire [BUFFER_BITS-1:0] write_buffer_i,
    input  wire [9:0]             write_word_i,
    input  wire [31:0]            write_data_i,
    input  wire                   read_i,
    input  wire [BUFFER_BITS-1:0] read_buffer_i,
    input  wire [8:0]             read_pair_i,    // words 2 n and 2 n + 1
    output wire [31:0]            even_o,         // until the next read
    output wire [31:0]            odd_o
);
    localparam MAIN_BITS   = $clog2(BUFFERS + 1) - 1;
    localparam MAIN        = 1 << MAIN_BITS;      // buffers: the largest power of two
    localparam BEYOND      = BUFFERS - MAIN;
    localparam BEYOND_BITS = BEYOND > 1 ? $clog2(BEYOND) : 0;

    wire        write_even = write_i && !write_word_i[0];
    wire        write_odd  = write_i && write_word_i[0];
    wire [31:0] main_even, main_odd;

    generate
        if (BEYOND == 0) begin : all_in_main
            memory_block #(.ADDRESS_BITS(MAIN_BITS + 9), .WORDS(512 * MAIN)) even (
                .clk_i(clk_i), .write_i(write_even), .write_address_i({write_buffer_i, write_word_i[9:1]}), .write_data_i(write_data_i),
                .read_i(read_i), .read_address_i({read_buffer_i, read_pair_i}), .read_data_o(main_even)
            );
            memory_block #(.ADDRESS_BITS(MAIN_BITS + 9), .WORDS(512 * MAIN)) odd (
                .clk_i(clk_i), .write_i(write_odd), .write_address_i({write_buffer_i, write_word_i[9:1]}), .write_data_i(write_data_i),
                .read_i(read_i), .read_address_i({read_buffer_i, read_pair_i}), .read_data_o(main_odd)
            );
            assign even_o = main_even;
            assign odd_o  = main_odd;
        end else begin : some_beyond
            wire        write_beyond = write_buffer_i >= MAIN[BUFFER_BITS-1:0];
            wire        read_beyond  = read_buffer_i >= MAIN[BUFFER_BITS-1:0];
            wire [31:0] beyond_even, beyond_odd;
            reg         beyond_q;
            wire [MAIN_BITS+8:0]   write_main = {write_buffer_i[MAIN_BITS-1:0], write_word_i[9:1]};
            wire [MAIN_BITS+8:0]   read_main  = {read_buffer_i[MAIN_BITS-1:0], read_pair_i};
            wire [BEYOND_BITS+8:0] write_rest = write_main[BEYOND_BITS+8:0];
            wire [BEYOND_BITS+8:0] read_rest  = read_main[BEYOND_BITS+8:0];

            memory_block #(.ADDRESS_BITS(MAIN_BITS + 9), .WORDS(512 * MAIN)) even (
                .clk_i(clk_i), .write_i(write_even && !write_beyond), .write_address_i(write_main), .write_data_i(write_data_i),
                .read_i(read_i && !read_beyond), .read_address_i(read_main), .read_data_o(main_even)
            );
            memory_block #(.ADDRESS_BITS(MAIN_BITS + 9), .WORDS(512 * MAIN)) odd (
                .clk_i(clk_i), .write_i(write_odd && !write_beyond), .write_address_i(write_main), .write_data_i(write_data_i),
                .read_i(read_i && !read_beyond), .read_address_i(read_main), .read_data_o(main_odd)
            );
            memory_block #(.ADDRESS_BITS(BEYOND_BITS + 9), .WORDS(512 * BEYOND)) even_beyond (
                .clk_i(clk_i), .write_i(write_even && write_beyond), .write_address_i(write_rest), .write_data_i(write_data_i),
                .read_i(read_i && read_beyond), .read_address_i(read_rest), .read_data_o(beyond_even)
            );
            memory_block #(.ADDRESS_BITS(BEYOND_BITS + 9), .WORDS(512 * BEYOND)) odd_beyond (
                .clk_i(clk_i), .write_i(write_odd && write_beyond), .write_address_i(write_rest), .write_data_i(write_data_i),
                .read_i(read_i && read_beyond), .read_address_i(read_rest), .read_data_o(beyond_odd)
            );

            always @(posedge clk_i) if (read_i) beyond_q <= read_beyond;
            assign even_o = beyond_q ? beyond_even : main_even;
            assign odd_o  = beyond_q ? beyond_odd : main_odd;
        end
    endgenerate
`ifdef FORMAL
    `include "waveform_memory_properties.vh"
`endif
endmodule

`default_nettype wire
