"""What is measured with a finger on the panel: axes, latency, ghosts."""
