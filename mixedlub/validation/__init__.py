"""Blind proof: a generator that shares nothing with the forward model, and what scores the answers.

Nothing here imports the laws, effects, gears or diagnosis of the package, so agreement between the two
is evidence and not a tautology. The laws are written out once more, slow and plain, with another
discretisation. Effects are planted in published forms, most in several. Where the literature has more than the
catalogue's form, one at least is a form that the catalogue's law cannot become; others it can, and each form says
which (``within``), so that the answers to both are told apart. Zeros, spans and miscounted fringes, and drives whose
directions differ, have the form of the catalogue alone.
"""
