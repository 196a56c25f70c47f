// What reset_release promises: no reset ends before the clock has been there for CLOCKS clocks, and then each does.
reg [4:0] there_g = 5'd0;                     // clocks for which it was there
always @(posedge clk_i) there_g <= !running_i ? 5'd0 : there_g == 5'd16 ? there_g : there_g + 5'd1;
always @* if (!running_i) lost_is_reset: assert (!released_o);
always @* if (running_i)  released_in_time: assert (released_o == (there_g == 5'd16));
