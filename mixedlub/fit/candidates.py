"""Candidate laws of a fit: every published law of the measured quantity, with free parameters and priors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect, Parameter
from mixedlub.chain.friction_law import FRICTION_LAWS, FrictionLaw
from mixedlub.chain.law import Law, Ranges
from mixedlub.chain.priors import LogNormal, Normal, Prior
from mixedlub.chain.quantities import unit_and_factor
from mixedlub.chain.ranges import declared
from mixedlub.chain.slots import FILM
from mixedlub.chain.slots import VISCOSITY as UNDER_PRESSURE
from mixedlub.ehl.oil.declared import VISCOSITY, Given, OilLaw, Pair
from mixedlub.fit.readings import MADE, Readings
from mixedlub.laws import film, oil
from mixedlub.own_laws import FileLaw, read_law
from mixedlub.schema.units import ENDINGS, ending_of
from profiles.errors import InputError

FORMS = Path(__file__).with_name("forms")
"""Folder of laws that only fits use, a law file each."""
NINE_IN_TEN = 3.29
"""Definition. Width of the middle 90 % of a normal distribution in standard deviations."""
FACTOR = "factor"
FILM_SPREAD, FRICTION_SPREAD = 0.15, 0.25
"""Judgement. Spread of the factor on a law with fixed constants: films differ by the oil's viscosity and coefficient,
friction by the oil's additives and the finish."""
PAIR = (313.15, 373.15)
"""Definition. Temperatures (K) at which oils are graded, 40 and 100 degC."""
RIVAL_SOURCES = {
    "Pan and Hamrock": "P. Pan, B. J. Hamrock, J. Tribol. 111 (1989) 246",
    "Grubin": "A. N. Grubin, Central Scientific Research Institute for Technology and Mechanical Engineering, Moscow, "
    "Book 30 (1949)",
}
"""Regressions of lines that no study offers, with their sources."""
LEAST_COEFFICIENT = 1e-10
"""Judgement. Least pressure-viscosity coefficient (1/Pa) far beyond the temperatures of the readings."""
BETTER = {"1/Pa": "1/GPa", "Pa s": "mPa s", "N/m": "N/mm"}
"""Units of headers in place of SI units."""
OUT_OF_REACH = {
    "condensed": "`mixedlub evaluate regression` fits it",
    "loepenhaus": "`mixedlub evaluate calibration` fits it",
}


@dataclass(frozen=True, eq=False)
class Candidate:
    """A law with free parameters.

    ``reads``: quantities in SI; ``law(state, values)``: values of the law; ``valid``: range of the source; ``house``:
    declaration of the law in this package, and ``constants``: its arguments that are held.
    """

    name: str
    title: str
    equation: str
    source: str
    reads: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    law: Callable[[Mapping[str, np.ndarray], Mapping[str, float]], Any]
    valid: Ranges = field(default_factory=dict)
    house: Law | None = None
    constants: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Unjudged:
    """A law that cannot be judged on a table, the reason, and the number of columns that it lacks."""

    name: str
    reason: str
    lacking: int = 0


def usual_prior(usual: tuple[float, float]) -> Prior:
    """Prior with the middle 90 % in a usual range: of the logarithm for a range above zero.

    >>> round(usual_prior((-0.1, 0.3)).value(-1.645), 4), round(usual_prior((1.0, 4.0)).value(0.0), 9)
    (-0.1, 2.0)
    """
    low, high = usual
    if low > 0.0:
        return LogNormal(float(np.sqrt(low * high)), float(np.log(high / low)) / NINE_IN_TEN)
    return Normal(0.5 * (low + high), (high - low) / NINE_IN_TEN)


def candidates(readings: Readings, own: tuple[Path, ...] = ()) -> tuple[list[Candidate], list[Unjudged]]:
    """Laws of the measured quantity with known inputs, and the other laws with the reason."""
    found, unjudged = [], []
    for one in _of(readings, own):
        if isinstance(one, Unjudged):
            unjudged.append(one)
            continue
        lacking = [name for name in one.reads if readings.get(name) is None]
        if lacking:
            names = ", ".join(map(_column, lacking))
            unjudged.append(Unjudged(one.name, f"needs a column {names}", len(lacking)))
        else:
            found.append(one)
    return found, unjudged


