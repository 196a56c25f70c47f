"""The Unix socket through which a user interface drives the panel: JSON lines, each answered exactly once."""
