"""The FPGA as the host sees it: registers, frames, links, session, recovery and bring-up."""
