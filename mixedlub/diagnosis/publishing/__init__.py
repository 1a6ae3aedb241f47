"""The answer as a page and as files."""
