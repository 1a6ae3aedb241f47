"""Common parts of all rigs: programme, base model with calibration, and effects that can be planted."""

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
AVERAGE = "contact_average"
"""Another id of a law of shear, of the catalogue alone."""
NAMES = LAWS | {AVERAGE}
"""Ids of laws in an answer."""


def steps(names: Collection[str]) -> frozenset[str]:
    """Steps of the base chain whose laws are named.

    >>> sorted(steps({"windage", "contact_average", "film_law"}))
    ['film_law', 'shear_law']
    """
    return frozenset(SHEAR if name == AVERAGE else name for name in names) & LAWS


@dataclass(frozen=True)
class Knob:
    """A parameter of a planted law: bounds of a rival fit (``low`` to ``high``) and the drawn range."""

    name: str
    low: float
    high: float
    typical: tuple[float, float]


def strength(low: float, high: float, typical: tuple[float, float] = (0.7, 1.4)) -> Knob:
    return Knob("strength", low, high, typical)


@dataclass(frozen=True)
class Act:
    """An acting effect: the stage after which it acts, and a function of the state alone."""

    stage: str
    act: Callable[[Any], Any]


@dataclass(frozen=True)
class Law:
    """A published law of the step ``id``; ``enter`` replaces the base law of a state.

    Steps with another law: ``needs`` required, ``bars`` excluded. ``average``: mean of traction over the contact.
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
        """Whether the law is compatible with other laws at the given steps."""
        return self.needs <= set(steps) and not self.bars & set(steps)

    def act(self, values: Mapping[str, float]) -> Act:
        return Act("oil", lambda state: self.enter(state, **values))

    @property
    def middle(self) -> dict[str, float]:
        """Knobs of the law at the middle of their drawn ranges."""
        return {knob.name: 0.5 * sum(knob.typical) for knob in self.knobs}


@dataclass(frozen=True)
class Form:
    """A published form of an effect after the stage ``hook``; its first knob is the strength, zero without the effect.

    ``rarity``: weight of the effect in the draw; 0 for a rival only. ``rank``: generality; a form that contains simpler
    effects as special cases is not a rival of them. ``rigid``: fixed size, such as a miscounted fringe. ``within``: the
    catalogue's law of the effect can become this form, at some parameter values or in a limit. ``holds``: range stated
    by the source; the formula is in the docstring of the law.
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
"""Noise-free readings at a calibration (in prior standard deviations) under the acting effects."""


@dataclass(frozen=True, kw_only=True)
class Rig(Case):
    """A rig and its programme; ``names``: calibrated inputs of ``model``; ``theta``: their values.

    ``fine``: model on a finer grid for recordings, if any. ``planted``: readings under another base law, which no
    calibration fully reproduces. ``followed``: published laws that replace laws of the model. ``settle``: columns that
    depend on the readings, such as counted fringe orders. ``floor``: bounds of absolute over relative noise at the
    ``quantile`` of the readings. ``signed``: negative readings allowed. ``least``: lowest reading over the true value,
    if any.
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
        """The same rig with the true laws in its model."""
        if not self.followed:
            return self
        model, laws = self.model, self.followed
        return replace(self, model=lambda z, acts: model(z, [*laws, *acts]), followed=())

    def records(self, z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        """Noise-free readings of the rig."""
        return self.model(z, [*self.followed, *acts]) if self.planted is None else self.planted(acts)


Chain = Sequence[tuple[str, Callable[[Any], Any] | None]]


def play(chain: Chain, state: Any, acts: Sequence[Act]) -> Any:
    """State after all stages, each followed by its effects."""
    for name, law in chain:
        state = state if law is None else law(state)
        for effect in acts:
            if effect.stage == name:
                state = effect.act(state)
    return state
