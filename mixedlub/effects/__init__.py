"""The catalogue of effects: one effect a file, read with those that other packages offer."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from mixedlub.chain.effect import REGISTRY, STAGES, Effect
from mixedlub.discovery import loaded
from profiles.errors import InputError, nearest


@cache
def catalogue() -> Mapping[str, Effect]:
    """Every effect by id: those of the package and those other packages offer as ``mixedlub.effects``."""
    loaded(__name__, "mixedlub.effects")
    order = sorted(REGISTRY.values(), key=lambda e: (STAGES.index(e.stage), e.id))
    return MappingProxyType({e.id: e for e in order})


@cache
def known_in(kind: str) -> Mapping[str, Effect]:
    """The catalogue with only those parameters that are free in a kind of recording."""
    return MappingProxyType(
        {
            e.id: e.holding({p.name: p.off for p in e.parameters if p.kinds and kind not in p.kinds})
            for e in catalogue().values()
        }
    )


def find(ids: list[str] | tuple[str, ...]) -> tuple[Effect, ...]:
    """Effects by id, or an error naming the nearest known one."""
    known = catalogue()
    for name in ids:
        if name not in known:
            raise InputError(f"no such effect; {nearest(name, known)}", where="effect", value=name)
    return tuple(known[name] for name in ids)


def page(effect_id: str) -> Effect:
    """One effect, which prints as its page; an error names the nearest known one.

    >>> import mixedlub as ml
    >>> print(repr(ml.effects.page("starvation")).splitlines()[0])
    starvation: Too little oil reaches the inlet above a certain viscosity times speed, and the film falls behind.
    """
    return find((effect_id,))[0]


__all__ = ["Effect", "catalogue", "find", "known_in", "page"]
