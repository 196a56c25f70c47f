"""A new panel: its board folder, from what its builder says of glass, discs, touch panel and FPGA."""
