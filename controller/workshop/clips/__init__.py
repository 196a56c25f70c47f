"""Clips of haptic designers, as rhythms that a panel plays."""
