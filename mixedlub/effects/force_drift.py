"""Zero drift of the friction force."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import SinhNormal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "drift",
            "-",
            SinhNormal(0.05),
            "zero drift of the force over the programme, as a share of the typical reading at the smallest load",
            null=0.0,
            symbol="d",
            relative_to="reading_scale",
        ),
    ),
    equation=r"y \leftarrow y + d\,y_0\,q_w\,q",
    source="zero stability of force transducers, over the load: ISO 376",
    fingerprint={"sequence": "+"},
    separated_by="the friction force with the contact open, before and after the test: surfaces that change do so at "
    "every load alike",
    applied_after=("heat_leak", "sensor_drift", "sensor_gain"),
)
def force_drift(
    reading: np.ndarray, reading_scale: np.ndarray, inverse_load: np.ndarray, sequence: np.ndarray, *, drift: float
) -> np.ndarray:
    """The zero of the friction force drifts; the error of a friction coefficient is inverse to the load.

    >>> smallest_over_load, place = np.array([1.0, 1.0, 0.25]), np.array([0.0, 1.0, 1.0])
    >>> force_drift(0.1, 0.1, smallest_over_load, place, drift=0.08).round(4).tolist()
    [0.1, 0.108, 0.102]
    """
    return reading + drift * reading_scale * inverse_load * sequence