def _column(quantity: str) -> str:
    """Header that gives a quantity, as text."""
    if quantity == "speed":
        return "of a speed"
    if quantity == "hersey_number":
        return "of viscosity, speed or load for a Hersey number"
    unit = BETTER.get(unit := unit_and_factor(quantity)[0].removeprefix("-"), unit)
    return f"{quantity} ({unit})" if unit else quantity


def _of(readings: Readings, own: tuple[Path, ...]) -> Iterator[Candidate | Unjudged]:
    quantity = readings.quantity
    if quantity == "friction":
        yield from map(of_friction, FRICTION_LAWS.all.values())
    if quantity == "film_thickness":
        yield from map(of_film, film_laws().values())
    wanted = "friction" if quantity == "friction_torque" else quantity
    effects = [read_law(path, MADE) for path in sorted(FORMS.glob("*.toml"))]
    forms = [of_file(effect, quantity) for effect in effects if effect.acts_on == (wanted,)]
    if quantity == "contact_viscosity":
        yield from (of_oil(law, readings) for law in VISCOSITY.all.values())
        yield from under_pressure([d341(), *forms], readings)
    else:
        yield from forms
    for path in own:
        effect = read_law(path, MADE)
        assert isinstance(effect.law, FileLaw)
        form, acts_on = effect.law.file.form, effect.law.file.acts_on
        if form != "replace" or acts_on not in (quantity, wanted):
            rule = f'fits take a law with form = "replace" of {quantity}'
            raise InputError(rule, where=str(path), value=f"{form} of {acts_on}")
        yield of_file(effect, quantity)


def of_friction(law: FrictionLaw) -> Candidate | Unjudged:
    """Candidate of a friction law: its coefficients are free, or a factor on it if it has none."""
    if law.name in OUT_OF_REACH:
        return Unjudged(law.name, OUT_OF_REACH[law.name])
    parameters = []
    for one in law.coefficients:
        if one.usual is not None:
            parameters.append(Parameter(one.name, one.unit, usual_prior(one.usual), one.meaning))
        elif one.default is None:
            return Unjudged(law.name, f"no source has a usual range of its coefficient {one.name}")
    scale = [] if parameters else [_factor(FRICTION_SPREAD)]

    def values(state: Mapping[str, np.ndarray], given: Mapping[str, float]) -> Any:
        return given.get(FACTOR, 1.0) * law.law(*(state[name] for name in law.arguments), **law.values(given))

    return Candidate(
        law.name,
        law.title,
        law.equation,
        law.source,
        law.arguments,
        (*parameters, *scale),
        values,
        law.valid,
        law,
    )


def _factor(spread: float) -> Parameter:
    return Parameter(FACTOR, "-", LogNormal(1.0, spread), "measured over the law as published", null=1.0)


@cache
def film_laws() -> Mapping[str, Law]:
    """Film laws by name: the laws of studies, and further laws of lines and points."""
    found = dict(FILM.choices)
    for name in RIVAL_SOURCES:
        word, valid = name.lower().replace(" ", "_"), film.ELASTIC | film.PIEZOVISCOUS
        found[word] = Law(name=word, law=_regression(name), title=f"central film of {name}", valid=valid)
    for law in (film.hamrock_dowson, film.hamrock_dowson_soft, film.nijenbanning):
        title = (law.__doc__ or "").split("\n")[0]
        found[law.__name__] = Law(name=law.__name__, law=law, title=title, valid=declared(law))
    return found


