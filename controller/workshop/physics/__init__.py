"""Plate, driver, responses and fields, and the plate twin: on any computer, never on the device."""
