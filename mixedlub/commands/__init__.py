"""The command line: one command a file, each a thin layer over functions anyone can call."""
