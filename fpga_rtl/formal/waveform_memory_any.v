// In place of waveform_memory where a proof takes its words as they come: waveform_buffer_properties.vh says which are known.
`default_nettype none

module waveform_memory #(
    parameter BUFFERS = 5,
    parameter BUFFER_BITS = 3
) (
    input  wire                   clk_i,
    input  wire                   write_i,
    input  wire [BUFFER_BITS-1:0] write_buffer_i,
    input  wire [9:0]             write_word_i,
    input  wire [31:0]            write_data_i,
    input  wire                   read_i,
    input  wire [BUFFER_BITS-1:0] read_buffer_i,
    input  wire [8:0]             read_pair_i,
    output wire [31:0]            even_o,
    output wire [31:0]            odd_o
);
    (* anyseq *) reg [31:0] even, odd;
    assign even_o = even;
    assign odd_o  = odd;
endmodule

`default_nettype wire
