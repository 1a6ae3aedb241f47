"""Heating of the film in the contact."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws import heating


@effect(
    stage="shear",
    acts_on="shear_stress",
    parameters=(
        Parameter("strength", "-", LogNormal(1.0, 0.8), "factor on the temperature rise", null=0.0, symbol="c"),
        Parameter(
            "flash",
            "-",
            Uniform(0.0, 1.0),
            "weight of the surfaces' flash temperature against the film's own rise; 1/2: both in full",
            symbol="d",
        ),
        Parameter(
            "pressure",
            "-",
            Uniform(0.0, 1.0),
            "temperature coefficient: 0 that at ambient pressure, 1 Roelands' at contact pressure",
            symbol="k",
            nominal=1.0,
        ),
    ),
    equation=r"\tau \leftarrow \tau' = "
    r"\tau_0 \operatorname{asinh}\left(\sinh\frac{\tau}{\tau_0}\,e^{-\beta_p\Delta T}\right),\quad "
    r"\Delta T = 2c\left[(1-d)\,\frac{\tau' v_s h}{12 k_f} + "
    r"d\,\theta_\mu\left((1 - P_B)\,\frac{\tau'}{p_0} + P_B\,\mu_B\right)\right],\quad "
    r"\beta_p = \beta\left[1 + \frac{\ln(\eta_p/\eta_0)}{\ln\eta_0 + 9.67}\right]^k",
    source="J. F. Archard, Wear 2 (1959) 438 (film); H. Blok, Proc. Gen. Disc. Lubrication, IMechE 2 (1937) "
    "222 (flash)",
    fingerprint={"load": "-", "speed": "-", "oil_temperature": "+", "roughness": "+", "slide_roll_ratio": "-"},
    separated_by="friction against sliding at fixed rolling speed: heating bends it down at high sliding and leaves "
    "the slope at small sliding; a limiting stress does so at a level set by pressure alone",
    valid={"slide_roll_ratio": (0.0, 2.0)},
    applied_after=("contact_average",),
)
def film_heating(
    shear_stress: np.ndarray,
    eyring_stress: np.ndarray,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    viscosity: np.ndarray,
    contact_viscosity: np.ndarray,
    temperature_viscosity: np.ndarray,
    oil_conductivity: np.ndarray,
    flash_per_friction: np.ndarray,
    hertz_pressure: np.ndarray,
    boundary_friction: np.ndarray,
    area_ratio: np.ndarray,
    *,
    strength: float,
    flash: float,
    pressure: float,
) -> np.ndarray:
    """Sliding heats the surfaces and the film between them, and the warmer film shears more easily.

    Stress and heat depend on each other and are solved together. Asperity friction (without additive film) warms the
    surfaces too; temperatures are means over the contact. The literature evaluates beta at ambient pressure (Nahme,
    Crook) or at contact pressure. Roelands' slope makes the
    form belong to Pa s.

    >>> flash = heating.flash_per_friction(0.9437e9, 0.148e-3, 2.2417, 0.7518, 46.0, 7800.0, 470.0)   # steel
    >>> oil = dict(viscosity=0.01489, contact_viscosity=70.2, temperature_viscosity=0.026, oil_conductivity=0.14)
    >>> motion = dict(sliding_speed=0.7518, film_thickness=0.231e-6, flash_per_friction=flash)
    >>> load = dict(hertz_pressure=0.9437e9, boundary_friction=0.1, area_ratio=0.163)
    >>> full = dict(strength=1.0, flash=0.5, pressure=1.0)
    >>> tau = film_heating(22.58e6, 5e6, **oil, **motion, **load, **full)
    >>> round(float(tau) / 1e6, 1)   # isothermal 22.6 MPa
    19.8
    """
    steeper = heating.contact_softening(temperature_viscosity, viscosity, contact_viscosity) / temperature_viscosity
    softening = strength * temperature_viscosity * steeper**pressure
    film = 2.0 * (1.0 - flash) * sliding_speed * film_thickness / (12.0 * oil_conductivity)
    bodies = 2.0 * flash * flash_per_friction
    by_asperities = softening * bodies * boundary_friction * area_ratio
    by_film = softening * (film + bodies * (1.0 - area_ratio) / hertz_pressure)
    return heating.softened_stress(shear_stress, eyring_stress, by_asperities, by_film)
