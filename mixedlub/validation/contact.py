"""Base model of a lubricated contact, written a second time: the readings of a rig without planted effects.

A recording of n readings is computed on arrays of shape (n, m): m points along the path of contact for gears (midpoints
of equal steps), one point for all other contacts. Each stage of the chain takes a frozen ``Contact`` and returns a new
one; a planted effect is a function inserted after the stage that it changes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mixedlub.validation.rig import Case, Chain, Model, play

ROELANDS_PRESSURE = 1.96e8
KELVIN = 273.15
PRIORS = ("boundary_friction", "viscosity", "pressure_viscosity", "eyring_stress", "roughness")


@dataclass(frozen=True)
class Oil:
    """Two-point data sheet of an oil: temperatures in C, kinematic viscosities in m2/s, the rest in SI."""

    temperature: tuple[float, float]
    kinematic: tuple[float, float]
    pressure_viscosity: tuple[float, float]
    density_15: float = 850.0
    expansion: float = 7e-4
    eyring_stress: float = 5e6
    conductivity: float = 0.14
    specific_heat: float = 2000.0

    def kinematic_at(self, temperature: np.ndarray) -> np.ndarray:
        """ASTM D341 through both points: log10 log10(nu + 0.7) linear in log10 T, nu in mm2/s; returns m2/s.

        >>> oil = Oil((40.0, 100.0), (30e-6, 6.2e-6), (18e-9, 14e-9))
        >>> [round(float(1e6 * oil.kinematic_at(t)), 6) for t in (40.0, 100.0)]
        [30.0, 6.2]
        """
        absolute = np.log10(np.asarray(self.temperature) + KELVIN)
        doubled = np.log10(np.log10(1e6 * np.asarray(self.kinematic) + 0.7))
        slope = (doubled[1] - doubled[0]) / (absolute[1] - absolute[0])
        line = doubled[0] + slope * (np.log10(np.asarray(temperature) + KELVIN) - absolute[0])
        return np.asarray(1e-6 * (10**10**line - 0.7))

    def density_at(self, temperature: np.ndarray) -> np.ndarray:
        return self.density_15 * (1 - self.expansion * (np.asarray(temperature) - 15.0))

    def viscosity_at(self, temperature: np.ndarray) -> np.ndarray:
        """Dynamic viscosity (Pa s)."""
        return self.kinematic_at(temperature) * self.density_at(temperature)

    def pressure_viscosity_at(self, temperature: np.ndarray) -> np.ndarray:
        """Straight line through the two given coefficients (1/Pa)."""
        (t1, t2), (a1, a2) = self.temperature, self.pressure_viscosity
        return a1 + (a2 - a1) * (np.asarray(temperature) - t1) / (t2 - t1)

    def thinning_at(self, temperature: np.ndarray) -> np.ndarray:
        """Temperature-viscosity coefficient -d ln(eta)/dT (1/K), by a central difference of 0.1 K."""
        warm, cold = np.asarray(temperature) + 0.05, np.asarray(temperature) - 0.05
        return np.log(self.viscosity_at(cold) / self.viscosity_at(warm)) / 0.1


@dataclass(frozen=True)
class Solid:
    """The two bodies: moduli in Pa, Poisson ratios; steel's heat conduction in SI."""

    modulus: tuple[float, float] = (206e9, 206e9)
    poisson: tuple[float, float] = (0.3, 0.3)
    conductivity: float = 46.0
    density: float = 7800.0
    specific_heat: float = 470.0

    @property
    def reduced(self) -> float:
        """E' = 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2] in Pa."""
        compliance = sum((1 - nu**2) / e for nu, e in zip(self.poisson, self.modulus))
        return 2.0 / compliance


@dataclass(frozen=True)
class Calibration:
    """Calibrated inputs: boundary friction by value, the others as factors on the data sheet."""

    boundary_friction: float = 0.1
    viscosity: float = 1.0
    pressure_viscosity: float = 1.0
    eyring_stress: float = 1.0
    roughness: float = 1.0


