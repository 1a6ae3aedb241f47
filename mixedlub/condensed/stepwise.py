"""Stepwise multiple regression: which terms of a law measured friction asks for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
import pandas as pd

from mixedlub.condensed.regression import Regression, design_of, fitted, limits_of
from mixedlub.friction.condensed import INPUTS, OIL, TERMS, coefficient_name

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
CONSTANT = coefficient_name("")


def least_squares(design: pd.DataFrame, wanted: np.ndarray) -> Any:
    """Ordinary least squares by statsmodels."""
    from statsmodels.regression.linear_model import OLS

    return OLS(wanted, design).fit()


def chosen_terms(design: pd.DataFrame, wanted: np.ndarray, criterion: Criterion) -> list[str]:
    """Columns of the design that a stepwise regression keeps, the constant first.

    Each step adds the term that improves the fit most, then drops those that have become needless: by the Bayesian
    information criterion, or by p-values of 0.05 to enter and 0.10 to leave.

    >>> x = np.random.default_rng(0).standard_normal((60, 4))
    >>> table = pd.DataFrame({"c_0": 1.0, "c_p": x[:, 0], "c_s": x[:, 1], "c_u": x[:, 2]})
    >>> chosen_terms(table, 1.0 + 2.0 * x[:, 1] + 0.1 * x[:, 2] + 1e-3 * x[:, 3], "bic")
    ['c_0', 'c_s', 'c_u']
    """
    kept, seen = [CONSTANT], set()
    while tuple(kept) not in seen:
        seen.add(tuple(kept))
        kept = _without_needless(design, wanted, _with_best(design, wanted, kept, criterion), criterion)
    return kept


def _with_best(design: pd.DataFrame, wanted: np.ndarray, kept: Sequence[str], criterion: Criterion) -> list[str]:
    """The terms with the one that improves the fit most, if any does."""
    if (len(kept) + 1) * PER_TERM > len(wanted):
        return list(kept)
    others = _determined(design, kept)
    fits = {name: least_squares(design[[*kept, name]], wanted) for name in others}
    if criterion == "bic":
        worth = {name: float(fit.bic) for name, fit in fits.items()}
        limit = float(least_squares(design[list(kept)], wanted).bic)
    else:
        worth, limit = {name: float(fit.pvalues[name]) for name, fit in fits.items()}, ENTER
    best = min(worth, key=lambda name: worth[name], default=None)
    return [*kept, best] if best is not None and worth[best] < limit else list(kept)


def _determined(design: pd.DataFrame, kept: Sequence[str]) -> list[str]:
    """Terms that differ from what those kept already make up."""
    known, others = design[list(kept)].to_numpy(), [str(name) for name in design if name not in kept]
    values = design[others].to_numpy()
    left = values - known @ np.linalg.lstsq(known, values, rcond=None)[0]
    share = (left**2).sum(axis=0) / np.maximum((values**2).sum(axis=0), np.finfo(float).tiny)
    return [name for name, own in zip(others, share, strict=True) if own > DETERMINED]


def _without_needless(design: pd.DataFrame, wanted: np.ndarray, kept: list[str], criterion: Criterion) -> list[str]:
    """The terms without those whose loss improves the criterion, one after the other."""
    while len(kept) > 1:
        now = least_squares(design[kept], wanted)
        if criterion == "bic":
            without = {name: least_squares(design[[k for k in kept if k != name]], wanted).bic for name in kept[1:]}
            worst = min(without, key=lambda name: without[name])
            if without[worst] >= now.bic:
                break
        else:
            worst = str(now.pvalues[kept[1:]].idxmax())
            if now.pvalues[worst] <= LEAVE:
                break
        kept = [name for name in kept if name != worst]
    return kept


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
    products of up to ``order`` logarithms of the inputs. Standard errors hold for the terms chosen, and for readings
    that scatter independently. Coefficients of the oil are left unknown.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, chapter 3, for the multiple regression of the logarithm of
    measured friction over transformed terms.
    """
    every, wanted = design_of(values), np.log(friction)
    kept = chosen_terms(every[candidates(varied(values), order)], wanted, by)
    fit = least_squares(every[kept], wanted)
    coefficients = (
        dict.fromkeys([*map(str, every), *OIL], 0.0)
        | {name: float(fit.params[name]) for name in kept}
        | limits_of(values)
    )
    table = pd.DataFrame({one.column: values[one.name] for one in INPUTS} | {"friction_coefficient": friction})
    table["fitted"] = fitted(values, coefficients)
    table["residual_of_log"] = wanted - np.log(table["fitted"].to_numpy())
    influence = fit.get_influence()
    table["standardised_residual"] = influence.resid_studentized_internal
    return Regression(coefficients, {name: float(fit.bse[name]) for name in kept}, table, _quality(fit, influence))


def _quality(fit: Any, influence: Any) -> dict[str, float]:
    """How many readings and terms, and how well the law has them."""
    return {
        "readings": int(fit.nobs),
        "terms": len(fit.params),
        "r_squared": float(fit.rsquared),
        "adjusted_r_squared": float(fit.rsquared_adj),
        "rms_of_log": float(np.sqrt(np.mean(np.asarray(fit.resid) ** 2))),
        "left_out_rms_of_log": float(np.sqrt(np.mean(np.asarray(influence.resid_press) ** 2))),
        "bic": float(fit.bic),
    }
