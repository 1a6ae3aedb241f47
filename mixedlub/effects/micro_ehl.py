"""Micro-EHL."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.flattening import amplitude_left, reduction_rate

REFERENCE = 0.01
NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(3)
WEIGHTS = WEIGHTS / WEIGHTS.sum()
"""Gauss' rule for a mean over the normal distribution."""


@effect(
    stage="contact",
    acts_on=("m0", "m2", "m4"),
    parameters=(
        Parameter(
            "relative_wavelength",
            "-",
            LogNormal(1.0, 0.6),
            "dominant wavelength of each surface over that of its spectrum",
            null=0.0,
            symbol="c",
        ),
        Parameter(
            "viscous",
            "-",
            Uniform(0.0, 1.0),
            "exponent of viscosity relative to that of speed, 1 in the source",
            symbol="a",
            nominal=1.0,
        ),
        Parameter(
            "spread",
            "-",
            Uniform(0.0, 1.5),
            "variance of the logarithm of the wavelengths of each surface over that of its spectrum",
            symbol="v",
            nominal=0.0,
        ),
    ),
    equation=r"m_{0,2,4} \leftarrow m_{0,2,4}\,[s_{0,2,4} B + (1 - s_{0,2,4}) B'],\quad "
    r"B = \int_{-\infty}^{\infty} \frac{e^{-z^2/2}}{\sqrt{2\pi}}\,A(\nabla e^{(1-k) w + \sqrt{w} z})^2\,dz,\ "
    r"k = 0, 2, 4,\quad A(q) = \frac{1}{1 + 0.17\,q + 0.03\,q^2},\quad "
    r"\nabla = \frac{2\pi c}{b_H}\sqrt{\frac{s_0 m_0}{s_2 m_2}}\,\frac{M^{3/4}}{L^{1/2}},\quad "
    r"w = \frac{v}{4}\ln\frac{s_0 m_0\,s_4 m_4}{(s_2 m_2)^2},\quad B' = B(1 - s_0,\ 1 - s_2,\ 1 - s_4),\quad "
    r"M = \frac{W}{\sqrt{2U}},\ L = G(2U)^{1/4},\quad W = 2\pi(p_0/E')^2,\ G = \alpha E',\quad "
    r"U = \frac{\eta_0^a\,\eta_r^{1-a}u}{E'R},\ \eta_r = 0.01\,\text{Pa s}",
    source="C. H. Venner, A. A. Lubrecht, J. Tribol. 116 (1994) 751; A. A. Lubrecht, C. H. Venner, Proc. "
    "IMechE J 213 (1999) 397; wave by wave of a spectrum as wide as the number of P. R. Nayak, J. Lubr. Technol. 93 "
    "(1971) 398, says",
    fingerprint={"speed": "+", "oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "+"},
    applied_after=("running_in",),
    separated_by="the short-wave filter of the roughness: long waves flatten and short ones do not, most at high "
    "load and low speed, where a plain error of Rq does not change",
    valid={"slide_roll_ratio": (0.0, 2.0)},
)
def micro_ehl(
    m0: np.ndarray,
    m2: np.ndarray,
    m4: np.ndarray,
    height_share: np.ndarray,
    slope_share: np.ndarray,
    curvature_share: np.ndarray,
    hertz_half_width: np.ndarray,
    hertz_pressure: np.ndarray,
    radius: np.ndarray,
    reduced_modulus: np.ndarray,
    viscosity: np.ndarray,
    entrainment_speed: np.ndarray,
    pressure_viscosity: np.ndarray,
    *,
    relative_wavelength: float,
    viscous: float,
    spread: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Film pressure flattens long-wavelength roughness inside the contact.

    The wavelength of each surface is 2 pi (m0/m2)^(1/2): one wave in the source, at ``spread`` 0. At 1 its wavelengths
    are lognormal, as wide as its Nayak number m0 m4/m2^2 says: long waves, which make the heights, flatten more than
    short ones, which make slopes and curvatures. W follows from the Hertz pressure, 2 pi (p0/E')^2, as for a line
    contact. Published forms differ in whether inlet viscosity enters; the reference viscosity 0.01 Pa s for those
    without makes the form belong to Pa s. Derived for pure rolling and transverse roughness.

    >>> here = dict(hertz_half_width=0.18e-3, hertz_pressure=0.9642e9, radius=8.3262e-3, reduced_modulus=226.374e9)
    >>> oil = dict(viscosity=0.01489, entrainment_speed=2.163, pressure_viscosity=14.81e-9)
    >>> like = dict(height_share=0.5, slope_share=0.5, curvature_share=0.5)   # waves of 60 um
    >>> form = dict(relative_wavelength=1.0, viscous=1.0, spread=0.0)
    >>> m0, _, _ = micro_ehl(1e-12, (2e-6 * np.pi / 60e-6) ** 2, 1.0, **like, **here, **oil, **form)
    >>> round(float((m0 / 1e-12) ** 0.5), 2)   # amplitude left at nabla = 1.1
    0.82
    """
    inlet = REFERENCE * (viscosity / REFERENCE) ** viscous
    speed = 2.0 * inlet * entrainment_speed / (reduced_modulus * radius)
    load = 2.0 * np.pi * (hertz_pressure / reduced_modulus) ** 2 * speed**-0.5
    material = pressure_viscosity * reduced_modulus * speed**0.25
    rate = 2.0 * np.pi * relative_wavelength / hertz_half_width * reduction_rate(load, material)
    kept: list[list[np.ndarray]] = [[], [], []]
    first = (height_share, slope_share, curvature_share)
    for heights, slopes, curvatures in (first, tuple(1.0 - share for share in first)):
        typical = rate * np.sqrt(m0 * heights / (m2 * slopes))
        variance = 0.25 * spread * np.log(np.maximum(m0 * heights * m4 * curvatures / (m2 * slopes) ** 2, 1.0))
        longer = [np.exp(np.sqrt(variance) * node) for node in NODES]
        for place, share in enumerate((heights, slopes, curvatures)):
            middle = typical * np.exp((1 - 2 * place) * variance)
            left = (w * amplitude_left(middle * length) ** 2 for w, length in zip(WEIGHTS, longer, strict=True))
            kept[place].append(share * sum(left))
    return m0 * sum(kept[0]), m2 * sum(kept[1]), m4 * sum(kept[2])
