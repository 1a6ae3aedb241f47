"""Churning."""

from collections.abc import Mapping

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws import drag

TURBULENT = -1.0 / 3.0, 8.0 / 3.0
"""Exponent of viscosity and excess exponent of speed in Boness' torque, for Reynolds numbers 2000 to 1e5."""
CASES = {
    "Changenet and Velex": {"viscous": 0.21, "surplus": 0.38, "second_law": 1.0},
    "Boness, laminar": {"viscous": 1.0, "surplus": 0.0, "second_law": 0.0},
    "Boness, turbulent": {"viscous": TURBULENT[0], "second_law": 0.0},
    "ISO/TR 14179-1": {"viscous": 1.0, "surplus": 1.0, "second_law": 0.0},
}


def _slow_bath(values: Mapping[str, float]) -> Mapping[str, tuple[float, float]]:
    """The range of the first law of Changenet and Velex where the second one does not take over from it in full."""
    cited = any(law["second_law"] == 0.0 and law.items() <= values.items() for law in CASES.values())
    return {} if cited or values["second_law"] >= 1.0 else {"bath_acceleration": (0.0, drag.SLOW_BATH)}


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
        Parameter(
            "second_law",
            "-",
            Uniform(-1.0, 1.0),
            "share of the second law of Changenet and Velex at high speed; up to 0 the powers of low speed stay",
            symbol="x",
        ),
    ),
    equation=r"P_L \leftarrow P_L + \chi c\,\tfrac12\rho\omega_2^3 r_2^3 S_m C_m,\quad "
    r"C_m = 0.7623\,\mathrm{Fr}^{-0.6}\,\mathrm{Re}^{-0.21}(\mathrm{Fr}/70)^{0.6-f}(\mathrm{Re}/16000)^{0.21-q},\ "
    r"f = 1 - q - \tfrac12 p',\quad "
    r"p' = p + \max(-3q, 0)(\tfrac83 - p),\quad "
    r"C_m \leftarrow C_m + \max(x, 0)\,\min(\max(\tfrac{\gamma - 750}{500}, 0), 1)"
    r"\left[2.7526\,\mathrm{Fr}^{-0.88}\left(\tfrac{b_w}{2 r_2}\right)^{0.85} - C_m\right],\quad "
    r"\gamma = \omega_2^2(r_2 b_w m_n)^{1/3},\quad "
    r"\mathrm{Fr} = \omega_2^2 r_2/(9.81\,\text{m/s}^2),\ \mathrm{Re} = \rho\,\omega_2 r_2^2/\eta_0,\quad "
    r"S_m = \left(\frac{2\pi}{3} - \frac{\sqrt{3}}{2}\right)r_2^2 + \frac{2\pi}{3}\,r_2 b_w + "
    r"\frac{1.5\,z_2 m_n b_w}{\cos 20^\circ\cos\beta}",
    source="C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128 (q = 0.21, f = 0.6; above 750 m/s^2 their second "
    "law); other powers reach from there to the viscous drag of R. J. Boness, Proc. Int. Symp. Gearing 1989 (n^2 nu), "
    "ISO/TR 14179-1 (n^3 nu), and to Boness' turbulent branch (n^(10/3) nu^(-1/3))",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "roughness": "-"},
    special_cases=CASES,
    also_valid=_slow_bath,
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
    bath_acceleration: np.ndarray,
    gears_fitted: np.ndarray,
    *,
    strength: float,
    viscous: float,
    surplus: float,
    second_law: float,
) -> np.ndarray:
    """A gear wheel that dips into the oil bath churns it.

    The immersion depth is half the wheel's radius; published methods differ by a factor of 6 at high speed. Power is
    proportional to n^(1 + q + p) nu^q: where viscosity resists, it does not also rise with the cube of speed as in air.
    Between q = 0 and Boness' branch, where thinner oil causes more loss, p rises to Boness' value. Changenet and Velex
    have a second law at high speed, which viscosity does not enter; the others cited keep their powers, and half of the
    prior lies on that. The accelerations make the form belong to m/s^2.

    >>> wheel = dict(gear_radius=0.05, face_width=0.02, gear_module=4e-3, gear_teeth=25.0)
    >>> wheel |= dict(helix_angle=0.0, gears_fitted=1.0)
    >>> speed, gamma = np.array([1100.0, 5000.0]) * np.pi / 30, np.array([211.0, 4352.0])
    >>> oil, shape = dict(viscosity=0.017, oil_density=850.0), dict(strength=1.0, viscous=0.21, surplus=0.38)
    >>> shape |= dict(second_law=1.0)
    >>> churning(0.0, gear_speed=speed, bath_acceleration=gamma, **wheel, **oil, **shape).round(1).tolist()
    [5.5, 76.2]
    """
    turbulent = max(viscous / TURBULENT[0], 0.0)
    more = surplus + turbulent * (TURBULENT[1] - surplus)
    wheel = (gear_radius, gear_speed, face_width, gear_module, gear_teeth)
    exponents = (viscous, 1.0 - viscous - 0.5 * more)
    slow = drag.churning_changenet_velex(*wheel, viscosity, oil_density, *exponents, helix_angle=helix_angle)
    fast = drag.churning_at_high_speed(*wheel, oil_density, helix_angle=helix_angle)
    return power_loss + strength * gears_fitted * drag.churning_at_either_speed(
        slow, fast, bath_acceleration, max(second_law, 0.0)
    )
