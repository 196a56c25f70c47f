"""Methods of finding drive words that the benchmark compares, each tried in full: from points to words."""
