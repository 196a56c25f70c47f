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

    wire       count   = due_q != 4'd0 && !accept_i;
    wire [1:0] lowest  = due_q[0] ? 2'd0 : due_q[1] ? 2'd1 : due_q[2] ? 2'd2 : 2'd3;
    wire [2:0] address = count ? {1'b0, lowest} : {which_i, uart_i};
    wire [31:0] value  = written_q[address] ? memory[address] : 32'd0;

    always @(posedge clk_i) begin
        if (hold_i || count) memory[hold_i ? {2'd2, uart_i} : address] <= hold_i ? high_i : value + 32'd1;
    end

    always @(posedge clk_i) begin
        if (hold_i) written_q[{2'd2, uart_i}] <= 1'b1;
        if (count) begin
            written_q[address] <= 1'b1;
            due_q[lowest]      <= 1'b0;
        end
        if (refused_i[0])                 due_q[0] <= 1'b1;
        if (refused_i[1])                 due_q[1] <= 1'b1;
        if (accept_i && gap_i && !uart_i) due_q[2] <= 1'b1;
        if (accept_i && gap_i && uart_i)  due_q[3] <= 1'b1;
        if (rst_i) begin
            written_q <= 8'd0;
            due_q     <= 4'd0;
        end
    end

    assign value_o = value;
endmodule

`default_nettype wire