@dataclass(frozen=True)
class Inputs:
    """Inputs of the chain, readings by points: SI units except for temperatures in C.

    ``share_force``: force on the tooth (or disc) at each point. ``step``: path length of a point over the base pitch (1
    without a path). ``conditions``: columns of the case file by name. ``shares``: shares of the two surfaces in the
    three composite moments (readings, 2, 3), equal by default. ``laws``: laws that replace the base model's, by step.
    """

    oil: Oil
    solid: Solid
    radius: np.ndarray
    speed_1: np.ndarray
    speed_2: np.ndarray
    share_force: np.ndarray
    width: float
    temperature: np.ndarray
    moments: np.ndarray
    sequence: np.ndarray
    conditions: Mapping[str, np.ndarray]
    step: float = 1.0
    phase: np.ndarray = field(default_factory=lambda: np.zeros(1))
    coated: np.ndarray | None = None
    coating_resistance: float = 0.0
    extras: Mapping[str, float] = field(default_factory=dict)
    shares: np.ndarray = field(default_factory=lambda: np.full((1, 2, 3), 0.5))
    is_point: bool = False
    laws: Mapping[str, Callable[..., Any]] = field(default_factory=dict)

    @property
    def is_mesh(self) -> bool:
        """Whether the contacts belong to a gear pair."""
        return bool(self.extras)


@dataclass(frozen=True)
class Contact:
    """State of every contact point along the chain; outputs of later stages are zero."""

    rig: Inputs
    temperature: np.ndarray
    viscosity: np.ndarray
    pressure_viscosity: np.ndarray
    eyring_stress: np.ndarray
    boundary_friction: np.ndarray
    m0: np.ndarray
    m2: np.ndarray
    m4: np.ndarray
    force: np.ndarray
    line_load: np.ndarray
    entrainment: np.ndarray
    sliding: np.ndarray
    pressure: np.ndarray = field(default_factory=lambda: np.zeros(1))
    half_width: np.ndarray = field(default_factory=lambda: np.zeros(1))
    film: np.ndarray = field(default_factory=lambda: np.zeros(1))
    area: np.ndarray = field(default_factory=lambda: np.zeros(1))
    stress: np.ndarray = field(default_factory=lambda: np.zeros(1))
    friction: np.ndarray = field(default_factory=lambda: np.zeros(1))
    recorded: np.ndarray = field(default_factory=lambda: np.zeros(1))

    @property
    def roughness(self) -> np.ndarray:
        """Composite root-mean-square height (m)."""
        return np.sqrt(self.m0)

    @property
    def fluid_friction(self) -> np.ndarray:
        return self.stress / self.pressure


Stage = Callable[[Contact], Contact]


def start(rig: Inputs, calibration: Calibration) -> Contact:
    """Oil, surfaces and kinematics at the recorded conditions."""
    temperature = rig.temperature[:, None]
    moments = rig.moments * calibration.roughness**2
    return Contact(
        rig=rig,
        temperature=temperature,
        viscosity=rig.oil.viscosity_at(temperature) * calibration.viscosity,
        pressure_viscosity=rig.oil.pressure_viscosity_at(temperature) * calibration.pressure_viscosity,
        eyring_stress=np.full_like(temperature, rig.oil.eyring_stress * calibration.eyring_stress),
        boundary_friction=np.full_like(temperature, calibration.boundary_friction),
        m0=moments[:, 0:1],
        m2=moments[:, 1:2],
        m4=moments[:, 2:3],
        force=rig.share_force,
        line_load=rig.share_force / rig.width,
        entrainment=0.5 * (rig.speed_1 + rig.speed_2),
        sliding=np.abs(rig.speed_1 - rig.speed_2),
    )


def press(c: Contact) -> Contact:
    """Hertz line contact: p0 = sqrt(w E'/(2 pi R)), b = 2 w/(pi p0)."""
    pressure = np.sqrt(c.line_load * c.rig.solid.reduced / (2 * np.pi * c.rig.radius))
    return replace(c, pressure=pressure, half_width=2 * c.line_load / (np.pi * pressure))


def followed(step: str, base: Stage) -> Stage:
    """Stage with the rig's law of the step, by default the base model's."""
    return lambda c: c.rig.laws.get(step, base)(c)


