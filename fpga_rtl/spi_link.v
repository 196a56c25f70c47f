// The link by SPI: bytes and frames. What it accepts is carried out at once.
`default_nettype none

module spi_link (
    input  wire        clk_i,
    input  wire        rst_i,
    input  wire        spi_sck_i,
    input  wire        spi_cs_n_i,
    input  wire        spi_mosi_i,
    output wire        spi_miso_o,
    // the answer's bytes
    input  wire [7:0]  answer_i,
    output wire        take_o,          // pulse
    // state of the core
    input  wire        landing_busy_i,
    input  wire        landing_live_i,
    input  wire [31:0] bit_period_i,
    // frames: as of frame_decoder
    output wire        busy_o,          // a frame is on its way to the core, or being carried out
    output wire        select_o,
    output wire        byte_valid_o,
    output wire [7:0]  byte_o,
    output wire        accept_o,
    output wire        refuse_o,
    output wire [7:0]  refusal_o,
    output wire [7:0]  kind_o,
    output wire [7:0]  sequence_o,
    output wire [15:0] argument_o,
    output wire [6:0]  payload_words_o,
    output wire        landing_busy_o,
    output wire        landing_live_o,
    output wire        fast_o,
    output wire        word_valid_o,
    output wire [7:0]  word_number_o,
    output wire [31:0] word_o,
    output wire        load_word_o
);
    wire stay, release_frame, partial;
    reg  busy_q;                     // of the clocks behind select_o, to that of the verdict
    always @(posedge clk_i) busy_q <= (stay || release_frame) && !rst_i;


    spi_peripheral spi_peripheral (
        .clk_i(clk_i), .rst_i(rst_i),
        .spi_sck_i(spi_sck_i), .spi_cs_n_i(spi_cs_n_i), .spi_mosi_i(spi_mosi_i), .spi_miso_o(spi_miso_o),
        .select_o(select_o), .stay_o(stay), .release_o(release_frame), .partial_o(partial),
        .byte_valid_o(byte_valid_o), .byte_o(byte_o), .answer_i(answer_i), .answer_take_o(take_o)
    );

    frame_decoder frame_decoder (
        .clk_i(clk_i), .rst_i(rst_i),
        .select_i(select_o), .release_i(release_frame), .partial_i(partial), .byte_valid_i(byte_valid_o), .byte_i(byte_o),
        .landing_busy_i(landing_busy_i), .landing_live_i(landing_live_i), .bit_period_i(bit_period_i),
        .accept_o(accept_o), .refuse_o(refuse_o), .refusal_o(refusal_o),
        .type_o(kind_o), .sequence_o(sequence_o), .argument_o(argument_o),
        .landing_busy_o(landing_busy_o), .landing_live_o(landing_live_o), .payload_words_o(payload_words_o), .fast_o(fast_o),
        .word_valid_o(word_valid_o), .word_number_o(word_number_o), .word_o(word_o), .load_word_o(load_word_o)
    );

    assign busy_o = select_o || busy_q;
endmodule

`default_nettype wire
