// What becomes of an accepted frame: its result, and the value of a READ. Both are found out in the clock in which it is accepted,
// and come a clock later.
`default_nettype none
`include "registers.vh"

module frame_result (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        accept_i,            // pulse
    input  wire        uart_i,              // it came by the UART
    input  wire [7:0]  kind_i, sequence_i,
    input  wire [9:0]  page_i,              // upper bits of the argument: what a READ asks for
    input  wire [7:0]  spi_sequence_i, uart_sequence_i,  // of the frame that each link had accepted before
    output wire        gap_o,               // in that clock: the number does not follow
    // results of each kind, and values of what a READ may ask for
    input  wire [7:0]  write_result_i, load_result_i, store_result_i, play_result_i,
    input  wire [7:0]  register_result_i, memory_result_i, crc_result_i, queue_result_i,
    input  wire [31:0] register_data_i, memory_data_i, crc_data_i, queue_data_i,
    // to the reply of its link
    output wire [1:0]  done_o,              // pulse: a frame was accepted, by SPI (0), by UART (1)
    output wire        read_o,              // data_o is the value that it asked for
    output wire [7:0]  result_o, sequence_o,
    output wire [31:0] data_o
);
    wire        of_memory = page_i[9];
    wire        of_crc    = page_i[9:2] == 8'd1;
    wire        of_queue  = page_i[9:2] == 8'd2;
    reg  [7:0]  read_result, result;
    reg  [31:0] other_data;                 // of a READ that asks for no register

    always @* begin
        read_result = `RESULT_OK;
        other_data  = 32'd0;
        result      = `RESULT_OK;
        if (accept_i) begin
            other_data  = of_memory ? memory_data_i : of_crc ? crc_data_i : queue_data_i;
            read_result = of_memory ? memory_result_i : of_crc ? crc_result_i
                        : of_queue ? (page_i[1:0] != 2'd0 ? `RESULT_BAD_RANGE : queue_result_i) : register_result_i;
            case (kind_i)
                `TYPE_NOP, `TYPE_TEST: result = `RESULT_OK;
                `TYPE_READ:  result = read_result;
                `TYPE_WRITE: result = write_result_i;
                `TYPE_LOAD:  result = load_result_i;
                `TYPE_STORE: result = store_result_i;
                `TYPE_PLAY:  result = play_result_i;
                default:     result = `RESULT_UNKNOWN_TYPE;
            endcase
        end
    end

    reg gap;
    always @* begin
        gap = 1'b0;
        if (accept_i) gap = sequence_i != (uart_i ? uart_sequence_i : spi_sequence_i) + 8'd1;
    end

    reg  [1:0]  done_q;
    reg         read_q, of_register_q;
    reg  [7:0]  result_q, sequence_q;
    reg  [31:0] register_data_q, other_data_q;  // side by side: a register is chosen of many

    always @(posedge clk_i) begin
        done_q <= {accept_i && uart_i, accept_i && !uart_i};
        if (accept_i) begin
            read_q     <= kind_i == `TYPE_READ;
            result_q   <= result;
            sequence_q <= sequence_i;
            of_register_q   <= !of_memory && !of_crc && !of_queue;
            register_data_q <= register_data_i;
            other_data_q    <= other_data;
        end
        if (rst_i) begin
            done_q     <= 2'b00;
            read_q     <= 1'b0;
            result_q   <= `RESULT_OK;
            sequence_q <= 8'd0;
            of_register_q   <= 1'b0;
            register_data_q <= 32'd0;
            other_data_q    <= 32'd0;
        end
    end

    assign gap_o      = gap;
    assign done_o     = done_q;
    assign read_o     = read_q && result_q == `RESULT_OK;
    assign result_o   = result_q;
    assign sequence_o = sequence_q;
    assign data_o     = of_register_q ? register_data_q : other_data_q;
endmodule

`default_nettype wire
