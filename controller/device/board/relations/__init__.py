"""Keys of board.toml that belong together: what each relation refuses or warns of."""