def dowson_toyoda(c: Contact) -> Contact:
    """Dowson-Toyoda central film h = 3.06 R G^0.56 U^0.69 W^-0.10 at the mean speed."""
    modulus, radius = c.rig.solid.reduced, c.rig.radius
    speed = c.viscosity * c.entrainment / (modulus * radius)
    load = c.line_load / (modulus * radius)
    logarithm = 0.56 * np.log(c.pressure_viscosity * modulus) + 0.69 * np.log(speed) - 0.10 * np.log(load)
    return replace(c, film=3.06 * radius * np.exp(logarithm))


lubricate = followed("film", dowson_toyoda)


@dataclass(frozen=True)
class Summits:
    """McCool summits of the two surfaces together: density (1/m2), radius, spread, plane offset (m)."""

    density: np.ndarray
    radius: np.ndarray
    spread: np.ndarray
    offset: np.ndarray


def summits(c: Contact) -> Summits:
    """Summit density, radius, spread and plane offset from m0, m2, m4 (McCool)."""
    nayak = c.m0 * c.m4 / c.m2**2
    return Summits(
        density=c.m4 / (c.m2 * 6 * np.pi * np.sqrt(3.0)),
        radius=0.375 * np.sqrt(np.pi / c.m4),
        spread=np.sqrt(np.maximum(1 - 0.8968 / nayak, 1e-3) * c.m0),
        offset=4 * np.sqrt(c.m0 / (np.pi * nayak)),
    )


def overlap(t: np.ndarray) -> np.ndarray:
    """Greenwood-Williamson F_1(t) = phi(t) - t Q(t), from the complementary error function.

    >>> [round(float(overlap(np.array(t))), 6) for t in (1.0, 2.0)]
    [0.083315, 0.008491]
    """
    from scipy.special import erfc

    return np.exp(-0.5 * t**2) / np.sqrt(2 * np.pi) - 0.5 * t * erfc(t / np.sqrt(2.0))


def greenwood_williamson(c: Contact) -> Contact:
    """Real over nominal area pi D R sigma F_1((h - z)/sigma), within 0 and 1."""
    s = summits(c)
    share = np.pi * s.density * s.radius * s.spread * overlap((c.film - s.offset) / s.spread)
    return replace(c, area=np.clip(share, 0.0, 1.0))


touch = followed("contact", greenwood_williamson)


def thick(c: Contact, warmer: np.ndarray | float = 0.0) -> np.ndarray:
    """Viscosity (Pa s) at the maximum pressure, ``warmer`` kelvin above the oil: Roelands, or the rig's law."""
    if "thick" in c.rig.laws:
        return np.asarray(c.rig.laws["thick"](c, warmer))
    level = np.log(c.viscosity) + 9.67
    exponent = c.pressure_viscosity * ROELANDS_PRESSURE / level
    rise = (1 + c.pressure / ROELANDS_PRESSURE) ** exponent
    if np.any(warmer):
        absolute = c.temperature + KELVIN - 138.0
        slope = c.rig.oil.thinning_at(c.temperature) * absolute / level
        rise = rise * (1 + warmer / absolute) ** (-slope)
    return c.viscosity * np.exp(level * (rise - 1))


def sheared(c: Contact, viscosity: np.ndarray) -> np.ndarray:
    """Ree-Eyring stress tau0 asinh(eta v_s/(h tau0)) in Pa."""
    return c.eyring_stress * np.arcsinh(viscosity * c.sliding / (c.film * c.eyring_stress))


def film_stress(c: Contact, warmer: np.ndarray | float = 0.0) -> np.ndarray:
    """Shear stress of the film (Pa) by the rig's law, ``warmer`` kelvin above the oil temperature."""
    law = c.rig.laws.get("shear")
    return sheared(c, thick(c, warmer)) if law is None else np.asarray(law(c, warmer))


def shear(c: Contact) -> Contact:
    return replace(c, stress=film_stress(c))


