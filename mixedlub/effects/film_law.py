"""Film of a contact by another published regression."""

from math import pi

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal
from mixedlub.laws.film import LINE_EXPONENT, LINE_LOAD_EXPONENT

MIDDLE_SPEED, MIDDLE_PRESSURE, MIDDLE_MATERIAL = 1e-11, 4e-3, 4e3
"""Definition. Groups about which the exponents turn, those of a gear contact: eta_0 u/(E' R), p_0/E' and alpha E'."""


def _against_dowson_toyoda(constant: float, speed: float, material: float, load: float) -> dict[str, float]:
    """A regression of line contacts in the groups U, G and W, over that of Dowson and Toyoda at the middle."""
    middle_load = 2.0 * pi * MIDDLE_PRESSURE**2
    more_speed, more_load = speed - LINE_EXPONENT, load - LINE_LOAD_EXPONENT
    factor = constant / 3.06 * MIDDLE_SPEED**more_speed * MIDDLE_MATERIAL ** (material - 0.56)
    return {
        "factor": factor * middle_load**more_load,
        "speed_exponent": more_speed,
        "pressure_exponent": 2.0 * more_load,
    }


@effect(
    stage="law",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "factor", "-", LogNormal(1.0, 0.2), "film over that of the base law at the middle", null=1.0, symbol="f"
        ),
        Parameter(
            "speed_exponent",
            "-",
            Normal(0.0, 0.02),
            "exponent of speed and viscosity beyond that of the base law",
            null=0.0,
            symbol="a",
            base_sd=0.01,
        ),
        Parameter(
            "pressure_exponent",
            "-",
            Normal(0.0, 0.08),
            "exponent of the Hertz pressure beyond that of the base law",
            null=0.0,
            symbol="c",
            base_sd=0.04,
        ),
    ),
    equation=r"h \leftarrow h\,f\left(\frac{\eta_0 u}{10^{-11} E' R}\right)^{a}\left(\frac{p_0}{0.004\,E'}\right)^{c}",
    source="D. Dowson, Proc. IMechE 182 Pt 3A (1968) 151; P. Pan, B. J. Hamrock, J. Tribol. 111 (1989) 246; A. N. "
    "Grubin, Central Scientific Research Institute for Technology and Mechanical Engineering, Moscow, Book 30 (1949)",
    fingerprint={"load": "+", "speed": "-", "roughness": "+"},
    separated_by="the film itself, by interferometry or capacitance over speed and load",
    applied_after=("inlet_shear_heating", "inlet_shear_thinning", "starvation", "roughness_lay"),
    kinds=("gear_pair", "disc", "friction_history", "mesh_friction"),
    replaces="film thickness",
    special_cases={
        "Dowson and Higginson": _against_dowson_toyoda(2.65, 0.70, 0.54, -0.13),
        "Pan and Hamrock": _against_dowson_toyoda(2.922, 0.692, 0.470, -0.166),
        "Grubin": _against_dowson_toyoda(1.95, 8.0 / 11.0, 8.0 / 11.0, -1.0 / 11.0),
    },
)
def film_law(
    film_thickness: np.ndarray,
    entrainment_speed: np.ndarray,
    viscosity: np.ndarray,
    hertz_pressure: np.ndarray,
    radius: np.ndarray,
    reduced_modulus: np.ndarray,
    *,
    factor: float,
    speed_exponent: float,
    pressure_exponent: float,
) -> np.ndarray:
    """The film follows another regression than the base law, with its own constant and exponents.

    Published regressions are powers of speed, load and material. They differ by up to a quarter in size, by 0.04 in
    the exponent of speed and by 0.07 in that of the load of a line contact, which is half that of the Hertz pressure.
    The exponent of the material is part of the factor: one oil hardly changes it. Minimum and central film are laws of
    one kind here, as studies take either for the separation.

    >>> case = (1.0, 2.1630, 0.01489, 0.9642e9, 8.3262e-3, 226.374e9)
    >>> h = film_law(*case, factor=0.7505, speed_exponent=0.01, pressure_exponent=-0.06)
    >>> round(float(h) * 0.2214, 3)   # um; Dowson and Higginson themselves, at G = 3350: 0.1671
    0.166
    """
    size = MIDDLE_SPEED * reduced_modulus * radius
    change = pressure_exponent * np.log(hertz_pressure / (MIDDLE_PRESSURE * reduced_modulus))
    change = change + speed_exponent * np.log(viscosity * entrainment_speed / size)
    return film_thickness * (factor * np.exp(change))
