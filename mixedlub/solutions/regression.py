"""The regression: coefficients from four solutions in five, and their error on the fifth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from mixedlub.ehl.solve import CONVERGED
from mixedlub.friction.condensed import INPUTS, TERMS, coefficient_name, columns, condensed
from mixedlub.solutions.least_squares import least_squares
from profiles.errors import RunError

EVERY = 5
"""Solutions of which one is left out of the fit."""
LEAST = 2 * EVERY * len(TERMS) // (EVERY - 1)
"""Solutions that are needed: two for each term."""


@dataclass(frozen=True)
class Regression:
    """Coefficients of the law with their standard errors, the solutions with fit and residual, and the errors."""

    coefficients: Mapping[str, float]
    standard_errors: Mapping[str, float]
    table: pd.DataFrame
    fit: Mapping[str, float]

    @property
    def terms(self) -> pd.DataFrame:
        """A row a term: coefficient, standard error and their ratio."""
        names = list(self.standard_errors)
        values, errors = ([of[name] for name in names] for of in (self.coefficients, self.standard_errors))
        rows = {"term": [term_in_words(name) for name in names], "coefficient": names, "value": values}
        return pd.DataFrame({**rows, "standard_error": errors, "t": np.array(values) / np.array(errors)})


def term_in_words(name: str) -> str:
    """The term of a coefficient.

    >>> term_in_words("c_ss"), term_in_words("c_0")
    ('s s', '1')
    """
    return " ".join(name.removeprefix("c_")).replace("0", "1")


def limits_of(values: Mapping[str, np.ndarray]) -> dict[str, float]:
    """Coefficients that bound the inputs (in their units) to what was solved or measured."""
    return {
        end: float(value)
        for one in INPUTS
        for end, value in zip(one.ends, (values[one.name].min(), values[one.name].max()), strict=True)
    }


def design_of(values: Mapping[str, np.ndarray]) -> pd.DataFrame:
    """A column a term, named as its coefficient, from the inputs in their units."""
    terms = columns({one.letter: np.log(values[one.name] / one.middle) for one in INPUTS})
    return pd.DataFrame(np.column_stack(np.broadcast_arrays(*terms)), columns=[coefficient_name(t) for t in TERMS])


def fitted(values: Mapping[str, np.ndarray], coefficients: Mapping[str, float]) -> np.ndarray:
    """Friction by the law at inputs in their units."""
    return np.asarray(condensed(*(values[one.name] * one.factor for one in INPUTS), **coefficients))


def regression(solutions: pd.DataFrame, of_oil: Mapping[str, float]) -> Regression:
    """The law fitted to the logarithm of friction by least squares; ``of_oil`` are its coefficients of the oil."""
    table = solutions[solutions["status"] == CONVERGED].reset_index(drop=True)
    if len(table) < LEAST:
        raise RunError(f"{len(table)} contacts have a solution; the regression needs {LEAST}: ask for more solutions")
    values = {one.name: table[one.column].to_numpy() for one in INPUTS}
    design = design_of(values)
    wanted = np.log(table["friction"].to_numpy())
    out = np.arange(len(table)) % EVERY == EVERY - 1
    law = least_squares(design[~out], wanted[~out])
    names = [coefficient_name(term) for term in TERMS]
    coefficients = dict(zip(names, law.coefficients.tolist(), strict=True)) | limits_of(values) | dict(of_oil)
    table["fitted"] = fitted(values, coefficients)
    table["residual_of_log"] = wanted - np.log(table["fitted"].to_numpy())
    table["left_out"] = out
    fit = _errors(table, solutions) | {"rms_of_log_of_published_terms": _published(values, wanted, out)}
    return Regression(coefficients, dict(zip(names, law.standard_errors.tolist(), strict=True)), table, fit)


def _errors(table: pd.DataFrame, solutions: pd.DataFrame) -> dict[str, float]:
    """How well the law has the solutions, on those that it was fitted to and on those left out."""
    left, out = table["residual_of_log"], table["left_out"]
    backwards = table["sliding"] == "first faster"
    away = table["friction"] - table["fitted"]
    rms = {
        "rms_of_log": left[~out],
        "left_out_rms_of_log": left[out],
        "left_out_rms_of_friction": away[out],
        "first_faster_rms_of_log": left[backwards],
        "second_faster_rms_of_log": left[~backwards],
    }
    return {
        "solutions": len(table),
        "without_solution": len(solutions) - len(table),
        "left_out": int(out.sum()),
        **{name: float(np.sqrt(np.mean(values**2))) for name, values in rms.items()},
        "left_out_95_percent_of_log": float(left[out].abs().quantile(0.95)),
        "difference_of_ways_of_log": float(left[~backwards].mean() - left[backwards].mean()),
    }


def _published(values: Mapping[str, np.ndarray], wanted: np.ndarray, out: np.ndarray) -> float:
    """Rms of what the terms of Xu and Kahraman leave of the same solutions, of those left out."""
    p, s, u, v, r = (values[one.name] for one in INPUTS)
    x = s * p * np.log10(v)
    design = np.column_stack([np.ones_like(p), *(np.log(each) for each in (p, s, u, v, r)), x, np.exp(-x)])
    found = np.linalg.lstsq(design[~out], wanted[~out], rcond=None)[0]
    return float(np.sqrt(np.mean((wanted[out] - design[out] @ found) ** 2)))
