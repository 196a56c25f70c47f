"""A scene that is read while the service runs, by a process beside the loop."""
