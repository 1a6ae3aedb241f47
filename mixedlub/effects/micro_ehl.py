"""Micro-EHL."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.film import wave_amplitude

REFERENCE = 0.01


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
            "texture",
            "-",
            Uniform(0.0, 1.0),
            "attenuation of slopes and curvatures relative to that of heights",
            symbol="r",
            nominal=1.0,
        ),
    ),
    equation=r"m_0 \leftarrow m_0\,[s_0 A_1^2 + (1 - s_0) A_2^2],\quad "
    r"m_2 \leftarrow m_2\,[s_2 A_1^{2r} + (1 - s_2) A_2^{2r}],\quad m_4 \leftarrow m_4\,[s_4 A_1^{2r} + "
    r"(1 - s_4) A_2^{2r}],\quad A_1 = \frac{1}{1 + 0.17\,\nabla + 0.03\,\nabla^2},\ "
    r"\nabla = \frac{2\pi c}{b_H}\sqrt{\frac{s_0 m_0}{s_2 m_2}}\,\frac{M^{3/4}}{L^{1/2}},\ "
    r"A_2 = A_1(1 - s_0,\ 1 - s_2),\quad "
    r"M = \frac{W}{\sqrt{2U}},\ L = G(2U)^{1/4},\quad W = 2\pi(p_0/E')^2,\ G = \alpha E',\ "
    r"U = \frac{\eta_0^a\,\eta_r^{1-a}u}{E'R},\ \eta_r = 0.01\,\text{Pa s}",
    source="C. H. Venner, A. A. Lubrecht, J. Tribol. 116 (1994) 751; A. A. Lubrecht, C. H. Venner, Proc. "
    "IMechE J 213 (1999) 397",
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
    texture: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Film pressure flattens long-wavelength roughness inside the contact.

    Each surface has waves of its own length, 2 pi (m0/m2)^(1/2). W follows from the Hertz pressure, 2 pi (p0/E')^2, as
    for a line contact. Published forms differ in whether inlet viscosity enters; the reference viscosity 0.01 Pa s for
    those without makes the form belong to Pa s. Derived for pure rolling and transverse roughness.

    >>> here = dict(hertz_half_width=0.18e-3, hertz_pressure=0.9642e9, radius=8.3262e-3, reduced_modulus=226.374e9)
    >>> oil = dict(viscosity=0.01489, entrainment_speed=2.163, pressure_viscosity=14.81e-9)
    >>> like = dict(height_share=0.5, slope_share=0.5, curvature_share=0.5)   # waves of 60 um
    >>> form = dict(relative_wavelength=1.0, viscous=1.0, texture=1.0)
    >>> m0, _, _ = micro_ehl(1e-12, (2e-6 * np.pi / 60e-6) ** 2, 1.0, **like, **here, **oil, **form)
    >>> round(float((m0 / 1e-12) ** 0.5), 2)   # amplitude left at nabla = 1.1
    0.82
    """
    inlet = REFERENCE * (viscosity / REFERENCE) ** viscous
    speed = 2.0 * inlet * entrainment_speed / (reduced_modulus * radius)
    load = 2.0 * np.pi * (hertz_pressure / reduced_modulus) ** 2 * speed**-0.5
    material = pressure_viscosity * reduced_modulus * speed**0.25
    left = []
    for heights, slopes in ((height_share, slope_share), (1.0 - height_share, 1.0 - slope_share)):
        length = 2.0 * np.pi * relative_wavelength * np.sqrt(m0 * heights / (m2 * slopes))
        left.append(wave_amplitude(length / hertz_half_width, load, material) ** 2)

    def summed(share: np.ndarray, power: float) -> np.ndarray:
        return share * left[0] ** power + (1.0 - share) * left[1] ** power

    return m0 * summed(height_share, 1.0), m2 * summed(slope_share, texture), m4 * summed(curvature_share, texture)