def _regression(name: str) -> Callable[..., Any]:
    """Film of a line contact by a regression of `film.RIVALS`."""

    constant, speed, material, load = film.RIVALS[name]

    def thickness(
        radius: np.ndarray,
        entrainment_speed: np.ndarray,
        line_load: np.ndarray,
        viscosity: np.ndarray,
        pressure_viscosity: np.ndarray,
        reduced_modulus: np.ndarray,
    ) -> np.ndarray:
        size = reduced_modulus * radius
        groups = (viscosity * entrainment_speed / size) ** speed * (line_load / size) ** load
        return np.asarray(constant * radius * (pressure_viscosity * reduced_modulus) ** material * groups)

    thickness.__doc__ = (
        f"Film thickness of a line contact (m).\n\n.. math:: h = {constant:g}\\,R\\,U^{{{speed:.4g}}}"
        f" G^{{{material:.4g}}} W^{{{load:.4g}}}\n\nSource: {RIVAL_SOURCES[name]}."
    )
    return thickness


def of_film(law: Law) -> Candidate:
    """Candidate of a film law with a factor on it."""

    def values(state: Mapping[str, np.ndarray], given: Mapping[str, float]) -> Any:
        return given[FACTOR] * law.law(*(state[name] for name in law.arguments))

    parameters = (_factor(FILM_SPREAD),)
    return Candidate(law.name, law.title, law.equation, law.source, law.arguments, parameters, values, law.valid, law)


def d341() -> Candidate:
    """Candidate of ASTM D341 over temperature, with both known viscosities free."""
    law = Law(name="d341", law=oil.kinematic_viscosity, title="ASTM D341 over temperature")
    parameters = (
        Parameter("at_40C", "mm²/s", usual_prior((5.0, 1000.0)), "kinematic viscosity at 40 °C"),
        Parameter("at_100C", "mm²/s", usual_prior((1.5, 60.0)), "kinematic viscosity at 100 °C"),
    )

    def values(state: Mapping[str, np.ndarray], given: Mapping[str, float]) -> Any:
        known = (given["at_40C"] * 1e-6, given["at_100C"] * 1e-6)
        return state["oil_density"] * oil.kinematic_viscosity(state["oil_temperature"], PAIR, known)

    reads = ("oil_temperature", "oil_density")
    return Candidate("d341", law.title, law.equation, law.source, reads, parameters, values, house=law)


def under_pressure(laws: Sequence[Candidate], readings: Readings) -> Iterator[Candidate]:
    """Candidates over temperature; where pressure changes, each with every law of viscosity under pressure.

    The coefficient is linear in temperature, as in ``[lubricant]``.
    """
    given = {"viscosity", "pressure_viscosity"}
    slot = [of_step(law) for law in UNDER_PRESSURE.choices.values() if given <= set(law.arguments)]
    over_temperature = [one for one in laws if not given & set(one.reads)]
    pressure = readings.get("pressure")
    if pressure is None or np.ptp(pressure) == 0.0:
        yield from over_temperature
        return
    for thinned in over_temperature:
        for thickened in (*slot, *(one for one in laws if given <= set(one.reads))):
            yield _together(thinned, thickened)


def of_step(law: Law) -> Candidate:
    """Candidate of a law of viscosity under pressure, without free parameters."""

    def values(state: Mapping[str, np.ndarray], given: Mapping[str, float]) -> Any:
        return law.law(*(state[name] for name in law.arguments))

    return Candidate(law.name, law.title, law.equation, law.source, law.arguments, (), values, law.valid, law)


def _together(thinned: Candidate, thickened: Candidate) -> Candidate:
    """A law over temperature with a law under pressure."""
    made = {"viscosity", "pressure_viscosity", "hertz_pressure", "pressure"}
    coefficients = tuple(
        Parameter(
            f"alpha_at_{celsius:g}C", "1/GPa", usual_prior(usual), f"pressure-viscosity coefficient at {celsius:g} °C"
        )
        for celsius, usual in ((40.0, (10.0, 35.0)), (100.0, (7.0, 25.0)))
    )

    def values(state: Mapping[str, np.ndarray], given: Mapping[str, float]) -> Any:
        place = (state["oil_temperature"] - PAIR[0]) / (PAIR[1] - PAIR[0])
        first, second = (given[c.name] * 1e-9 for c in coefficients)
        known = {
            **state,
            "viscosity": thinned.law(state, given),
            "pressure_viscosity": np.maximum(first + place * (second - first), LEAST_COEFFICIENT),
            "hertz_pressure": state["pressure"],
        }
        return thickened.law(known, given)

    return Candidate(
        f"{thinned.name}_{thickened.name}",
        f"{thinned.title}; under pressure: {thickened.title}",
        rf"{thinned.equation};\quad {thickened.equation}",
        f"{thinned.source}; {thickened.source}",
        tuple(dict.fromkeys((*thinned.reads, "oil_temperature", "pressure", *set(thickened.reads) - made))),
        (*thinned.parameters, *coefficients, *thickened.parameters),
        values,
        house=thickened.house,
    )


