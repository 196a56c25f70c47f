"""Recordings of touch panels, read, replayed and written."""
