"""Tables of the oils and gears that come with the package: numbers, status and source."""

from __future__ import annotations

from typing import Any

import markdown_tables as md


def oils() -> str:
    """Every oil that comes with the package: its numbers with unit, status and source."""
    from mixedlub.schema.oil_file import oil_names, shipped_oil

    parts = []
    for name in oil_names():
        oil = shipped_oil(name)
        parts += [f"## {name}", f"{oil.name}, base stock `{oil.base}`. {oil.about}".rstrip()]
        rows = [(key, _numbers(one.value), one.status, one.source) for key, one in oil.properties.items()]
        parts.append(md.named_table(("key", "value", "status", "source"), rows))
        if oil.further:
            further = [
                (
                    key,
                    f"{one.equation}; {', '.join(f'{n} = {v:g}' for n, v in one.values.items())}",
                    one.status,
                    one.source,
                )
                for key, one in oil.further.items()
            ]
            parts += ["Further laws:", md.named_table(("law", "equation and numbers", "status", "source"), further)]
    return "\n\n".join(parts)


def oils_known() -> str:
    """Temperatures and pressures at which each oil is known, and its laws."""
    from mixedlub.schema.oil_file import oil_names, shipped_oil

    rows = []
    for name in oil_names():
        oil = shipped_oil(name)
        known = oil.properties
        viscosity, alpha = known["kinematic_viscosity_mm2_s"], known["pressure_viscosity_per_GPa"]
        at = _numbers(known["temperature_C"].value)
        coefficient = at if alpha.temperature_C is None else f"{alpha.temperature_C:g}"
        law = "modulus equation, Roelands" if "pressure_modulus_MPa" in known else "Roelands"
        stress = known.get("eyring_stress_MPa")
        shear = "typical" if stress is None else f"{_numbers(stress.value)} MPa, {stress.status}"
        limit = oil.further.get("limiting_stress")
        limited = "not known" if limit is None else f"{limit.values['Lambda']:g} p, not used"
        rows.append((name, f"{at} °C, {viscosity.status}", f"{coefficient} °C, {alpha.status}", law, shear, limited))
    head = ("oil", "viscosity", "coefficient under pressure", "law under pressure", "Eyring stress", "limiting stress")
    return md.named_table(head, rows)


def presets() -> str:
    """Every gear pair that comes with the package: its numbers with status and source."""
    from mixedlub.schema.gear_file import gear_names, shipped_gears

    parts = []
    for name in gear_names():
        gears = shipped_gears(name)
        parts += [f"## {name}", f"{gears.name}. {gears.about} Source: {gears.source}."]
        rows = [(key, _numbers(one.value), one.status, one.note) for key, one in gears.properties.items()]
        parts.append(md.named_table(("key", "value", "status", "note"), rows))
    return "\n\n".join(parts)


def _numbers(value: Any) -> str:
    return ", ".join(f"{x:g}" for x in (value if isinstance(value, tuple) else (value,)))