def of_oil(law: OilLaw, readings: Readings) -> Candidate | Unjudged:
    """Candidate of a viscosity law of the solver: its constants are free, at the middle temperature of the readings."""
    if "volume" in law.arguments:
        return Unjudged(law.name, "its volume under pressure is another measurement")
    kelvin = readings.get("oil_temperature")
    middle = 0.0 if kelvin is None else float(np.round(0.5 * (kelvin.min() + kelvin.max()) - oil.ZERO_CELSIUS))
    held = {g.key: ((40.0, 100.0) if g.type is Pair else middle) for g in law.keys if g.usual is None}
    parameters = tuple(
        Parameter(_name(given, place), _unit(given.key), usual_prior(usual), given.meaning)
        for given in law.keys
        if given.usual is not None
        for place, usual in enumerate(_ranges(given))
    )
    quantities = {"pressure": "pressure", "temperature": "oil_temperature", "density": "oil_density"}
    reads = tuple(quantities[name] for name in law.arguments)

    def values(state: Mapping[str, np.ndarray], given: Mapping[str, float]) -> Any:
        numbers = law.si(_Section(law, held, given))
        return np.exp(np.minimum(law.law(*(state[name] for name in reads), **numbers)[0], oil.LARGEST_LOG))

    title = law.title if law.name != "barus" else "exponential in pressure (Barus) and in temperature (Reynolds)"
    return Candidate(law.name, title, law.equation, law.source, reads, parameters, values, house=law, constants=held)


def _ranges(given: Given) -> tuple[tuple[float, float], ...]:
    usual: Any = given.usual
    return usual if isinstance(usual[0], tuple) else (usual,)


def _name(given: Given, place: int) -> str:
    return f"{given.key}_{place + 1}" if given.type is Pair else given.key


def _unit(key: str) -> str:
    return ENDINGS.get(ending_of(key), "") or "-"


class _Section:
    """Keys of a law with the values of a fit."""

    def __init__(self, law: OilLaw, held: Mapping[str, Any], given: Mapping[str, float]) -> None:
        for one in law.keys:
            names = [_name(one, place) for place in range(2 if one.type is Pair else 1)]
            value: Any = held[one.key] if one.key in held else tuple(given[name] for name in names)
            setattr(self, one.key, value[0] if isinstance(value, tuple) and len(value) == 1 else value)


def of_file(effect: Effect, quantity: str) -> Candidate:
    """Candidate of a law file with its parameters and priors."""
    law = effect.law
    assert isinstance(law, FileLaw)
    reads = tuple(name for name in law.arguments if name != effect.acts_on[0])

    def values(state: Mapping[str, np.ndarray], given: Mapping[str, float]) -> Any:
        return law.expression_at(state, given)

    parameters = effect.parameters
    if quantity == "friction_torque":
        parameters = tuple(_of_torque(p) for p in parameters)
    return Candidate(
        effect.name,
        law.file.description.rstrip("."),
        effect.equation,
        effect.source,
        reads,
        parameters,
        values,
        effect.valid,
        effect,
    )


def _of_torque(p: Parameter) -> Parameter:
    """Parameter of a friction law in the units of torque and angular speed."""
    units = {"m/s": "rad/s", "s/m": "N m s/rad"}
    unit = "N m" if p.unit == "-" and p.meaning.startswith("friction") else units.get(p.unit, p.unit)
    return Parameter(p.name, unit, p.prior, p.meaning, nominal=p.nominal)
