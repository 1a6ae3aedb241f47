"""A boundary film that remains at zero speed."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform


@effect(
    stage="boundary",
    acts_on="film_thickness",
    parameters=(
        Parameter("thickness", "m", LogNormal(4e-9, 0.8), "thickness of the layer", null=0.0, symbol="h_b"),
        Parameter(
            "joining",
            "-",
            LogNormal(2.0, 0.4),
            "blending exponent: 1 adds layer and film, large values take the thicker",
            symbol="m",
        ),
        Parameter(
            "gain",
            "-",
            LogUniform(0.5, 100.0),
            "largest added thickness relative to a thin film; large: the layer remains at rest",
            symbol="g",
        ),
    ),
    equation=r"h \leftarrow \left[h^m + \left(\frac{g h\,h_b}{g h + h_b}\right)^m\right]^{1/m}",
    source="layers that stay at rest: G. Guangteng, H. A. Spikes, Tribol. Trans. 39 (1996) 448; layers of thicker "
    "fluid that a thin film consists of: M. Smeeth, H. A. Spikes, S. Gunsel, Tribol. Trans. 39 (1996) 720; joined so "
    "that it fades at speed, by the root of squares or more sharply",
    fingerprint={"speed": "-"},
    separated_by="a zero check at rest before and after: a drifted zero shifts all films, a layer only the thinnest; "
    "base oil without polymer, where thicker fluid at the walls would need one",
    applied_after=(
        *("inlet_shear_heating", "inlet_shear_thinning", "starvation", "roughness_lay", "film_law"),
        "soft_contact_film",
    ),
    kinds=("film",),
)
def boundary_film(film_thickness: np.ndarray, *, thickness: float, joining: float, gain: float) -> np.ndarray:
    """Adsorbed or reacted layers separate the surfaces where the fluid film is thinner than the layers.

    A layer of more viscous fluid must be entrained: a film much thinner than the layer gains at most g times its
    thickness.

    >>> [round(boundary_film(h, thickness=4e-9, joining=2.0, gain=1e9) * 1e9, 2) for h in (3e-9, 400e-9)]
    [5.0, 400.02]
    >>> round(boundary_film(1e-12, thickness=4e-9, joining=1.0, gain=1.5) * 1e12, 2)
    2.5
    """
    layer = gain * thickness / (gain * film_thickness + thickness)
    return film_thickness * (1.0 + layer**joining) ** (1.0 / joining)
