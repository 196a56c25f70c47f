"""Bitstreams as files: what one says of itself, of which Verilog it is built, and loading it into an FPGA."""