def mix(c: Contact) -> Contact:
    """Friction (tau/p0)(1 - P_B) + mu_B P_B."""
    return replace(c, friction=c.fluid_friction * (1 - c.area) + c.boundary_friction * c.area)


def record_power(c: Contact) -> Contact:
    """Power loss (W) of a gear pair: the integral along the path of contact over one base pitch."""
    return replace(c, recorded=np.sum(c.friction * c.force * c.sliding, axis=1) * c.rig.step)


def record_friction(c: Contact) -> Contact:
    return replace(c, recorded=c.friction[:, 0])


def friction_chain(press: Stage = press, lubricate: Stage = lubricate, record: Stage = record_friction) -> Chain:
    """Stages from the oil to the reading for a pressure law, a film law and a recorded quantity."""
    return (
        ("oil", None),
        ("load", None),
        ("surface", press),
        ("film", lubricate),
        ("contact", touch),
        ("shear", shear),
        ("boundary", None),
        ("friction", mix),
        ("loss", record),
        ("sensor", None),
    )


def oil_of(settings: Mapping[str, Any]) -> Oil:
    table = settings["lubricant"]
    return Oil(
        temperature=tuple(table["temperature_C"]),
        kinematic=tuple(1e-6 * v for v in table["kinematic_viscosity_mm2_s"]),
        pressure_viscosity=tuple(1e-9 * v for v in table["pressure_viscosity_per_GPa"]),
        density_15=table["density_15C_kg_m3"],
        expansion=table["density_change_per_K"],
        eyring_stress=1e6 * table["eyring_stress_MPa"],
        conductivity=table["thermal_conductivity_W_mK"],
        specific_heat=table["specific_heat_J_kgK"],
    )


def solid_of(table: Mapping[str, Any]) -> Solid:
    return Solid(tuple(1e9 * e for e in table["youngs_modulus_GPa"]), tuple(table["poisson_ratio"]))


def surfaces_of(case: Case, first: str, second: str) -> dict[str, Any]:
    """Composite moments of both surfaces (readings by 3, SI), shares of each surface, coated surfaces, and coating."""
    units = np.array([1e-12, 1.0, 1e12])
    table = case.settings["surfaces"]
    moments = {name: np.array([s["m0_um2"], s["m2"], s["m4_per_um2"]]) * units for name, s in table.items()}
    pairs = list(zip(case.columns[first], case.columns[second]))
    both = np.array([(moments[a], moments[b]) for a, b in pairs])
    layers = [surface["coating"] for surface in table.values() if "coating" in surface]
    return {
        "moments": both.sum(axis=1),
        "shares": both / both.sum(axis=1, keepdims=True),
        "coated": np.array([[float("coating" in table[a]) + float("coating" in table[b])] for a, b in pairs]),
        "coating_resistance": 1e-6 * layers[0]["thickness_um"] / layers[0]["thermal_conductivity_W_mK"]
        if layers
        else 0.0,
    }


def calibrated(settings: Mapping[str, Any], z: np.ndarray) -> Calibration:
    """Calibration ``z`` prior standard deviations off: boundary friction by addition, the others lognormal."""
    priors = settings["uncertainty"]
    moved = {name: priors.get(name, 0.0) * shift for name, shift in zip(PRIORS, z)}
    factors = {name: float(np.exp(moved[name])) for name in PRIORS[1:]}
    return Calibration(max(settings["boundary_friction"] + moved["boundary_friction"], 1e-4), **factors)


def contact_model(settings: Mapping[str, Any], inputs: Callable[[], Inputs], chain: Chain) -> Model:
    """Model of a rig with the given chain of its contacts."""
    return lambda z, acts: np.asarray(play(chain, start(inputs(), calibrated(settings, z)), acts).recorded)


def contact_theta(settings: Mapping[str, Any]) -> Callable[[np.ndarray], dict[str, float]]:
    """Values of the calibration by the names of the diagnosis."""

    def theta(z: np.ndarray) -> dict[str, float]:
        at = calibrated(settings, z)
        return {
            "boundary_friction": at.boundary_friction,
            **{f"{name}_scale": getattr(at, name) for name in PRIORS[1:]},
        }

    return theta
