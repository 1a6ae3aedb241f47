"""The mismatch that no effect of the catalogue explains."""
