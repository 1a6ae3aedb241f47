"""Synthetic rigs whose friction is known, for the proof of the evaluations; nothing of the package is used.

Each bench draws its instrument errors anew from the standard deviations that its file states, and returns the tables
that the rig would record and the truth behind them.
"""
