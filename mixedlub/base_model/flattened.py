"""Chain with the roughness left inside the film."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.chain.model import Chain, Law
from mixedlub.chain.renamed import renamed
from mixedlub.laws.flattening import flattening_rate, kept_moments
from roughness.waves import Waves

STEP = 0.1
"""Grid. Logarithmic steps of the tables: linear in the logarithms they are within 1e-3 of the sums over the waves."""
RATES = np.arange(0.0, 21.0, STEP)
"""Grid. Logarithms of flattening rates (1/m), beyond which waves of 1 nm to 0.5 m are flat or as they were."""
CUTOFFS = np.arange(-18.5, -6.5, STEP)
"""Grid. Logarithms of short cut-offs (m) tied to the contact: 10 nm to 1.5 mm."""
LEAST = 1e-30
"""Grid. Smallest kept share with a logarithm."""
MOMENTS, SHARES = ("m0", "m2", "m4"), ("height_share", "slope_share", "curvature_share")
IN_FILM = {name: f"film_{name}" for name in (*MOMENTS, *SHARES)}
"""Names of the moments outside the film, with the names inside."""
OF_ASPERITIES = (
    *("summit_density", "summit_radius", "summit_sigma", "plane_offset"),
    *("separation", "area_ratio", "asperity_pressure"),
)
"""Steps that read the roughness inside the film."""


@dataclass(frozen=True, eq=False)
class Flattening:
    """Logarithms of kept moments by surface, moment, rate and short cut-off.

    ``flattens``: whether the film flattens waves; ``cutoff_share``: short cut-off over the half width of the contact,
    None for the cut-offs of the surfaces themselves.
    """

    logs: np.ndarray
    flattens: bool
    cutoff_share: float | None

    def kept(self, order: int, rows: np.ndarray, rate: np.ndarray, half_width: np.ndarray) -> np.ndarray:
        """Kept share of a moment of surfaces by row, linear in the logarithms."""
        table = self.logs[:, order]
        row = np.asarray(rows).astype(int)
        low, part = _place(rate, RATES) if self.flattens else (np.zeros(1, dtype=int), 0.0)
        if self.cutoff_share is None:
            found = _between(table[row, low, 0], table[row, low + self.flattens, 0], part)
        else:
            near, share = _place(self.cutoff_share * half_width, CUTOFFS)
            finer, coarser = (
                _between(table[row, low, at], table[row, low + self.flattens, at], part) for at in (near, near + 1)
            )
            found = _between(finer, coarser, share)
        return np.exp(found)


def _place(value: np.ndarray, grid: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Index below a value in an even grid of logarithms, and the part of the step beyond; held at both ends."""
    with np.errstate(divide="ignore", invalid="ignore"):
        place = np.clip((np.log(value) - grid[0]) / STEP, 0.0, grid.size - 1.0)
    place = np.where(np.isnan(place), 0.0, place)
    low = np.minimum(place.astype(int), grid.size - 2)
    return low, place - low


def _between(low: np.ndarray, high: np.ndarray, part: np.ndarray | float) -> np.ndarray:
    return np.asarray(low + part * (high - low))


def flattening(waves: Sequence[tuple[Waves, float]], flattens: bool, cutoff_share: float | None) -> Flattening:
    """Tables of surfaces, each with its waves and the factor of its lay on the flattening rate.

    >>> ripple = Waves(np.array([60e-6]), np.ones((3, 1)))
    >>> one = flattening([(ripple, 1.0)], True, None)
    >>> round(float(one.kept(0, np.array(0.0), np.array(1.1 / 60e-6), np.array(1.0)) ** 0.5), 2)
    0.82
    """
    rates = np.exp(RATES) if flattens else np.zeros(1)
    cutoffs = np.zeros(1) if cutoff_share is None else np.exp(CUTOFFS)
    tables = [kept_moments(one.lengths, one.shares, rates * factor, cutoffs) for one, factor in waves]
    return Flattening(np.log(np.maximum(tables, LEAST)), flattens, cutoff_share)


class _InFilm:
    """A moment of both surfaces inside the film, or the share of the first surface in it, as a law of the chain."""

    def __init__(self, tables: Flattening, order: int, shared: bool) -> None:
        self.tables, self.order, self.shared = tables, order, shared
        self.__name__ = IN_FILM[(SHARES if shared else MOMENTS)[order]]
        own = (SHARES[order],) if shared else (MOMENTS[order], SHARES[order])
        kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
        names = (*own, "first_waves", "second_waves", "flattening_rate", "hertz_half_width")
        self.__signature__ = inspect.Signature([inspect.Parameter(n, kind) for n in names])
        self.__doc__ = WORDS

    def __call__(self, *values: np.ndarray) -> np.ndarray:
        *own, first, second, rate, half_width = values
        share = own[-1]
        kept = [self.tables.kept(self.order, rows, rate, half_width) for rows in (first, second)]
        of_first, of_second = share * kept[0], (1.0 - share) * kept[1]
        return of_first / (of_first + of_second) if self.shared else own[0] * (of_first + of_second)


WORDS = r"""Moment of the roughness inside the film, both surfaces together, or the share of the first in it.

    .. math:: m_n' = m_n\left[s_n K_1 + (1 - s_n) K_2\right],\quad
              K = \sum_w s_{n,w}\,A(\lambda_w g)^2\,e^{-2\pi(\alpha\lambda_c/\lambda_w)^2}

    over the waves of each surface. Source: C. H. Venner, A. A. Lubrecht, Proc. IMechE J 213 (1999) 397, wave by wave.
    """


def with_flattening(chain: Chain, tables: Flattening) -> Chain:
    """Chain of a line contact, its asperities with the moments inside the film.

    The film, its roughness outside and the film ratio stay as measured. A balance of the load
    that is added later reads the flattened asperities too.

    >>> from mixedlub.base_model.chains import LINE
    >>> ripple = Waves(np.array([60e-6]), np.ones((3, 1)))
    >>> names = [name for name, _ in with_flattening(LINE, flattening([(ripple, 1.0)], True, None))]
    >>> names[names.index("composite_roughness") :][:4]
    ['composite_roughness', 'flattening_rate', 'film_m0', 'film_m2']
    """
    made = (("flattening_rate", flattening_rate), *_moments(tables))
    place = [name for name, _ in chain].index("summit_density")
    after = ((name, of_flattened(law) if name in OF_ASPERITIES else law) for name, law in chain[place:])
    return (*chain[:place], *made, *after)


def of_flattened(law: Law) -> Law:
    """A law of asperities that reads the roughness inside the film."""
    return renamed(law, IN_FILM)


def _moments(tables: Flattening) -> Iterator[tuple[str, Law]]:
    for shared, names in ((False, MOMENTS), (True, SHARES)):
        for order, name in enumerate(names):
            yield IN_FILM[name], _InFilm(tables, order, shared)
