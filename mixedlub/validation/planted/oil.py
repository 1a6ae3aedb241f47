"""Property effects: another pressure law of viscosity, oil ageing, teeth warmer than their oil."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from mixedlub.validation.contact import Contact, lubricate, mix, record_power, shear, sheared, thick, touch
from mixedlub.validation.rig import Form, Knob, strength

SWEEPS = 5


def pressure_viscosity_law(c: Contact, strength: float, stiffening: float) -> Contact:
    """In the contact ln(eta/eta0) = alpha p/(1 + stiffening p), not Roelands, ``strength`` of the way."""
    modulus_form = c.pressure_viscosity * c.pressure / (1 + stiffening * c.pressure / 1e9)
    roelands = np.log(thick(c) / c.viscosity)
    mixed = np.minimum((1 - strength) * roelands + strength * modulus_form, 60.0)
    return replace(c, stress=sheared(c, c.viscosity * np.exp(mixed)))


def viscosity_drift(c: Contact, strength: float) -> Contact:
    """Oxidation thickens (+) or shear thins (-) the oil over the programme: eta exp(0.2 strength s^1.5)."""
    return replace(c, viscosity=c.viscosity * np.exp(0.2 * strength * c.rig.sequence**1.5)[:, None])


def viscosity_sheared_down(c: Contact, strength: float, pace: float) -> Contact:
    """Polymers break into short chains: eta (1 - 0.2 strength (1 - e^(-s/pace))), a tenth at least."""
    left = np.maximum(1 + 0.2 * strength * np.expm1(-c.rig.sequence / pace), 0.1)
    return replace(c, viscosity=c.viscosity * left[:, None])


def viscosity_diluted(c: Contact, strength: float) -> Contact:
    """A liquid mixes in at a constant rate, Arrhenius' law of mixtures: eta exp(0.2 strength s)."""
    return replace(c, viscosity=c.viscosity * np.exp(0.2 * strength * c.rig.sequence)[:, None])


def warmed(c: Contact, rise: np.ndarray) -> Contact:
    """Contact with its oil ``rise`` kelvin warmer, calibration and ageing kept."""
    oil, warm = c.rig.oil, c.temperature + rise
    return replace(
        c,
        temperature=warm,
        viscosity=c.viscosity * oil.viscosity_at(warm) / oil.viscosity_at(c.temperature),
        pressure_viscosity=c.pressure_viscosity
        * oil.pressure_viscosity_at(warm)
        / oil.pressure_viscosity_at(c.temperature),
    )


def _heated_by_mesh(c: Contact, rise_at: Callable[[np.ndarray], np.ndarray]) -> Contact:
    """Contact with oil at tooth temperature, in balance with the mesh loss (W) of the base chain, one rise a reading.

    Five sweeps leave some mK at strength 1: a reading's rise changes its loss little.
    """
    warm = c
    for _ in range(SWEEPS):
        loss = record_power(mix(shear(touch(lubricate(warm))))).recorded
        warm = warmed(c, rise_at(loss)[:, None])
    return warm


def bulk_temperature(c: Contact, strength: float) -> Contact:
    """ISO/TR 15144-1: teeth 7400 strength [P/(a b)]^0.72/1.2 K above their oil, P the mesh loss (kW), a and b in mm.

    Strength is X_S/X_Ca: 1 for dip lubrication without tip relief, 1.2 for spray. Constants from one source.
    """
    face = 1e6 * c.rig.extras["centre"] * c.rig.width
    return _heated_by_mesh(c, lambda loss: strength * 7400 * (1e-3 * loss / face) ** 0.72 / 1.2)


def bulk_temperature_by_convection(c: Contact, strength: float) -> Contact:
    """The mesh heats both wheels, oil mist cools rims and faces: strength P/(h A), h = 700 W/(m2 K) (v/10 m/s)^0.5.

    Laminar heat transfer of a rotating disc: root of speed, here of the pitch line; h is a common value, not published.
    """
    diameters = np.array([c.rig.extras["pitch_diameter"], c.rig.extras["wheel_diameter"]])
    area = np.pi * np.sum(diameters * c.rig.width + 0.5 * diameters**2)
    speed = c.rig.conditions["speed_rpm"].astype(float) * np.pi / 30 * 0.5 * diameters[0]
    return _heated_by_mesh(c, lambda loss: strength * loss / (700 * np.sqrt(speed / 10) * area))


AGEING = partial(Form, "viscosity_drift", "oil", rarity=0.6)
TEETH = partial(Form, "bulk_temperature", "surface")
EFFECTS = (
    Form("pressure_viscosity_law", "shear", pressure_viscosity_law,
         (strength(0.0, 1.5, (0.8, 1.1)), Knob("stiffening", 0.1, 1.2, (0.2, 0.7))), "modulus equation (Bode 1989)",
         rarity=0.6),
    AGEING(viscosity_drift, (strength(-4.0, 4.0, (0.7, 1.8)),), "accelerating oxidation"),
    AGEING(viscosity_sheared_down, (strength(0.0, 4.0, (0.7, 1.8)), Knob("pace", 0.05, 2.0, (0.1, 0.6))),
           "permanent shear loss of polymers"),
    AGEING(viscosity_diluted, (strength(-4.0, 4.0, (0.7, 1.8)),), "dilution by Arrhenius' law of mixtures 1887",
           within=True),
    TEETH(bulk_temperature, (strength(0.0, 3.0),), "ISO/TR 15144-1"),
    TEETH(bulk_temperature_by_convection, (strength(0.0, 3.0),), "heat balance of a mesh cooled by convection"),
)  # fmt: skip
