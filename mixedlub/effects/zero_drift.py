"""A zero that drifts during the test."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "drift",
            "-",
            Normal(0.0, 0.1),
            "change of the zero over the programme, over the typical reading",
            null=0.0,
            symbol="d",
            of="reading_scale",
        ),
    ),
    equation=r"y \leftarrow y + d\,y_0\,q",
    source="rated output and zero stability of transducers: IEC 60770",
    fingerprint={"sequence": "+"},
    separated_by="a reading at rest before and after the test",
    kinds=("film", "friction_map"),
)
def zero_drift(reading: np.ndarray, reading_scale: np.ndarray, sequence: np.ndarray, *, drift: float) -> np.ndarray:
    """The reading at rest is no longer zero at the end; every reading shifts by the same amount.

    Offered where readings change size or sign within the recording, as films and torques of drives do: on a
    friction that stays of one size it is `sensor_drift`.

    >>> round(float(zero_drift(0.05, 0.05, 0.5, drift=0.1)), 4)
    0.0525
    """
    return reading + drift * reading_scale * sequence
