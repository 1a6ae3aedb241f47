"""Description of a discrepancy: the stage that can absorb it, and the shortest power law."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from math import comb

import numpy as np

from mixedlub.chain.quantities import GLOSSARY
from mixedlub.diagnosis.discrepancy.modulated import log_slope
from mixedlub.diagnosis.inference.map_fit import covariance, linear_fit, whitening
from mixedlub.diagnosis.labels import number, words_of
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import (
    ABSORBING_LENGTH,
    BEAM_WIDTH,
    BLOCK_CELLS,
    COLLINEAR,
    CONDITIONS_WON,
    EXPONENTS,
    LARGEST_LOG_FORM,
    LAW_BLOCKS,
    LAW_READINGS,
    LEAST_FOLDS,
    MOST_ERROR_SHARE,
    VARIED_FROM,
)
from mixedlub.diagnosis.settings.discrepancy import LOG_FACTOR_SIZES, READING_SIZES
from mixedlub.diagnosis.settings.inference import SEED, STRONG_EVIDENCE
from mixedlub.schema.units import unit_of

CHAIN = ("film_ratio", "slide_roll_ratio", "hertz_pressure", "viscosity", "entrainment_speed", "sliding_speed")
SLOTS = (
    ("film", ("film_thickness",)),
    ("shear", ("shear_stress",)),
    ("contact", ("area_ratio",)),
    ("boundary", ("boundary_friction",)),
    ("load", ("load_share", "line_load")),
    ("loss", ("power_loss", "tangential_friction", "friction")),
)


@dataclass(frozen=True)
class Absorbed:
    """Log evidence, over none, of a smooth free factor on a quantity of the chain."""

    stage: str
    quantity: str
    evidence: float


@dataclass(frozen=True, eq=False)
class Law:
    """A power law of the mismatch: coefficient times the product of (quantity over its middle) to exponents.

    ``relative`` laws are a share of the calibrated base model's reading; others have the unit of the reading. ``shape``
    is the product (times the base model's reading where relative) for each reading, ``observed`` the recorded readings
    less the base model at the law's calibration; their ratio is the coefficient except for noise. Errors on levels left
    out are in sigmas of a single reading. ``odd`` laws turn their sign with the direction of motion.
    """

    factors: tuple[tuple[str, Fraction], ...]
    middles: tuple[float, ...]
    relative: bool
    coefficient: float
    sd: float
    unit: str
    evidence: float
    heldout_before: float
    heldout_after: float
    shape: np.ndarray
    observed: np.ndarray
    odd: bool

    @property
    def text(self) -> str:
        """The law as a line of text."""
        head = (
            f"{number(self.coefficient)} {self.unit}".rstrip()
            if not self.relative
            else f"{number(self.coefficient)} × base"
        )
        parts = [f"({_words(name)}/{_middle(name, x)})^{_power(b)}" for (name, b), x in self._items]
        sign = ", in the direction of motion" if self.odd else ""
        return "missing part = " + " × ".join([head, *parts]) + sign

    @property
    def _items(self) -> list[tuple[tuple[str, Fraction], float]]:
        return list(zip(self.factors, self.middles, strict=True))


@dataclass(frozen=True)
class DescribedDiscrepancy:
    """Stages that can absorb the mismatch, best first, and the power law if one holds on left-out levels."""

    stages: tuple[Absorbed, ...]
    law: Law | None


def describe_discrepancy(search: Search) -> DescribedDiscrepancy:
    """Describe a mismatch without a name in the catalogue."""
    stages = tuple(stage for stage in absorbing_stages(search) if stage.evidence > 0.0)
    return DescribedDiscrepancy(stages, power_law(search))


def absorbing_stages(search: Search) -> tuple[Absorbed, ...]:
    """Weigh a smooth free factor on one quantity per stage, linearised at the calibrated base model."""
    problem, base = search.problem, search.discrepancy.base
    fixed, weight = np.hstack([base.slopes, problem.shared]), search.discrepancy.fit.weight
    plain = linear_fit(base.anchor, fixed, weight).evidence
    smooth = search.space.columns(search.values, ABSORBING_LENGTH)
    calibrated = problem.run(base.explanation, base.z)
    weighed = []
    for stage, names in SLOTS:
        for name in names:
            slope = log_slope(problem, calibrated, name)
            if slope is None or not np.isfinite(slope).all() or not slope.any():
                continue
            columns = smooth * (slope / problem.sd)[:, None]
            each = [
                linear_fit(base.anchor, np.hstack([fixed, size * columns]), weight).evidence
                for size in LOG_FACTOR_SIZES
            ]
            weighed.append(Absorbed(stage, name, float(np.logaddexp.reduce(each) - np.log(len(each)) - plain)))
            break
    return tuple(sorted(weighed, key=lambda a: -a.evidence))


def features(search: Search) -> dict[str, np.ndarray]:
    """Positive quantities that vary over the recording, one value per reading, without collinear quantities."""
    case, rows, forward = search.problem.case, search.problem.rows, search.problem.forward
    candidates: dict[str, np.ndarray] = {}
    for column in case.kind.columns:
        if column.dtype != "name" and column.name in rows and not column.name.endswith("_C"):
            candidates[column.name] = np.abs(np.asarray(rows[column.name], dtype=float))
    fit = search.discrepancy.base
    base = search.problem.run(fit.explanation, fit.z)
    inputs = base.inputs
    computed = set(inputs) | {name for name, _ in forward.chain}
    parts = [name for name in (*CHAIN[1:], "film_thickness", "composite_roughness") if name in computed]
    state = forward.model(parts)(inputs, base.record.values) if parts else {}
    if "film_thickness" in state and "composite_roughness" in state:
        state["film_ratio"] = state["film_thickness"] / state["composite_roughness"]
    for name in CHAIN:
        if name in state and name not in candidates:
            value = np.atleast_2d(np.asarray(state[name], dtype=float)).mean(axis=-1)
            candidates[name] = np.broadcast_to(value, (len(rows),))
    distinct: dict[str, np.ndarray] = {}
    for name, value in candidates.items():
        if not (np.isfinite(value).all() and (value > 0).all()) or np.ptp(np.log(value)) < VARIED_FROM:
            continue
        shape = _standard(np.log(value))
        if all(abs(np.mean(shape * _standard(np.log(other)))) < COLLINEAR for other in distinct.values()):
            distinct[name] = value
    return distinct


def _standard(values: np.ndarray) -> np.ndarray:
    return np.asarray((values - values.mean()) / values.std())


@dataclass(frozen=True, eq=False)
class _Search:
    """Inputs of the search for a power law: logarithms of the features, linearised base, target."""

    names: tuple[str, ...]
    logs: np.ndarray
    share: np.ndarray
    fixed: np.ndarray
    target: np.ndarray
    weight: np.ndarray

    def take(self, rows: np.ndarray) -> _Search:
        return _Search(
            self.names, self.logs[rows], self.share[rows], self.fixed[rows], self.target[rows], self.weight[rows]
        )

    def columns(self, powers: np.ndarray, carrier: np.ndarray) -> np.ndarray:
        """Column of each form, in sigmas: product of powers times a carrier; shape (forms, rows)."""
        return self.share.T[carrier] * np.exp(np.clip(powers @ self.logs.T, -LARGEST_LOG_FORM, LARGEST_LOG_FORM))

    def evidence(self, powers: np.ndarray, carrier: np.ndarray) -> np.ndarray:
        """Log evidence of each form over nothing, its amplitude averaged over READING_SIZES."""
        whitened = whitening(self.fixed, self.weight)
        log_evidence = np.empty(len(powers))
        step = max(1, BLOCK_CELLS // self.target.size)
        for start in range(0, len(powers), step):
            part = slice(start, start + step)
            each = self.columns(powers[part], carrier[part])
            each = each / np.sqrt(np.mean(each**2, axis=1))[:, None]
            whitened_columns = whitened(each)
            power = np.einsum("ij,ij->i", whitened_columns, each)
            projected = (whitened_columns @ self.target) ** 2
            square = np.array(READING_SIZES)[:, None] ** 2
            grown = 1.0 + square * np.maximum(power, 0.0)
            value = 0.5 * (square * projected / grown - np.log(grown))
            log_evidence[part] = np.logaddexp.reduce(value, axis=0) - np.log(len(READING_SIZES))
        return log_evidence

    def best(self) -> tuple[float, np.ndarray, int]:
        """Form with the highest posterior, and its carrier: all forms up to two factors, the leaders with a third."""
        count = len(self.names)
        leaders: list[tuple[float, np.ndarray, int]] = []
        for size in range(3):
            leaders += self._weigh(_all_powers(count, size), size)
        leaders.sort(key=lambda item: -item[0])
        thirds = [
            _with(powers, place, b)
            for _, powers, _ in leaders[:BEAM_WIDTH]
            if np.count_nonzero(powers) == 2
            for place in range(count)
            if powers[place] == 0
            for b in EXPONENTS
        ]
        if thirds:
            leaders += self._weigh(np.unique(np.array(thirds), axis=0), 3)
        return max(leaders, key=lambda item: item[0])

    def _weigh(self, powers: np.ndarray, size: int) -> list[tuple[float, np.ndarray, int]]:
        """Leading forms of a size with their log posterior; every further factor halves the prior of the whole size."""
        if not len(powers):
            return []
        count = self.share.shape[1]
        all_powers, carrier = np.tile(powers, (count, 1)), np.repeat(np.arange(count), len(powers))
        forms = comb(len(self.names), size) * (2 * len(EXPONENTS)) ** size
        score = self.evidence(all_powers, carrier) - np.log(count * forms)
        order = np.argsort(-score, kind="stable")[:BEAM_WIDTH]
        return [(float(score[i]), all_powers[i], int(carrier[i])) for i in order]


def _all_powers(count: int, size: int) -> np.ndarray:
    """Exponents of every form with ``size`` factors, shape (forms, count).

    >>> _all_powers(3, 0).shape, _all_powers(3, 1).shape, _all_powers(3, 2).shape
    ((1, 3), (30, 3), (300, 3))
    """
    values = [float(b) for b in EXPONENTS]
    rows = []
    for places in combinations(range(count), size):
        grid = np.array(list(product(values, repeat=size))).reshape(len(values) ** size, size)
        powers = np.zeros((len(grid), count))
        powers[:, list(places)] = grid
        rows.append(powers)
    return np.vstack(rows) if rows else np.zeros((0, count))


def _with(powers: np.ndarray, place: int, b: Fraction) -> np.ndarray:
    changed = powers.copy()
    changed[place] = float(b)
    return changed


def power_law(search: Search) -> Law | None:
    """Shortest power law that predicts left-out levels; None if no law does.

    The law is chosen anew in every fold; it must lower the held-out error clearly over all folds, and in most of the
    conditions.
    """
    values = features(search)
    if not values:
        return None
    problem, base = search.problem, search.discrepancy.base
    names = tuple(values)
    middles = np.array([float(f"{np.exp(np.mean(np.log(v))):.2g}") for v in values.values()])
    logs = np.log(np.array(list(values.values())).T / middles)
    one = problem.sd * problem.d_inverse(base.prediction)
    level = problem.inverse(base.prediction)
    # Carriers of a law: 0 the base model's reading, 1 none, 2 the direction of motion where there are two.
    share = np.column_stack([level, np.ones_like(level), *_turning(search)]) / one[:, None]
    fixed = np.hstack([base.slopes, problem.shared])
    full = _Search(names, logs, share, fixed, base.anchor, search.discrepancy.fit.weight)
    count = min(problem.y.size, LAW_READINGS)
    thin = np.sort(np.random.default_rng(SEED).choice(problem.y.size, count, replace=False))
    thinned = full.take(thin)
    score, powers, carrier = thinned.best()
    if score < STRONG_EVIDENCE:
        return None
    before, after, wins_most = _held_out(search, thinned, thin)
    if after > MOST_ERROR_SHARE * before or not wins_most:
        return None
    in_single = float(np.sqrt(problem.n_per_effective))
    column = full.columns(powers[None], np.array([carrier]))[0]
    coefficient, sd, c = _coefficient(full, column)
    used = np.flatnonzero(powers)
    exponent = {float(b): b for b in EXPONENTS}
    return Law(
        factors=tuple((names[i], exponent[powers[i]]) for i in used),
        middles=tuple(float(middles[i]) for i in used),
        relative=carrier == 0,
        coefficient=coefficient,
        sd=sd,
        unit=unit_of(problem.case.quantity),
        evidence=score,
        heldout_before=in_single * before,
        heldout_after=in_single * after,
        shape=column * one,
        observed=(full.target - fixed @ c[:-1]) * one,
        odd=carrier == 2,
    )


def _turning(search: Search) -> list[np.ndarray]:
    """Direction of motion of every reading as a sign; empty if only one direction was run."""
    speed = search.problem.forward.inputs.get("drive_speed")
    if speed is None or np.ptp(np.sign(speed)) == 0.0:
        return []
    return [np.broadcast_to(np.sign(speed)[:, 0], search.problem.y.shape)]


def _coefficient(search: _Search, column: np.ndarray) -> tuple[float, float, np.ndarray]:
    """Coefficient of a column under a wide prior, its sd, and all coefficients."""
    scale = READING_SIZES[-1] / np.sqrt(np.mean(column**2))
    columns = np.column_stack([search.fixed, column * scale])
    fit = linear_fit(search.target, columns, search.weight)
    spread = covariance(columns, fit.weight)
    coefficients = fit.coefficients.copy()
    coefficients[-1] *= scale
    return float(coefficients[-1]), float(np.sqrt(spread[-1, -1]) * scale), coefficients


def _held_out(search: Search, thinned: _Search, thin: np.ndarray) -> tuple[float, float, bool]:
    """Rms error (sigmas) on left-out levels, without and with a law chosen on the others; whether most splits win."""
    squares: list[tuple[float, float]] = []
    for axis, values in zip(search.space.axes, search.values, strict=True):
        levels, label = np.unique(values[thin], return_inverse=True)
        if levels.size < LEAST_FOLDS or axis.name == "sequence":
            continue
        label = label * min(levels.size, LAW_BLOCKS) // levels.size
        residual = np.zeros((2, thinned.target.size))
        for k in range(int(label.max()) + 1):
            out = label == k
            train, test = thinned.take(~out), thinned.take(out)
            plain = linear_fit(train.target, train.fixed, train.weight)
            residual[0, out] = test.target - test.fixed @ plain.coefficients
            _, powers, carrier = train.best()
            by = np.array([carrier])
            _, _, c = _coefficient(train, train.columns(powers[None], by)[0])
            residual[1, out] = test.target - np.column_stack([test.fixed, test.columns(powers[None], by)[0]]) @ c
        mean = (thinned.weight * residual**2).sum(axis=1) / thinned.weight.sum()
        squares.append((float(mean[0]), float(mean[1])))
    if not squares:
        return 0.0, 0.0, False
    total = np.mean(np.array(squares), axis=0)
    wins = sum(after < before for before, after in squares)
    return float(np.sqrt(total[0])), float(np.sqrt(total[1])), wins >= CONDITIONS_WON * len(squares)


def _words(name: str) -> str:
    return "film ratio" if name == "film_ratio" else words_of(name)


def _middle(name: str, value: float) -> str:
    """Middle of a quantity with its unit, as printed in the law."""
    unit = unit_of(name) if unit_of(name) else GLOSSARY[name].unit if name in GLOSSARY else "-"
    if unit == "Pa":
        return f"{number(value * 1e-9)} GPa"
    return number(value) if unit in ("-", "") else f"{number(value)} {unit}"


def _power(b: Fraction) -> str:
    return str(b) if b.denominator == 1 and b > 0 else f"({b})"
