"""The chain with film and film friction of full solutions in place of the formulas."""

from __future__ import annotations

import inspect
from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from operator import is_
from typing import Any

import numpy as np

from mixedlub.chain.model import Chain, Law
from mixedlub.full_base.emulator import FILM_GOAL, FRICTION_GOAL, INPUTS, Emulator
from mixedlub.full_base.gaussian_process import Process
from mixedlub.full_base.solutions import Bodies, Matter
from mixedlub.full_base.words import CONTAINED, FULL, WORDS
from mixedlub.laws import film, shear
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema import system_file
from mixedlub.schema.findings import collected, finding, report
from profiles.errors import InputError

CLOSE = 1e-4
"""Judgement. Move of a feature, of its range from -1 to 1, up to which a ratio follows its slopes: the relative error
is then about 1e-8."""
REACH = 60.0
"""Judgement. Distance (K) from the two viscosities of an oil up to which full solutions are computed, as of
`viscosity_extrapolated` the range in which numbers count."""


class Places:
    """Places of contacts in the emulator, kept for the last two states: both ratios ask for the same.

    A state is known by its arrays, which must not be written in place.
    """

    def __init__(self, emulator: Emulator) -> None:
        self.emulator = emulator
        self._kept: deque[tuple[Sequence[Any], np.ndarray]] = deque(maxlen=2)

    def __call__(self, state: Sequence[Any]) -> np.ndarray:
        """Places at values of `INPUTS`."""
        for known, found in tuple(self._kept):
            if all(map(is_, known, state)):
                return found
        found = self.emulator.places(dict(zip(INPUTS, state, strict=True)))
        self._kept.append((state, found))
        return found

    def __reduce__(self) -> tuple[type[Places], tuple[Emulator]]:
        """Sent to another process without the states."""
        return Places, (self.emulator,)


class Ratio:
    """A ratio of full solutions and formulas, as a law of the chain with the range of its emulator."""

    def __init__(self, places: Places, quantity: str, name: str) -> None:
        self.emulator, self.places, self.quantity, self.__name__ = places.emulator, places, quantity, name
        kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
        arguments = (*INPUTS, f"{quantity}_ratio_factor")
        self.__signature__ = inspect.Signature([inspect.Parameter(n, kind) for n in arguments])
        self.__doc__ = WORDS
        self._expanded: dict[str, Any] = {"result": None}

    @property
    def valid(self) -> Mapping[str, tuple[float, float]]:
        """Range of the emulator."""
        return self.emulator.valid

    def __call__(self, *values: Any) -> np.ndarray:
        return np.asarray(values[-1] * self.emulator.ratios(self._process, self.places(values[:-1])))

    def near(self, values: Sequence[Any], others: Sequence[Any], result: np.ndarray) -> np.ndarray:
        """Ratio at values close to others with a known result, by the slopes there; else as for any values."""
        here = self._expanded
        if here["result"] is not result:
            here = self._expanded = {"result": result, "places": self.places(others[:-1])}
        moved = self.places(values[:-1]) - here["places"]
        if not (np.max(np.abs(moved), initial=0.0) <= CLOSE and np.all(others[-1])):
            return self(*values)
        if "slopes" not in here:
            here["slopes"] = self.emulator.slopes(self._process, here["places"])
        return np.asarray(values[-1] / others[-1] * result * np.exp(np.sum(moved * here["slopes"], axis=-1)))

    def __reduce__(self) -> tuple[type[Ratio], tuple[Places, str, str]]:
        """Sent to another process without the last expansion."""
        return Ratio, (self.places, self.quantity, self.__name__)

    @property
    def _process(self) -> Process:
        process: Process = getattr(self.emulator, self.quantity)
        return process


