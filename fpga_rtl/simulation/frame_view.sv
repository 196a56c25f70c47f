// Beside the pins in `haptic-panel gateware waves`: each frame as it is on the wires, what became of it, and the gate's state.
// Bound into haptic_core in the traced build alone; nothing reads it.
`default_nettype none
`include "registers.vh"

/* verilator tracing_off */                 // what the core shows already, and what only this needs
module frame_view (
    input wire        clk_i, rst_i,
    input wire        spi_sck_i, spi_cs_n_i, spi_mosi_i, spi_miso_i,
    input wire        accept_i,
    input wire [7:0]  kind_i,
    input wire [15:0] argument_i,
    input wire [1:0]  done_i,
    input wire [7:0]  result_i, sequence_i,
    input wire [1:0]  refuse_i,             // by UART (1), by SPI (0)
    input wire [7:0]  spi_refusal_i, uart_refusal_i,
    input wire [5:0]  gate_i
);
    typedef enum logic [7:0] {
        // generated: kinds
        NOP = `TYPE_NOP,
        READ = `TYPE_READ,
        WRITE = `TYPE_WRITE,
        LOAD = `TYPE_LOAD,
        STORE = `TYPE_STORE,
        PLAY = `TYPE_PLAY,
        TEST = `TYPE_TEST,
        // end of kinds
        HEADER = 8'hFE,                     // its first bytes are on the wire
        NONE   = 8'hFF
    } kind_t;
    typedef enum logic [7:0] {
        // generated: results
        OK = `RESULT_OK,
        BAD_SYNC = `RESULT_BAD_SYNC,
        BAD_LENGTH = `RESULT_BAD_LENGTH,
        BAD_CRC = `RESULT_BAD_CRC,
        UNKNOWN_TYPE = `RESULT_UNKNOWN_TYPE,
        UNKNOWN_REGISTER = `RESULT_UNKNOWN_REGISTER,
        READ_ONLY = `RESULT_READ_ONLY,
        BAD_VALUE = `RESULT_BAD_VALUE,
        BAD_SLOT = `RESULT_BAD_SLOT,
        BAD_CHUNK = `RESULT_BAD_CHUNK,
        INCOMPLETE = `RESULT_INCOMPLETE,
        EMPTY_SLOT = `RESULT_EMPTY_SLOT,
        BUSY = `RESULT_BUSY,
        NOT_ARMED = `RESULT_NOT_ARMED,
        ARMED = `RESULT_ARMED,
        FAULTED = `RESULT_FAULTED,
        NO_PERMIT = `RESULT_NO_PERMIT,
        BAD_KEY = `RESULT_BAD_KEY,
        LOCKED = `RESULT_LOCKED,
        QUEUE_FULL = `RESULT_QUEUE_FULL,
        BAD_RANGE = `RESULT_BAD_RANGE,
        BAD_PERIOD = `RESULT_BAD_PERIOD,
        TOO_LONG = `RESULT_TOO_LONG,
        TOO_LATE = `RESULT_TOO_LATE,
        OVERLAP = `RESULT_OVERLAP,
        SLOT_DAMAGED = `RESULT_SLOT_DAMAGED,
        LINK_SLOW = `RESULT_LINK_SLOW,
        // end of results
        NO_RESULT = 8'hFF
    } result_t;
    typedef enum logic [1:0] {NO_LINK, SPI, UART} link_t;
    typedef enum logic [5:0] {OFF = 1, SETTLING = 2, RAMP_UP = 4, ON = 8, STOPPING = 16, RAMP_DOWN = 32} gate_t;

    // On the wires, as far as it has come: the frame, and in the answer the result of the one before
    /* verilator tracing_on */
    kind_t       spi_kind = NONE;
    logic [7:0]  spi_sequence;
    logic [15:0] spi_argument;
    result_t     spi_answer = NO_RESULT;
    logic [7:0]  spi_answer_sequence;
    logic [15:0] spi_answer_state, spi_answer_faults;
    /* verilator tracing_off */
    logic [12:0] bits;
    logic [14:0] sent, came;                // the bits before
    wire  [15:0] sent_now = {sent, spi_mosi_i}, came_now = {came, spi_miso_i};
    always_ff @(posedge spi_sck_i or posedge spi_cs_n_i) begin
        if (spi_cs_n_i) begin
            bits       <= 13'd0;
            spi_kind   <= NONE;
            spi_answer <= NO_RESULT;
        end else begin
            bits <= bits + 13'd1;
            sent <= sent_now[14:0];
            came <= came_now[14:0];
            case (bits)
                13'd0:  spi_kind <= HEADER;
                13'd23: {spi_kind, spi_answer} <= {kind_t'(sent_now[7:0]), result_t'(came_now[7:0])};
                13'd31: {spi_sequence, spi_answer_sequence} <= {sent_now[7:0], came_now[7:0]};
                13'd47: spi_answer_state <= {came_now[7:0], came_now[15:8]};
                13'd63: begin
                    spi_argument      <= {sent_now[7:0], sent_now[15:8]};
                    spi_answer_faults <= {came_now[7:0], came_now[15:8]};
                end
                default: ;
            endcase
        end
    end

    // The last frame that was carried out, or refused: its kind is none then
    kind_t       accepted_kind;
    logic [15:0] accepted_argument;
    /* verilator tracing_on */
    kind_t       done_kind;
    logic [15:0] done_argument, done_slot;  // done_slot: of the last STORE or PLAY
    link_t       done_link;
    logic [7:0]  done_sequence;
    result_t     done_result;
    logic [31:0] done_count;
    always_ff @(posedge clk_i) begin
        if (accept_i) {accepted_kind, accepted_argument} <= {kind_t'(kind_i), argument_i};
        if (|done_i) begin
            done_link     <= done_i[1] ? UART : SPI;
            done_kind     <= accepted_kind;
            done_argument <= accepted_argument;
            done_sequence <= sequence_i;
            done_result   <= result_t'(result_i);
            done_count    <= done_count + 32'd1;
            if (accepted_kind == STORE || accepted_kind == PLAY) done_slot <= accepted_argument;
        end else if (|refuse_i) begin
            done_link   <= refuse_i[1] ? UART : SPI;
            done_kind   <= NONE;
            done_result <= result_t'(refuse_i[1] ? uart_refusal_i : spi_refusal_i);
            done_count  <= done_count + 32'd1;
        end
        if (rst_i) {done_link, done_kind, done_result, done_count} <= {NO_LINK, NONE, NO_RESULT, 32'd0};
    end

    gate_t gate;
    assign gate = gate_t'(gate_i);
endmodule

bind haptic_core frame_view frames (
    .clk_i, .rst_i, .spi_sck_i, .spi_cs_n_i, .spi_mosi_i, .spi_miso_i(spi_miso_o),
    .accept_i(accept), .kind_i(kind), .argument_i(argument), .done_i(done), .result_i(done_result), .sequence_i(done_sequence),
    .refuse_i({uart_refuse, spi_refuse}), .spi_refusal_i(spi_refusal), .uart_refusal_i(uart.uart_refusal),
    .gate_i({ramp_down, stopping, armed, ramp_up, settling, off})
);

`default_nettype wire
