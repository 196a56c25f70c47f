"""A panel that is computed: plate twin, simulated run, the Verilog compiled, pictures."""
