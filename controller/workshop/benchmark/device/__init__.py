"""What the device's loop costs and leaves out."""
