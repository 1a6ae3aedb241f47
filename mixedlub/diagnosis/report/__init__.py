"""The answer as text, figures, HTML page and files."""
