// Memory of one waveform buffer: written by uploads, read by whoever is given the address, two clocks later.
`default_nettype none

module buffer_memory (
    input  wire        clk_i,
    input  wire        write_i,
    input  wire        here_i,             // what is written is this buffer's
    input  wire [9:0]  write_word_i,
    input  wire [31:0] write_data_i,
    input  wire [9:0]  read_word_i,
    output wire [31:0] read_data_o
);
    (* no_rw_check *)                   // nothing is read while it is written
    reg [31:0] memory [0:1023];
    reg [31:0] read_q, read_data_q;     // the memory's own output register, and the one that leaves it time

    always @(posedge clk_i) begin
        if (write_i) if (here_i) memory[write_word_i] <= write_data_i;
        read_q      <= memory[read_word_i];
        read_data_q <= read_q;
    end

    assign read_data_o = read_data_q;
endmodule

`default_nettype wire
