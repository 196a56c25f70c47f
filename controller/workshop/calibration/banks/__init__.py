"""Banks of measured plates: of one, and of a whole fleet."""
