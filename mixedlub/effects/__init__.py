"""The catalogue of effects: one per module, and the effects of installed plug-ins."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

from mixedlub.chain.effect import EFFECTS, Effect
from mixedlub.chain.model import Chain, available
from profiles.errors import InputError, nearest


def catalogue() -> Mapping[str, Effect]:
    """All effects by id: this package and plug-ins of the entry point ``mixedlub.effects``."""
    return EFFECTS.all


@cache
def known_in(kind: str) -> Mapping[str, Effect]:
    """The catalogue with only those parameters that are free in a kind of recording."""
    return MappingProxyType(
        {
            e.id: e.fixing({p.name: p.null_value for p in e.parameters if p.kinds and kind not in p.kinds})
            for e in catalogue().values()
        }
    )


NO_LAWS: Mapping[str, Effect] = MappingProxyType({})
"""Laws of a user who has none."""


def find(
    ids: str | list[str] | tuple[str, ...], where: str = "effect", laws: Mapping[str, Effect] = NO_LAWS
) -> tuple[Effect, ...]:
    """Effects by one id or several, of the catalogue or of a user's ``laws``.

    An unknown id raises an error that names the nearest and the place ``where``.
    """
    names = (ids,) if isinstance(ids, str) else ids
    return tuple(laws[one] if isinstance(one, str) and one in laws else EFFECTS.find(one, where) for one in names)


def page(effect_id: str) -> Effect:
    """One effect; printing it shows its page. An unknown id raises an error that names the nearest known one.

    >>> import mixedlub as ml
    >>> print(repr(ml.effects.page("starvation")).splitlines()[0])
    starvation: Above a certain viscosity times speed the inlet lacks oil; the film
    """
    return find((effect_id,))[0]


LAW, SD = "law", "_sd"
"""Key of a published law, and end of the key of a standard deviation, in the section ``[effects]`` of a file."""


@dataclass(frozen=True)
class Known:
    """Effects that a file takes as known: parameter values by effect, and standard deviations by effect and name."""

    effects: tuple[Effect, ...]
    values: Mapping[str, Mapping[str, float]]
    sds: Mapping[tuple[str, str], float]


def known_effects(
    section: Mapping[str, Mapping[str, float | str]],
    kind: str,
    chain: Chain,
    given: Sequence[str],
    want: str,
    laws: Mapping[str, Effect] = NO_LAWS,
) -> Known:
    """The effects of a section ``[effects]`` in a chain; omitted parameters have the values of a published law, or of
    the chain and the other effects where they depend on them.

    ``law`` names a published law in the effect and fixes its parameters; the default is the first law. NAME_sd is the
    standard deviation of the parameter NAME. ``laws``: laws of the user.
    """
    own = {**known_in(kind), **laws}
    effects = tuple(own[e.id] for e in find(sorted(section), "effects", laws))
    _refuse_second_law(effects)
    values: dict[str, dict[str, float]] = {}
    sds: dict[tuple[str, str], float] = {}
    for e in effects:
        if not available(e, chain, given, want, kind):
            lacking = [name.replace("_", " ") for name in e.reads if name not in (*given, *dict(chain))]
            rule = f"cannot act on the {want.replace('_', ' ')} of a {kind.replace('_', ' ')}"
            rule += f"; it needs {', '.join(lacking)}, which these columns and keys do not give" if lacking else ""
            raise InputError(rule, where=f"effects.{e.id}")
        law = section[e.id].get(LAW)
        fixed = _of_law(e, law)
        values[e.id] = e.law_values("" if law is None else str(law))
        for key, value in section[e.id].items():
            name = key.removesuffix(SD)
            where = f"effects.{e.id}.{key}"
            if key == LAW:
                continue
            if name not in values[e.id]:
                names = (*values[e.id], *([LAW] if e.special_cases else []))
                rule = f"no such parameter of {e.id}; {nearest(name, names)}"
                raise InputError(rule, where=f"effects.{e.id}", value=key)
            if isinstance(value, str):
                raise InputError("must be a number", where=where, value=value)
            if name in fixed:
                raise InputError(f"the law {section[e.id][LAW]!r} fixes it; leave one of them out", where=where)
            if value < 0 and (key != name or _is_positive(e, name)):
                raise InputError("must not be negative", where=where, value=value)
            if key == name:
                values[e.id][name] = float(value)
            elif value > 0:
                sds[e.id, name] = float(value)
    for e in effects:
        for p in e.parameters:
            if p.of_chain is not None and p.name not in section[e.id]:
                values[e.id][p.name] = p.of_chain(chain, effects, values)
    return Known(effects, values, sds)


def _refuse_second_law(effects: Sequence[Effect]) -> None:
    """Refuse two effects that replace the same step."""
    by_step: dict[str, Effect] = {}
    for e in effects:
        first = by_step.setdefault(e.replaces or e.id, e)
        if first is not e:
            rule = f"and effects.{first.id} are two laws of one step, the {e.replaces}; leave one of them out"
            raise InputError(rule, where=f"effects.{e.id}")


def _of_law(e: Effect, law: float | str | None) -> dict[str, float]:
    """Free parameters that a published law fixes."""
    if law is None:
        return {}
    if law not in e.special_cases:
        raise InputError(
            f"no such law of {e.id}; {nearest(str(law), e.special_cases)}", where=f"effects.{e.id}", value=law
        )
    return {name: value for name, value in e.special_cases[str(law)].items() if name in e.prior_medians}


def _is_positive(e: Effect, name: str) -> bool:
    """Whether the prior of a parameter excludes negative values."""
    return next(p.prior.value(-math.inf) for p in e.parameters if p.name == name) >= 0.0


__all__ = ["Effect", "catalogue", "find", "known_in", "page"]
