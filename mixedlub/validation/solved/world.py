"""Rigs of full physics: film and friction solved contact by contact, with or without something concealed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from mixedlub.validation.contact import Contact, Inputs, calibrated, dowson_toyoda, sheared, thick
from mixedlub.validation.planted import FORMS
from mixedlub.validation.rig import FILM, SHEAR, Form, Knob, Law, Rig
from mixedlub.validation.rigs import discs, gears
from mixedlub.validation.solved.fluid import carreau, eyring, limited
from mixedlub.validation.solved.solver import UnsolvedError
from mixedlub.validation.solved.table import Physics, Table, table
from mixedlub.validation.worlds import follow
from mixedlub.validation.worlds.catalogue import Followed, World, following
from mixedlub.validation.worlds.mixed import BALANCES
from mixedlub.validation.worlds.traction import li_kahraman
from profiles.errors import InputError

SOURCE = "full solutions of the generator"
ALWAYS = ("gear_pair", "disc")
MOST_RIGS = 20
"""Rigs that are drawn until every contact has a solution."""
NOTHING, THERMAL, STARVED, LIMITED, RHEOLOGY, LOADS, WINDAGE, BEARINGS = (
    "nothing",
    "thermal",
    "starved",
    "limited",
    "rheology",
    "balance",
    "windage",
    "bearings",
)


@dataclass(frozen=True)
class Switch:
    """Something concealed in a rig of full physics: kinds of rig, its effect, and effects that it brings along.

    ``weight``: share in the deck. ``contained``: part of the full base, so dealt with the formulas as base alone.
    """

    effect: str = ""
    beside: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ALWAYS
    weight: float = 1.0
    contained: bool = False


SWITCHES: Mapping[str, Switch] = {
    NOTHING: Switch(weight=2.0),
    THERMAL: Switch("film_heating", ("inlet_shear_heating",), contained=True),
    STARVED: Switch("starvation"),
    LIMITED: Switch("limiting_shear_stress"),
    RHEOLOGY: Switch(),
    LOADS: Switch(),
    WINDAGE: Switch("windage", kinds=("gear_pair",)),
    BEARINGS: Switch("bearing_drag", kinds=("gear_pair",)),
}


def _film(c: Contact, solved: Table) -> Contact:
    base = dowson_toyoda(c)
    return replace(base, film=base.film * np.exp(solved.at(c)[0]))


def _stress(c: Contact, warmer: np.ndarray | float = 0.0, *, solved: Table) -> np.ndarray:
    return np.asarray(sheared(c, thick(c, warmer)) * np.exp(solved.at(c)[1]))


def laws_of(solved: Table, name: str) -> World:
    """Laws of film and shear of a rig that follows solutions."""
    film = Law(FILM, name, SOURCE, lambda c: follow(c, "film", partial(_film, solved=solved)))
    stress = Law(SHEAR, name, SOURCE, lambda c: follow(c, "shear", partial(_stress, solved=solved)), average=True)
    return (Followed(film, {}), Followed(stress, {}))


def switched(effect: str, base: Table, other: Table) -> Form:
    """Difference of two solutions of a rig as an effect on its film and stress."""

    def solved(c: Contact, strength: float) -> Contact:
        """Film and stress of the solutions with the effect, over those without."""
        (film, stress), (film_0, stress_0) = other.at(c), base.at(c)
        law: Callable[..., Any] = c.rig.laws["shear"]
        more = np.exp(strength * (stress - stress_0))
        thinned = replace(c, film=c.film * np.exp(strength * (film - film_0)))
        return follow(thinned, "shear", lambda state, warmer=0.0: law(state, warmer) * more)

    return Form(effect, "film", solved, (Knob("strength", 0.0, 2.0, (1.0, 1.0)),), SOURCE, rigid=True)


def physics_of(
    rng: np.random.Generator, switch: str, rig: Inputs, scale: float, base: Physics, known: Table
) -> Physics:
    """Physics of a rig with something switched on; ``scale``: the oil's Eyring stress (Pa)."""
    law = base.law or eyring(scale)
    if switch == THERMAL:
        return replace(base, thermal=True)
    if switch == STARVED:
        return replace(base, inlet=float(rng.uniform(1.1, 1.3)))
    if switch == LIMITED:
        most = float(np.quantile(known.friction, 0.95)) * rng.uniform(0.5, 0.75)
        return replace(base, law=limited(law, most))
    if switch == RHEOLOGY:
        if rng.random() < 0.5:
            return replace(base, law=carreau(scale, float(rng.uniform(0.3, 0.5))))
        grown = li_kahraman(np.array(5e8))
        return replace(
            base, law=eyring(lambda p: scale * li_kahraman(np.maximum(p, 0.0)) / grown, "stress of pressure")
        )
    return base


def inputs_of(rig: Rig) -> Inputs:
    return gears.inputs_of(rig, gears.COARSE) if rig.kind == "gear_pair" else discs.inputs_of(rig)


def draw(
    rng: np.random.Generator, kind: str, switch: str, full_base: bool
) -> tuple[Rig, World, tuple[Form, ...], np.ndarray]:
    """A rig of full physics with something switched on: rig, laws, planted effects and calibration.

    The base has Eyring's law without heat, or with heat if the case declares full solutions as its base. A rig with a
    contact that has no solution is drawn again.
    """
    for _ in range(MOST_RIGS):
        with suppress(UnsolvedError):
            return _drawn(rng, kind, switch, full_base)
    raise InputError("every rig has a contact without solution", where=kind, value=switch)


def _drawn(
    rng: np.random.Generator, kind: str, switch: str, full_base: bool
) -> tuple[Rig, World, tuple[Form, ...], np.ndarray]:
    room = gears if kind == "gear_pair" else discs
    case = room.draw_case(rng, coated=False)
    if full_base:
        case = replace(case, settings={**case.settings, "base": "full_solution"})
    rig = room.rig_of(case)
    z = rng.standard_normal(len(rig.names))
    inputs, calibration = inputs_of(rig), calibrated(rig.settings, z)
    scale = inputs.oil.eyring_stress * calibration.eyring_stress
    base = Physics(thermal=full_base)
    known = table(inputs, calibration, base)
    world, forms = laws_of(known, "full solution"), _planted(rng, switch)
    other = physics_of(rng, switch, inputs, scale, base, known)
    if other != base:
        solved = table(inputs, calibration, other)
        effect = SWITCHES[switch].effect
        forms = (switched(effect, known, solved),) if effect else ()
        world = world if effect else laws_of(solved, f"full solution, {other.law.name if other.law else SOURCE}")
    if switch == LOADS:
        world = (*world, Followed(BALANCES[0], {}))
    return following(rig, world), world, forms, z


def _planted(rng: np.random.Generator, switch: str) -> tuple[Form, ...]:
    """A published form of the effect of a gearbox."""
    if switch not in (WINDAGE, BEARINGS):
        return ()
    some = [form for form in FORMS[SWITCHES[switch].effect] if form.rarity > 0]
    return (some[int(rng.integers(len(some)))],)
