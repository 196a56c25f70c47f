"""What the loop notes in rings that are made once, for those who look later: its last turns, the last starts."""
