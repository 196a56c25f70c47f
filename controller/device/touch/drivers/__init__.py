"""What the drivers of touch panels share: readers of event devices and chips, their lines, the process that a panel may run in."""
