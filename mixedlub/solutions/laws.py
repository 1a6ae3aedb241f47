"""Laws compared with full solutions, each with the result it approximates."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from mixedlub.chain.law import Law
from mixedlub.chain.ranges import beyond
from mixedlub.chain.slots import FILM, FILM_FRICTION, SHEAR, VISCOSITY
from mixedlub.effects.contact_average import contact_average
from mixedlub.effects.film_heating import film_heating
from mixedlub.effects.inlet_shear_heating import inlet_shear_heating
from mixedlub.effects.rolling_resistance import rolling_resistance
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil
from mixedlub.friction import BASE, FrictionLaw, catalogue
from mixedlub.laws import film, heating, mixture, oil, shear

State = dict[str, Any]
ROUGHNESS = 0.07e-6
"""Composite roughness (m) for friction laws that read it: superfinished, the smoothest in their range."""
LEAST_RISE = 5.0
"""Temperature rise of the walls (K) above which sliding dominates: compression and rolling cause a few kelvin."""
MINIMUM = "minimum"
"""Part of the name of film laws for the minimum film."""


@dataclass(frozen=True)
class Compared:
    """A law: column of the solution for comparison, and value in the unit of that column."""

    name: str
    against: str
    value: Callable[[State, Mapping[str, np.ndarray]], np.ndarray]
    meaning: str


def state_of(of: Oil, found: Contacts) -> State:
    """Glossary quantities read by laws of smooth contacts; bodies are of steel at the oil temperature."""
    temperature, pressure = found.oil_temperature, found.pressure
    viscosity, coefficient = of.at_ambient(temperature)
    none = np.zeros_like(temperature)
    density = of.density * of.density_ratio(none, temperature)[0]
    state: State = {
        "radius": found.radius,
        "line_load": found.line_load,
        "entrainment_speed": found.speed,
        "sliding_speed": np.abs(found.sliding),
        "slide_roll_ratio": np.abs(found.sliding) / found.speed,
        "reduced_modulus": found.modulus,
        "hertz_pressure": pressure,
        "hertz_half_width": found.half_width,
        "oil_temperature": temperature,
        "viscosity": viscosity,
        "pressure_viscosity": coefficient,
        "temperature_viscosity": -of.log_viscosity(none, temperature)[2],
        "oil_density": density,
        "kinematic_viscosity": oil.kinematic(viscosity, density),
        "oil_conductivity": np.full_like(none, of.conductivity),
        "eyring_stress": of.stress_scale(pressure),
        "solid_conductivity": found.first.conductivity,
        "solid_density": found.first.density,
        "solid_heat_capacity": found.first.heat_capacity,
        "composite_roughness": np.full_like(none, ROUGHNESS),
        "boundary_friction": none,
        "area_ratio": none,
        "own_viscosity": np.exp(of.log_viscosity(pressure, temperature)[0]),
    }
    chain: tuple[tuple[str, Callable[..., Any]], ...] = (
        ("moes_load", film.moes_load),
        ("isoviscous_ratio", film.isoviscous_ratio),
        ("film_thickness", film.dowson_toyoda),
        ("flash_per_friction", heating.flash_per_friction),
        *_SHEARED,
    )
    for name, law in chain:
        state[name] = called(law, state)
    return state


def called(law: Callable[..., Any], state: State, **parameters: float) -> np.ndarray:
    """Value of a law at a state."""
    needed = [name for name in inspect.signature(law).parameters if name not in parameters]
    return np.asarray(law(*(state[name] for name in needed), **parameters))


def compared() -> Iterator[Compared]:
    """All laws: film, heat and friction."""
    yield from _films()
    yield from _heat()
    yield from _frictions()


def _films() -> Iterator[Compared]:
    for choice in FILM.choices.values():
        kind = "minimum" if MINIMUM in choice.name else "flow" if choice.law is film.moes else "central"

        def thick(state: State, _: Mapping[str, np.ndarray], of: Law = choice) -> np.ndarray:
            return np.where(beyond(state, of.valid), np.nan, 1e9 * called(of.law, state))

        yield Compared(choice.name, f"isothermal_{kind}_film_nm", thick, choice.title)


def _heat() -> Iterator[Compared]:
    for name, sliding in (("inlet_shear_heating (Gupta)", 1.0), ("inlet_shear_heating (Gupta, no sliding)", 0.0)):

        def heated(state: State, solved: Mapping[str, np.ndarray], weight: float = sliding) -> np.ndarray:
            own = {**state, "film_thickness": solved["isothermal_central_film_nm"]}
            gupta = {"strength": 1.0, "loading_power": 0.64, "pressure_power": 0.0}
            return called(inlet_shear_heating, own, sliding=weight, **gupta)

        yield Compared(name, "thermal_central_film_nm", heated, "on the isothermal film of the solution")

    def flash(state: State, solved: Mapping[str, np.ndarray]) -> np.ndarray:
        rise = heating.largest_flash_temperature(state["flash_per_friction"], solved["thermal_friction"])
        return np.where(solved["thermal_wall_rise_K"] >= LEAST_RISE, rise, np.nan)

    yield Compared("largest_flash_temperature", "thermal_wall_rise_K", flash, "with the friction of the solution")
    for name, exponent in (("Biboulet and Houpert", 0.75), ("Goksem and Hargreaves", 0.658)):

        def rolling(state: State, _: Mapping[str, np.ndarray], power: float = exponent) -> np.ndarray:
            force = called(rolling_resistance, {**state, "rolling_force": 0.0}, strength=1.0, exponent=power)
            return np.asarray(2.0 * state["entrainment_speed"] * force)

        yield Compared(f"rolling_resistance ({name})", "isothermal_rolling_W_m", rolling, "power of rolling")


def _readings() -> Iterator[Compared]:
    """The isothermal base model, as is and with single options changed."""
    meaning = "Dowson and Toyoda, Roelands and Ree-Eyring at the largest pressure, against an isothermal solution"
    yield Compared("base model, isothermal", "isothermal_friction", lambda state, _: state["fluid_friction"], meaning)
    changed = [
        (f"{slot.option} = {choice.name}", {slot.quantity: choice.law}, choice.title)
        for slot in (VISCOSITY, SHEAR, FILM_FRICTION)
        for choice in slot.choices.values()
        if choice.name not in (slot.default, OWN_CONSTANTS)
    ]
    changed.append(("viscosity law of the oil", {"contact_viscosity": _own_viscosity}, "that of the full solution"))
    for name, laws, about in changed:
        yield Compared(name, "isothermal_friction", partial(_friction, laws=laws, pressure=1.0), about)
    at_mean = partial(_friction, laws={}, pressure=MEAN)
    yield Compared("viscosity_pressure = mean", "isothermal_friction", at_mean, "viscosity at the mean Hertz pressure")
    both = partial(_friction, laws={"fluid_friction": mixture.fluid_friction_at_mean_pressure}, pressure=MEAN)
    yield Compared("both pressures = mean", "isothermal_friction", both, "viscosity and stress at the mean pressure")
    yield Compared("base model and contact_average", "isothermal_friction", _averaged, "mean over the contact")


def _friction(
    state: State, _: Mapping[str, np.ndarray], *, laws: Mapping[str, Callable[..., Any]], pressure: float
) -> np.ndarray:
    """Isothermal friction with some laws replaced, and the viscosity at a fraction of the largest Hertz pressure."""
    own = dict(state)
    for name, law in _SHEARED:
        at = {"hertz_pressure": pressure * state["hertz_pressure"]} if name == "contact_viscosity" else {}
        own[name] = called(laws.get(name, law), {**own, **at})
    return np.asarray(own["fluid_friction"])


def _averaged(state: State, _: Mapping[str, np.ndarray]) -> np.ndarray:
    """Isothermal friction with the mean over the contact in place of the stress at the largest pressure."""
    own = {**state, "mean_pressure": MEAN * state["hertz_pressure"]}
    return np.asarray(called(contact_average, own, share=1.0) / state["hertz_pressure"])


def _own_viscosity(own_viscosity: np.ndarray) -> np.ndarray:
    return own_viscosity


_SHEARED: tuple[tuple[str, Callable[..., Any]], ...] = (
    ("contact_viscosity", oil.roelands_viscosity),
    ("shear_stress", shear.ree_eyring),
    ("fluid_friction", mixture.fluid_friction),
)
OWN_CONSTANTS = "modulus"
"""Viscosity law with constants known for few oils; for those, the constants of the oil are used."""
MEAN = 0.25 * np.pi
"""Mean over largest Hertz pressure of a line contact."""


def _frictions() -> Iterator[Compared]:
    yield from _readings()
    yield Compared(
        "base model and film_heating",
        "thermal_friction",
        lambda state, _: _heated_friction(state),
        "the same with heat, against a thermal solution",
    )
    for law in catalogue().values():
        if law.place == "contact" and all(c.default is not None for c in law.coefficients):
            name = "base model" if law.name == BASE else law.name
            yield Compared(name, "thermal_friction", partial(_inside, law), law.title)


def _inside(law: FrictionLaw, state: State, _: Mapping[str, np.ndarray]) -> np.ndarray:
    """A friction law inside the range of its source."""
    if not state.keys() >= set(law.reads):
        return np.full_like(state["radius"], np.nan)
    friction = called(law.with_coefficients({}), state)
    outside = law.outside({**state, "friction": friction}) | law.divergent(state)
    return np.where(outside, np.nan, friction)


def _heated_friction(state: State) -> np.ndarray:
    stress = called(film_heating, state, strength=1.0, flash=0.5, pressure=1.0)
    return mixture.fluid_friction(stress, state["hertz_pressure"])
