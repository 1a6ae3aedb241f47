"""The answer as text, figures, page and files."""
