"""Surface defects."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="contact",
    acts_on="area_ratio",
    parameters=(
        Parameter("share", "-", LogNormal(0.01, 0.8), "share of the contact that always touches", null=0.0, symbol="c"),
    ),
    equation=r"P_B \leftarrow P_B + c\,(1 - P_B)",
    source="geometry: defects that stand proud of the film touch whatever the film; size as of scratches and "
    "burrs of 1 %",
    fingerprint={"load": "-", "speed": "+", "roughness": "-", "slide_roll_ratio": "-"},
    separated_by="thick films: contact that does not vanish above a film ratio of 3; outliers on the normal "
    "probability plot of the profile; a signal once a revolution",
    after=("asperity_plasticity", "skewed_heights"),
    odds=0.3,
)
def surface_defects(area_ratio: np.ndarray, *, share: float) -> np.ndarray:
    """Scratches and burrs keep touching where the film is thick enough for the rest.

    It is rare that all surfaces of a test carry the same share of them.

    >>> round(surface_defects(0.2, share=0.01), 3)
    0.208
    """
    return area_ratio + share * (1.0 - area_ratio)
