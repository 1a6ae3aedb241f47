"""The model: laws in order, effects between them, and the check that every input exists."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from mixedlub.chain.effect import Effect
from profiles.errors import nearest

Law = Callable[..., Any]
Chain = tuple[tuple[str, Law], ...]
State = dict[str, Any]
Parameters = Mapping[str, Mapping[str, float]]


class ChainError(TypeError):
    """A law or effect reads a quantity that no earlier step provides."""


@dataclass(frozen=True)
class Step:
    """A call of a law, or of an effect with its parameters: outputs, inputs, and id of the effect."""

    outputs: tuple[str, ...]
    law: Law
    reads: tuple[str, ...]
    effect: str | None = None


class Model:
    """The chain with some effects switched on.

    ``given``: input quantities. ``want``: returned quantities. Only steps on which the wanted quantities depend are
    run, in the order of the chain; an effect acts as soon as the quantities it changes and reads exist, which must be
    before a law reads the changed quantity.
    """

    def __init__(self, chain: Chain, given: Sequence[str], want: Sequence[str], effects: Sequence[Effect] = ()) -> None:
        self.given = tuple(given)
        self.want = tuple(want)
        self.effects = _in_order(effects)
        self.steps = _needed(_lay_out(chain, set(given), self.effects), self.want, set(given))
        self._nulls = {e.id: e.nulls for e in self.effects}
        self._affected: dict[frozenset[int | str], tuple[_Call, ...]] = {}

    def __call__(self, inputs: Mapping[str, Any], parameters: Parameters | None = None) -> State:
        """Run the model; ``parameters``: values by effect id, by default the nulls of the effect."""
        state: State = dict(inputs)
        values = self._values(parameters)
        for step in self.steps:
            result = _result(step, [state[name] for name in step.reads], values)
            state.update(zip(step.outputs, (result,) if len(step.outputs) == 1 else result, strict=True))
        return {name: state[name] for name in self.want}

    def record(
        self, inputs: Mapping[str, Any], parameters: Parameters | None = None, near: Record | None = None
    ) -> Record:
        """Run the model and keep every quantity; unaffected steps are taken from a previous run ``near``.

        The numbers equal a full run to the last bit, except those of a law with a method ``near``: it is called with
        the arguments, the previous arguments and the previous result, and may approximate.
        """
        values = self._values(parameters)
        given = [inputs[name] for name in self.given]
        if near is None:
            made, calls = [*given, *[None] * (self._slots - len(given))], self._calls
        else:
            made = near.made.copy()
            made[: len(given)] = given
            changed = [i for i, value in enumerate(given) if value is not near.made[i]]
            changed_effects = [name for name, own in values.items() if own != near.values[name]]
            calls = self._reached_by(frozenset([*changed, *changed_effects]))
        for call in calls:
            arguments = [made[i] for i in call.reads]
            close = None if near is None or call.effect else getattr(call.law, "near", None)
            if close is not None and near is not None:
                result = close(arguments, [near.made[i] for i in call.reads], near.made[call.writes[0]])
            else:
                result = _result(call, arguments, values)
            if len(call.writes) == 1:
                made[call.writes[0]] = result
            else:
                for i, own in zip(call.writes, result, strict=True):
                    made[i] = own
        return Record(self, values, made)

    @cached_property
    def _calls(self) -> tuple[_Call, ...]:
        """Steps with a separate slot for every value, so that no value is overwritten."""
        latest = {name: i for i, name in enumerate(self.given)}
        calls = []
        count = len(latest)
        for step in self.steps:
            reads = tuple(latest[name] for name in step.reads)
            writes = tuple(range(count, count + len(step.outputs)))
            latest.update(zip(step.outputs, writes, strict=True))
            calls.append(_Call(step.law, reads, writes, step.effect))
            count += len(writes)
        return tuple(calls)

    @cached_property
    def latest(self) -> dict[str, int]:
        """Slot of the last value of each quantity."""
        found = {name: i for i, name in enumerate(self.given)}
        for step, call in zip(self.steps, self._calls, strict=True):
            found.update(zip(step.outputs, call.writes, strict=True))
        return found

    @cached_property
    def _slots(self) -> int:
        return len(self.given) + sum(len(call.writes) for call in self._calls)

    def _reached_by(self, changed: frozenset[int | str]) -> tuple[_Call, ...]:
        """Steps affected by changed slots or effects."""
        if changed not in self._affected:
            dirty, found = set(changed), []
            for call in self._calls:
                if call.effect in changed or not dirty.isdisjoint(call.reads):
                    dirty.update(call.writes)
                    found.append(call)
            self._affected[changed] = tuple(found)
        return self._affected[changed]

    def _values(self, parameters: Parameters | None) -> dict[str, Mapping[str, float]]:
        given = parameters or {}
        return {name: {**nulls, **given[name]} if name in given else nulls for name, nulls in self._nulls.items()}


@dataclass(frozen=True)
class _Call:
    """A step with its input and output slots."""

    law: Law
    reads: tuple[int, ...]
    writes: tuple[int, ...]
    effect: str | None


def _result(call: Step | _Call, arguments: Sequence[Any], values: Mapping[str, Mapping[str, float]]) -> Any:
    return call.law(*arguments, **values[call.effect]) if call.effect else call.law(*arguments)


@dataclass(frozen=True, eq=False)
class Record:
    """A run of a model: parameter values, and every given or computed value by slot."""

    model: Model
    values: Mapping[str, Mapping[str, float]]
    made: list[Any]

    def __getitem__(self, name: str) -> Any:
        """Last value of a quantity."""
        return self.made[self.model.latest[name]]

    @property
    def state(self) -> State:
        """Last value of every quantity."""
        return {name: self.made[i] for name, i in self.model.latest.items()}


def available(effect: Effect, chain: Chain, given: Sequence[str], want: str, kind: str) -> bool:
    """Whether the chain provides all inputs of the effect and the effect can change the wanted quantity."""
    if effect.kinds and kind not in effect.kinds:
        return False
    if not {*given, *(name for name, _ in chain)}.issuperset((*effect.acts_on, *effect.reads)):
        return False
    try:
        model = Model(chain, given, (want,), (effect,))
    except ChainError:
        return False
    return any(step.effect == effect.id for step in model.steps)


def _in_order(effects: Sequence[Effect]) -> tuple[Effect, ...]:
    """Effects sorted by ``applied_after``."""
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
    """Whether an effect must be applied after another on a quantity changed by both."""
    return other.id in one.applied_after and bool(set(one.acts_on) & set(other.acts_on))


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
        reads = _arguments(law)
        _check(f"law for {name!r}", reads, known)
        already_read.update(reads)
        steps.append(Step((name,), law, reads))
        known.add(name)
        admit()
    return steps


@lru_cache(maxsize=1024)
def _arguments(law: Law) -> tuple[str, ...]:
    return tuple(inspect.signature(law).parameters)


def _check(who: str, reads: Sequence[str], known: set[str]) -> None:
    for name in reads:
        if name not in known:
            raise ChainError(f"{who} needs {name!r}, which nothing before it provides; {nearest(name, known)}")


def _needed(steps: list[Step], want: Sequence[str], given: set[str]) -> tuple[Step, ...]:
    """Steps on which the wanted quantities depend, by a backward pass."""
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
