"""From a batch of emissions to an accepted play."""
