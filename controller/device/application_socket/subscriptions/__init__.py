"""What clients are sent without a request: touches, the panel's condition and description, what is played."""
