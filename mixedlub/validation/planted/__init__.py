"""Planted effects by name, inside and outside the catalogue.

``FORMS`` has every published form of an effect of gears and discs, ``NAMED`` the first of each; forms of other rigs are
made by functions of their programme. Sources give the origin of a form. Constants without a source are common sizes,
chosen so that a strength of about 1 is realistic for the rig.
"""

from __future__ import annotations

from mixedlub.validation.planted import boundary, contact, film, load, loss, measurement, oil, outside, shear
from mixedlub.validation.rig import Form

_EVERY = tuple(
    effect for room in (film, shear, contact, boundary, load, loss, oil, measurement) for effect in room.EFFECTS
)
FORMS: dict[str, tuple[Form, ...]] = {e.id: tuple(form for form in _EVERY if form.id == e.id) for e in _EVERY}
NAMED: dict[str, Form] = {name: forms[0] for name, forms in FORMS.items()}
OUTSIDE: dict[str, Form] = {effect.id: effect for effect in outside.EFFECTS}
MIMICS = outside.MIMICS
MEASUREMENT = frozenset(effect.id for effect in measurement.EFFECTS) | {
    "force_drift",
    "force_offset",
    "fringe_order",
    "fringe_step",
    "torque_constant",
    "zero_drift",
}
