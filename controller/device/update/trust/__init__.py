"""Which releases a device may take: signed metadata, its age, the clock."""
