"""The catalogue of friction laws: one published formula a module, with those of installed plug-ins."""

from __future__ import annotations

from collections.abc import Mapping

from mixedlub.chain.friction_law import BASE, FRICTION_LAWS, PLACES, FrictionLaw


def catalogue() -> Mapping[str, FrictionLaw]:
    """All friction laws by name, that of the base model first, then those of contact points, then those of a mesh."""
    return FRICTION_LAWS.all


def find(name: str, where: str = "NAME") -> FrictionLaw:
    """A friction law by name; an unknown one raises an error with the nearest known name.

    >>> import mixedlub as ml
    >>> print(repr(ml.friction.find("misharin")).splitlines()[0])
    misharin: Friction coefficient of rolling and sliding discs (-), from speeds and
    """
    return FRICTION_LAWS.find(name, where)


__all__ = ["BASE", "PLACES", "FrictionLaw", "catalogue", "find"]
