"""Blind cases of the kinds that are no gear pair and no pair of discs: one room a kind, each its own generator.

A room draws benches (what a rig is, in which conditions it is read, what calibration may move) and carries
the effects that can be at work there, most of them in several published forms of which one is drawn. Base
models are written out from the contract's formulas; nothing of the forward model, its laws or its effects
is used. A third of the films have an oil that nobody names and keep to another film law than the base model's.
"""
