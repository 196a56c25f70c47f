"""A bit-exact model of the gateware's Verilog, and links to it."""
