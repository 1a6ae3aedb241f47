"""File of a fitted friction law, and its deviation from the published law."""

from __future__ import annotations

import json
from collections.abc import Mapping

import numpy as np
import pandas as pd

from mixedlub.friction.condensed import INPUTS, condensed
from mixedlub.friction.xu_kahraman import xu_kahraman
from mixedlub.schema.friction_file import SCHEMA
from mixedlub.solutions.regression import Regression

LEVELS = 5
"""Levels of pressure, sliding, speed and viscosity for the comparison of both laws."""
SMOOTH = 0.0
"""Composite roughness in the published law (m): the solutions are for smooth surfaces."""


def law_file(oil: str, found: Regression) -> str:
    """Text of the file for `friction_coefficients` of a study."""
    about = f"Friction of full thermal solutions for {oil}.\nSmooth surfaces of steel. Written by `mixedlub condense`."
    return friction_file("condensed", oil, about, found.fit, found.coefficients)


def friction_file(law: str, oil: str, about: str, fit: Mapping[str, float], coefficients: Mapping[str, float]) -> str:
    """File of a fitted friction law; ``about``: description of the data, by line."""
    lines = [
        *(f"# {line}" for line in about.splitlines()),
        f'# In a study: [options] friction = "{law}" and friction_coefficients = "THIS FILE".',
        f'schema = "{SCHEMA}"',
        f'law = "{law}"',
        f"oil = {json.dumps(oil, ensure_ascii=False)}",
        "",
        "[fit]",
        *(f"{name} = {_number(value)}" for name, value in fit.items()),
        "",
        "[coefficients]",
        *(f"{name} = {_number(value)}" for name, value in coefficients.items()),
    ]
    return "\n".join(lines) + "\n"


def _number(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:.9g}"


def against_published(found: Regression) -> pd.DataFrame:
    """Friction by the condensed law and by Xu and Kahraman's over the range of the solutions, at the middle radius."""
    ends = [[found.coefficients[end] for end in one.ends] for one in INPUTS]
    axes = [np.geomspace(low, high, LEVELS) for low, high in ends[:-1]]
    radius = np.sqrt(np.prod(ends[-1]))
    grid = [axis.ravel() for axis in np.meshgrid(*axes, [radius], indexing="ij")]
    values = [one.factor * axis for one, axis in zip(INPUTS, grid, strict=True)]
    own = condensed(*values, **found.coefficients)
    published = xu_kahraman(*[*values, np.full_like(own, SMOOTH)])
    table = pd.DataFrame(dict(zip([one.column for one in INPUTS], grid, strict=True)))
    return table.assign(condensed_friction=own, published_friction=published, published_over_condensed=published / own)
