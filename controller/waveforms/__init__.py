"""From the responses of a bank to drive words: which entry, composed of what, at which amplitude."""
