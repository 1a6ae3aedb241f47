"""Formats of input files: keys and columns, their ranges, units and messages."""
