// What permit_latch promises of its pins, whatever they do: a low is low at once, and the core is told of it long enough, before.
reg [3:0] run_g = 4'd0;                       // clocks since the beginning
reg       low_1_g, told_1_g, told_2_g, told_3_g;
reg [3:0] shut_g;                             // clocks since the core was told of the last low, up to 15
wire      low  = !run_permit_i || !temperature_ok_i;
wire      told = !run_permit_o || !temperature_ok_o;
always @(posedge clk_i) begin
    run_g   <= run_g == 4'd15 ? run_g : run_g + 4'd1;
    low_1_g <= low;
    {told_3_g, told_2_g, told_1_g} <= {told_2_g, told_1_g, told};
    shut_g  <= told ? 4'd1 : shut_g == 4'd15 ? shut_g : shut_g + 4'd1;
end
always @* if (low) low_is_low_at_once: assert (!permitted_o && told);
always @* if (run_g == 4'd15) begin
    if (low_1_g)     core_is_told:          assert (told && !permitted_o);
    if (permitted_o) core_has_shut_before:  assert (!told && shut_g >= 4'd7);
    if (told_1_g && !told_3_g) a_low_lasts: assert (told);  // three clocks, or a pin that is still low
    comes_back: cover (permitted_o && shut_g != 4'd15);
end
