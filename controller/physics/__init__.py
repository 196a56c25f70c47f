"""Physics and tools that run on any computer, never on the device; may import scipy and matplotlib."""
