"""The answer as text and numbers."""
