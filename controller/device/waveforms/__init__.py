"""From the responses of a bank to drive words: selection, interpolation, composition, amplitude masking."""
