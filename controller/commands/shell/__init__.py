"""Completions and manual page: committed files, and what makes them of the argument parser."""
