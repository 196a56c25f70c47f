"""Touch panels and recordings: drivers, recordings, decoder and tracker, from input events to touch samples (README.md)."""
