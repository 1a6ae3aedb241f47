"""Blind proof: a generator that shares nothing with the forward model, and what scores the answers.

Nothing here imports the laws, effects, gears or diagnosis of the package, so agreement between the two
is evidence and not a tautology. The laws are written out once more, slow and plain, with another
discretisation, and every hidden effect has another published form than the catalogue's where there is one.
"""
