"""The host's side of the FPGA: registers, frames, links, session, recovery and bring-up."""
