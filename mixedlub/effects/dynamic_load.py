"""Dynamic mesh load."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal, Uniform

QUARTER = 0.5 * np.pi
TYPICAL_FORCE = 3000.0
"""Tooth force (N) at which the amplitude is stated."""
LEAST_LOAD = 0.1
"""Load over the typical one below which the relative added force stays as it is."""
LEAST_LOAD_FACTOR = 0.1
"""Smallest share of the static force that is computed where vibration unloads the teeth."""


@effect(
    stage="load",
    acts_on="transmitted_force",
    parameters=(
        Parameter(
            "amplitude",
            "-",
            Normal(0.0, 0.05),
            "relative added force at resonance and 3 kN, times twice the damping ratio",
            null=0.0,
            symbol="a",
        ),
        Parameter("resonance", "1/s", LogNormal(1500.0, 0.7), "natural frequency of the gear pair", symbol="f_n"),
        Parameter("damping", "-", LogNormal(0.1, 0.5), "damping ratio (share of critical damping)", symbol=r"\zeta"),
        Parameter(
            "phase",
            "rad",
            Uniform(-QUARTER, QUARTER),
            "phase of sliding and vibration: at 0 the added force peaks at resonance, otherwise it changes sign there",
            symbol=r"\phi",
        ),
        Parameter(
            "second",
            "-",
            Normal(0.0, 0.4),
            "response to the second mesh harmonic, at half the speed, relative to the first",
            symbol="s",
        ),
        Parameter(
            "fade",
            "-",
            Uniform(0.0, 1.0),
            "exponent of load with which the relative added force falls: 0 deflection of the teeth, 1 their errors",
            symbol="q",
            nominal=0.0,
        ),
    ),
    equation=r"F_t \leftarrow F_t\max\left\{1 + ax^{-q}\,[R(r) + s\,R(2r)],\ 0.1\right\},\quad "
    r"x = \max\left(\frac{F_t}{\text{3 kN}},\ 0.1\right),\quad "
    r"R(x) = x\,\frac{(1-x^2)\sin\phi + 2\zeta x\cos\phi}{(1-x^2)^2 + (2\zeta x)^2},\quad "
    r"r = \frac{z_1\omega_1}{2\pi f_n}",
    special_cases={"one harmonic": {"second": 0.0, "fade": 0.0}},
    source="one degree of freedom driven by the transmission error, steady state; as the dynamic factor of "
    "ISO 6336-1, of which pitch errors cause a part that is the same force at any load",
    fingerprint={"load": "-", "speed": "+"},
    separated_by="a fine speed sweep: it is narrow, follows tooth frequency and inertia and not the oil; an "
    "accelerometer or the transmission error shows it",
    prior_odds=0.3,
)
def dynamic_load(
    transmitted_force: np.ndarray,
    pinion_speed: np.ndarray,
    pinion_teeth: np.ndarray,
    *,
    amplitude: float,
    resonance: float,
    damping: float,
    phase: float,
    second: float,
    fade: float,
) -> np.ndarray:
    """Near mesh resonance the tooth force differs from the static force where the teeth slide most.

    The phase between vibration and roll angle sets the sign of the added force, and most of it averages out over the
    mesh cycle. The phase shifts by half a period across the resonance, so the force where sliding is largest may change
    from above to below the static force. The second mesh harmonic excites the resonance at half the speed. The damping
    ratio of gear pairs is 0.05 to 0.10. Far below resonance the rise is linear in speed, as in the standard, and
    quadratic at phase 0: between the responses to a varying stiffness and to a transmission error. By ISO 6336-1 steel
    discs of 70 and 110 mm with a mesh stiffness of 20 N/(mm um) resonate at 6.4 kHz, two standard deviations above the
    prior's median; shafts and attached inertia lower this frequency. The reference force of 3 kN makes the form belong
    to N.

    >>> at_resonance = 2 * np.pi * 850.0 / 17   # 3000 rpm at 17 teeth
    >>> pair = dict(amplitude=0.05, resonance=850.0, damping=0.1, second=0.0, fade=0.0)
    >>> round(float(dynamic_load(1.0, at_resonance, 17.0, **pair, phase=0.0)), 3)
    1.25
    >>> dynamic_load(1.0, at_resonance * np.array([0.9, 1.0, 1.1]), 17.0, **pair, phase=np.pi / 2).round(3).tolist()
    [1.125, 1.0, 0.875]
    """
    ratio = pinion_teeth * pinion_speed / (2.0 * np.pi * resonance)
    response = _response(ratio, damping, phase) + second * _response(2.0 * ratio, damping, phase)
    relative = amplitude * np.maximum(transmitted_force / TYPICAL_FORCE, LEAST_LOAD) ** -fade
    return transmitted_force * np.maximum(1.0 + relative * response, LEAST_LOAD_FACTOR)


def _response(ratio: np.ndarray, damping: float, phase: float) -> np.ndarray:
    """Frequency response of one degree of freedom in the given phase, times the frequency ratio."""
    stiff, lag = 1.0 - ratio**2, 2.0 * damping * ratio
    return np.asarray(ratio * (np.sin(phase) * stiff + np.cos(phase) * lag) / (stiff**2 + lag**2))
