"""How a release's files reach a device: over HTTP or from a stick."""
