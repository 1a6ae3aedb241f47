"""Film of a line contact by another published regression."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal, Uniform
from mixedlub.laws.film import DOWSON_TOYODA, RIVALS, Regression, dowson_toyoda, moes

MIDDLE = {"speed": 1e-11, "material": 4e3, "load": 1e-4}
"""Definition. Groups U, G and W about which the exponents turn: values of a gear contact."""


def _against_base(law: Regression) -> dict[str, float]:
    """A regression of line contacts over the regression of the base model."""
    base = DOWSON_TOYODA
    turned = [group ** (getattr(law, name) - getattr(base, name)) for name, group in MIDDLE.items()]
    return {
        "factor": law.constant / base.constant * float(np.prod(turned)),
        "speed_exponent": law.speed - base.speed,
        "load_exponent": law.load - base.load,
        "material_exponent": law.material - base.material,
        "regimes": 0.0,
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
            base_sd=0.013,
        ),
        Parameter(
            "load_exponent",
            "-",
            Normal(0.0, 0.04),
            "exponent of load beyond that of the base law",
            null=0.0,
            symbol="c",
            base_sd=0.03,
        ),
        Parameter(
            "material_exponent",
            "-",
            Normal(0.0, 0.1),
            "exponent of the pressure-viscosity coefficient beyond that of the base law",
            null=0.0,
            symbol="g",
        ),
        Parameter(
            "regimes",
            "-",
            Uniform(0.0, 1.0),
            "share of the way from one power law to the film of Moes for all regimes",
            null=0.0,
            symbol="r",
        ),
    ),
    equation=r"h \leftarrow h\,f\left(\frac{\eta_0 u}{10^{-11} E' R}\right)^{a}\left(\frac{w}{10^{-4} E' R}\right)^{c}"
    r"\left(\frac{\alpha E'}{4000}\right)^{g}\left(\frac{h_M}{h_{DT}}\right)^{r},\quad "
    r"h_M = \text{film of Moes},\ h_{DT} = \text{film of Dowson and Toyoda}",
    source="D. Dowson, Proc. IMechE 182 Pt 3A (1968) 151; H. Moes, Wear 159 (1992) 57; P. Pan, B. J. Hamrock, "
    "J. Tribol. 111 (1989) 246; A. N. Grubin, Central Scientific Research Institute for Technology and Mechanical "
    "Engineering, Moscow, Book 30 (1949)",
    fingerprint={"load": "+", "speed": "-", "roughness": "+"},
    separated_by="the film itself, by interferometry or capacitance over speed and load",
    applied_after=("inlet_shear_heating", "inlet_shear_thinning", "starvation", "roughness_lay"),
    kinds=("gear_pair", "disc", "friction_history", "mesh_friction"),
    replaces="film thickness",
    special_cases={
        **{name: _against_base(law) for name, law in RIVALS.items()},
        "Moes": {**_against_base(DOWSON_TOYODA), "regimes": 1.0},
    },
)
def film_law(
    film_thickness: np.ndarray,
    entrainment_speed: np.ndarray,
    viscosity: np.ndarray,
    line_load: np.ndarray,
    radius: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
    *,
    factor: float,
    speed_exponent: float,
    load_exponent: float,
    material_exponent: float,
    regimes: float,
) -> np.ndarray:
    """The film of a line contact follows another regression than the base law, with other constant and exponents.

    Published regressions are powers of speed, load and material. They differ by up to a quarter in size, by 0.04 in the
    exponent of speed, by 0.07 of load and by 0.17 of material; an oil changes the material group with its temperature.
    Moes joins the regimes of rigid and elastic bodies, which is not a power law. Minimum and central film are laws of
    one kind here, as studies take either for the separation.

    >>> case = (0.2214, 2.1630, 0.01489, 214.86e3, 8.3262e-3, 14.81e-9, 226.374e9)   # um, by Dowson and Toyoda
    >>> round(float(film_law(*case, **_against_base(RIVALS["Dowson and Higginson"]))), 3)   # by themselves 0.1671
    0.167
    """
    size = reduced_modulus * radius
    change = load_exponent * np.log(line_load / (MIDDLE["load"] * size))
    change = change + speed_exponent * np.log(viscosity * entrainment_speed / (MIDDLE["speed"] * size))
    change = change + material_exponent * np.log(pressure_viscosity * reduced_modulus / MIDDLE["material"])
    if regimes != 0.0:
        state = (radius, entrainment_speed, line_load, viscosity, pressure_viscosity, reduced_modulus)
        change = change + regimes * np.log(moes(*state) / dowson_toyoda(*state))
    return film_thickness * (factor * np.exp(change))
