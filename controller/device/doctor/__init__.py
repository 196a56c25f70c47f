"""Examinations of a device: its files, devices, link, FPGA and updates."""
