"""What a law of a machine part is: one published formula for the drag of a bearing, a seal or a wheel."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from mixedlub.chain.documented import Coefficient, Documented
from mixedlub.chain.plain_text import plain_equation
from profiles.errors import nearest

Kind = Literal["bearing", "seal", "windage", "churning", "pocketing", "jet", "other"]
GIVES: dict[Kind, str] = {
    "bearing": "torque (N m)",
    "seal": "torque (N m)",
    "windage": "power (W)",
    "churning": "power (W)",
    "pocketing": "power (W)",
    "jet": "power (W)",
    "other": "torque (N m)",
}
"""Kinds of parts, each with what its laws give."""
COMPUTED = {
    "shaft_speed": "angular speed of the shaft (rad/s)",
    "viscosity": "viscosity of the oil at its temperature (Pa s)",
    "oil_density": "density of the oil at its temperature (kg/m³)",
    "radial_load": "radial load of the bearing (N)",
    "axial_load": "axial load of the bearing (N)",
    "wheel_radius": "radius of the operating pitch circle (m)",
    "face_width": "common face width (m)",
    "gear_module": "normal module (m)",
    "wheel_teeth": "number of teeth (-)",
    "helix_angle": "helix angle (rad)",
    "root_diameter": "root diameter by the dedendum of the gears (m)",
    "tip_diameter": "tip diameter (m)",
}
"""Quantities that follow from gears, oil and condition, each with its meaning."""
GIVEN = {
    "bore_diameter": ("bore_mm", 1e-3),
    "outside_diameter": ("outside_diameter_mm", 1e-3),
    "static_rating": ("static_rating_N", 1.0),
    "seal_diameter": ("diameter_mm", 1e-3),
    "wall_clearance": ("wall_clearance_mm", 1e-3),
    "immersion": ("immersion_mm", 1e-3),
    "oil_volume": ("oil_volume_l", 1e-3),
    "exit_area": ("exit_area_mm2", 1e-6),
    "oil_flow": ("oil_flow_l_min", 1e-3 / 60.0),
    "jet_speed": ("jet_speed_m_s", 1.0),
}
"""Quantities that the user gives: the key of the file, and the factor from its unit to SI."""


@dataclass(frozen=True, repr=False)
class PartLaw(Documented):
    """A law of a part: the function, its kind, and what is known of its constants.

    ``sources`` counts independent sources that print the constants, 0 where they are quoted from memory of reviews;
    ``series`` has the coefficients of series of bearings by name.
    """

    name: str
    kind: Kind
    law: Callable[..., Any]
    title: str
    sources: int
    status: str
    coefficients: tuple[Coefficient, ...] = ()
    series: str = ""

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of the file that it needs."""
        return tuple(GIVEN[name][0] for name in self.reads if name in GIVEN)

    def page(self) -> str:
        """Equation, inputs, status, coefficients and source, as text of 80 columns."""
        parts = {
            "kind": f"{self.kind}; gives its {GIVES[self.kind]}",
            "equation": plain_equation(self.equation),
            "": self.remarks,
            "reads": ", ".join(name for name in self.reads if name in COMPUTED) or "nothing",
            "keys": ", ".join(self.keys) or "none of its own",
            "status": self.status,
            "source": self.source,
        }
        return self._page(parts)

    __repr__ = page


REGISTRY: dict[tuple[Kind, str], PartLaw] = {}
"""Laws by kind and name, as their modules were imported; `mixedlub.parts.catalogue` imports them all."""


def part_law(
    kind: Kind,
    name: str,
    title: str,
    *,
    sources: int,
    status: str,
    coefficients: tuple[Coefficient, ...] = (),
    series: str = "",
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Register the function below as a law of a kind of parts.

    Its arguments are quantities of `COMPUTED` and `GIVEN`, its keyword-only arguments the coefficients; its docstring
    has the equation and names the source. ``series`` names the table of the coefficients of series.
    """

    def register(law: Callable[..., Any]) -> Callable[..., Any]:
        found = PartLaw(name, kind, law, title, sources, status, coefficients, series)
        _check(found)
        REGISTRY[kind, name] = found
        return law

    return register


def _check(found: PartLaw) -> None:
    where = f"{found.kind} law {found.name!r}"
    known = REGISTRY.get((found.kind, found.name))
    if known is not None and known.law.__module__ != found.law.__module__:
        raise TypeError(f"{where} is already defined in {known.law.__module__}")
    for name in found.reads:
        if name not in COMPUTED and name not in GIVEN:
            raise TypeError(f"{where}: {name!r} is no quantity; {nearest(name, {**COMPUTED, **GIVEN})}")
    keywords = {n for n, a in inspect.signature(found.law).parameters.items() if a.kind is a.KEYWORD_ONLY}
    if keywords != {c.name for c in found.coefficients}:
        raise TypeError(f"{where}: its coefficients are not its keyword-only arguments")
    if not found.source:
        raise TypeError(f"{where}: its docstring names no 'Source: '")
