"""Links to the FPGA: SPI and UART, with their GPIO lines."""
