"""Misalignment."""

import numpy as np

from mixedlub.effect import Between, LogNormal, Parameter, effect

_STIFFNESS = 2e10
_REFERENCE = 1e5


@effect(
    stage="load",
    acts_on="line_load",
    parameters=(
        Parameter("misalignment", "m", LogNormal(10e-6, 1.0), "gap across the face without load", null=0.0, symbol="f"),
        Parameter("relief", "-", Between(0.0, 1.0), "power of load with which teeth yield to it", symbol="q"),
    ),
    equation=r"w \leftarrow w\,(1 + x^2)^{1/4},\quad "
    r"x = \frac{f\,c_\gamma}{2 w_r}\left(\frac{w_r b_w}{F_t}\right)^{q},\quad "
    r"c_\gamma = 20\,\text{GPa},\ w_r = 100\,\text{N/mm}",
    source="ISO 6336-1, face load factor: b_cal/b = [2 F/(b f c_gamma)]^(1/2) in partial contact, c_gamma = "
    "20 N/(mm um), w_r = 100 N/mm; joined smoothly to full contact",
    fingerprint={"load": "-", "roughness": "-"},
    separated_by="the contact pattern, strain along the face, and a shim that reverses it; it fades with load",
    odds=0.5,
)
def misalignment(
    line_load: np.ndarray, transmitted_force: np.ndarray, face_width: np.ndarray, *, misalignment: float, relief: float
) -> np.ndarray:
    """Flanks out of parallel touch over part of the face, and more load per length meets the same film law.

    A load share from a gear program often holds it already. Stiffness and w_r make the form belong to Pa and N/m.
    A power of load of 1 is that of elastic teeth, 0 a width that load does not change.

    >>> load = misalignment(2e5, 3000.0, 0.014, misalignment=10e-6, relief=1.0)   # 3000 N on 14 mm: x = 0.47
    >>> round(float(load) / 2e5, 2)
    1.05
    """
    half_gap_load = 0.5 * misalignment * _STIFFNESS / _REFERENCE
    partial = half_gap_load * (_REFERENCE * face_width / transmitted_force) ** relief
    return line_load * (1.0 + partial**2) ** 0.25
