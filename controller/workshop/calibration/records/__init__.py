"""Measurements of a plate, as files."""
