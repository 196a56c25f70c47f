"""The FPGA as the host sees it: registers, frames, links, and a bit-exact model of the gateware."""
