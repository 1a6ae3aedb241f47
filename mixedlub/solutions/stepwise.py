"""Stepwise multiple regression: which terms of a law measured friction asks for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
import pandas as pd
from scipy.stats import t as student

from mixedlub.friction.condensed import INPUTS, OIL, TERMS, coefficient_name
from mixedlub.solutions.least_squares import LinearFit, least_squares
from mixedlub.solutions.regression import Regression, design_of, fitted, limits_of

Criterion = Literal["bic", "p-value"]
ENTER, LEAVE = 0.05, 0.10
"""Convention. p-values below which a term enters, and above which it leaves."""
PER_TERM = 5
"""Judgement. Readings that each term of a law needs."""
FEWEST = 2 * PER_TERM
"""Readings that a regression needs."""
SAME = 1e-6
"""Relative difference up to which values of an input are one level."""
DETERMINED = 1e-8
"""Least share of a term's squares that the terms chosen so far do not make up."""
ONE_BY_ONE, FOLDS = 200, 10
"""Cost limit. Readings that are left out one by one, and parts in which more of them are."""
ALIKE = 1e-6
"""Relative difference up to which two terms leave the same, as squares and cubes of three levels do."""
CONSTANT = coefficient_name("")


def chosen_terms(design: pd.DataFrame, wanted: np.ndarray, criterion: Criterion) -> list[str]:
    r"""Columns of the design that a stepwise regression keeps, the constant first.

    Each step adds the term that improves the fit most, then drops those that have become needless: by the Bayesian
    information criterion, or by p-values of 0.05 to enter and 0.10 to leave. For one term among k of n readings, both
    are bounds of its t; the criterion falls where :math:`t^2 > (n - k)(n^{1/n} - 1)`.

    >>> x = np.random.default_rng(0).standard_normal((60, 4))
    >>> table = pd.DataFrame({"c_0": 1.0, "c_p": x[:, 0], "c_s": x[:, 1], "c_u": x[:, 2]})
    >>> chosen_terms(table, 1.0 + 2.0 * x[:, 1] + 0.1 * x[:, 2] + 1e-3 * x[:, 3], "bic")
    ['c_0', 'c_s', 'c_u']
    """
    values, names = design.to_numpy(), list(design)
    kept, seen = [names.index(CONSTANT)], set()
    while tuple(kept) not in seen:
        seen.add(tuple(kept))
        kept = _without_needless(values, wanted, _with_best(values, wanted, kept, criterion), criterion)
    return [str(names[one]) for one in kept]


def _bound(criterion: Criterion, count: int, terms: int, level: float) -> float:
    """Square of t from which on a term is worth its place among as many."""
    freedom = count - terms
    return (
        freedom * (count ** (1.0 / count) - 1.0) if criterion == "bic" else float(student.isf(level / 2, freedom) ** 2)
    )


def _with_best(design: np.ndarray, wanted: np.ndarray, kept: list[int], criterion: Criterion) -> list[int]:
    """The terms with the one that improves the fit most, if any does."""
    count, terms = len(wanted), len(kept) + 1
    if terms * PER_TERM > count:
        return kept
    left = left_of(design[:, kept], np.column_stack([wanted, design]))
    rest, others, size = left[:, 0], left[:, 1:], (left[:, 1:] ** 2).sum(axis=0)
    free = size > DETERMINED * (design**2).sum(axis=0)
    free[kept] = False
    if not free.any():
        return kept
    slope = np.divide(rest @ others, size, out=np.zeros_like(size), where=free)
    after = np.where(free, ((rest[:, None] - others * slope) ** 2).sum(axis=0), np.inf)
    best = int(np.argmax(after <= (1.0 + ALIKE) * after.min()))
    gain = float(slope[best] ** 2 * size[best]) * (count - terms)
    return [*kept, best] if gain > _bound(criterion, count, terms, ENTER) * after[best] else kept


def is_determined(design: pd.DataFrame, name: str) -> bool:
    """Whether a column differs from what the others make up."""
    own = design[[name]].to_numpy()
    return bool((left_of(design.drop(columns=name).to_numpy(), own) ** 2).sum() > DETERMINED * (own**2).sum())


def left_of(known: np.ndarray, values: np.ndarray) -> np.ndarray:
    """What columns that are known leave of others by least squares."""
    return np.asarray(values - known @ np.linalg.lstsq(known, values, rcond=None)[0])


