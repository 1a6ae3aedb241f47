"""Zero offset of the friction force."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import SinhNormal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "offset",
            "-",
            SinhNormal(0.05),
            "zero offset of the force, as a share of the typical reading at the smallest load",
            null=0.0,
            symbol="a",
            relative_to="reading_scale",
        ),
    ),
    equation=r"y \leftarrow y + a\,y_0\,q_w",
    source="measurement: zero error of a force transducer, over the load; zero balance in ASTM E74 and ISO 376",
    fingerprint={"load": "-", "roughness": "-"},
    separated_by="a reading of the friction force with the contact open; both directions of sliding, whose mean is it",
    applied_after=("heat_leak", "sensor_drift", "sensor_gain"),
    exact_form=True,
)
def force_offset(
    reading: np.ndarray, reading_scale: np.ndarray, inverse_load: np.ndarray, *, offset: float
) -> np.ndarray:
    """The friction force has a zero offset; the error of a friction coefficient is inverse to the load.

    Offered where a friction coefficient is recorded at different loads; at one load it equals `sensor_offset`.

    >>> smallest_over_load = np.array([1.0, 0.25])
    >>> force_offset(0.1, 0.1, smallest_over_load, offset=0.08).round(4).tolist()
    [0.108, 0.102]
    """
    return reading + offset * reading_scale * inverse_load
