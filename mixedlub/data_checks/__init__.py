"""Checks of a recording before anything is fitted."""