def _without_needless(design: np.ndarray, wanted: np.ndarray, kept: list[int], criterion: Criterion) -> list[int]:
    """The terms without those whose loss improves the criterion, one after the other."""
    count = len(wanted)
    while len(kept) > 1:
        inverse = np.linalg.pinv(design[:, kept])
        found, terms = inverse @ wanted, len(kept)
        loss = found[1:] ** 2 / (inverse[1:] ** 2).sum(axis=1) * (count - terms)
        worst = int(np.argmin(loss))
        after = float(((wanted - design[:, kept] @ found) ** 2).sum())
        if not loss[worst] < _bound(criterion, count, terms, LEAVE) * after:
            break
        kept = kept[: worst + 1] + kept[worst + 2 :]
    return kept


def errors_left_out(design: pd.DataFrame, wanted: np.ndarray, criterion: Criterion) -> tuple[np.ndarray, int]:
    """Errors at readings that neither chose the terms nor were fitted, and into how many parts these were put.

    Each reading is a part of its own, or up to `ONE_BY_ONE` of them; more are dealt to `FOLDS` parts by chance. Terms
    are chosen anew without each part.
    """
    count, values = len(wanted), design.to_numpy()
    parts = count if count <= ONE_BY_ONE else FOLDS
    part = np.random.default_rng(0).permutation(count) % parts
    error = np.empty(count)
    for one in range(parts):
        out = part == one
        kept = [design.columns.get_loc(name) for name in chosen_terms(design[~out], wanted[~out], criterion)]
        found = np.linalg.lstsq(values[~out][:, kept], wanted[~out], rcond=None)[0]
        error[out] = wanted[out] - values[out][:, kept] @ found
    return error, parts


def varied(values: Mapping[str, np.ndarray]) -> str:
    """Letters of the inputs that were varied."""
    return "".join(one.letter for one in INPUTS if np.ptp(np.log(values[one.name])) > SAME)


def candidates(letters: str, order: int) -> list[str]:
    """Names of the coefficients of products of up to ``order`` logarithms of the inputs with these letters.

    >>> candidates("ps", 2)
    ['c_0', 'c_p', 'c_s', 'c_pp', 'c_ps', 'c_ss']
    """
    return [coefficient_name(term) for term in TERMS if len(term) <= order and set(term) <= set(letters)]


def measured_regression(
    values: Mapping[str, np.ndarray], friction: np.ndarray, order: int, by: Criterion
) -> Regression:
    r"""A law of measured friction from the terms that it asks for; all other coefficients are zero.

    ``values`` are the inputs in their units, of `FEWEST` readings or more. The logarithm of friction is regressed over
    products of up to ``order`` logarithms of the inputs. Standard errors would hold only had the terms
    been named beforehand, for readings that scatter independently: the same readings chose the terms, so that those
    kept by chance look significant. Terms are chosen anew for the error of readings left out. Coefficients of the oil
    are left unknown.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, chapter 3, for the multiple regression of the logarithm of
    measured friction over transformed terms.
    """
    every, wanted = design_of(values), np.log(friction)
    asked = every[candidates(varied(values), order)]
    kept = chosen_terms(asked, wanted, by)
    fit = least_squares(every[kept], wanted)
    coefficients = (
        dict.fromkeys([*map(str, every), *OIL], 0.0)
        | {name: float(fit.coefficients[name]) for name in kept}
        | limits_of(values)
    )
    table = pd.DataFrame({one.column: values[one.name] for one in INPUTS} | {"friction_coefficient": friction})
    table["fitted"] = fitted(values, coefficients)
    table["residual_of_log"] = wanted - np.log(table["fitted"].to_numpy())
    table["standardised_residual"] = fit.standardised_residuals
    quality = _quality(fit, *errors_left_out(asked, wanted, by))
    return Regression(coefficients, {name: float(fit.standard_errors[name]) for name in kept}, table, quality)


def _quality(fit: LinearFit, left_out: np.ndarray, parts: int) -> dict[str, float]:
    """Number of readings and terms, and measures of the misfit of the law."""
    readings, terms = len(fit.residuals), len(fit.coefficients)
    unexplained = fit.squares / fit.total_squares
    return {
        "readings": readings,
        "terms": terms,
        "r_squared": 1.0 - unexplained,
        "adjusted_r_squared": 1.0 - unexplained * (readings - 1) / fit.freedom,
        "rms_of_log": float(np.sqrt(fit.squares / readings)),
        "left_out_rms_of_log": float(np.sqrt(np.mean(left_out**2))),
        "left_out_parts": parts,
        "bic": float(readings * (np.log(2.0 * np.pi * fit.squares / readings) + 1.0) + terms * np.log(readings)),
    }
