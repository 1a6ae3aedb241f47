"""Steps of the gear chain with a choice of laws, and the laws offered for each.

A law is offered in its file, so that one file adds a law: the pure function, decorated by the slot with the name used
in study files and the meaning of the choice. Other packages name such a module as an entry point of the group
``mixedlub.laws``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

from mixedlub.chain.law import Catalogue, Function, Law
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.chain.ranges import holds_within


@dataclass(frozen=True, eq=False)
class Slot:
    """A step of the chain: option that chooses its law, quantity returned, and law of the base model.

    The arguments of a law are quantities of the glossary; its docstring names the source.
    """

    option: str
    quantity: str
    meaning: str
    default: str

    @cached_property
    def laws(self) -> Catalogue[Law]:
        """Laws by name in a study file, base model first."""
        return Catalogue("mixedlub.laws", f"{self.option} =", GLOSSARY, lambda law: law.name != self.default)

    def offers(
        self, name: str, meaning: str, valid: Mapping[str, tuple[float, float]] | None = None
    ) -> Callable[[Function], Function]:
        """Offer the law below under a name, with the meaning of the choice and the valid range."""
        declares = self.laws.declares(lambda law: Law(name=name, law=law, title=meaning, valid=valid or {}))
        return lambda law: holds_within(valid or {})(declares(law))

    @property
    def choices(self) -> Mapping[str, Law]:
        """Laws by name, base model first."""
        return self.laws.all


FILM = Slot("film", "film_thickness", "law of the film thickness", "dowson_toyoda_central")
ASPERITY_AREA = Slot("asperities", "area_ratio", "law of the asperities", "greenwood_williamson")
ASPERITY_LOAD = Slot("asperities", "asperity_pressure", "law of the asperities", "greenwood_williamson")
VISCOSITY = Slot("viscosity_law", "contact_viscosity", "law of the viscosity under pressure", "roelands")
SHEAR = Slot("effective_viscosity", "shear_stress", "how the film thins under shear", "asinh")
FILM_FRICTION = Slot("contact_pressure", "fluid_friction", "pressure that the shear stress is divided by", "maximum")
MIXTURE = Slot("mixture", "friction", "friction of film and asperities together", "tallian")
SLIDING_POWER = Slot(
    "averaging", "sliding_power", "how the power loss is averaged over the path of contact", "mesh_integral"
)
SLOTS = (FILM, ASPERITY_AREA, ASPERITY_LOAD, VISCOSITY, SHEAR, FILM_FRICTION, MIXTURE, SLIDING_POWER)
"""Slots in the order of the chain. Slots of the same option take laws of the same name."""

STEPS: Mapping[str, tuple[str, ...]] = {
    "contact of the asperities": ("asperities", "heights"),
    "film thickness": ("film", "film_roughness", "balance"),
    "friction of film and asperities together": ("mixture", "friction"),
    "load of film and asperities": ("balance", "film", "film_roughness", "asperities", "heights", "friction"),
    "load sharing of the teeth": ("averaging",),
    "shear of the film": ("effective_viscosity",),
    "stress at the largest pressure": ("effective_viscosity", "viscosity_pressure", "contact_pressure"),
    "viscosity over temperature": (),
    "viscosity under pressure": ("viscosity_law", "viscosity_pressure"),
}
"""Steps that an effect may replace, each with the options that choose its law or a law containing it."""
