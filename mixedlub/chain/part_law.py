"""Laws of machine parts: published formulas for the drag of a bearing, a seal or a wheel."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from mixedlub.chain.law import Catalogue, Function, Law
from mixedlub.chain.plain_text import plain_equation

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
"""Result of the laws of each kind of part."""
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
"""Quantities computed from gears, oil and condition, with their meaning."""
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
"""Quantities given by the user: key in the file, and factor to SI."""


@dataclass(frozen=True, repr=False, kw_only=True)
class PartLaw(Law):
    """A law of a machine part; ``series``: name of its table of coefficients of bearing series."""

    kind: Kind
    series: str = ""

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of the file needed by the law."""
        return tuple(GIVEN[name][0] for name in self.reads if name in GIVEN)

    def facts(self) -> Mapping[str, str]:
        """Lines of the page by their headings."""
        return {
            "kind": f"{self.kind}; gives its {GIVES[self.kind]}",
            "equation": plain_equation(self.equation),
            "": self.remarks,
            "reads": ", ".join(name for name in self.reads if name in COMPUTED) or "nothing",
            "keys": ", ".join(self.keys) or "none of its own",
            "status": self.status,
            "source": self.source,
        }


PART_LAWS: dict[Kind, Catalogue[PartLaw]] = {
    kind: Catalogue("mixedlub.parts", f"{kind} law", {*COMPUTED, *GIVEN}) for kind in GIVES
}
"""Laws of parts by kind."""


def part_law(kind: Kind, name: str, title: str, **known: Any) -> Callable[[Function], Function]:
    """Register the function below as a law of a kind of part.

    Its arguments are quantities of `COMPUTED` and `GIVEN`, its keyword-only arguments the coefficients; its docstring
    contains the equation and the source. ``known``: fields of `PartLaw`.
    """
    return PART_LAWS[kind].declares(lambda law: PartLaw(name=name, kind=kind, law=law, title=title, **known))
