"""Friction of a smooth film by a regression of full solutions for one oil, from a file of `mixedlub condense`."""

import inspect
from collections.abc import Mapping
from functools import reduce
from itertools import combinations_with_replacement
from operator import mul
from typing import NamedTuple

import numpy as np

from mixedlub.chain.friction_law import Coefficient, OfOil, friction_law
from mixedlub.laws.oil import ZERO_CELSIUS


class Input(NamedTuple):
    """A quantity of the regression: letter, name, unit with its factor to SI, and reference value of its logarithm."""

    letter: str
    name: str
    unit: str
    factor: float
    middle: float

    @property
    def column(self) -> str:
        """Column name with unit."""
        return f"{self.name}_{self.unit}" if self.unit else self.name

    @property
    def written(self) -> str:
        """Unit as text."""
        return {"": "-", "m_s": "m/s", "mPa_s": "mPa s"}.get(self.unit, self.unit)

    @property
    def ends(self) -> tuple[str, str]:
        """Names of the coefficients that bound the quantity."""
        return f"least_{self.column}", f"largest_{self.column}"


INPUTS = (
    Input("p", "hertz_pressure", "GPa", 1e9, 1.0),
    Input("s", "slide_roll_ratio", "", 1.0, 0.1),
    Input("u", "entrainment_speed", "m_s", 1.0, 5.0),
    Input("v", "viscosity", "mPa_s", 1e-3, 10.0),
    Input("r", "radius", "mm", 1e-3, 10.0),
)
_CUBIC = "psuv"
TERMS = tuple(
    "".join(letters)
    for order in range(4)
    for letters in combinations_with_replacement("psuvr" if order < 3 else _CUBIC, order)
)
"""Products of logarithms by their letters: all up to two, and of three without the radius, the weakest input."""


def coefficient_name(term: str) -> str:
    """Name of a term's coefficient.

    >>> coefficient_name("pps"), coefficient_name("")
    ('c_pps', 'c_0')
    """
    return f"c_{term or 0}"


def columns(logarithms: Mapping[str, np.ndarray]) -> list[np.ndarray]:
    """All terms, from the logarithm of each input by its letter."""
    return [reduce(mul, (logarithms[letter] for letter in term), np.ones(())) for term in TERMS]


def _law(*quantities: np.ndarray, **coefficients: float) -> np.ndarray:
    r"""Friction coefficient of a smooth film of one oil (-), a regression of full thermal solutions.

    .. math:: \ln\mu = c_0 + \sum_i c_i x_i + \sum_{i \le j} c_{ij} x_i x_j + \sum_{i \le j \le k} c_{ijk} x_i x_j x_k

    of the logarithms of pressure p (1 GPa), slide-to-roll ratio s (0.1), speed u (5 m/s), viscosity v (10 mPa s) and
    reduced radius r (10 mm), each over the value in brackets. The viscosity stands for the temperature of this oil.
    Quantities beyond the range of the solutions are held at its ends, and flagged; only below the least sliding,
    as at a pitch point, friction falls in proportion to sliding. No asperities. The oil of a study is compared with
    the oil of the solutions: viscosity and Eyring stress to 10 %, the pressure-viscosity coefficient to 20 %.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, chapter 3, for the regression of a logarithm over
    transformed terms; these terms are others, which fit better.

    >>> given = dict.fromkeys((c.name for c in COEFFICIENTS), 0.0)
    >>> given |= {name: end for one in INPUTS for name, end in zip(one.ends, (0.01, 100.0))}
    >>> given |= {"c_0": np.log(0.02), "c_p": 1.0, "c_ss": np.log(2.0) / np.log(2.0) ** 2}
    >>> [round(float(condensed(2e9, s, 5.0, 0.010, 0.010, **given)), 4) for s in (0.1, 0.2, 0.0)]
    [0.04, 0.08, 0.0]
    """
    logarithms = {}
    for one, value in zip(INPUTS, quantities, strict=True):
        low, high = (coefficients[name] for name in one.ends)
        logarithms[one.letter] = np.log(np.clip(np.asarray(value) / one.factor, low, high) / one.middle)
    values = [coefficients[coefficient_name(term)] for term in TERMS]
    friction = np.exp(sum(c * column for c, column in zip(values, columns(logarithms), strict=True)))
    return np.asarray(friction * np.minimum(quantities[1] / coefficients[INPUTS[1].ends[0]], 1.0))


CELSIUS = (40, 75, 110)
"""Temperatures for the comparison of a study's oil with the oil of the solutions."""
OIL = {
    **{f"oil_viscosity_{t}C": OfOil("viscosity", t + ZERO_CELSIUS, 1e-3, 0.1) for t in CELSIUS},
    **{f"oil_pressure_viscosity_{t}C": OfOil("pressure_viscosity", t + ZERO_CELSIUS, 1e-9, 0.2) for t in CELSIUS},
    "oil_eyring_stress": OfOil("eyring_stress", CELSIUS[0] + ZERO_CELSIUS, 1e6, 0.1),
}
"""Required properties of the study's oil, by coefficient. Tolerances: differences of viscometers and rheometers."""
_OIL_UNITS = {"viscosity": "mPa s", "pressure_viscosity": "1/GPa", "eyring_stress": "MPa"}
_OIL_WORDS = {
    **{f"oil_viscosity_{t}C": f"viscosity of the oil of the solutions at {t} °C" for t in CELSIUS},
    **{f"oil_pressure_viscosity_{t}C": f"its pressure-viscosity coefficient at {t} °C" for t in CELSIUS},
    "oil_eyring_stress": "its Eyring stress; zero where another law of shear is its own",
}
COEFFICIENTS = (
    *(Coefficient(coefficient_name(t), "-", f"of the term {' '.join(t) or '1'}") for t in TERMS),
    *(
        Coefficient(end, one.written, f"{word} {one.name.replace('_', ' ')} of the solutions")
        for one in INPUTS
        for end, word in zip(one.ends, ("least", "largest"))
    ),
    *(Coefficient(name, _OIL_UNITS[one.quantity], _OIL_WORDS[name]) for name, one in OIL.items()),
)
_law.__name__ = "condensed"
_law.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
    [
        *(inspect.Parameter(one.name, inspect.Parameter.POSITIONAL_OR_KEYWORD) for one in INPUTS),
        *(inspect.Parameter(c.name, inspect.Parameter.KEYWORD_ONLY) for c in COEFFICIENTS),
    ]
)
condensed = friction_law(
    "Condensed full solutions",
    "contact",
    sources=0,
    status="regression of this package's own full solutions for one oil: `mixedlub condense OIL` writes a file with "
    "the coefficients, their range and their error; `mixedlub evaluate regression` writes one of measured traction",
    coefficients=COEFFICIENTS,
    of_oil=OIL,
    limits={one.name: (None if one.letter == "s" else one.ends[0], one.ends[1], one.factor) for one in INPUTS},
)(_law)
