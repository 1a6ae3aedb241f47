"""What the files of a package declare and what other packages offer: a part is added by adding one file."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from importlib.metadata import entry_points
from typing import Any

from profiles.errors import InputError


def offered(group: str) -> list[Any]:
    """What other packages offer under a group of entry points: modules, or objects in them."""
    found = []
    for point in entry_points(group=group):
        try:
            found.append(point.load())
        except (ImportError, AttributeError) as error:
            raise InputError(
                f"cannot be loaded ({error})", where=f"entry point of {group}", value=point.value
            ) from None
    return found


def loaded(package: str, group: str) -> list[Any]:
    """The modules of a package by name, then what other packages offer; all are imported."""
    own = pkgutil.iter_modules(importlib.import_module(package).__path__)
    return [*(importlib.import_module(f"{package}.{module.name}") for module in own), *offered(group)]


@cache
def declared(package: str, group: str, name: str) -> tuple[Any, ...]:
    """The objects that modules of a package, or offered ones, hold under this name; each has a name of its own.

    An entry point may lead to the object itself.

    >>> [kind.name for kind in declared("mixedlub.kinds", "mixedlub.kinds", "KIND")][:2]
    ['disc', 'film']
    """
    every = (getattr(one, name, one) for one in loaded(package, group))
    found = [one for one in every if hasattr(one, "name")]
    names = [one.name for one in found]
    for one in names:
        if names.count(one) > 1:
            raise InputError("is declared twice; rename one of the two", where=group, value=one)
    return tuple(found)
