"""Dynamic mesh load."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal, Uniform

TYPICAL_FORCE = 3000.0
"""Tooth force (N) at which the amplitude is stated."""
LEAST_LOAD = 0.1
"""Load over the typical load, below which the relative added force is constant."""
LEAST_LOAD_FACTOR = 0.05
"""Smallest share of the static force where vibration unloads the teeth: laws of contact need some load."""


@effect(
    stage="load",
    acts_on="load_share",
    parameters=(
        Parameter(
            "amplitude",
            "-",
            LogNormal(0.05, 0.8),
            "relative added force at resonance and 3 kN, times twice the damping ratio",
            null=0.0,
            symbol="a",
        ),
        Parameter("resonance", "1/s", LogNormal(1500.0, 0.7), "natural frequency of the gear pair", symbol="f_n"),
        Parameter("damping", "-", LogNormal(0.1, 0.5), "damping ratio (share of critical damping)", symbol=r"\zeta"),
        Parameter(
            "phase",
            "rad",
            Uniform(-np.pi, np.pi),
            "phase of the excitation where contact begins; the second harmonic has twice this phase",
            symbol=r"\phi",
        ),
        Parameter(
            "second",
            "-",
            Normal(0.0, 0.4),
            "response to the second mesh harmonic, at half the speed, relative to the first",
            symbol="b",
        ),
        Parameter(
            "fade",
            "-",
            Uniform(0.0, 1.0),
            "exponent of load with which the relative added force falls: 0 deflection of the teeth, 1 their errors",
            symbol="q",
            nominal=0.0,
        ),
        Parameter(
            "power",
            "-",
            Uniform(0.5, 2.0),
            "power of speed with which the added force grows far below resonance",
            symbol="p",
        ),
        Parameter(
            "in_phase",
            "-",
            Uniform(0.0, 1.0),
            "0 the phase of the response, 1 that of the excitation at any speed",
            symbol="k",
            nominal=0.0,
        ),
        Parameter(
            "everywhere",
            "-",
            Uniform(0.0, 1.0),
            "0 a wave along the path of contact, 1 the same factor at each place of it",
            symbol="m",
            nominal=0.0,
        ),
    ),
    equation=r"s \leftarrow s\max\left\{1 + ay^{-q}\,[R(1) + b\,R(2)],\ 0.05\right\},\quad "
    r"y = \max\left(\frac{F_t}{\text{3 kN}},\ 0.1\right),\quad "
    r"R(n) = (nr)^p\left[(1 - k)\,\frac{(1 - n^2r^2)\,c + 2\zeta nr\,d}{N^2} + k\,\frac{c}{N}\right],\quad "
    r"r = \frac{z_1\omega_1}{2\pi f_n},\ N = \sqrt{(1 - n^2r^2)^2 + (2\zeta nr)^2},\quad "
    r"c = (1 - m)\cos nw + m,\ d = (1 - m)\sin nw,\ w = 2\pi\psi + \phi",
    special_cases={"one mesh order": {"second": 0.0, "fade": 0.0}},
    source="one degree of freedom driven by the transmission error, steady state (H. N. Ozguven, D. R. Houser, J. "
    "Sound Vib. 125 (1988) 71); dynamic factors of ISO 6336-1, of which pitch errors cause a part that is the same "
    "force at any load, and of AGMA 2001",
    fingerprint={"load": "-", "speed": "+"},
    separated_by="a fine speed sweep: it is narrow, follows tooth frequency and inertia and not the oil; an "
    "accelerometer or the transmission error shows it",
    applied_after=("load_sharing_law", "tip_relief"),
    prior_odds=0.3,
)
def dynamic_load(
    load_share: np.ndarray,
    transmitted_force: np.ndarray,
    pinion_speed: np.ndarray,
    pinion_teeth: np.ndarray,
    mesh_phase: np.ndarray,
    *,
    amplitude: float,
    resonance: float,
    damping: float,
    phase: float,
    second: float,
    fade: float,
    power: float,
    in_phase: float,
    everywhere: float,
) -> np.ndarray:
    """Near mesh resonance the force on the teeth differs from their share of the static force.

    The force on the springs of the teeth is a wave over the mesh cycle, the same for all contacts at one time, so that
    most of it averages out: the remainder depends on where the teeth slide most. The wave shifts by half a cycle across
    the resonance. The second mesh harmonic excites the resonance at half the speed. A dynamic factor instead is the
    amplitude at any time (k = m = 1); bearings and uneven faces have the static force even then. Far below resonance
    the amplitude grows with the square of speed where the transmission error drives it (p = 2), in proportion in ISO
    6336-1 (p = 1) and with the root of speed in AGMA 2001 (p = 1/2). The damping ratio of gear pairs is 0.05 to 0.10.
    By ISO 6336-1 steel discs of 70 and 110 mm with a mesh stiffness of 20 N/(mm um) resonate at 6.4 kHz, two standard
    deviations above the prior's median; shafts and attached inertia lower this frequency. The reference force of 3 kN
    makes the form belong to N.

    >>> at_resonance = 2 * np.pi * 850.0 / 17   # 3000 rpm at 17 teeth
    >>> teeth = dict(transmitted_force=3000.0, pinion_teeth=17.0, mesh_phase=np.array([0, 0.25]))
    >>> pair = dict(amplitude=0.05, resonance=850.0, damping=0.1, phase=0.0, second=0.0, fade=0.0, power=2.0)
    >>> dynamic_load(1.0, pinion_speed=at_resonance, **teeth, **pair, in_phase=0.0, everywhere=0.0).round(3).tolist()
    [1.0, 1.25]
    >>> dynamic_load(1.0, pinion_speed=at_resonance, **teeth, **pair, in_phase=1.0, everywhere=1.0).round(3).tolist()
    [1.25, 1.25]
    """
    ratio = pinion_teeth * pinion_speed / (2.0 * np.pi * resonance)
    turn = 2.0 * np.pi * mesh_phase + phase

    def response(ratio: np.ndarray, turn: np.ndarray) -> np.ndarray:
        stiff, lag = 1.0 - ratio**2, 2.0 * damping * ratio
        square = stiff**2 + lag**2
        along, behind = (1.0 - everywhere) * np.cos(turn) + everywhere, (1.0 - everywhere) * np.sin(turn)
        resolved = (1.0 - in_phase) * (stiff * along + lag * behind) / square
        return np.asarray(ratio**power * (resolved + in_phase * along / np.sqrt(square)))

    relative = amplitude * np.maximum(transmitted_force / TYPICAL_FORCE, LEAST_LOAD) ** -fade
    added = relative * (response(ratio, turn) + second * response(2.0 * ratio, 2.0 * turn))
    return load_share * np.maximum(1.0 + added, LEAST_LOAD_FACTOR)
