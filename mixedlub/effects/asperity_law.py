"""Contact of asperities by another elastic theory."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal, Uniform

MIDDLE_NAYAK = 10.0
"""Definition. Nayak number at which the factor on the density is the stated one."""


@effect(
    stage="law",
    acts_on=("summit_density", "summit_sigma", "plane_offset"),
    parameters=(
        Parameter("density", "-", LogNormal(1.0, 0.4), "summits over those of the base law", null=1.0, symbol="f"),
        Parameter("nayak_exponent", "-", Normal(0.0, 0.3), "exponent of the Nayak number in it", null=0.0, symbol="a"),
        Parameter(
            "heights",
            "-",
            Normal(0.0, 0.5),
            "share of the way from the heights of the summits to those of the whole surface",
            null=0.0,
            symbol="r",
        ),
        Parameter(
            "offset",
            "-",
            Normal(0.0, 0.4),
            "separation beyond that of the base law, in standard deviations of these heights",
            null=0.0,
            symbol="d",
            base_sd=0.15,
        ),
        Parameter(
            "each",
            "-",
            Uniform(0.0, 1.0),
            "exponent by which summits of both surfaces count, not those of their sum",
            null=0.0,
            symbol="q",
        ),
    ),
    equation=r"D \leftarrow f\left(\frac{\alpha}{10}\right)^{a}"
    r"\left[\frac{\sqrt{s_4(1 - s_4)}}{2 s_2 (1 - s_2)}\right]^{q} D,\quad "
    r"\alpha = \frac{16\,\sigma^2}{\pi z_s^2},\quad "
    r"\sigma_s \leftarrow \sigma_s^{1-r}\sigma^{r},\quad z_s \leftarrow (1 - r)\,z_s - d\,\sigma_s",
    source="A. W. Bush, R. D. Gibson, T. R. Thomas, Wear 35 (1975) 87; J. A. Greenwood, J. H. Tripp, Proc. IMechE 185 "
    '(1970) 625, over mean planes (over summit planes it is the option asperities = "greenwood_tripp"); '
    "B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840; against J. A. Greenwood, J. B. P. Williamson, "
    "Proc. R. Soc. A 295 (1966) 300",
    fingerprint={"oil_temperature": "+", "roughness": "+"},
    separated_by="contact resistance or the real area itself over the film thickness",
    replaces="contact of the asperities",
    special_cases={
        "Greenwood and Tripp over mean planes": {
            "density": 0.97,
            "nayak_exponent": 0.49,
            "heights": 1.03,
            "offset": 0.45,
            "each": 1.0,
        },
        "Bush, Gibson and Thomas": {
            "density": 1.36,
            "nayak_exponent": -0.01,
            "heights": 0.2,
            "offset": -0.01,
            "each": 0.0,
        },
        "Persson": {"density": 1.62, "nayak_exponent": 0.19, "heights": 0.14, "offset": 0.18, "each": 0.0},
    },
)
def asperity_law(
    summit_density: np.ndarray,
    summit_sigma: np.ndarray,
    plane_offset: np.ndarray,
    composite_roughness: np.ndarray,
    slope_share: np.ndarray,
    curvature_share: np.ndarray,
    *,
    density: float,
    nayak_exponent: float,
    heights: float,
    offset: float,
    each: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Elastic asperities touch over another area than Greenwood and Williamson's theory gives.

    Theories differ in the counted heights, of summits or of the whole surface, in the plane from which the separation
    is measured, and in the number of contacts and how it goes with the bandwidth of the spectrum. For Nayak numbers of
    3 to 30 and films of up to 2.5 times the roughness such a change reproduces the area of two like surfaces by
    Greenwood and Tripp, and the area by Bush, Gibson and Thomas, within 1.5 %, and the area of Persson's theory, at
    Greenwood and Williamson's pressure, within 2.5 %. Areas below 0.02 count as 0.02 in this. Asperities that yield are
    `asperity_plasticity`.

    >>> law = dict(density=1.0, nayak_exponent=0.5, heights=1.0, offset=0.5, each=1.0)
    >>> changed = asperity_law(4.4106e10, 0.48970e-6, 0.13298e-6, 0.49422e-6, 0.5, 0.5, **law)
    >>> [float(f"{value:.4g}") for value in changed]   # at a Nayak number of 70.3
    [117000000000.0, 4.942e-07, -2.471e-07]
    """
    nayak = 16.0 / np.pi * (composite_roughness / plane_offset) ** 2
    spread = summit_sigma * (composite_roughness / summit_sigma) ** heights
    plane = (1.0 - heights) * plane_offset - offset * spread
    unlike = np.sqrt(curvature_share * (1.0 - curvature_share)) / (2.0 * slope_share * (1.0 - slope_share))
    factor = density * (nayak / MIDDLE_NAYAK) ** nayak_exponent * unlike**each
    return factor * summit_density, spread, plane
