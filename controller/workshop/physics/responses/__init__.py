"""Responses of a plate to a bit of drive voltage."""
