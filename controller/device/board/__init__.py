"""The description of a panel: board.toml as checked records, folders of boards and state, and access to devices."""
