"""Contact of asperities by another elastic theory."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal


@effect(
    stage="law",
    acts_on=("summit_density", "separation"),
    parameters=(
        Parameter("density", "-", LogNormal(1.0, 0.5), "summits over those of the base law", null=1.0, symbol="f"),
        Parameter(
            "offset",
            "-",
            Normal(0.0, 0.5),
            "separation beyond that of the base law, in standard deviations of summit height",
            null=0.0,
            symbol="d",
            base_sd=0.15,
        ),
    ),
    equation=r"D \leftarrow f D,\quad t \leftarrow t + d",
    source="A. W. Bush, R. D. Gibson, T. R. Thomas, Wear 35 (1975) 87; J. A. Greenwood, J. H. Tripp, Proc. IMechE 185 "
    "(1970) 625; against J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300",
    fingerprint={"load": "+", "oil_temperature": "-", "roughness": "-"},
    separated_by="contact resistance or the real area itself over the film thickness",
    replaces="contact of the asperities",
)
def asperity_law(
    summit_density: np.ndarray, separation: np.ndarray, *, density: float, offset: float
) -> tuple[np.ndarray, np.ndarray]:
    """Elastic asperities touch over another area than Greenwood and Williamson's theory gives.

    Theories of elastic contact agree on the shape over the separation; they differ in scale and in the plane from which
    the separation is measured, by up to half a standard deviation. Two rough surfaces whose asperities meet off their
    tops, as Greenwood and Tripp have them, are within 8 % of such a change for films of 0.3 to 3 times the roughness.
    Asperities that yield are `asperity_plasticity`.

    >>> asperity_law(4.4e10, 0.18, density=2.0, offset=0.3)
    (88000000000.0, 0.48)
    """
    return density * summit_density, separation + offset
