"""Rigs that follow other published laws than the base model's, one module a step.

A law takes the place of a step of the base chain and adds nothing to it. Each is written from its paper, with formula,
source and range; what a paper leaves open is drawn as a knob. The laws of a rig are put in place before anything else
happens, so that planted effects act in the world that they make.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Act, Knob

FILM, ASPERITIES, BALANCE, MIXTURE, SHEAR, SHARING, PRESSURE, TEMPERATURE = (
    "film_law",
    "asperity_law",
    "load_balance",
    "mixture_law",
    "shear_law",
    "load_sharing_law",
    "pressure_viscosity_law",
    "viscosity_temperature_law",
)
LAWS = frozenset({FILM, ASPERITIES, BALANCE, MIXTURE, SHEAR, SHARING, PRESSURE, TEMPERATURE})
"""Steps of the base chain, by the ids of their laws."""


@dataclass(frozen=True)
class Law:
    """A published law of the step ``id``; ``enter`` puts it in the place of the base law of a state.

    ``needs`` are steps that must follow another law too, ``bars`` those that must not. An ``average`` of traction over
    the contact is marked as one.
    """

    id: str
    name: str
    source: str
    enter: Callable[..., Any]
    knobs: tuple[Knob, ...] = ()
    needs: frozenset[str] = frozenset()
    bars: frozenset[str] = frozenset()
    average: bool = False

    def fits(self, steps: Collection[str]) -> bool:
        """Whether the law can be followed where these steps follow another law."""
        return self.needs <= set(steps) and not self.bars & set(steps)

    def act(self, values: Mapping[str, float]) -> Act:
        return Act("oil", lambda state: self.enter(state, **values))

    @property
    def middle(self) -> dict[str, float]:
        """Its knobs at the middle of what is drawn."""
        return {knob.name: 0.5 * sum(knob.typical) for knob in self.knobs}


def follow(c: Contact, step: str, law: Callable[..., Any]) -> Contact:
    """The contact of a rig that follows a law at one step."""
    return replace(c, rig=replace(c.rig, laws={**c.rig.laws, step: law}))
