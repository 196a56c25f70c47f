"""How a plate is measured, really or simulated."""
