"""Every command that makes a figure of the README."""
