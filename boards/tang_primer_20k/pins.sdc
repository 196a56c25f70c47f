create_clock -name clk_27mhz -period 37.037 [get_pins clk_pad/O]
create_clock -name clk -period 15.873 [get_pins clock.pll/CLKOUT]
create_clock -name watch -period 180 [get_pins clock.watch_buffer/O]
create_clock -name spi_sck -period 40 [get_pins sck_pad/O]
