"""Readers, one file format a module: each a small class with a name, a format and a magic check."""
