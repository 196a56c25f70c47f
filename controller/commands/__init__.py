"""One module per command: its arguments, and one call into a room."""
