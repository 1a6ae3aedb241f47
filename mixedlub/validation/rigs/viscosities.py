"""Viscosity of a sample: tables against pressure and temperature, cycles of temperature against time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from mixedlub.validation.contact import KELVIN, Oil, oil_of
from mixedlub.validation.disclosure import BOW, NOT_GIVEN
from mixedlub.validation.planted import viscosity_temperature as cooling
from mixedlub.validation.planted.measurement import channel
from mixedlub.validation.rig import Act, Chain, Form, Knob, Rig, play, strength
from mixedlub.validation.sample_rig import between, draw_oil, pick, progress, repeated, rounded

PAIRS = (
    ("viscosity_drift", "sensor_offset"),
    ("pressure_viscosity_law", "sensor_offset"),
    ("pressure_viscosity_law", "sensor_drift"),
    ("viscosity_temperature_law", "sensor_drift"),
    ("pressure_viscosity_law", "viscosity_temperature_law"),
)


@dataclass(frozen=True)
class Sample:
    """Viscosity at rest (Pa s), slope against pressure (1/Pa), log rise with pressure, reading (mPa s).

    ``by_walther``: viscosity at rest by ASTM D341. ``known``: data-sheet temperatures (C) and viscosities there (Pa s).
    """

    celsius: np.ndarray
    pressure: np.ndarray
    resting: np.ndarray
    slope: np.ndarray
    rise: np.ndarray
    recorded: np.ndarray
    by_walther: np.ndarray
    known: tuple[cooling.Pair, cooling.Pair]


CHAIN: Chain = (
    ("oil", None),
    ("rise", lambda s: replace(s, rise=s.slope * s.pressure)),
    ("loss", lambda s: replace(s, recorded=1e3 * s.resting * np.exp(np.minimum(s.rise, 60.0)))),
    ("sensor", None),
)


def _part(s: Sample, rise: np.ndarray, strength: float) -> Sample:
    return replace(s, rise=(1 - strength) * s.rise + strength * rise)


def mcewen(s: Sample, strength: float, power: float) -> Sample:
    """(1 + a p/q)^q."""
    return _part(s, power * np.log1p(s.slope * s.pressure / power), strength)


def roelands_of_1966(s: Sample, strength: float, modulus: float) -> Sample:
    """A power of 1 + p/p_r on log viscosity over 6.31e-5 Pa s, p_r about 0.196 GPa."""
    level = np.log(s.resting) + 9.67
    exponent = np.clip(s.slope * modulus * 1e9 / level, 0.05, 0.95)
    return _part(s, level * ((1 + s.pressure / (modulus * 1e9)) ** exponent - 1), strength)


def mcewen_paluch(s: Sample, strength: float, power: float, glass: float) -> Sample:
    """McEwen's factor, and a factor diverging at a glass pressure (GPa) that grows with temperature."""
    runaway = (glass + 0.008 * s.celsius) * 1e9
    bent = power * np.log1p(0.8 * s.slope * s.pressure / power)
    return _part(s, bent + 0.2 * s.slope * runaway * s.pressure / np.maximum(runaway - s.pressure, 1e7), strength)


def bode(s: Sample, strength: float, stiffening: float) -> Sample:
    """The modulus equation: a p/(1 + c p), c in 1/GPa."""
    return _part(s, s.slope * s.pressure / (1 + 1e-9 * stiffening * s.pressure), strength)


def _tait(s: Sample) -> np.ndarray:
    """Volume over the volume at rest: 1 - ln(1 + p (1 + K')/K0)/(1 + K'), K0 softening with temperature."""
    bulk = 9e9 * np.exp(-6.5e-3 * (s.celsius + KELVIN))
    return np.asarray(1 - np.log1p(s.pressure * 11.0 / bulk) / 11.0)


def doolittle(s: Sample, strength: float, occupied: float) -> Sample:
    """Doolittle: ln eta is linear in occupied over free volume, the volume from Tait, scaled to the slope at rest."""
    free = 1 + 8e-4 * (s.celsius - 20.0)
    bulk = 9e9 * np.exp(-6.5e-3 * (s.celsius + KELVIN))

    def term(volume: np.ndarray) -> np.ndarray:
        return np.asarray(occupied / np.maximum(volume * free - occupied, 0.02))

    rise = term(_tait(s)) - term(np.ones_like(free))
    start = occupied * free / (free - occupied) ** 2 / bulk
    return _part(s, s.slope / start * rise, strength)


