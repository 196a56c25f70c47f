"""What a panel is made of: board.toml as checked records, where boards and state lie, and how devices are reached."""
