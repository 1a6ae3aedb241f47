"""The catalogue of effects: one per module, with those of installed plug-ins."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from mixedlub.chain.effect import REGISTRY, STAGES, Effect
from mixedlub.discovery import loaded
from profiles.errors import InputError, nearest


@cache
def catalogue() -> Mapping[str, Effect]:
    """All effects by id: those of this package and plug-ins of the entry point ``mixedlub.effects``."""
    loaded(__name__, "mixedlub.effects")
    order = sorted(REGISTRY.values(), key=lambda e: (STAGES.index(e.stage), e.id))
    return MappingProxyType({e.id: e for e in order})


@cache
def known_in(kind: str) -> Mapping[str, Effect]:
    """The catalogue with only those parameters that are free in a kind of recording."""
    return MappingProxyType(
        {
            e.id: e.fixing({p.name: p.null_value for p in e.parameters if p.kinds and kind not in p.kinds})
            for e in catalogue().values()
        }
    )


def find(ids: list[str] | tuple[str, ...]) -> tuple[Effect, ...]:
    """Effects by id; an unknown id raises an error that names the nearest known one."""
    known = catalogue()
    for name in ids:
        if name not in known:
            raise InputError(f"no such effect; {nearest(name, known)}", where="effect", value=name)
    return tuple(known[name] for name in ids)


def page(effect_id: str) -> Effect:
    """One effect; printing it shows its page. An unknown id raises an error that names the nearest known one.

    >>> import mixedlub as ml
    >>> print(repr(ml.effects.page("starvation")).splitlines()[0])
    starvation: Above a certain viscosity times speed the inlet lacks oil; the film
    """
    return find((effect_id,))[0]


__all__ = ["Effect", "catalogue", "find", "known_in", "page"]
