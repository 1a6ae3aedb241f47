"""Surface defects."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform, Uniform


@effect(
    stage="contact",
    acts_on="area_ratio",
    parameters=(
        Parameter(
            "share",
            "-",
            LogNormal(0.01, 0.8),
            "share of the contact area that touches at zero film thickness",
            null=0.0,
            symbol="c",
        ),
        Parameter(
            "inverse_height",
            "1/m",
            Uniform(0.0, 1e6),
            "reciprocal of the height that 37 % of the defects exceed",
            symbol=r"\kappa",
        ),
        Parameter(
            "evenness",
            "-",
            LogUniform(1.0, 5.0),
            "shape of the height distribution: 1 exponential, 3.6 nearly normal with 30 % scatter",
            symbol="m",
        ),
    ),
    equation=r"P_B \leftarrow P_B + c\,\exp[-(\kappa h)^m]\,(1 - P_B)",
    source="exponential heights, as J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300, widened to "
    "W. Weibull, J. Appl. Mech. 18 (1951) 293; those that stand proud of any film touch always; size as of scratches "
    "and burrs of 1 %",
    fingerprint={"load": "-", "roughness": "-", "slide_roll_ratio": "-"},
    separated_by="thick films: contact that fades far slower than the finish's above a film ratio of 3; outliers on "
    "the normal probability plot of the profile; a signal once a revolution",
    applied_after=("asperity_plasticity", "skewed_heights"),
    prior_odds=0.3,
    special_cases={
        "defects above any film": {"inverse_height": 0.0, "evenness": 1.0},
        "Greenwood and Williamson with exponential heights": {"evenness": 1.0},
    },
)
def surface_defects(
    area_ratio: np.ndarray, film_thickness: np.ndarray, *, share: float, inverse_height: float, evenness: float
) -> np.ndarray:
    """Scratches and burrs remain in contact where the film separates the rest of the surfaces.

    The surfaces of a test rarely have the same share of them. Their heights, a micrometre and more, do not follow from
    the finish; a film of that thickness covers the lower ones. Each defect higher than the film adds the same area.

    >>> round(float(surface_defects(0.2, 1e-6, share=0.01, inverse_height=0.0, evenness=1.0)), 3)
    0.208
    >>> burrs = dict(share=0.01, inverse_height=0.5e6)
    >>> surface_defects(0.0, np.array([0.0, 2e-6]), **burrs, evenness=1.0).round(4).tolist()   # 1/e of them
    [0.01, 0.0037]
    >>> surface_defects(0.0, np.array([1e-6, 3e-6]), **burrs, evenness=3.6).round(4).tolist()   # most, few touch
    [0.0092, 0.0001]
    """
    touching = share * np.exp(-((inverse_height * film_thickness) ** evenness))
    return area_ratio + touching * (1.0 - area_ratio)
