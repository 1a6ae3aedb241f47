"""Disclosed oil and film law of a film case, and the prior spread of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from mixedlub.validation.contact import KELVIN, Calibration, Contact, Inputs, Oil, start
from mixedlub.validation.rig import Act, play
from mixedlub.validation.rigs.ball import SPEED_EXPONENT, ball_film_between, film_chain
from mixedlub.validation.sample_rig import pick, rounded

LEVEL, STEEPNESS, BOW, VISCOSITY, COEFFICIENT, WARMTH, BEND, REGIME, EXPONENT = (
    "viscosity_level",
    "viscosity_steepness",
    "viscosity_bow",
    "viscosity",
    "pressure_viscosity",
    "pressure_viscosity_warmth",
    "pressure_viscosity_bow",
    "film_regime",
    "film_exponent",
)
LAW = {EXPONENT: 0.015}
"""Relative spread: exponent 0.67 of Hamrock, Dowson 1977 and 0.68 of Chittenden, Dowson, Dunn, Taylor 1985."""
OF_A_KNOWN_OIL, OF_AN_UNKNOWN_OIL = {REGIME: 0.5, **LAW}, {REGIME: 1.0, **LAW}
"""Spreads of the law, with the fraction of the way from Hamrock-Dowson to Nijenbanning, Venner and Moes 1994."""
NOT_GIVEN = {LEVEL: 1.0, STEEPNESS: 0.5, BOW: 0.04, COEFFICIENT: 0.35, WARMTH: 0.4, BEND: 0.25}
"""Oil without any description: spreads of logarithms; relative fall of the coefficient over 100 K."""
NOMINAL = 0.3
"""Relative, of viscosities taken from a class of oils or a label."""
ACROSS = (STEEPNESS, BOW, WARMTH, BEND)
"""Properties that matter only for readings at several temperatures."""
MINERAL = Oil((40.0, 100.0), (55e-6, 6.6e-6), (19.9e-9, 14.8e-9), 865.0)
"""Middle of the drawn mineral oils; only a starting point of calibration."""
THINNEST, THICKEST = 0.4e-6, 1.0


def _ordinate(kinematic: Any) -> np.ndarray:
    """Ordinate of ASTM D341, viscosities in m2/s clipped to the thinnest and the thickest."""
    return np.log10(np.log10(1e6 * np.clip(kinematic, THINNEST, THICKEST) + 0.7))


def moved(oil: Oil, pivot: float, level: float, steepness: float) -> Oil:
    """Oil with viscosity times ``level`` at the pivot (C) and slope times ``steepness`` in the chart of ASTM D341.

    >>> oil = moved(MINERAL, 40.0, 2.0, 1.0)
    >>> [round(1e6 * nu, 1) for nu in oil.kinematic]
    [110.0, 9.6]
    """
    at = oil.kinematic_at(np.array(pivot))
    line = _ordinate(level * at) + steepness * (_ordinate(oil.kinematic) - _ordinate(at))
    first, second = 1e-6 * (10**10 ** np.clip(line, _ordinate(THINNEST), _ordinate(THICKEST)) - 0.7)
    return replace(oil, kinematic=(float(first), float(second)))


@dataclass(frozen=True)
class Disclosed:
    """A film rig with the oil disclosed in the case, and the prior standard deviation of each free property."""

    rig: Inputs
    spreads: dict[str, float]

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self.spreads)

    @property
    def pivot(self) -> float:
        """Pivot temperature (C) of an oil without data sheet."""
        return float(np.exp(np.mean(np.log(self.rig.temperature + KELVIN))) - KELVIN)

    @property
    def middle(self) -> float:
        """Viscosity times speed in the middle of the programme, the pivot of the film law."""
        c = start(self.rig, Calibration())
        return float(np.exp(np.mean(np.log(c.viscosity * c.entrainment))))

    def factors(self, z: np.ndarray) -> dict[str, float]:
        """Factors on the disclosed properties by name, ``z`` prior standard deviations off."""
        return {name: float(np.exp(self.spreads[name] * value)) for name, value in zip(self.names, z)}

    def start(self, z: np.ndarray) -> Contact:
        """Oil and kinematics with the calibration ``z`` spreads off."""
        by, rig = self.factors(z), self.rig
        if LEVEL in by:
            rig = replace(rig, oil=moved(rig.oil, self.pivot, by[LEVEL], by.get(STEEPNESS, 1.0)))
        c = start(rig, Calibration(viscosity=by.get(VISCOSITY, 1.0), pressure_viscosity=by[COEFFICIENT]))
        away = (c.temperature - self.pivot) / 100.0
        viscosity = c.viscosity * by.get(BOW, 1.0) ** (4.0 * away**2)
        bent = c.pressure_viscosity * by.get(BEND, 1.0) ** away**2
        c = replace(c, viscosity=viscosity, pressure_viscosity=bent)
        return self._tilted(c, float(np.log(by.get(WARMTH, 1.0))))

    def _tilted(self, c: Contact, more: float) -> Contact:
        """Coefficient with another fall over 100 K, linear in temperature about the pivot."""
        low, high = c.rig.oil.pressure_viscosity_at(np.array([self.pivot, self.pivot + 100.0]))
        fall, place = high / low - 1, (c.temperature - self.pivot) / 100
        ratio = np.maximum(1 + (fall + more) * place, 0.05) / np.maximum(1 + fall * place, 0.05)
        return replace(c, pressure_viscosity=c.pressure_viscosity * ratio)

    def model(self, z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        """Films (nm) by a law between the regression formula and the formula of all regimes."""
        by = self.factors(z)
        way, change = float(np.log(by[REGIME])), SPEED_EXPONENT * (by[EXPONENT] - 1)
        law = partial(ball_film_between, way=way, change=change, middle=self.middle)
        return np.asarray(play(film_chain(law), self.start(z), acts).recorded)


def with_data_sheet(rig: Inputs, viscosity: float, coefficient: float) -> Disclosed:
    """Rig with the data sheet of its oil."""
    return Disclosed(rig, {VISCOSITY: viscosity, COEFFICIENT: coefficient, **OF_A_KNOWN_OIL})


def _spreads(free: Sequence[str], celsius: np.ndarray) -> dict[str, float]:
    several = np.ptp(celsius) > 2.0
    return {name: NOT_GIVEN[name] for name in free if several or name not in ACROSS}


def without_data_sheet(rng: np.random.Generator, true: Inputs) -> tuple[Disclosed, dict[str, Any]]:
    """Rig with a default oil or with nominal viscosities only, and the sections of the case that state them."""
    if pick(rng, (True, False)):
        free = _spreads((LEVEL, STEEPNESS, BOW, COEFFICIENT, WARMTH, BEND), true.temperature)
        return Disclosed(replace(true, oil=MINERAL), {**free, **OF_AN_UNKNOWN_OIL}), {}
    off = float(np.exp(NOMINAL * rng.standard_normal()))
    first, second = (rounded(1e6 * off * nu) for nu in true.oil.kinematic)
    section = {
        "name": "unnamed oil",
        "temperature_C": list(true.oil.temperature),
        "kinematic_viscosity_mm2_s": [first, second],
    }
    oil = replace(MINERAL, temperature=true.oil.temperature, kinematic=(1e-6 * first, 1e-6 * second))
    free = _spreads((COEFFICIENT, WARMTH, BEND), true.temperature)
    disclosed = Disclosed(replace(true, oil=oil), {VISCOSITY: NOMINAL, **free, **OF_AN_UNKNOWN_OIL})
    return disclosed, {"lubricant": section, "uncertainty": {"viscosity": NOMINAL}}
