"""One module per command, or a folder with its parts: its arguments, and one call into a room."""
