"""What every bench has: conditions, a base model that calibration moves, and the forms effects may take."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mixedlub.validation.planted.kinds import Concealed, Knob, strength
from mixedlub.validation.planted.measurement import crept, diffused, warmed_up

Chain = Sequence[tuple[str, Callable[[Any], Any] | None]]


@dataclass(frozen=True)
class Act:
    """One effect at work: the stage after which it acts, and a function of the state alone."""

    stage: str
    act: Callable[[Any], Any]


@dataclass(frozen=True)
class Form:
    """One published form of an effect; the first knob is the strength, absent at zero.

    ``rank`` is how general a form is: a form that holds simpler effects as special cases is no rival to them.
    ``rigid`` forms come in one size, as a miscounted fringe does. ``rarity`` weighs the effect when drawn; a form
    of rarity 0 is only a rival. ``within`` says that the catalogue's law of the same effect can become this one, at
    some values of its parameters or in their limit.
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

    def hide(self, values: Mapping[str, float]) -> Act:
        return Act(self.hook, lambda state: self.law(state, **values))


@dataclass(frozen=True)
class Bench:
    """A rig and its programme.

    ``model`` gives the noise-free readings at calibration ``z`` (in prior sds, one a name of ``names``) with
    effects at work. ``planted`` gives them where nature keeps to another base law than the model's, which no
    calibration quite becomes. ``quantile`` tells which of the readings the absolute part of the noise is measured by.
    ``settle`` completes columns that depend on the readings, such as the fringe order an instrument counts.
    """

    kind: str
    settings: dict[str, Any]
    columns: dict[str, np.ndarray]
    names: tuple[str, ...]
    model: Callable[[np.ndarray, Sequence[Act]], np.ndarray]
    theta: Callable[[np.ndarray], dict[str, float]]
    forms: tuple[Form, ...]
    outside: tuple[Form, ...]
    quantile: float = 0.5
    floor: tuple[float, float] = (0.1, 1.0)
    repeats: bool = False
    share: np.ndarray | None = None
    settle: Callable[[np.ndarray], dict[str, np.ndarray]] = field(default=lambda values: {})
    planted: Callable[[Sequence[Act]], np.ndarray] | None = None

    @property
    def ids(self) -> set[str]:
        return {form.id for form in self.forms}

    def records(self, z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        """What the rig reads without noise."""
        return self.model(z, acts) if self.planted is None else self.planted(acts)


def play(chain: Chain, state: Any, acts: Sequence[Act]) -> Any:
    """The state carried through the stages, every effect slipped in after the law of its stage."""
    for name, law in chain:
        state = state if law is None else law(state)
        for effect in acts:
            if effect.stage == name:
                state = effect.act(state)
    return state


def borrowed(effect: Concealed, rarity: float | None = None) -> Form:
    """A form of the gear and disc battery, where it can act on this kind too."""
    return Form(
        effect.id,
        effect.hook,
        effect.law,
        effect.knobs,
        effect.source,
        rarity=effect.rarity if rarity is None else rarity,
        within=effect.within,
    )


def pick(rng: np.random.Generator, options: Sequence[Any]) -> Any:
    """One of the options."""
    return options[int(rng.integers(len(options)))]


def rounded(value: float, digits: int = 4) -> float:
    return float(f"{value:.{digits}g}")


def between(rng: np.random.Generator, low: float, high: float, digits: int = 4) -> float:
    """Even in the logarithm between two positive numbers."""
    return rounded(float(np.exp(rng.uniform(np.log(low), np.log(high)))), digits)


def progress(count: int) -> np.ndarray:
    """Place of each reading in the programme, 0 to 1."""
    return np.round(np.arange(count) / max(count - 1, 1), 6)


def repeated(columns: Mapping[str, np.ndarray], times: int, order: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """Every condition ``times`` times over, in one order or another, numbered anew."""
    count = len(next(iter(columns.values()))) * times
    places = np.tile(np.arange(count // times), times) if order is None else order
    return {"run": np.arange(1, count + 1), **{name: column[places] for name, column in columns.items()}}


def _usual(values: np.ndarray) -> float:
    return float(np.median(np.abs(values)))


def channel(sequence: np.ndarray, zero: bool, gain: bool, drifting_zero: bool) -> tuple[Form, ...]:
    """Faults of any channel: a wrong zero, a wrong span, a creeping span, and where so a creeping zero."""

    def sensor_offset(state: Any, strength: float) -> Any:
        return replace(state, recorded=state.recorded + 0.05 * strength * _usual(state.recorded))

    def sensor_gain(state: Any, strength: float) -> Any:
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength))

    def steady(state: Any, strength: float) -> Any:
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * sequence))

    def settling(state: Any, strength: float, pace: float) -> Any:
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * warmed_up(sequence, pace)))

    def logarithmic(state: Any, strength: float, onset: float) -> Any:
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * crept(sequence, onset)))

    def soaking(state: Any, strength: float) -> Any:
        return replace(state, recorded=state.recorded * (1 + 0.1 * strength * diffused(sequence)))

    def zero_drift(state: Any, strength: float) -> Any:
        return replace(state, recorded=state.recorded + 0.1 * strength * _usual(state.recorded) * sequence)

    def zero_settling(state: Any, strength: float, pace: float) -> Any:
        more = 0.1 * strength * _usual(state.recorded) * warmed_up(sequence, pace)
        return replace(state, recorded=state.recorded + more)

    either, share = strength(-8.0, 8.0), strength(-4.0, 4.0)
    found = []
    if zero:
        found.append(Form("sensor_offset", "sensor", sensor_offset, (either,), "instrument zero", within=True))
    if gain:
        found.append(Form("sensor_gain", "sensor", sensor_gain, (share,), "instrument span", rarity=0.5, within=True))
    if len(np.unique(sequence)) > 1:
        slow, early = Knob("pace", 0.7, 5.0, (1.0, 3.0)), Knob("onset", 0.001, 0.2, (0.003, 0.05))
        found.append(Form("sensor_drift", "sensor", steady, (share,), "linear drift", within=True))
        found.append(Form("sensor_drift", "sensor", settling, (share, slow), "warming amplifier", within=True))
        found.append(Form("sensor_drift", "sensor", logarithmic, (share, early), "logarithmic creep of a load cell"))
        found.append(Form("sensor_drift", "sensor", soaking, (share,), "heat or moisture that diffuses in"))
        if drifting_zero:
            found.append(Form("zero_drift", "sensor", zero_drift, (share,), "linear drift of the zero", within=True))
            found.append(Form("zero_drift", "sensor", zero_settling, (share, slow), "warming amplifier"))
    return tuple(found)


