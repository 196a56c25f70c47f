"""What a panel is built from, by board.toml and boards/stage: its circuit as a netlist for KiCad, and the bill of materials."""
