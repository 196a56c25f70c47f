"""Releases in the field: trusted, fetched, installed beside the running one, tried, and rolled back."""
