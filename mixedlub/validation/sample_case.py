"""A random case: rig, calibration, planted effects, and the noise that gives their visibility."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mixedlub.validation.rig import Act, Form, Rig
from mixedlub.validation.rigs import KINDS, Family, family_of
from mixedlub.validation.rivals import nearest, sensitivity, visibility
from mixedlub.validation.solved.world import draw as draw_solved
from mixedlub.validation.worlds.catalogue import World, drawn, following
from mixedlub.validation.worlds.misfit import CLEAR, Seen
from profiles.errors import InputError

VISIBLE = {"clear": (16.0, 30.0), "faint": (7.0, 11.0), "pair": (10.0, 24.0)}
"""Root of the chi-square of an effect after recalibration; of the weaker effect of a pair."""
CLOSE_ENOUGH = 0.25
"""Logarithm of visibility over its goal below which a sample is accepted."""
TRIES = 12
"""Number of samples; the nearest to the order is taken."""
TRIES_IF_SOLVED = 2
"""The same, where each sample takes hundreds of solutions."""
TRIES_FOR_LAW = 40
"""Largest number of samples tried for a first law that deviates from the base model."""
MOST_RIGS = 400
"""Largest number of rigs drawn for a case."""
SMALL_CASE_SIZES = (20, 41)
"""Readings of a small case."""
FEW, LASTING, HEAVY, SD_ESTIMATED, MIS_SET = (
    "few readings",
    "lasting noise",
    "heavy tails",
    "estimated sds",
    "mis-set calibration",
)
"""Possible flaws of a recording."""
FEW_SIZES = (12, 25)
"""Number of readings of a case with few readings."""


@dataclass(frozen=True)
class Order:
    """Order of a case: kind, class, planted effects, and their visibility.

    ``laws``: steps at which the rig follows another law; ``strong``: recalibration of the base model must not hide the
    first law. ``flaws``: defects of the recording. ``law``: name of the law of a single effect, any if empty.
    ``beyond``: an end of a condition is withheld. ``solved``: the concealed part of a rig of full physics, empty for
    other rigs; ``full_base``: its case has full solutions as base.
    """

    name: str
    kind: str
    label: str
    effects: tuple[str, ...]
    level: str
    outliers: bool = False
    no_data_sheet: bool = False
    small: bool = False
    laws: tuple[str, ...] = ()
    strong: bool = False
    flaws: tuple[str, ...] = ()
    law: str = ""
    beyond: bool = False
    solved: str = ""
    full_base: bool = False

    @property
    def sizes(self) -> tuple[int, int] | None:
        """Bounds of the number of readings of a case with few."""
        return FEW_SIZES if FEW in self.flaws else SMALL_CASE_SIZES if self.small else None


@dataclass(frozen=True)
class Sample:
    """A drawn case: rig, withheld readings, calibration, forms with their knobs, noise, visibility, laws."""

    rig: Rig
    hidden: np.ndarray
    z: np.ndarray
    forms: tuple[Form, ...]
    knobs: tuple[dict[str, float], ...]
    relative: float
    absolute: float
    visibility: float
    world: World = ()

    @property
    def seen(self) -> Seen:
        """Recorded readings for the comparison of laws."""
        sd = self.sd(self.rig.records(self.z, self.acts))
        rows = np.flatnonzero(~self.hidden)
        return Seen(self.rig, rows, self.z, sd[rows])

    @property
    def acts(self) -> list[Act]:
        return [form.hide(values) for form, values in zip(self.forms, self.knobs)]

    def sd(self, values: np.ndarray) -> np.ndarray:
        """Standard deviation of readings with the values."""
        return np.asarray(np.sqrt((self.relative * values) ** 2 + self.absolute**2))

    @property
    def possible(self) -> bool:
        """Whether an instrument could read the values: noise-free readings must be positive unless signed."""
        return self.rig.signed or bool(np.all(self.rig.records(self.z, self.acts) > 0))


def sample_case(rng: np.random.Generator, order: Order) -> Sample:
    """Sample nearest to the order; rigs without visible effect or with impossible readings are drawn again."""
    goal = float(rng.uniform(*VISIBLE["pair" if order.label == "pair" else order.level]))

    def far(sample: Sample) -> float:
        return abs(float(np.log(sample.visibility / goal))) if order.effects else 0.0

    nearest_yet: Sample | None = None
    for place in range(MOST_RIGS):
        sample = _sample(rng, order, goal)
        if not sample.possible:
            continue
        if order.strong and place < TRIES_FOR_LAW and not sample.seen.alone(sample.world, sample.world[0]) > CLEAR:
            continue
        if nearest_yet is None or far(sample) < far(nearest_yet):
            nearest_yet = sample
        if far(nearest_yet) < CLOSE_ENOUGH or place + 1 >= (TRIES_IF_SOLVED if order.solved else TRIES):
            return nearest_yet
    raise InputError("no rig with these effects can be read", where=order.kind, value=order.effects)


def _rig_for(rng: np.random.Generator, order: Order) -> tuple[Rig, World, tuple[Form, ...]]:
    """A rig open to the ordered effects, its laws, and one form of each effect."""
    kind = KINDS[order.kind]
    draw = kind.draw_without_data_sheet if order.no_data_sheet and kind.draw_without_data_sheet else kind.draw
    for _ in range(MOST_RIGS):
        rig = draw(rng)
        world: World = ()
        if order.laws:
            followed = drawn(rng, rig, order.laws)
            if followed is None:
                continue
            rig, world = following(rig, followed), followed
        pool = rig.outside if order.label == "unknown" else rig.forms
        pool = tuple(form for form in pool if order.law in ("", form.law.__name__))
        options = [[form for form in pool if form.id == name and form.rarity > 0] for name in order.effects]
        if all(options):
            return rig, world, tuple(forms[int(rng.integers(len(forms)))] for forms in options)
    raise InputError("no rig is open to these effects", where=order.kind, value=order.effects)


def _knobs(rng: np.random.Generator, form: Form) -> dict[str, float]:
    values = {knob.name: float(rng.uniform(*knob.typical)) for knob in form.knobs}
    if form.knobs[0].low < 0 and rng.random() < 0.4:
        values["strength"] = -values["strength"]
    return values


def _scaled(form: Form, values: dict[str, float], factor: float) -> dict[str, float]:
    if form.rigid:
        return values
    knob = form.knobs[0]
    return {**values, "strength": float(np.clip(values["strength"] * factor, 0.98 * knob.low, 0.98 * knob.high))}


def withhold(
    rng: np.random.Generator, rig: Rig, family: Family, sizes: tuple[int, int] | None = None, beyond: bool = False
) -> np.ndarray:
    """Readings to withhold: some at random and often a level of a condition or a stretch of time.

    ``sizes``: bounds of the number of recorded readings, the upper bound excluded; all others are then withheld.
    ``beyond``: the last level of a condition is withheld.
    """
    count = len(rig.columns["run"])
    if sizes is not None:
        hidden = np.ones(count, dtype=bool)
        kept = min(int(rng.integers(*sizes)), count - 1)
        hidden[rng.choice(count, kept, replace=False)] = False
        return hidden
    hidden = rng.random(count) < rng.uniform(*family.scattered)
    several = {
        name: np.unique(column)
        for name, column in rig.columns.items()
        if name not in ("run", "sequence", "time_s", "position_deg") and column.dtype != object
    }
    several = {name: levels for name, levels in several.items() if len(levels) >= family.levels}
    if beyond and several:
        name = list(several)[int(rng.integers(len(several)))]
        hidden |= rig.columns[name] == several[name][-1]
    elif count >= 30 and several and rng.random() < family.blocks:
        name = list(several)[int(rng.integers(len(several)))]
        levels = several[name] if family.ends else several[name][1:-1]
        hidden |= rig.columns[name] == levels[int(rng.integers(len(levels)))]
    elif count >= 30 and "time_s" in rig.columns and rng.random() < family.blocks:
        first = int(rng.uniform(0.1, 0.8) * count)
        hidden[first : first + count // 12] = True
    if not hidden.any():
        hidden[count // 2] = True
    return hidden


def _sample(rng: np.random.Generator, order: Order, goal: float) -> Sample:
    """A rig with noise and strengths scaled for a visibility of the effects as near the goal as possible."""
    family = family_of(order.kind)
    if order.solved:
        rig, world, forms, z = draw_solved(rng, order.kind, order.solved, order.full_base)
        return _leveled(rng, order, goal, (rig, withhold(rng, rig, family), z, forms, world))
    rig, world, forms = _rig_for(rng, order)
    hidden = withhold(rng, rig, family, order.sizes, order.beyond)
    z = rng.standard_normal(len(rig.names))
    if not order.effects and rng.random() < family.mis_set:
        z = np.sign(z) * rng.uniform(1.0, 2.0, len(z))
    if MIS_SET in order.flaws:
        off = rng.choice(len(z), min(2, len(z)), replace=False)
        z[off] = np.sign(z[off]) * rng.uniform(2.0, 3.0, len(off))
    z = z if rig.planted is None else nearest(rig)
    return _leveled(rng, order, goal, (rig, hidden, z, forms, world))


Drawn = tuple[Rig, np.ndarray, np.ndarray, tuple[Form, ...], World]
"""Rig, withheld readings, calibration, planted effects and laws of a case."""


def _leveled(rng: np.random.Generator, order: Order, goal: float, case: Drawn) -> Sample:
    """A drawn case with noise and strengths that give its effects the visibility."""
    rig, hidden, z, forms, world = case
    family = family_of(order.kind)
    knobs = tuple(_knobs(rng, form) for form in forms)
    slopes = sensitivity(rig.nature, z)[~hidden]
    typical = float(np.quantile(np.abs(rig.records(z, ())), rig.quantile))
    share = float(np.exp(rng.uniform(*np.log(rig.floor))))

    def sample(level: float, factors: Sequence[float]) -> Sample:
        now = tuple(_scaled(f, k, factor) for f, k, factor in zip(forms, knobs, factors))
        absolute = float(f"{0.01 * level * share * typical:.4g}")
        return Sample(rig, hidden, z, forms, now, round(0.01 * level, 6), absolute, 0.0, world)

    def each(level: float, factors: Sequence[float]) -> list[float]:
        """Visibility of every effect in the presence of the others."""
        one = sample(level, factors)
        truth = rig.records(z, one.acts)
        sd = one.sd(truth)[~hidden]
        rests = [rig.records(z, [act for j, act in enumerate(one.acts) if j != i]) for i in range(len(forms))]
        return [visibility((truth - rest)[~hidden], sd, slopes) for rest in rests]

    level, factors = (
        float(np.exp(rng.uniform(*np.log(family.noise if forms else family.noise_alone)))),
        [1.0] * len(forms),
    )
    if not forms:
        return sample(level, factors)
    level = solve(lambda x: min(each(x, factors)), goal, *family.noise, falling=True)
    for i, form in enumerate(forms):
        widest = max(1.0, min(4.0, form.knobs[0].high / abs(knobs[i]["strength"])))
        wanted = goal if len(forms) == 1 else float(np.clip(each(level, factors)[i], goal, 1.6 * goal))
        seen = partial(_visibility_of, each, level, factors, i)
        factors = _exchanged(factors, i, solve(seen, wanted, 0.05, widest, falling=False))
    return replace(sample(level, factors), visibility=max(min(each(level, factors)), 1e-3))


def _exchanged(factors: Sequence[float], index: int, factor: float) -> list[float]:
    return [factor if i == index else f for i, f in enumerate(factors)]


def _visibility_of(
    each: Callable[[float, Sequence[float]], list[float]], level: float, factors: list[float], index: int, factor: float
) -> float:
    """Visibility of one effect at another factor on its strength."""
    return each(level, _exchanged(factors, index, factor))[index]


def solve(measure: Callable[[float], float], goal: float, low: float, high: float, falling: bool) -> float:
    """Log bisection of a monotone measure to the goal; the nearer end if the goal is out of reach."""
    if not falling and abs(np.log(max(measure(1.0), 1e-9) / goal)) < 0.03:
        return 1.0
    for _ in range(12):
        middle = float(np.sqrt(low * high))
        above = measure(middle) > goal
        low, high = (middle, high) if above == falling else (low, middle)
    return float(f"{np.sqrt(low * high):.5g}")
