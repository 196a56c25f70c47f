"""The simulated panel: whole runs, the compiled Verilog, a panel served in real time, synthetic panels, timing diagrams."""
