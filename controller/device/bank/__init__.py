"""The bank: precomputed drive waveforms and responses in one memory-mapped file."""
