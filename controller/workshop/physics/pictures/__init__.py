"""Plots and films of a plate's field."""
