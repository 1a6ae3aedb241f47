"""The catalogue of friction laws: one published formula a module, with those of installed plug-ins."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from mixedlub.chain.friction_law import PLACES, REGISTRY, FrictionLaw
from mixedlub.schema.discovery import loaded
from profiles.errors import InputError, nearest

BASE = "tallian_mixture"
"""The friction of the base model."""


@cache
def catalogue() -> Mapping[str, FrictionLaw]:
    """All friction laws by name, that of the base model first, then those of contact points, then those of a mesh."""
    loaded(__name__, "mixedlub.friction")
    places = list(PLACES)
    order = sorted(REGISTRY.values(), key=lambda law: (law.name != BASE, places.index(law.place), law.name))
    return MappingProxyType({law.name: law for law in order})


def find(name: str, where: str = "NAME") -> FrictionLaw:
    """A friction law by name; an unknown one raises an error with the nearest known name.

    >>> import mixedlub as ml
    >>> print(repr(ml.friction.find("misharin")).splitlines()[0])
    misharin: Friction coefficient of rolling and sliding discs (-), from speeds and
    """
    known = catalogue()
    if name not in known:
        raise InputError(f"no such friction law; {nearest(name, known)}", where=where, value=name)
    return known[name]


__all__ = ["PLACES", "FrictionLaw", "catalogue", "find"]
