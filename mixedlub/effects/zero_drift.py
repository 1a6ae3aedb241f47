"""Zero drift of the recorded channel."""

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
            "change of the zero over the programme, relative to the typical reading",
            null=0.0,
            symbol="d",
            relative_to="reading_scale",
        ),
    ),
    equation=r"y \leftarrow y + d\,y_0\,q",
    source="rated output and zero stability of transducers: IEC 60770",
    fingerprint={"sequence": "+"},
    separated_by="a reading at rest before and after the test",
    kinds=("film", "friction_map"),
)
def zero_drift(reading: np.ndarray, reading_scale: np.ndarray, sequence: np.ndarray, *, drift: float) -> np.ndarray:
    """The zero of the channel drifts during the programme; the shift is the same for small and large readings.

    Offered where readings change size or sign within the recording, as films and drive torques do; for friction of
    nearly constant size it equals `sensor_drift`.

    >>> round(float(zero_drift(0.05, 0.05, 0.5, drift=0.1)), 4)
    0.0525
    """
    return reading + drift * reading_scale * sequence
