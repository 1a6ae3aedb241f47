"""Oil or a sample that changes during the test."""

import numpy as np

from mixedlub.effect import LogNormal, Normal, Parameter, effect


@effect(
    stage="property",
    acts_on="viscosity",
    parameters=(
        Parameter("drift", "-", Normal(0.0, 0.2), "change of the logarithm of viscosity over the programme", null=0.0),
        Parameter("power", "-", LogNormal(1.0, 0.4), "1: steady, above: it gathers pace"),
    ),
    equation=r"\eta_0 \leftarrow \eta_0\,e^{d\,q^m}",
    source="evaporation, oxidation or shear-down as a steady relative rate; e.g. ASTM D445 on used oils reports it so",
    fingerprint={},
    separated_by="a repeat of the first point at the end, with a fresh sample and a cover against evaporation",
)
def viscosity_drift(viscosity, sequence, *, drift, power):
    """The sample thickens or thins with time; no law of temperature and pressure can show it.

    >>> viscosity_drift(0.04, np.array([0.0, 1.0]), drift=0.2, power=1.0).round(4).tolist()
    [0.04, 0.0489]
    """
    return viscosity * np.exp(drift * np.maximum(sequence, 0.0) ** power)
