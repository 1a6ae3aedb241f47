"""Laws in order, effects between them, and the check that every piece finds what it needs."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mixedlub.chain.effect import Effect
from profiles.errors import nearest

Law = Callable[..., Any]
Chain = tuple[tuple[str, Law], ...]
State = dict[str, Any]
Parameters = Mapping[str, Mapping[str, float]]


class ChainError(TypeError):
    """A law or effect asks for a quantity that nothing before it provides."""


@dataclass(frozen=True)
class Step:
    """One call: the law or effect, what it writes, what it reads, and whose parameters it takes."""

    outputs: tuple[str, ...]
    law: Law
    reads: tuple[str, ...]
    effect: str | None = None


class Model:
    """The chain with some effects switched on; calling it runs it.

    ``given`` names the quantities that come from outside, ``want`` those to be returned. Only steps that
    the wanted quantities depend on are run. The order is that of the chain; an effect acts as soon as the
    quantities it changes and reads exist, and must do so before a law reads the changed one.
    """

    def __init__(self, chain: Chain, given: Sequence[str], want: Sequence[str], effects: Sequence[Effect] = ()) -> None:
        self.want = tuple(want)
        self.effects = _in_order(effects)
        self.steps = _needed(_lay_out(chain, set(given), self.effects), self.want, set(given))

    def __call__(self, inputs: Mapping[str, Any], parameters: Parameters | None = None) -> State:
        """Run; ``parameters`` maps effect id to its values (its null where an effect is not named)."""
        state: State = dict(inputs)
        values = self._values(parameters)
        for step in self.steps:
            state.update(_call(step, state, values))
        return {name: state[name] for name in self.want}

    def record(
        self, inputs: Mapping[str, Any], parameters: Parameters | None = None, near: Record | None = None
    ) -> Record:
        """Run and keep every step; steps that nothing new reaches are taken from a run ``near`` by.

        The numbers are those of a full run to the last bit.
        """
        values = self._values(parameters)
        if near is None:
            changed_effects, dirty = set(values), set(inputs)
        else:
            changed_effects = {name for name, own in values.items() if own != near.values[name]}
            dirty = {name for name, value in inputs.items() if value is not near.inputs[name]}
        state: State = dict(inputs)
        made: list[State] = []
        for i, step in enumerate(self.steps):
            if step.effect in changed_effects or not dirty.isdisjoint(step.reads) or near is None:
                output = _call(step, state, values)
                dirty.update(step.outputs)
            else:
                output = near.made[i]
                dirty.difference_update(step.outputs)
            state.update(output)
            made.append(output)
        return Record(inputs, values, tuple(made), {name: state[name] for name in self.want})

    def _values(self, parameters: Parameters | None) -> dict[str, dict[str, float]]:
        values = {e.id: e.nulls for e in self.effects}
        values.update({k: {**values.get(k, {}), **v} for k, v in (parameters or {}).items()})
        return values


@dataclass(frozen=True, eq=False)
class Record:
    """A run with all its steps: what went in, what each step made, what was wanted."""

    inputs: Mapping[str, Any]
    values: Mapping[str, Mapping[str, float]]
    made: tuple[State, ...]
    wanted: State


def _call(step: Step, state: State, values: Mapping[str, Mapping[str, float]]) -> State:
    arguments = [state[name] for name in step.reads]
    if step.effect is None:
        return {step.outputs[0]: step.law(*arguments)}
    result = step.law(*arguments, **values[step.effect])
    return {step.outputs[0]: result} if len(step.outputs) == 1 else dict(zip(step.outputs, result, strict=True))


def available(effect: Effect, chain: Chain, given: Sequence[str], want: str, kind: str) -> bool:
    """Whether the effect finds all it reads in this chain and can change the wanted quantity."""
    if effect.kinds and kind not in effect.kinds:
        return False
    try:
        model = Model(chain, given, (want,), (effect,))
    except ChainError:
        return False
    return any(step.effect == effect.id for step in model.steps)


def _in_order(effects: Sequence[Effect]) -> tuple[Effect, ...]:
    """Effects sorted so that each comes behind those it names in ``after``."""
    waiting = sorted(effects, key=lambda e: e.id)
    ordered: list[Effect] = []
    while waiting:
        free = next((e for e in waiting if not any(_behind(e, other) for other in waiting)), None)
        if free is None:
            raise ChainError(f"effects wait for each other: {', '.join(e.id for e in waiting)}")
        ordered.append(free)
        waiting.remove(free)
    return tuple(ordered)


def _behind(one: Effect, other: Effect) -> bool:
    """Whether one effect declares to come after another on a quantity both change."""
    return other.id in one.after and bool(set(one.acts_on) & set(other.acts_on))


def _lay_out(chain: Chain, given: set[str], effects: Sequence[Effect]) -> list[Step]:
    known = set(given)
    produced = known | {name for name, _ in chain}
    for e in effects:
        for name in (*e.acts_on, *e.reads):
            if name not in produced:
                raise ChainError(f"effect {e.id!r} needs {name!r}, which this chain lacks; {nearest(name, produced)}")
    waiting = list(effects)
    steps: list[Step] = []
    already_read: set[str] = set()

    def admit() -> None:
        for e in list(waiting):
            if any(_behind(e, other) for other in waiting) or not known.issuperset((*e.acts_on, *e.reads)):
                continue
            late = already_read.intersection(e.acts_on)
            if late:
                raise ChainError(f"effect {e.id!r} would change {', '.join(late)} after a law has read it")
            steps.append(Step(e.acts_on, e.law, (*e.acts_on, *e.reads), e.id))
            waiting.remove(e)

    admit()
    for name, law in chain:
        reads = tuple(inspect.signature(law).parameters)
        _check(f"law for {name!r}", reads, known)
        already_read.update(reads)
        steps.append(Step((name,), law, reads))
        known.add(name)
        admit()
    return steps


def _check(who: str, reads: Sequence[str], known: set[str]) -> None:
    for name in reads:
        if name not in known:
            raise ChainError(f"{who} needs {name!r}, which nothing before it provides; {nearest(name, known)}")


def _needed(steps: list[Step], want: Sequence[str], given: set[str]) -> tuple[Step, ...]:
    """The steps that the wanted quantities depend on, by walking backwards."""
    made = given | {name for step in steps for name in step.outputs}
    for name in want:
        if name not in made:
            raise ChainError(f"nothing provides {name!r}; {nearest(name, made)}")
    wanted = set(want)
    kept: list[Step] = []
    for step in reversed(steps):
        if wanted.intersection(step.outputs):
            kept.append(step)
            wanted.update(step.reads)
    return tuple(reversed(kept))
