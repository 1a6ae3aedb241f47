"""Churning."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.drag import churning_changenet_velex

TURBULENT = -1.0 / 3.0, 8.0 / 3.0
"""Exponent of viscosity and excess exponent of speed in Boness' torque, for Reynolds numbers 2000 to 1e5."""


@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(1.0, 0.9),
            "factor for immersion depth, housing and number of dipping wheels",
            null=0.0,
            symbol="c",
        ),
        Parameter(
            "viscous", "-", Uniform(TURBULENT[0], 1.0), "exponent of viscosity", symbol="q", published=(0.21, 1.0)
        ),
        Parameter(
            "surplus",
            "-",
            Uniform(0.0, 1.1),
            "exponent of speed less that of viscosity less 1, where the viscosity exponent is not negative",
            symbol="p",
            published=(0.0, 1.0),
        ),
    ),
    equation=r"P_L \leftarrow P_L + \chi c\,\tfrac12\rho\omega_2^3 r_2^3 S_m C_m,\quad "
    r"C_m = 0.7623\,\mathrm{Fr}^{-0.6}\,\mathrm{Re}^{-0.21}(\mathrm{Fr}/70)^{0.6-f}(\mathrm{Re}/16000)^{0.21-q},\ "
    r"f = 1 - q - \tfrac12 p',\quad "
    r"p' = p + \max(-3q, 0)(\tfrac83 - p),\quad "
    r"\mathrm{Fr} = \omega_2^2 r_2/(9.81\,\text{m/s}^2),\ \mathrm{Re} = \rho\,\omega_2 r_2^2/\eta_0,\quad "
    r"S_m = \left(\frac{2\pi}{3} - \frac{\sqrt{3}}{2}\right)r_2^2 + \frac{2\pi}{3}\,r_2 b_w + "
    r"\frac{1.5\,z_2 m_n b_w}{\cos 20^\circ\cos\beta}",
    source="C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128 (q = 0.21, f = 0.6); other powers reach from "
    "there to the viscous drag of R. J. Boness, Proc. Int. Symp. Gearing 1989 (n^2 nu), ISO/TR 14179-1 (n^3 nu), "
    "and to Boness' turbulent branch (n^(10/3) nu^(-1/3))",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "roughness": "-"},
    special_cases={
        "Changenet and Velex": {"viscous": 0.21, "surplus": 0.38},
        "Boness, laminar": {"viscous": 1.0, "surplus": 0.0},
        "Boness, turbulent": {"viscous": TURBULENT[0]},
        "ISO/TR 14179-1": {"viscous": 1.0, "surplus": 1.0},
    },
    valid={"bath_acceleration": (0.0, 750.0)},
    separated_by="the oil level, or a dry sump: it changes with depth, rolling resistance does not; out of mesh it "
    "stays",
)
def churning(
    power_loss: np.ndarray,
    gear_radius: np.ndarray,
    gear_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    gear_teeth: np.ndarray,
    helix_angle: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    gears_fitted: np.ndarray,
    *,
    strength: float,
    viscous: float,
    surplus: float,
) -> np.ndarray:
    """A gear wheel that dips into the oil bath churns it.

    The immersion depth is half the wheel's radius; published methods differ by a factor of 6 at high speed. Power is
    proportional to n^(1 + q + p) nu^q: where viscosity resists, it does not also rise with the cube of speed as in air.
    Between q = 0 and Boness' branch, where thinner oil causes more loss, p rises to Boness' value. The acceleration of
    gravity makes the form belong to m/s^2.

    >>> wheel = dict(gear_radius=0.05, face_width=0.02, gear_module=4e-3, gear_teeth=25.0)
    >>> wheel |= dict(helix_angle=0.0, gears_fitted=1.0)
    >>> speed = 1100 * 3.14159 / 30
    >>> shape = dict(strength=1.0, viscous=0.21, surplus=0.38)
    >>> round(float(churning(0.0, gear_speed=speed, viscosity=0.017, oil_density=850.0, **wheel, **shape)), 1)
    5.5
    """
    turbulent = max(viscous / TURBULENT[0], 0.0)
    more = surplus + turbulent * (TURBULENT[1] - surplus)
    stirred = churning_changenet_velex(
        gear_radius,
        gear_speed,
        face_width,
        gear_module,
        gear_teeth,
        viscosity,
        oil_density,
        viscosity_exponent=viscous,
        gravity_exponent=1.0 - viscous - 0.5 * more,
        helix_angle=helix_angle,
    )
    return power_loss + strength * gears_fitted * stirred
