"""Headers of a table: quantity and unit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mixedlub.chain.quantities import GLOSSARY, unit_and_factor
from mixedlub.importers.vocabulary import target_of
from mixedlub.schema.units import ENDINGS, dimension, ending_of, split, tidy, to_si, unit_of, without_unit, words_of
from profiles.errors import InputError

OTHER_NAMES: Mapping[str, str] = {
    "temperature": "oil_temperature",
    "speed": "drive_speed",
    "friction_coefficient": "friction",
    "specific_load": "mean_pressure",
    "projected_pressure": "mean_pressure",
    "bearing_pressure": "mean_pressure",
    "density": "oil_density",
}
"""Words of headers, and their quantities."""


@dataclass(frozen=True)
class Meaning:
    """Quantity of a header, and its conversion to SI."""

    quantity: str
    factor: float = 1.0
    added: float = 0.0


def meaning(header: str, where: str) -> Meaning | None:
    """Quantity and unit of a header; None if unknown; raise an error for a missing or wrong unit.

    >>> meaning("Load (kN)", ""), meaning("mean_roughness_um", "").quantity, meaning("colour", "")
    (Meaning(quantity='load', factor=1000.0, added=0.0), 'mean_roughness', None)
    """
    target = target_of(header)
    named = header.strip()
    words, unit = (without_unit(named), ENDINGS.get(ending_of(named), "")) if ending_of(named) else split(header)
    if target is not None:
        words = without_unit(target.name)
        unit = unit or (unit_of(target.name) if named == target.name else "")
    words = words_of(words).replace(" ", "_")
    name = OTHER_NAMES.get(words, words)
    if name == "viscosity" and unit and dimension_of(unit) == dimension("m^2/s"):
        name = "kinematic_viscosity"
    if name not in GLOSSARY:
        return None
    wanted = GLOSSARY[name].unit
    if not unit:
        if dimension(wanted) == dimension("-"):
            return Meaning(name)
        shown = unit_and_factor(name)[0]
        raise InputError(f"has no unit; write it in the header, as {name} ({shown})", where=where, value=header)
    if dimension_of(unit) != GLOSSARY[name].dimension:
        if name == "drive_speed" and dimension_of(unit) == dimension("m/s"):
            return Meaning("sliding_speed", *to_si(unit))
        rule = f"{unit} is no unit of {name.replace('_', ' ')}; one is {unit_and_factor(name)[0]}"
        raise InputError(rule, where=where, value=header)
    return Meaning(name, *to_si(unit))


def dimension_of(unit: str) -> tuple[int, int, int, int] | None:
    """Dimension of a written unit; None if unknown.

    >>> dimension_of("kN") == dimension_of("N"), dimension_of("furlong")
    (True, None)
    """
    try:
        return dimension(tidy(unit))
    except (KeyError, AttributeError):
        pass
    try:
        to_si(unit)
    except KeyError:
        return None
    ending = next((one for one, shown in ENDINGS.items() if shown == unit), "")
    return dimension(tidy(ENDINGS[ending])) if ending else dimension("-")