def zero_of_force(recorded: np.ndarray, load: np.ndarray) -> np.ndarray:
    """Error of a friction coefficient whose force is off by 0.5 % of the largest friction force, over the load."""
    return np.asarray(0.005 * _usual(recorded) * np.max(np.abs(load)) / np.abs(load))


def force_cell(load: np.ndarray, sequence: np.ndarray) -> tuple[Form, ...]:
    """Faults of the cell that reads a friction force, where a friction coefficient is that force over a load.

    A residual zero and a zero that moves from before the test to after it are what ISO 376 asks for; a zero that goes
    with the temperature of the cell, which takes on that of the rig, is in OIML R 60.
    """
    if np.ptp(load) == 0:
        return ()

    def off(state: Any, share: np.ndarray | float) -> Any:
        return replace(state, recorded=state.recorded + share * zero_of_force(state.recorded, load))

    def unzeroed(state: Any, strength: float) -> Any:
        return off(state, strength)

    def creeping(state: Any, strength: float) -> Any:
        return off(state, 2 * strength * sequence)

    def warming(state: Any, strength: float, pace: float) -> Any:
        return off(state, 2 * strength * warmed_up(sequence, pace))

    either = strength(-8.0, 8.0)
    pace = Knob("pace", 0.1, 5.0, (0.15, 2.0))
    return (
        Form("force_offset", "sensor", unzeroed, (either,), "zero of a force cell, ISO 376", within=True),
        Form("force_drift", "sensor", creeping, (either,), "linear drift of a force cell, ISO 376", within=True),
        Form("force_drift", "sensor", warming, (either, pace), "warming force cell, OIML R 60"),
    )
