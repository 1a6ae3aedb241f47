"""One file format a file: each a small class with a name, a format and a magic check."""
