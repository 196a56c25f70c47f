"""Foci on the plate model: amplitude, contrast, spot."""
