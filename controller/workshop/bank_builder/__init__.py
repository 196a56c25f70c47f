"""Builds banks of precomputed waveforms, on any computer."""
