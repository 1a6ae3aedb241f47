"""Synthetic rigs with known friction, for the proof of the evaluations; nothing of the package is used.

Each bench draws instrument errors from the standard deviations in its file and returns recorded tables and truth.
"""
