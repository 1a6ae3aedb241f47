"""Insulation by a coating."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal
from mixedlub.laws import heating


@effect(
    stage="shear",
    acts_on="shear_stress",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(1.0, 1.0),
            "factor on the temperature rise across the coating",
            null=0.0,
            symbol="c",
        ),
    ),
    equation=r"\tau \leftarrow \tau' = "
    r"\tau_0 \operatorname{asinh}\left(\sinh\frac{\tau}{\tau_0}\,e^{-\beta_p\Delta T}\right),\quad "
    r"\Delta T = c\,\frac{\tau' v_s}{4}\,\frac{t_c}{k_c},\quad "
    r"\beta_p = \beta\left[1 + \frac{\ln(\eta_p/\eta_0)}{\ln\eta_0 + 9.67}\right]",
    source="M. Bjoerling, W. Habchi, S. Bair, R. Larsson, P. Marklund, Tribol. Lett. 53 (2014) 477 (the "
    "mechanism); steady conduction through a layer that carries half the heat to each side",
    fingerprint={"speed": "-", "slide_roll_ratio": "-"},
    separated_by="a change of the coating alone: heating of uncoated steel stays, insulation goes with the coating, "
    "and at thick films a lower boundary friction would have no effect",
    applied_after=("contact_average", "film_heating"),
)
def coating_insulation(
    shear_stress: np.ndarray,
    eyring_stress: np.ndarray,
    sliding_speed: np.ndarray,
    viscosity: np.ndarray,
    contact_viscosity: np.ndarray,
    temperature_viscosity: np.ndarray,
    coating_thickness: np.ndarray,
    coating_conductivity: np.ndarray,
    *,
    strength: float,
) -> np.ndarray:
    """A coating of low thermal conductivity keeps heat in the film, which is warmer and shears more easily.

    Valid while the coating is thinner than the thermal penetration depth of one contact passage (2-3 um of diamond-like
    carbon: diffusion time about 10 us, contact time 20-200 us). Roelands' slope makes the form belong to Pa s.

    >>> tau = coating_insulation(22.58e6, 5e6, 0.7518, 0.01489, 70.2, 0.026, 6e-6, 2.0, strength=1.0)
    >>> round(float(tau) / 1e6, 1)   # 3 um of diamond-like carbon on each flank
    19.0
    """
    softening = strength * heating.contact_softening(temperature_viscosity, viscosity, contact_viscosity)
    rise = 0.25 * sliding_speed * coating_thickness / coating_conductivity
    return heating.softened_stress(shear_stress, eyring_stress, 0.0, softening * rise)