def solved_film(
    film_ratio: np.ndarray,
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Central film of a full solution (m), :math:`h = r_h\,h_{DT}`, with the film of Dowson and Toyoda.

    Source: the solver of this package; the ratio is an emulator of its solutions.
    """
    given = (radius, entrainment_speed, line_load, viscosity, pressure_viscosity, reduced_modulus)
    return film_ratio * film.dowson_toyoda(*given)


def solved_stress(
    stress_ratio: np.ndarray,
    contact_viscosity: np.ndarray,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    eyring_stress: np.ndarray,
) -> np.ndarray:
    r"""Shear stress of a full solution (Pa), :math:`\tau = r_\tau\,\tau_0\operatorname{asinh}(\eta v_s/(h\tau_0))`.

    Friction times the largest Hertz pressure. Source: the solver of this package; the ratio is an emulator of its
    solutions.
    """
    return stress_ratio * shear.ree_eyring(contact_viscosity, sliding_speed, film_thickness, eyring_stress)


def with_full_base(chain: Chain, emulator: Emulator) -> Chain:
    """Chain of a line contact with film and shear stress of full solutions.

    Ratios multiply film law and shear law, so that effects on film, viscosity under pressure or Eyring stress act as on
    the formulas. The first film of a chain is replaced: a balance of the load thins it afterwards.
    """
    places = Places(emulator)
    ratios = {name: Ratio(places, name, FULL) for name in ("film", "stress")}
    found: list[tuple[str, Law]] = []
    for name, law in chain:
        if name == "film_thickness" and "film_ratio" not in dict(found):
            found += [("film_ratio", ratios["film"]), (name, solved_film)]
        elif name == "shear_stress":
            found += [("stress_ratio", ratios["stress"]), (name, solved_stress)]
        else:
            found.append((name, law))
    return tuple(found)


def refuse_contained(effects: Collection[str]) -> None:
    """Raise an error for an effect that full solutions contain."""
    for name in effects:
        if name in CONTAINED:
            rule = f'is part of base = "{FULL}", or of the formulas that it replaces; leave one of them out'
            raise InputError(rule, where=f"effects.{name}")


NEEDED = {
    "kinematic_viscosity_mm2_s": "viscosity at two temperatures",
    "eyring_stress_MPa": "Eyring stress",
    "pressure_viscosity_per_GPa": "pressure-viscosity coefficient",
}
"""Keys that an oil must have for solutions."""
THERMAL = ("density_15C_kg_m3", "thermal_conductivity_W_mK", "specific_heat_J_kgK")
"""Keys of an oil that may be typical of a stated base stock."""


def refuse_oil(section: system_file.Lubricant | None, oil: Callable[[], Lubricant], hottest: Sequence[float]) -> None:
    """Raise an error for a missing oil, an oil without the data of the solver, or temperatures beyond the oil."""
    if section is None:
        raise InputError(f'base = "{FULL}" needs an oil', where="lubricant")
    known = section.model_dump(exclude_none=True)
    lacking = [name for name in NEEDED if name not in known and not _otherwise(name, known)]
    lacking += [] if section.base else [name for name in THERMAL if name not in known]
    if lacking:
        keys = ", ".join(lacking)
        raise InputError(f'base = "{FULL}" needs {keys} of the oil, which nothing typical replaces', where="lubricant")
    with collected():
        of = oil()
    low, high = sorted(of.temperature)
    for kelvin in hottest:
        if not low - REACH <= kelvin <= high + REACH:
            ends = " to ".join(f"{t - ZERO_CELSIUS:g}" for t in (low - REACH, high + REACH))
            rule = f"°C: must be from {ends} °C, within {REACH:g} K of the viscosities of the oil, for full solutions"
            raise InputError(rule, where="oil_temperature_C", value=round(kelvin - ZERO_CELSIUS, 6))


def _otherwise(name: str, known: Mapping[str, Any]) -> bool:
    """Whether another key gives the pressure-viscosity coefficient."""
    return name == "pressure_viscosity_per_GPa" and "known_pressure_viscosity" in known


def matter_of(oil: Lubricant, inputs: Mapping[str, Any]) -> Matter:
    """Oil and bodies of a chain's inputs; bodies of several materials raise an error."""
    values = []
    for name in ("reduced_modulus", "solid_conductivity", "solid_density", "solid_heat_capacity"):
        own = np.unique(np.asarray(inputs[name], dtype=float))
        if np.ptp(own) > 1e-9 * own[0]:
            rule = f'base = "{FULL}" needs surfaces of one material; {name} is {own[0]:.6g} to {own[-1]:.6g}'
            raise InputError(rule, where="surfaces")
        values.append(float(own[0]))
    return Matter(oil, Bodies(*values))


def noted(emulator: Emulator, built: bool) -> None:
    """Report the emulator with its errors, and errors above the goals."""
    errors = emulator.errors
    how = "built for this range" if built else "reused"
    report(finding("full_base", f"emulator of full solutions, {how}: {errors}", "base"))
    if errors.unsolved:
        text = f"{errors.unsolved} of {errors.unsolved + errors.count} contacts of the range have no full solution"
        report(finding("full_base_unsolved", text, "base"))
    if not errors.meets_goal:
        goals = f"{100 * FILM_GOAL:g} % in film and {100 * FRICTION_GOAL:g} % in friction"
        report(finding("full_base_inexact", f"the errors exceed {goals} in more than 5 of 100 contacts", "base"))
