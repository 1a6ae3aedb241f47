"""Discovery of declarations in the modules of a package and in other packages, so that each part is one file."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from importlib.metadata import entry_points
from typing import Any

from profiles.errors import InputError


def offered(group: str) -> list[Any]:
    """Modules or objects of other packages under a group of entry points."""
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
    """Import and return the modules of a package by name, then the entry points of other packages."""
    own = pkgutil.iter_modules(importlib.import_module(package).__path__)
    return [*(importlib.import_module(f"{package}.{module.name}") for module in own), *offered(group)]


@cache
def declared(package: str, group: str, name: str) -> tuple[Any, ...]:
    """Objects of a given name in modules of a package and entry points; their ``name`` must be unique.

    An entry point may be the object itself.

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
