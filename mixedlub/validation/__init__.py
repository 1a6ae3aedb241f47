"""Blind validation of the diagnosis: a generator of cases that shares nothing with the package, and a scorer.

Nothing here imports the laws, effects, gears or diagnosis of the package, so that agreement between the two is evidence
and not a tautology. The laws are written a second time, slowly and plainly, with another discretisation. Effects are
planted in published forms, most of them in several. Where the literature has more than the form of the catalogue, at
least one is a form that the catalogue's law cannot become; ``Form.within`` separates them, so that both are scored
apart. Zeros, spans and miscounted fringes, and drives whose directions differ, have the form of the catalogue alone.
"""
