// What the core promises of the wires between its modules: its pins are those of the island, whose promises they have, and what
// must reach several modules, or comes of one of two links, does. Names with a module before them are that module's ports.
(* hierconn *) wire        \safety_island.run_permit_i , \safety_island.temperature_ok_i , \safety_island.clock_lost_i ;
(* hierconn *) wire        \safety_island.rst_i , \safety_island.run_permit_o , \safety_island.temperature_ok_o ;
(* hierconn *) wire        \safety_island.hv_enable_o , \safety_island.hv_alive_o , \safety_island.focus_o ;
(* hierconn *) wire [31:0] \safety_island.channel_o ;
(* hierconn *) wire        \indicator_pins.fault_i , \indicator_pins.fault_o , \indicator_pins.waiting_i , \indicator_pins.waiting_o ;
(* hierconn *) wire        \register_file.faulted_i , \trigger_input.level_o , \trigger_input.trigger_i ;

(* hierconn *) wire        \safety_island.arm_i , \safety_island.disarm_i , \safety_island.clear_i , \safety_island.heard_i ;
(* hierconn *) wire        \safety_island.link_i , \safety_island.faulted_o , \safety_island.shut_o ;
(* hierconn *) wire [31:0] \safety_island.drive_i , \safety_island.channel_mask_i , \safety_island.heartbeat_ticks_i ;
(* hierconn *) wire [31:0] \safety_island.channel_edges_i , \safety_island.total_edges_i , \safety_island.emission_ticks_i ;
(* hierconn *) wire [31:0] \safety_island.duty_ticks_i ;
(* hierconn *) wire [16:0] \safety_island.duty_share_i ;
(* hierconn *) wire [15:0] \safety_island.pulse_ticks_i , \safety_island.bit_ticks_i ;
(* hierconn *) wire [31:0] \waveform_player.drive_o , \waveform_player.bit_period_i , \waveform_player.idle_word_i ;
(* hierconn *) wire        \waveform_player.stop_i , \waveform_player.disarm_i , \waveform_player.fault_i , \waveform_player.trigger_i ;
(* hierconn *) wire        \waveform_player.waiting_o ;
(* hierconn *) wire        \play_queue.drop_i , \play_queue.push_i , \play_check.forget_i , \play_check.accept_i , \play_check.good_o ;
(* hierconn *) wire [31:0] \play_check.bit_period_i , \play_check.emission_ticks_i ;
(* hierconn *) wire        \register_file.arm_o , \register_file.disarm_o , \register_file.clear_o , \register_file.stop_o ;
(* hierconn *) wire        \register_file.trigger_o , \register_file.uart_i , \register_file.accept_i , \register_file.permitted_i ;
(* hierconn *) wire [31:0] \register_file.heartbeat_ticks_o , \register_file.emission_ticks_o , \register_file.duty_ticks_o ;
(* hierconn *) wire [31:0] \register_file.channel_mask_o , \register_file.bit_period_o , \register_file.idle_word_o ;
(* hierconn *) wire [28:0] \register_file.total_edges_o ;
(* hierconn *) wire [23:0] \register_file.channel_edges_o ;
(* hierconn *) wire [16:0] \register_file.duty_share_o ;
(* hierconn *) wire [15:0] \register_file.pulse_ticks_o ;
(* hierconn *) wire [2:0]  \register_file.inputs_i ;
(* hierconn *) wire        \register_file.quiet_i , \register_file.off_i , \waveform_player.quiet_o , \safety_island.off_o ;
(* hierconn *) wire        \safety_island.armed_o , \safety_island.settling_o , \safety_island.ramp_up_o ;
(* hierconn *) wire        \safety_island.stopping_o , \safety_island.ramp_down_o ;
(* hierconn *) wire [3:0]  \play_queue.queued_o ;
(* hierconn *) wire        \spi_link.accept_o , \spi_encoder.echo_i , \trigger_input.trigger_o , \trigger_input.command_i ;
(* hierconn *) wire [7:0]  \spi_link.kind_o ;
(* hierconn *) wire        \uart.uart_link.accept_o , \uart.uart_link.turn_o ;

