"""Compact banks: responses as complex weights of pulses at half a wavelength, in four bits, for boards of little memory."""
