"""Explanations fitted to a recording and weighed."""
