"""Power loss by origin: contribution of each effect outside the mesh."""

from __future__ import annotations

import copy
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Law, Model
from mixedlub.study.columns import loss_of

TOTAL = "power_loss"


def losing(effects: Iterable[Effect]) -> tuple[str, ...]:
    """Effects that add a loss outside the mesh."""
    return tuple(e.id for e in effects if e.acts_on == (TOTAL,))


def by_origin(model: Model) -> Model:
    """The model with additional outputs: the loss of each effect outside the mesh."""
    part = copy.copy(model)
    part.steps = tuple(
        replace(step, outputs=(*step.outputs, loss_of(step.effect)), law=_with_growth(step.law))
        if step.effect and step.outputs == (TOTAL,)
        else step
        for step in model.steps
    )
    part.want = (*model.want, *(name for step in part.steps for name in step.outputs[1:] if step.outputs[0] == TOTAL))
    return part


def _with_growth(law: Law) -> Law:
    """An effect on the total that also returns its change of the total.

    >>> _with_growth(lambda total, more, *, strength: total + strength * more)(100.0, 2.0, strength=3.0)
    (106.0, 6.0)
    """

    def both(total: Any, *read: Any, **parameters: float) -> tuple[Any, Any]:
        found = law(total, *read, **parameters)
        return found, found - total

    return both
