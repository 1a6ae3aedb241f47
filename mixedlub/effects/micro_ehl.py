"""Micro-EHL."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

REFERENCE = 0.01


@effect(
    stage="contact",
    acts_on=("m0", "m2", "m4"),
    parameters=(
        Parameter(
            "wavelength",
            "m",
            LogNormal(40e-6, 0.9),
            "dominant wavelength of the roughness",
            null=0.0,
            symbol=r"\lambda_w",
        ),
        Parameter(
            "viscous",
            "-",
            Uniform(0.0, 1.0),
            "exponent of viscosity relative to that of speed, 1 in the source",
            symbol="a",
        ),
        Parameter(
            "texture",
            "-",
            Uniform(0.0, 1.0),
            "attenuation of slopes and curvatures relative to that of heights",
            symbol="r",
        ),
    ),
    equation=r"m_0 \leftarrow m_0 A^2,\ m_{2,4} \leftarrow m_{2,4} A^{2r},\quad "
    r"A = \frac{1}{1 + 0.15\,\nabla + 0.015\,\nabla^2},\quad \nabla = \frac{\lambda_w}{b_H}\,\frac{M^{3/4}}{L^{1/2}},\ "
    r"M = \frac{W}{\sqrt{2U}},\ L = G(2U)^{1/4},\quad W = 2\pi(p_0/E')^2,\ G = \alpha E',\ "
    r"U = \frac{\eta_0^a\,\eta_r^{1-a}u}{E'R},\ \eta_r = 0.01\,\text{Pa s}",
    source="C. H. Venner, A. A. Lubrecht, J. Tribol. 116 (1994) 751; A. A. Lubrecht, C. H. Venner, Proc. "
    "IMechE J 213 (1999) 397",
    fingerprint={"speed": "+", "oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "+"},
    separated_by="the short-wave filter of the roughness: long waves flatten and short ones do not, most at high "
    "load and low speed, where a plain error of Rq does not change",
    valid={"slide_roll_ratio": (0.0, 2.0)},
)
def micro_ehl(
    m0: np.ndarray,
    m2: np.ndarray,
    m4: np.ndarray,
    hertz_half_width: np.ndarray,
    hertz_pressure: np.ndarray,
    radius: np.ndarray,
    reduced_modulus: np.ndarray,
    viscosity: np.ndarray,
    entrainment_speed: np.ndarray,
    pressure_viscosity: np.ndarray,
    *,
    wavelength: float,
    viscous: float,
    texture: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Film pressure flattens long-wavelength roughness inside the contact.

    W follows from the Hertz pressure, 2 pi (p0/E')^2. Published forms differ in whether inlet viscosity enters; the
    reference viscosity 0.01 Pa s for those without makes the form belong to Pa s. Derived for pure rolling and
    transverse roughness.

    >>> here = dict(hertz_half_width=0.18e-3, hertz_pressure=0.9642e9, radius=8.3262e-3, reduced_modulus=226.374e9)
    >>> oil = dict(viscosity=0.01489, entrainment_speed=2.163, pressure_viscosity=14.81e-9)
    >>> m0, _, _ = micro_ehl(1.0, 1.0, 1.0, **here, **oil, wavelength=60e-6, viscous=1.0, texture=1.0)
    >>> round(m0**0.5, 2)   # amplitude left at nabla = 1.1
    0.85
    """
    inlet = REFERENCE * (viscosity / REFERENCE) ** viscous
    speed = 2.0 * inlet * entrainment_speed / (reduced_modulus * radius)
    load = 2.0 * np.pi * (hertz_pressure / reduced_modulus) ** 2
    moes = (load / speed**0.5) ** 0.75 / (pressure_viscosity * reduced_modulus * speed**0.25) ** 0.5
    length = wavelength / hertz_half_width * moes
    attenuation = (1.0 + 0.15 * length + 0.015 * length**2) ** -2
    short = attenuation**texture
    return m0 * attenuation, m2 * short, m4 * short
