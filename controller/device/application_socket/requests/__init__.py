"""What clients ask for: each line checked, carried out, and answered exactly once."""
