"""The concealed effects by name: those the catalogue should name, and those outside any catalogue.

``FORMS`` has every published form of an effect that may be planted, ``NAMED`` the first of each.

Sources say where a form comes from. Constants that a docstring does not call published are usual sizes,
chosen so that a strength of about 1 is what such a rig could show.
"""

from __future__ import annotations

from mixedlub.validation.planted import boundary, contact, film, load, loss, measurement, oil, outside, shear
from mixedlub.validation.planted.kinds import Concealed, Knob

_ROOMS = (film, shear, contact, boundary, load, loss, oil, measurement)

_EVERY = tuple(effect for room in _ROOMS for effect in room.EFFECTS)
FORMS: dict[str, tuple[Concealed, ...]] = {e.id: tuple(form for form in _EVERY if form.id == e.id) for e in _EVERY}
NAMED: dict[str, Concealed] = {name: forms[0] for name, forms in FORMS.items()}
OUTSIDE: dict[str, Concealed] = {effect.id: effect for effect in outside.EFFECTS}
MIMICS = outside.MIMICS
MEASUREMENT = frozenset(effect.id for effect in measurement.EFFECTS) | {
    "force_drift",
    "force_offset",
    "fringe_order",
    "fringe_step",
    "torque_constant",
    "zero_drift",
}

__all__ = ["FORMS", "MEASUREMENT", "MIMICS", "NAMED", "OUTSIDE", "Concealed", "Knob"]
