"""The answer in words, on a page and in files."""
