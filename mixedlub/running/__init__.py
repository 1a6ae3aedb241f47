"""Needs of every run: results that appear whole, their origin, processors and clusters, the version."""
