"""Blind validation of the diagnosis: a case generator independent of the package, and a scorer.

Nothing here imports the laws, effects, gears or diagnosis of the package; agreement is therefore evidence rather than a
tautology. The laws are written a second time, slowly and plainly, with another discretisation. Effects are planted in
published forms, most effects in several. Where the literature offers further forms, at least one planted form lies
outside the catalogue's law; ``Form.within`` marks the difference, and both groups are scored separately. Zeros, spans,
miscounted fringes and drives with unequal directions have only the form of the catalogue.
"""
