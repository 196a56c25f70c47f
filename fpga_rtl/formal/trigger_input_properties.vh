// What trigger_input promises: its level is the pin two clocks ago; a trigger is a command, a clock later, or the pin high for
// three clocks, once, after it was low for three. Levels and lengths are counted here, at the pin.
initial assume (rst_i);

reg       pin_1_g = 1'b1, pin_2_g = 1'b1, command_1_g = 1'b0;
reg [1:0] high_g = 2'd3, low_g = 2'd0;        // clocks for which the pin was high, or low, up to two clocks ago; at most 3
reg       ready_g = 1'b0;                     // it was low for three clocks, and not high for three since
reg       pulse_g = 1'b0;                     // a clock ago the pin triggered
always @(posedge clk_i) begin
    {pin_2_g, pin_1_g} <= {pin_1_g, trigger_i};
    command_1_g <= command_i;
    high_g      <= !pin_2_g ? 2'd0 : high_g == 2'd3 ? 2'd3 : high_g + 2'd1;
    low_g       <= pin_2_g ? 2'd0 : low_g == 2'd3 ? 2'd3 : low_g + 2'd1;
    ready_g     <= long_low || (ready_g && !long_high);
    pulse_g     <= ready_g && long_high;
    if (rst_i) begin
        {pin_2_g, pin_1_g, command_1_g, ready_g, pulse_g} <= 5'b11000;
        {high_g, low_g} <= {2'd3, 2'd0};
    end
end
wire long_high = pin_2_g && high_g >= 2'd2, long_low = !pin_2_g && low_g >= 2'd2;

// the registers beside their counts: only a help
always @* if (!$initstate) begin
    assert (trigger_q[1:0] == {pin_2_g, pin_1_g} && command_q == command_1_g);
    ready_is_linked: assert (triggered_q == !ready_g);
    assert (trigger_q[2] ? high_g != 2'd0 && low_g == 2'd0 : high_g == 2'd0 && low_g != 2'd0);
    assert ((high_g >= 2'd2) == (trigger_q[3:2] == 2'b11) && (low_g >= 2'd2) == (trigger_q[3:2] == 2'b00));
end

always @* if (!$initstate) begin
    level_is_the_pin:        assert (level_o == pin_2_g);
    triggers_as_it_should:   assert (trigger_o == (command_1_g || (ready_g && long_high)));
    if (pulse_g) once_a_high: assert (trigger_o == command_1_g);
end
always @* if (!rst_i) begin
    pin_triggers_twice: cover (trigger_o && !command_1_g && twice_g);
    glitch_is_none:     cover (ready_g && high_g == 2'd2 && !pin_2_g);
end
reg twice_g = 1'b0;                           // the pin has triggered before
always @(posedge clk_i) twice_g <= !rst_i && (twice_g || pulse_g);
