"""Responses of a real plate: measured, checked, interpolated to every place of the plate."""
