"""Whether a measurement is good enough for a bank."""
