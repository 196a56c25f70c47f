"""Figures and pictures of a measurement, of points left out and of a plan."""
