"""Sources of touch samples."""
