"""The FPGA on a computer: its model, the compiled Verilog, timing tables, bitstreams, generated register files."""
