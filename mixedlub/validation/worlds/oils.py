"""Viscosity under pressure and over temperature by other laws, with the coefficients of the same data sheet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mixedlub.validation.contact import KELVIN, Contact, Oil
from mixedlub.validation.planted import viscosity_temperature as cooling
from mixedlub.validation.planted.oil import warmed
from mixedlub.validation.rig import PRESSURE, TEMPERATURE, Knob, Law
from mixedlub.validation.rigs.viscosities import Sample
from mixedlub.validation.worlds import follow

Rise = Callable[..., np.ndarray]
"""ln(eta/eta_0) from the coefficient alpha (1/Pa), the pressure (Pa), the temperature (C) and ln(eta_0) + 9.67."""
MOST = 60.0


def barus(alpha: np.ndarray, pressure: np.ndarray, celsius: np.ndarray, level: np.ndarray) -> np.ndarray:
    """alpha p (Barus, Am. J. Sci. 45 (1893) 87): far too thick above some 0.5 GPa, yet in common use."""
    return np.asarray(alpha * pressure)


def mcewen(alpha: np.ndarray, pressure: np.ndarray, celsius: np.ndarray, level: np.ndarray, power: float) -> np.ndarray:
    """q ln(1 + alpha p/q) (McEwen 1952), q 7 to 18, up to some 1 GPa.

    >>> round(float(np.exp(mcewen(2e-8, 1e9, 40.0, 6.0, power=10.0))))  # (1 + 20/10)^10
    59049
    """
    return np.asarray(power * np.log1p(alpha * pressure / power))


def modulus(
    alpha: np.ndarray, pressure: np.ndarray, celsius: np.ndarray, level: np.ndarray, stiffening: float
) -> np.ndarray:
    """p/(A + B p) with A = 1/alpha (Bode 1989): alpha p/(1 + c p), c = alpha B the stiffening in 1/GPa."""
    return np.asarray(alpha * pressure / (1 + 1e-9 * stiffening * pressure))


def free_volume(
    alpha: np.ndarray, pressure: np.ndarray, celsius: np.ndarray, level: np.ndarray, occupied: float
) -> np.ndarray:
    """Doolittle's B v_0/(v - v_0), J. Appl. Phys. 22 (1951) 1471, v by Tait's equation, B by the slope at rest.

    Volume relative to 20 C at rest: (1 + 8e-4 (T - 20)) (1 - ln(1 + 11 p/K)/11), K = 9 GPa exp(-0.0065 T), T in kelvin;
    ``occupied`` is v_0. At least a fiftieth of the volume stays free.
    """
    resting = 1 + 8e-4 * (celsius - 20.0)
    bulk = 9e9 * np.exp(-6.5e-3 * (celsius + KELVIN))
    volume = resting * (1 - np.log1p(11 * pressure / bulk) / 11)
    filled = occupied / np.maximum(volume - occupied, 0.02) - occupied / (resting - occupied)
    return np.asarray(alpha * filled * bulk * (resting - occupied) ** 2 / (occupied * resting))


def roelands(alpha: np.ndarray, pressure: np.ndarray, celsius: np.ndarray, level: np.ndarray) -> np.ndarray:
    """(ln eta_0 + 9.67) [(1 + p/0.196 GPa)^Z - 1] (Roelands 1966), the base model's law for contacts."""
    return np.asarray(level * ((1 + pressure / 1.96e8) ** (alpha * 1.96e8 / level) - 1))


def _thick(c: Contact, warmer: np.ndarray | float = 0.0, *, rise: Rise) -> np.ndarray:
    c = warmed(c, np.asarray(warmer)) if np.any(warmer) else c
    logarithm = rise(c.pressure_viscosity, c.pressure, c.temperature, np.log(c.viscosity) + 9.67)
    return np.asarray(c.viscosity * np.exp(np.clip(logarithm, 0.0, MOST)))


@dataclass(frozen=True)
class OilBy(Oil):
    """An oil with another law than ASTM D341 between its two known viscosities."""

    law: cooling.Law = cooling.andrade

    def viscosity_at(self, temperature: np.ndarray) -> np.ndarray:
        first, second = super().viscosity_at(np.array(self.temperature))
        return self.law(np.asarray(temperature), self.temperature, (float(first), float(second)))


def _cooled(c: Contact, law: cooling.Law) -> Contact:
    oil = OilBy(**vars(c.rig.oil), law=law)
    ratio = oil.viscosity_at(c.temperature) / c.rig.oil.viscosity_at(c.temperature)
    return replace(c, viscosity=c.viscosity * ratio, rig=replace(c.rig, oil=oil))


def _entered(state: Contact | Sample, *, rise: Rise, **values: float) -> Contact | Sample:
    """State of a contact or a viscometer with a pressure law in place."""
    rise = partial(rise, **values)
    if isinstance(state, Contact):
        return follow(state, "thick", partial(_thick, rise=rise))
    logarithm = rise(state.slope, state.pressure, state.celsius, np.log(state.resting) + 9.67)
    return replace(state, slope=logarithm / np.maximum(state.pressure, 1.0))


def _turned(state: Contact | Sample, *, law: Callable[..., np.ndarray], **values: float) -> Contact | Sample:
    """State of a contact or a viscometer with a temperature law in place."""
    turned = partial(law, **values)
    if isinstance(state, Contact):
        return _cooled(state, turned)
    return replace(state, resting=state.resting * turned(state.celsius, *state.known) / state.by_walther)


def _pressed(name: str, source: str, rise: Rise, *knobs: Knob) -> Law:
    return Law(PRESSURE, name, source, partial(_entered, rise=rise), knobs)


def _by_temperature(name: str, source: str, law: Callable[..., np.ndarray], *knobs: Knob) -> Law:
    return Law(TEMPERATURE, name, source, partial(_turned, law=law), knobs)


SHARED = (
    _pressed("McEwen", "McEwen 1952", mcewen, Knob("power", 4.0, 40.0, (7.0, 18.0))),
    _pressed("modulus equation", "Bode 1989", modulus, Knob("stiffening", 0.1, 2.5, (0.2, 0.8))),
    _pressed("free volume", "Doolittle 1951 with Tait's volume", free_volume, Knob("occupied", 0.5, 0.75, (0.6, 0.7))),
)
OF_CONTACTS = (_pressed("Barus", "Barus 1893", barus), *SHARED)
OF_SAMPLES = (_pressed("Roelands", "Roelands 1966", roelands), *SHARED)
COOLING = (
    _by_temperature("Vogel", cooling.VOGEL, cooling.vogel, cooling.DIVERGENCE),
    _by_temperature("Slotte", cooling.SLOTTE, cooling.slotte, cooling.ABOVE),
    _by_temperature("Andrade", cooling.ANDRADE, cooling.andrade),
)
