"""Property effects: another pressure law of viscosity, an oil that thickens or thins as the test goes on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.proof.concealed.kinds import Concealed, Knob, strength
from mixedlub.proof.rig import Contact, sheared, thick


def pressure_viscosity_law(c: Contact, strength: float, stiffening: float) -> Contact:
    """In the contact ln(eta/eta0) = alpha p/(1 + stiffening p), not Roelands, ``strength`` of the way."""
    modulus_form = c.pressure_viscosity * c.pressure / (1 + stiffening * c.pressure / 1e9)
    roelands = np.log(thick(c) / c.viscosity)
    mixed = np.minimum((1 - strength) * roelands + strength * modulus_form, 60.0)
    return replace(c, stress=sheared(c, c.viscosity * np.exp(mixed)))


def viscosity_drift(c: Contact, strength: float) -> Contact:
    """Oxidation thickens (+) or shear thins (-) the oil over the programme: eta exp(0.2 strength s^1.5)."""
    return replace(c, viscosity=c.viscosity * np.exp(0.2 * strength * c.rig.sequence**1.5)[:, None])


EFFECTS = (
    Concealed(
        "pressure_viscosity_law",
        "property",
        "shear",
        pressure_viscosity_law,
        (strength(0.0, 1.5, (0.8, 1.1)), Knob("stiffening", 0.1, 1.2, (0.2, 0.7))),
        "modulus equation (Bode 1989)",
        0,
        rarity=0.6,
    ),
    Concealed(
        "viscosity_drift",
        "property",
        "oil",
        viscosity_drift,
        (strength(-4.0, 4.0, (0.7, 1.8)),),
        "accelerating oxidation",
        0,
        rarity=0.6,
    ),
)
