"""Support of runs: complete results, their origin, processors and clusters, version."""
