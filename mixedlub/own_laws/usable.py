"""Checks of a law of the user in a model: its quantities exist in time, and its values are finite."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import signature
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Chain, ChainError, Model
from mixedlub.chain.ranges import beyond
from mixedlub.own_laws.law import FileLaw
from profiles.errors import InputError, nearest

ABSENT = "has no such quantity"
"""Part of the message on a quantity that a model lacks."""
TRIED = (-2.0, 0.0, 2.0)
"""Standard deviations from the prior median at which each parameter is tried."""


def check_usable(law: Effect, chain: Chain, inputs: Mapping[str, Any], want: str, model_of: str) -> None:
    """Raise an error for a law that cannot act on the wanted quantity of a model, or has no finite value in its range.

    ``model_of``: the model in words, for the message.
    """
    own = law.law
    assert isinstance(own, FileLaw)
    where, made = f"{own.path}", {*inputs, *(name for name, _ in chain)}
    for name in own.arguments:
        if name not in made:
            key = "acts_on" if name in law.acts_on else "expression"
            rule = f"the model of a {model_of} {ABSENT}; {nearest(name, made)}"
            raise InputError(rule, where=f"{where}: {key}", value=name)
    for name in law.valid:
        if name not in made:
            rule = f"the model of a {model_of} {ABSENT}; {nearest(name, made)}"
            raise InputError(rule, where=f"{where}: range", value=name)
    changed = law.acts_on[0]
    try:
        model = Model(chain, tuple(inputs), (want,), (law,))
    except ChainError:
        rule = f"is cyclic: {', '.join(_late(law, chain))} exists only after {changed} is used"
        raise InputError(rule, where=f"{where}: expression", value=own.file.expression) from None
    if not any(step.effect == law.id for step in model.steps):
        rule = f"the {want.replace('_', ' ')} of a {model_of} does not depend on it"
        raise InputError(rule, where=f"{where}: acts_on", value=changed)
    base = Model(chain, tuple(inputs), tuple(dict.fromkeys((*own.arguments, *law.valid, want))))(inputs)
    within = np.asarray(~beyond(base, law.valid)) if law.valid else np.ones(1, bool)
    for values in _tried(law):
        with np.errstate(all="ignore"):
            found = own.expression_at(base, values)
        _refuse_infinite(law, found, base, within, values)
    with np.errstate(all="ignore"):
        result = np.asarray(Model(chain, tuple(inputs), (want,), (law,))(inputs)[want])
        unchanged = np.asarray(own(*(base[name] for name in own.arguments), **law.nulls))
    if np.ndim(result) > 1 and result.shape[-1] > 1 and np.shape(base[want])[-1] == 1:
        rule = f"varies along the path of contact, and {changed} is one number a row"
        raise InputError(rule, where=f"{where}: expression", value=own.file.expression)
    off = any(p.null is not None for p in law.parameters)
    if off and not np.all(unchanged == base[changed]):
        nulls = ", ".join(f"{p.name} = {p.null:g}" for p in law.parameters if p.null is not None)
        rule = f"must leave {changed} as it is at {nulls}: correct null, or leave it out"
        raise InputError(rule, where=f"{where}: parameters", value=own.file.expression)


def _late(law: Effect, chain: Chain) -> list[str]:
    """Quantities that a law reads and that exist only after the quantity it changes is used."""
    used = next(i for i, (_, step) in enumerate(chain) if law.acts_on[0] in signature(step).parameters)
    return [name for name, _ in chain[used:] if name in law.reads]


def _tried(law: Effect) -> list[dict[str, float]]:
    """Parameter values at which a law must be finite: as stated, and each parameter through its prior."""
    stated = law.law_values()
    every = [{**law.fixed, **stated}]
    for p in law.parameters:
        every += [{**law.fixed, **stated, p.name: p.prior.value(z)} for z in TRIED]
    return every


def _refuse_infinite(
    law: Effect, found: np.ndarray, state: Mapping[str, Any], within: np.ndarray, values: Mapping[str, float]
) -> None:
    own = law.law
    assert isinstance(own, FileLaw)
    bad = ~np.isfinite(found) & within
    if not bad.any():
        return
    place = tuple(int(i[0]) for i in np.nonzero(bad))
    at = {name: float(np.broadcast_to(state[read.argument], bad.shape)[place]) for name, read in own.reads.items()}
    shown = {name: (at[name] - read.added) / read.factor for name, read in own.reads.items()} | dict(values)
    text = ", ".join(f"{name} = {value:.4g}" for name, value in shown.items())
    rule = f"is not finite in its range, at {text}; a range that leaves this out, or another form, is needed"
    raise InputError(rule, where=f"{own.path}: expression", value=own.file.expression)
