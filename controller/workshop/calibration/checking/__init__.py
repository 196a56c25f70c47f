"""What is wrong with a measurement, and the verdict on its wires, by channel and point."""
