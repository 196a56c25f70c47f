"""The gateware computed: a bit-exact model of the Verilog, and the links by which it is reached."""
