"""What the loop did, written when something has to be explained, and read again."""