def _drifts(time: np.ndarray) -> tuple[Form, ...]:
    def even(s: Sample, strength: float) -> Sample:
        """eta (1 + 0.2 strength s), s from 0 to 1 over the programme."""
        return replace(s, resting=s.resting * np.clip(1 + 0.2 * strength * time, 0.05, None))

    def gathering(s: Sample, strength: float) -> Sample:
        """Remainder after a light fraction evaporates at a constant rate."""
        return replace(s, resting=s.resting / np.clip(1 - 0.17 * strength * time, 0.05, None))

    def hot(s: Sample, strength: float) -> Sample:
        """Oxidation: the rate doubles every 12 K, summed over the programme."""
        pace = np.exp(np.log(2) * (s.celsius - 40.0) / 12.0)
        done = np.cumsum(pace) / pace.sum()
        return replace(s, resting=s.resting * np.exp(0.2 * strength * done))

    size = (strength(-4.0, 5.0),)
    return (
        Form("viscosity_drift", "oil", even, size, "even pace"),
        Form("viscosity_drift", "oil", gathering, size, "evaporation"),
        Form("viscosity_drift", "oil", hot, size, "oxidation that doubles every 12 K"),
    )


def _cooled(s: Sample, strength: float, law: cooling.Law) -> Sample:
    """Sample with another law than ASTM D341, ``strength`` of the way, through its two known viscosities."""
    return replace(s, resting=s.resting * (law(s.celsius, *s.known) / s.by_walther) ** strength)


def vogel(s: Sample, strength: float, divergence: float) -> Sample:
    """Vogel, Fulcher and Tammann; T0 in kelvin."""
    return _cooled(s, strength, partial(cooling.vogel, divergence=divergence))


def slotte(s: Sample, strength: float, above: float) -> Sample:
    """Slotte's power of the temperature over ``above`` C below the freezing point."""
    return _cooled(s, strength, partial(cooling.slotte, above=above))


def andrade(s: Sample, strength: float) -> Sample:
    """eta = A exp(B/T) through both known viscosities."""
    return _cooled(s, strength, cooling.andrade)


def reynolds(s: Sample, strength: float) -> Sample:
    """eta = A exp(-b T) through both known viscosities."""
    return _cooled(s, strength, cooling.reynolds)


def _temperature_forms(oil: Oil, named: bool) -> tuple[Form, ...]:
    def misstated(s: Sample, strength: float) -> Sample:
        """The second viscosity of the data sheet is 5 % strength too low."""
        return replace(s, resting=s.resting * cooling.misstated(oil, s.celsius, 0.05 * strength))

    whole, pole, above, by = cooling.WHOLE, cooling.DIVERGENCE, cooling.ABOVE, cooling.MISSTATED_BY
    return (
        Form("viscosity_temperature_law", "oil", vogel, (whole, pole), cooling.VOGEL, within=True),
        Form("viscosity_temperature_law", "oil", slotte, (whole, above), cooling.SLOTTE),
        Form("viscosity_temperature_law", "oil", andrade, (whole,), cooling.ANDRADE, within=True),
        Form("viscosity_temperature_law", "oil", reynolds, (whole,), cooling.REYNOLDS, within=True),
        *((Form("viscosity_temperature_law", "oil", misstated, (by,), cooling.MISSTATED),) if named else ()),
    )


def _pressure_forms() -> tuple[Form, ...]:
    near_one = strength(0.0, 1.3, (0.9, 1.05))
    return (
        Form("pressure_viscosity_law", "rise", mcewen,
             (near_one, Knob("power", 4.0, 40.0, (7.0, 18.0))), "McEwen 1952"),
        Form("pressure_viscosity_law", "rise", roelands_of_1966,
             (near_one, Knob("modulus", 0.17, 0.22, (0.19, 0.2))), "Roelands 1966"),
        Form("pressure_viscosity_law", "rise", mcewen_paluch,
             (near_one, Knob("power", 2.0, 15.0, (3.0, 7.0)), Knob("glass", 0.5, 2.5, (0.8, 1.6))), "Bair's hybrid"),
        Form("pressure_viscosity_law", "rise", bode,
             (near_one, Knob("stiffening", 0.1, 2.5, (0.4, 1.5))), "Bode 1989", within=True),
        Form("pressure_viscosity_law", "rise", doolittle,
             (near_one, Knob("occupied", 0.5, 0.75, (0.6, 0.7))), "Doolittle 1951 with Tait's volume"),
    )  # fmt: skip


