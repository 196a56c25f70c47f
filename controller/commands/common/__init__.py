"""What several commands share: arguments, boards and links by name, output."""