// What the island promises of its pins is promised of the core's
always @* begin
    pins_are_the_island_s: assert (\safety_island.run_permit_i == run_permit_i && \safety_island.temperature_ok_i == temperature_ok_i
        && \safety_island.clock_lost_i == clock_lost_i && \safety_island.rst_i == rst_i && channel_o == \safety_island.channel_o
        && hv_enable_o == \safety_island.hv_enable_o && hv_alive_o == \safety_island.hv_alive_o && focus_o == \safety_island.focus_o );
    permits_are_told: assert (\register_file.inputs_i
        == {\trigger_input.level_o , \safety_island.temperature_ok_o , \safety_island.run_permit_o });
    arming_is_permitted: assert (\register_file.permitted_i == (\safety_island.temperature_ok_o && \safety_island.run_permit_o ));
    fault_pin_is_the_fault: assert (\indicator_pins.fault_i == \safety_island.faulted_o && fault_o == \indicator_pins.fault_o
        && \register_file.faulted_i == \safety_island.faulted_o );
    waiting_pin_waits: assert (\indicator_pins.waiting_i == \waveform_player.waiting_o && waiting_o == \indicator_pins.waiting_o );
    trigger_is_its_pin: assert (\trigger_input.trigger_i == trigger_i);
end

// What ends reaches all that it ends: what waits, its times, what plays, the outputs
wire drops = \register_file.stop_o || \register_file.disarm_o || \safety_island.shut_o ;
always @* begin
    what_is_dropped_is_forgotten: assert (\play_queue.drop_i == drops && \play_check.forget_i == drops);
    what_ends_ends_the_player:    assert (\waveform_player.stop_i == \register_file.stop_o && \waveform_player.fault_i == \safety_island.shut_o
                                          && \waveform_player.disarm_i == \register_file.disarm_o );
    commands_reach_the_island:    assert (\safety_island.arm_i == \register_file.arm_o && \safety_island.clear_i == \register_file.clear_o
                                          && \safety_island.disarm_i == \register_file.disarm_o );
    only_good_plays_are_queued:   assert (\play_queue.push_i == (\play_check.accept_i && \play_check.good_o ));
    triggers_reach_the_player:    assert (\waveform_player.trigger_i == \trigger_input.trigger_o
                                          && \trigger_input.command_i == \register_file.trigger_o );
    only_the_player_drives:       assert (\safety_island.drive_i == \waveform_player.drive_o );
end

// Frames: what a link says counts as that link's
always @* begin
    heard_is_accepted: assert (\safety_island.heard_i == (\spi_link.accept_o || \uart.uart_link.accept_o )
                               && \register_file.accept_i == \safety_island.heard_i );
    heard_by_its_link: assert (\safety_island.link_i == \uart.uart_link.turn_o && \register_file.uart_i == \uart.uart_link.turn_o );
    only_tests_echo:   assert (\spi_encoder.echo_i == (\spi_link.kind_o == `TYPE_TEST));
end

// The bit clock changes only where nothing sounds, waits or glides; settings reach what they limit
wire moves = \safety_island.settling_o || \safety_island.ramp_up_o || \safety_island.stopping_o || \safety_island.ramp_down_o ;
wire rests = \waveform_player.quiet_o && \play_queue.queued_o == 4'd0;
always @* begin
    off_is_the_island_s: assert (\register_file.off_i == \safety_island.off_o );
    if (\register_file.quiet_i ) quiet_is_at_rest: assert (!moves && rests);
    if ((\safety_island.off_o || \safety_island.armed_o ) && rests) rest_is_quiet: assert (\register_file.quiet_i );
    limits_are_the_set_ones: assert (\safety_island.heartbeat_ticks_i == \register_file.heartbeat_ticks_o
        && \safety_island.pulse_ticks_i == \register_file.pulse_ticks_o && \safety_island.duty_share_i == \register_file.duty_share_o
        && \safety_island.channel_edges_i == {8'd0, \register_file.channel_edges_o } && \safety_island.duty_ticks_i == \register_file.duty_ticks_o
        && \safety_island.total_edges_i == {3'd0, \register_file.total_edges_o } && \safety_island.channel_mask_i == \register_file.channel_mask_o
        && \safety_island.emission_ticks_i == \register_file.emission_ticks_o && \play_check.emission_ticks_i == \register_file.emission_ticks_o );
    bits_are_as_set: assert (\waveform_player.bit_period_i == \register_file.bit_period_o && \play_check.bit_period_i == \register_file.bit_period_o
        && \safety_island.bit_ticks_i == \register_file.bit_period_o [31:16] && \waveform_player.idle_word_i == \register_file.idle_word_o );
end