def outside_of(columns: Mapping[str, np.ndarray], time: np.ndarray) -> tuple[Form, ...]:
    celsius = columns["temperature_C"]
    rate = np.sign(np.gradient(celsius)) if len(celsius) > 2 else np.zeros_like(celsius)

    def multiplied(s: Sample, factor: np.ndarray) -> Sample:
        return replace(s, recorded=s.recorded * factor)

    def waxing(s: Sample, strength: float, cloud: float) -> Sample:
        """Below the cloud point wax thickens the oil."""
        below = np.clip(np.quantile(celsius, cloud) - celsius, 0, None) / 10
        return multiplied(s, 1 + 0.3 * strength * below)

    def lagging(s: Sample, strength: float) -> Sample:
        """The sample lags its thermometer on ramps: colder while heated, warmer while cooled."""
        return multiplied(s, np.exp(0.04 * strength * rate))

    def refilled(s: Sample, strength: float, when: float) -> Sample:
        """Another sample from one moment on."""
        return multiplied(s, 1 + 0.1 * strength * (time > when))

    def freezing(s: Sample, strength: float, where: float) -> Sample:
        """A part of the sample solidifies above a pressure: a step."""
        return multiplied(s, 1 + 0.3 * strength * (s.pressure > where * s.pressure.max()))

    def one_cell(s: Sample, strength: float) -> Sample:
        """One temperature was measured in another cell."""
        levels = np.unique(celsius)
        return multiplied(s, 1 + 0.2 * strength * (celsius == levels[len(levels) // 2]))

    either, up = strength(-3.0, 8.0), strength(0.0, 10.0)
    moving = "time_s" in columns
    forms = [Form("refilled", "loss", refilled, (either, Knob("when", 0.2, 0.8, (0.3, 0.7))), "constructed")]
    if moving:
        forms.append(Form("waxing", "loss", waxing, (up, Knob("cloud", 0.1, 0.5, (0.15, 0.35))), "constructed"))
        forms.append(Form("lagging", "loss", lagging, (up,), "constructed"))
        return tuple(forms)
    if len(np.unique(celsius)) > 2:
        forms.append(Form("one_cell", "loss", one_cell, (either,), "constructed"))
    forms.append(Form("freezing", "loss", freezing, (up, Knob("where", 0.3, 0.8, (0.4, 0.7))), "constructed"))
    return tuple(forms)


def forms_over(time: np.ndarray) -> tuple[Form, ...]:
    """Forms of a sample without a data sheet that need its programme alone."""
    return _drifts(time) + channel(time, True, False, False)


def _table(rng: np.random.Generator) -> tuple[dict[str, np.ndarray], bool]:
    baths = pick(rng, ([20.0, 60.0, 100.0], [0.0, 25.0, 40.0, 100.0], [40.0, 80.0], [25.0, 50.0, 75.0, 100.0, 150.0]))
    top = between(rng, 300, 1000, 2)
    steps = np.round(np.linspace(0.1, top, int(rng.integers(7, 14))), 1)
    grid = np.array([(t, p) for t in baths for p in steps if p <= top * (0.55 + 0.45 * t / max(baths))])
    if rng.random() < 0.6:
        grid = grid[rng.permutation(len(grid))]
    again = len(grid) < 50 and rng.random() < 0.2
    columns = repeated({"temperature_C": grid[:, 0], "pressure_MPa": grid[:, 1]}, 3 if again else 1)
    columns["sequence"] = progress(len(columns["run"]))
    return columns, again


def _cycle(rng: np.random.Generator) -> dict[str, np.ndarray]:
    start, high, low = 25.0, between(rng, 60, 110, 2), rounded(rng.uniform(0, 15), 2)
    legs = [np.linspace(start, high, int(rng.integers(10, 26))), np.linspace(high, low, int(rng.integers(15, 41)))]
    legs.append(np.linspace(low, start, int(rng.integers(6, 16))))
    celsius = np.round(np.concatenate([legs[0], legs[1][1:], legs[2][1:]]), 2)
    if rng.random() < 0.3:
        celsius = np.concatenate([np.full(10, start), celsius])
    columns = repeated({"temperature_C": celsius}, 1)
    columns["time_s"] = np.round(progress(len(celsius)) * between(rng, 5000, 1e5), 1)
    return columns


@dataclass(frozen=True)
class Fluid:
    """Oil of a sample at the temperatures of its programme; without a data sheet its properties are free."""

    oil: Oil
    celsius: np.ndarray
    priors: dict[str, float]
    named: bool
    pressed: bool

    @property
    def names(self) -> tuple[str, ...]:
        if self.named:
            return ("viscosity", "pressure_viscosity") if self.pressed else ("viscosity",)
        return ("viscosity", "steepness", "bow", *(("pressure_viscosity", "warmth") if self.pressed else ()))

    def resting(self, z: np.ndarray, celsius: np.ndarray) -> np.ndarray:
        """Viscosity at rest by ASTM D341; without a data sheet with free level, steepness and bow."""
        by = dict(zip(self.names, z))
        if self.named:
            return np.asarray(self.oil.viscosity_at(celsius) * np.exp(self.priors["viscosity"] * by["viscosity"]))
        middle = float(self._walther(self.celsius).mean())
        line = middle + 0.05 * by["viscosity"] + (1 + 0.08 * by["steepness"]) * (self._walther(celsius) - middle)
        bow = NOT_GIVEN[BOW] * by["bow"] * ((celsius - self.celsius.mean()) / 50.0) ** 2
        return np.asarray(1e-6 * (10**10**line - 0.7) * self.oil.density_at(celsius) * np.exp(bow))

    def _walther(self, celsius: np.ndarray) -> np.ndarray:
        return np.asarray(np.log10(np.log10(1e6 * self.oil.kinematic_at(celsius) + 0.7)))

    def sample(self, z: np.ndarray, pressure: np.ndarray) -> Sample:
        still, known = self.resting(z, self.celsius), self.oil.temperature
        first, second = self.resting(z, np.array(known))
        flat = np.zeros_like(still)
        return Sample(self.celsius, pressure, still, self.slope(z), flat, still, still, (known, (first, second)))

    @property
    def beyond_the_data_sheet(self) -> bool:
        """Whether the temperatures separate the laws: more than the two of a data sheet, or four without one."""
        if self.named:
            return cooling.separates_laws(self.celsius, self.oil.temperature)
        return len(np.unique(self.celsius)) > 3

    def slope(self, z: np.ndarray) -> np.ndarray:
        """Barus coefficient, linear in temperature; without a data sheet its level and tilt are free."""
        by = dict(zip(self.names, z))
        given = self.oil.pressure_viscosity_at(self.celsius)
        width = self.priors["pressure_viscosity"] if self.named else 0.3
        tilt = 0.2 * by.get("warmth", 0.0) * given.mean() * (self.celsius - self.celsius.mean()) / 100
        return np.asarray((given + tilt) * np.exp(width * by.get("pressure_viscosity", 0.0)))

    def theta(self, z: np.ndarray) -> dict[str, float]:
        if not self.named:
            return {}
        return {f"{name}_scale": float(np.exp(self.priors[name] * value)) for name, value in zip(self.names, z)}


def draw(rng: np.random.Generator) -> Rig:
    """A viscometer with a known or unknown sample and its programme."""
    moving = rng.random() < 0.4
    columns, again = (_cycle(rng), False) if moving else _table(rng)
    named = rng.random() < 0.5
    table = draw_oil(rng)
    priors = {"viscosity": pick(rng, (0.05, 0.15)), "pressure_viscosity": pick(rng, (0.06, 0.15))}
    settings: dict[str, Any] = {
        "schema": "mixedlub-case/1",
        "kind": "viscosity",
        **({"lubricant": table, "uncertainty": priors} if named else {}),
        "recording": {"quantity": "viscosity_mPa_s"},
    }
    celsius = columns["temperature_C"]
    pressure = 1e6 * columns.get("pressure_MPa", np.full(len(celsius), 0.1))
    time = columns.get("sequence", progress(len(celsius)))
    fluid = Fluid(oil_of({"lubricant": table}), celsius, priors, named, "pressure_MPa" in columns)

    def model(z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        return np.asarray(play(CHAIN, fluid.sample(z, pressure), acts).recorded)

    forms = _drifts(time) + (_pressure_forms() if fluid.pressed else ()) + channel(time, True, named, False)
    if fluid.beyond_the_data_sheet:
        forms += _temperature_forms(fluid.oil, named)
    return Rig(
        settings=settings,
        columns=columns,
        names=fluid.names,
        model=model,
        theta=fluid.theta,
        forms=forms,
        outside=outside_of(columns, time),
        quantile=0.1,
        floor=(0.05, 0.5),
        repeats=again,
        least=0.02,
    )
