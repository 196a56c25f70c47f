// Words in block memory: one is written and one is read in a clock; what was read stays until the next read.
`default_nettype none

module memory_block #(
    parameter ADDRESS_BITS = 9,
    parameter WORDS = 512
) (
    input  wire                    clk_i,
    input  wire                    write_i,
    input  wire [ADDRESS_BITS-1:0] write_address_i,
    input  wire [31:0]             write_data_i,
    input  wire                    read_i,
    input  wire [ADDRESS_BITS-1:0] read_address_i,
    output wire [31:0]             read_data_o      // a clock later
);
    (* no_rw_check *)                   // nothing is read while it is written
    reg [31:0] memory [0:WORDS-1];
    reg [31:0] data_q;

    always @(posedge clk_i) begin
        if (write_i) memory[write_address_i] <= write_data_i;
        if (read_i)  data_q <= memory[read_address_i];
    end

    assign read_data_o = data_q;
endmodule

`default_nettype wire
