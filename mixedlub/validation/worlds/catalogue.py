"""Laws available to a rig, and the random world drawn from them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.validation.rig import (
    ASPERITIES,
    BALANCE,
    FILM,
    LAWS,
    MIXTURE,
    PRESSURE,
    SHEAR,
    TEMPERATURE,
    Act,
    Law,
    Rig,
)
from mixedlub.validation.worlds import films, mixed, oils, sharing, traction

TOGETHER = (FILM, SHEAR, PRESSURE, ASPERITIES)
"""A rig of full physics: film, traction averaged over the contact, viscosity and asperities all follow other laws."""
SPOILT = {name: frozenset({ASPERITIES, BALANCE, MIXTURE}) for name in ("skewed_heights", "asperity_plasticity")}
"""Effects with a law of real area that replaces the base model's, and the laws overruled by them."""
SHOWN = 2e-3
"""Smallest relative change of a reading at which a law differs from the base model's."""

_CONTACT = (*mixed.THEORIES, *mixed.BALANCES, *mixed.MIXTURES, *traction.EVERY, *oils.OF_CONTACTS, *oils.COOLING)
OF_KIND: dict[str, tuple[Law, ...]] = {
    "gear_pair": (*films.LINE, *_CONTACT, *sharing.EVERY),
    "disc": (*films.LINE, *_CONTACT),
    "mesh_friction": (*films.LINE, *_CONTACT, *sharing.EVERY),
    "friction_history": (*films.POINT, *_CONTACT),
    "film": (*films.POINT, *oils.COOLING),
    "viscosity": (*oils.OF_SAMPLES, *oils.COOLING),
}
"""Laws by kind; a friction map has no law of the base chain."""


@dataclass(frozen=True)
class Followed:
    """A law followed by a rig, with its drawn knobs."""

    law: Law
    values: dict[str, float]

    @property
    def act(self) -> Act:
        return self.law.act(self.values)


World = tuple[Followed, ...]


def in_order(world: Sequence[Followed]) -> World:
    """Laws with the temperature law first: the others read the viscosity at rest."""
    return tuple(sorted(world, key=lambda one: one.law.id != TEMPERATURE))


def following(rig: Rig, world: Sequence[Followed]) -> Rig:
    """Rig in a world: its model stays the base model, and effects replaced by the laws are left out."""
    ids = {one.law.id for one in world}
    forms = tuple(form for form in rig.forms if form.id not in LAWS and not SPOILT.get(form.id, frozenset()) & ids)
    return replace(rig, followed=tuple(one.act for one in in_order(world)), forms=forms)


def has_contact(rig: Rig) -> bool:
    """Whether the case describes the subject of the laws: a sample, or a lubricated contact."""
    return rig.kind == "viscosity" or "lubricant" in rig.settings


def shows(rig: Rig, law: Law, base: np.ndarray) -> bool:
    """Whether a law changes the readings of the base model on a rig, ``base``; assumed for laws with needs."""
    if law.needs:
        return True
    z = np.zeros(len(rig.names))
    return bool(np.max(np.abs(rig.model(z, [law.act(law.middle)]) / base - 1)) > SHOWN)


def laws_on(rig: Rig) -> dict[str, tuple[Law, ...]]:
    """Laws that a rig can follow and that change its readings, by id."""
    if not has_contact(rig):
        return {}
    base = rig.model(np.zeros(len(rig.names)), ())
    every = [law for law in OF_KIND.get(rig.kind, ()) if shows(rig, law, base)]
    found = {name: tuple(law for law in every if law.id == name) for name in sorted(LAWS)}
    return {name: some for name, some in found.items() if some}


def candidates(pool: Mapping[str, Sequence[Law]], name: str, ids: Sequence[str]) -> list[Law]:
    """Laws of an id in the pool of a rig that can be followed beside laws of the other ids."""
    some = [law for law in pool.get(name, ()) if law.fits(ids)]
    return [law for law in some if law.average] if name == SHEAR and set(TOGETHER) <= set(ids) else some


def drawn(rng: np.random.Generator, rig: Rig, ids: Sequence[str]) -> World | None:
    """A law of each id with its knobs; None if the rig lacks any of them."""
    pool = laws_on(rig)
    if not set(ids) <= set(pool):
        return None
    world = []
    for name in ids:
        some = candidates(pool, name, ids)
        if not some:
            return None
        law = some[int(rng.integers(len(some)))]
        world.append(Followed(law, {knob.name: float(rng.uniform(*knob.typical)) for knob in law.knobs}))
    return tuple(world)
