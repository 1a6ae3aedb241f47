"""What every rig has: a programme, a base model that calibration moves, and the effects that can be planted on it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

FILM, ASPERITIES, BALANCE, MIXTURE, SHEAR, SHARING, PRESSURE, TEMPERATURE = (
    "film_law",
    "asperity_law",
    "load_balance",
    "mixture_law",
    "shear_law",
    "load_sharing_law",
    "pressure_viscosity_law",
    "viscosity_temperature_law",
)
LAWS = frozenset({FILM, ASPERITIES, BALANCE, MIXTURE, SHEAR, SHARING, PRESSURE, TEMPERATURE})
"""Steps of the base chain, by the ids of their laws."""


@dataclass(frozen=True)
class Knob:
    """One parameter of a planted law: bounds of a rival fit (``low`` to ``high``) and the range that is drawn."""

    name: str
    low: float
    high: float
    typical: tuple[float, float]


def strength(low: float, high: float, typical: tuple[float, float] = (0.7, 1.4)) -> Knob:
    return Knob("strength", low, high, typical)


@dataclass(frozen=True)
class Act:
    """One effect at work: the stage after which it acts, and a function of the state alone."""

    stage: str
    act: Callable[[Any], Any]


@dataclass(frozen=True)
class Law:
    """A published law of the step ``id``; ``enter`` puts it in the place of the base law of a state.

    ``needs`` are steps that must follow another law too, ``bars`` those that must not. An ``average`` of traction over
    the contact is marked as one.
    """

    id: str
    name: str
    source: str
    enter: Callable[..., Any]
    knobs: tuple[Knob, ...] = ()
    needs: frozenset[str] = frozenset()
    bars: frozenset[str] = frozenset()
    average: bool = False

    def fits(self, steps: Collection[str]) -> bool:
        """Whether the law can be followed where these steps follow another law."""
        return self.needs <= set(steps) and not self.bars & set(steps)

    def act(self, values: Mapping[str, float]) -> Act:
        return Act("oil", lambda state: self.enter(state, **values))

    @property
    def middle(self) -> dict[str, float]:
        """Its knobs at the middle of what is drawn."""
        return {knob.name: 0.5 * sum(knob.typical) for knob in self.knobs}


@dataclass(frozen=True)
class Form:
    """One published form of an effect, acting after the stage ``hook``; its first knob is the strength, absent at zero.

    ``rarity`` is the weight of the effect when effects are drawn; a form of rarity 0 is only a rival.
    ``rank`` is how general a form is: a form that contains simpler effects as special cases is no rival to them.
    ``rigid`` forms have one size, as a miscounted fringe has. ``within``: the catalogue's law of the same
    effect can become this one, at some values of its parameters or in their limit. ``holds`` is the range that its
    source states; the formula is in the docstring of the law.
    """

    id: str
    hook: str
    law: Callable[..., Any]
    knobs: tuple[Knob, ...]
    source: str
    rank: int = 0
    rigid: bool = False
    rarity: float = 1.0
    within: bool = False
    holds: str = ""

    def hide(self, values: Mapping[str, float]) -> Act:
        return Act(self.hook, lambda state: self.law(state, **values))


@dataclass(frozen=True, kw_only=True)
class Case:
    """A case folder in memory: settings as written, columns of its readings, rows of its load-share table."""

    settings: dict[str, Any]
    columns: dict[str, np.ndarray]
    share: np.ndarray | None = None

    @property
    def kind(self) -> str:
        return str(self.settings["kind"])

    @property
    def quantity(self) -> str:
        return str(self.settings["recording"]["quantity"])


Model = Callable[[np.ndarray, Sequence[Act]], np.ndarray]
"""Noise-free readings at a calibration (in prior standard deviations) with effects at work."""


@dataclass(frozen=True, kw_only=True)
class Rig(Case):
    """A rig and its programme; ``names`` are the calibrations that ``model`` takes, ``theta`` gives their values.

    ``fine`` is the model on the finer grid of which recordings are made, if it has one. ``planted`` gives the readings
    where nature follows another base law than the model's, which no calibration quite becomes. ``settle`` completes
    columns that depend on the readings, such as the fringe order an instrument counts. ``floor`` are the bounds
    of the absolute part of the noise over its relative part at the ``quantile`` of the readings.
    Where nature follows other published laws than the model's, ``followed`` puts them in place.
    A ``signed`` quantity may be negative. No reading falls below the share ``least`` of the true value, if it has one.
    """

    names: tuple[str, ...]
    model: Model
    theta: Callable[[np.ndarray], dict[str, float]]
    forms: tuple[Form, ...]
    outside: tuple[Form, ...]
    fine: Model | None = None
    planted: Callable[[Sequence[Act]], np.ndarray] | None = None
    followed: tuple[Act, ...] = ()
    settle: Callable[[np.ndarray], dict[str, np.ndarray]] = field(default=lambda values: {})
    quantile: float = 0.5
    floor: tuple[float, float] = (0.1, 1.0)
    repeats: bool = False
    signed: bool = False
    least: float | None = None

    @property
    def ids(self) -> set[str]:
        return {form.id for form in self.forms}

    @property
    def refined(self) -> Rig:
        """The same rig on its finer grid."""
        return self if self.fine is None else replace(self, model=self.fine)

    @property
    def nature(self) -> Rig:
        """The same rig with a model that follows the laws that nature follows."""
        if not self.followed:
            return self
        model, laws = self.model, self.followed
        return replace(self, model=lambda z, acts: model(z, [*laws, *acts]), followed=())

    def records(self, z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        """What the rig reads without noise."""
        return self.model(z, [*self.followed, *acts]) if self.planted is None else self.planted(acts)


Chain = Sequence[tuple[str, Callable[[Any], Any] | None]]


def play(chain: Chain, state: Any, acts: Sequence[Act]) -> Any:
    """The state after all stages, each followed by the effects that act after it."""
    for name, law in chain:
        state = state if law is None else law(state)
        for effect in acts:
            if effect.stage == name:
                state = effect.act(state)
    return state
