// What a READ gives each link of its own: frames refused, gaps in its numbers, and the high half of the time whose LOW it read last.
// All are in one memory with one counter: a link comes to a READ many clocks after its frame before, so counting may wait its turn.
`default_nettype none

module link_counters (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        accept_i,       // pulse: a frame is accepted: value_o is asked for now
    input  wire        uart_i,         // it came by the UART
    input  wire        gap_i,          // with accept_i: its number does not follow
    input  wire [1:0]  refused_i,      // pulses: a frame was refused, by SPI (0), by UART (1)
    input  wire        hold_i,         // pulse: keep high_i for this link
    input  wire [31:0] high_i,
    input  wire [1:0]  which_i,        // 0: frames refused, 1: gaps, 2: what was kept
    output wire [31:0] value_o         // of this link
);
    reg [31:0] memory [0:7];           // by {which, link}
    reg [7:0]  written_q;              // since reset; 0 before
    reg [3:0]  due_q;                  // to be counted: gaps by UART, SPI, refusals by UART, SPI
    reg        fetched_q;              // one of them is to be written with the next clock without hold_i
    reg [1:0]  which_q;
    reg [31:0] count_q;                // as it was

    wire       fetch  = due_q != 4'd0 && !fetched_q;
    wire [1:0] lowest = due_q[0] ? 2'd0 : due_q[1] ? 2'd1 : due_q[2] ? 2'd2 : 2'd3;
    wire       write  = hold_i || fetched_q;
    wire [2:0] address = hold_i ? {2'd2, uart_i} : {1'b0, which_q};
    wire [2:0] asked  = {which_i, uart_i};

    always @(posedge clk_i) begin
        if (write) memory[address] <= hold_i ? high_i : count_q + 32'd1;
    end

    always @(posedge clk_i) begin
        if (write) written_q[address] <= 1'b1;
        if (!hold_i) fetched_q <= fetch;
        if (fetch) begin
            which_q       <= lowest;
            count_q       <= written_q[{1'b0, lowest}] ? memory[{1'b0, lowest}] : 32'd0;
            due_q[lowest] <= 1'b0;
        end
        if (refused_i[0])                 due_q[0] <= 1'b1;
        if (refused_i[1])                 due_q[1] <= 1'b1;
        if (accept_i && gap_i && !uart_i) due_q[2] <= 1'b1;
        if (accept_i && gap_i && uart_i)  due_q[3] <= 1'b1;
        if (rst_i) begin
            written_q <= 8'd0;
            due_q     <= 4'd0;
            fetched_q <= 1'b0;
            which_q   <= 2'd0;
            count_q   <= 32'd0;
        end
    end

    assign value_o = written_q[asked] ? memory[asked] : 32'd0;
endmodule

`default_nettype wire
