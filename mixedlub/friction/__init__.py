"""Catalogue of friction laws: a published formula per module, and laws of plug-ins."""

from __future__ import annotations

from collections.abc import Mapping

from mixedlub.chain.friction_law import BASE, FRICTION_LAWS, PLACES, FrictionLaw


def catalogue() -> Mapping[str, FrictionLaw]:
    """All friction laws by name: base model, laws of contact points, laws of a mesh."""
    return FRICTION_LAWS.all


def find(name: str, where: str = "NAME") -> FrictionLaw:
    """Friction law by name; the error for an unknown name gives the nearest known name.

    >>> import mixedlub as ml
    >>> print(repr(ml.friction.find("misharin")).splitlines()[0])
    misharin: Friction coefficient of rolling and sliding discs (-), from speeds and
    """
    return FRICTION_LAWS.find(name, where)


__all__ = ["BASE", "PLACES", "FrictionLaw", "catalogue", "find"]
