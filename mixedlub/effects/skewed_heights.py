"""Skewed heights."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal, Uniform
from mixedlub.laws.contact import area_per_overlap
from roughness.integrals import area_integral

_LIMIT_BELOW = 1e-4


@effect(
    stage="contact",
    acts_on="area_ratio",
    parameters=(
        Parameter(
            "skewness",
            "-",
            Normal(-0.6, 0.8),
            "skewness of the heights; negative for plateaus",
            null=0.0,
            symbol="S_{sk}",
        ),
        Parameter(
            "narrowing",
            "-",
            Uniform(0.0, 0.6),
            "degree to which the spread of the summits narrows to that of the plateau",
            symbol="n",
            nominal=0.0,
        ),
    ),
    equation=r"P_B \leftarrow P_B + \pi D R_s\sigma_s\,[w F(t/w) - F_1(t)]\ (0 \leq P_B \leq 1),\quad "
    r"w = e^{n S_{sk}},\quad "
    r"F(t) = \frac{y\,\Phi(d) - \Phi(d-k)}{x}\ (y > 0;\ \text{otherwise}\ \max(-t, 0)),\ y = 1 - x t,\ "
    r"d = \frac{\ln y}{k} + \frac{k}{2},\ k = \operatorname{sgn}(x)\sqrt{\ln(1 + x^2)},\ x^3 + 3x = -S_{sk},\quad "
    r"F_1(t) = \int_t^\infty (z - t)\,\Phi'(z)\,dz",
    source="J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300, with lognormal heights "
    "(N. L. Johnson, Biometrika 36 (1949) 149, system S_L) in place of normal ones",
    fingerprint={"load": "+", "oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "+"},
    separated_by="the measured height distribution (Abbott curve): a plateau moves the knee of loss against film ratio "
    "to thinner films and leaves the fluid's friction alone",
    valid={"area_ratio": (0.0, 0.3)},
)
def skewed_heights(
    area_ratio: np.ndarray,
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    *,
    skewness: float,
    narrowing: float,
) -> np.ndarray:
    """Heights worn to a plateau have less contact area than Gaussian ones; a few high peaks give more.

    Heights keep their mean and, without narrowing, their standard deviation; the heights of a negatively skewed surface
    have an upper bound. Narrowing lets the summits of a plateau be smoother than the whole surface with its valleys.

    >>> area = np.pi * 1e-2 * area_integral(np.array([-1.0, 1.0, 2.0]))
    >>> flat = skewed_heights(area, np.array([-1.0, 1.0, 2.0]), 1e10, 1e-5, 1e-7, skewness=-0.8, narrowing=0.0)
    >>> (flat / area).round(2).tolist()   # deep in more contact, high up less
    [1.02, 0.59, 0.05]
    """
    width = np.exp(narrowing * skewness)
    change = width * _skewed_area_integral(separation / width, skewness) - area_integral(separation)
    return np.clip(area_ratio + area_per_overlap(summit_density, summit_radius, summit_sigma) * change, 0.0, 1.0)


def _skewed_area_integral(t: np.ndarray, skewness: float) -> np.ndarray:
    """Mean of (s - t) above t for standardised lognormal heights of a given skewness."""
    from scipy.special import ndtr

    if abs(skewness) < _LIMIT_BELOW:
        odd = t * np.exp(-0.5 * np.square(t)) / np.sqrt(2.0 * np.pi)
        return area_integral(t) + skewness / 6.0 * odd
    spread = _spread(abs(skewness))
    shape = -np.sign(skewness) * np.sqrt(np.log1p(spread**2))
    inside = 1.0 - t * np.sign(shape) * spread
    kept = np.maximum(inside, 1e-300)
    depth = np.log(kept) / shape + 0.5 * shape
    value = (kept * ndtr(depth) - ndtr(depth - shape)) / (np.sign(shape) * spread)
    return np.where(inside > 0.0, value, np.maximum(-t, 0.0))


def _spread(skewness: float) -> float:
    """Root x of (x^2 + 3) x = skewness, the coefficient of variation of the lognormal."""
    root = (0.5 * skewness + np.sqrt(0.25 * skewness**2 + 1.0)) ** (1.0 / 3.0)
    return root - 1.0 / root
