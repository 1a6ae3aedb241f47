"""A study file from the form of the page, and a result for it: ranking and map."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mixedlub.app.reading import refuse_foreign_files
from mixedlub.importers.dialogue import value_of
from mixedlub.schema.gear_file import gear_names, shipped_gears
from mixedlub.schema.oil_file import STOCKS, oil_names, shipped_oil
from mixedlub.schema.section import Key, table
from mixedlub.schema.toml_file import parse, to_toml, toml_value
from mixedlub.study.costs import check_costs
from mixedlub.study.plan import pairings_of
from mixedlub.study.schema import StudyFile
from profiles.errors import InputError

GEARS = ("teeth", "normal_module_mm", "face_width_mm", "pressure_angle_deg", "helix_angle_deg", "profile_shift")
OIL = ("temperature_C", "kinematic_viscosity_mm2_s")
CONDITIONS = ("torque_Nm", "speed_rpm", "oil_temperature_C")
OPTIONS = ("friction", "bands")
UNCERTAIN = ("boundary_friction", "viscosity", "pressure_viscosity", "eyring_stress")
CUTOFFS = ("cutoff_mm", "short_cutoff_um")
PLACES = ("both", "pinion", "gear", "neither")
"""Wheels that a surface may have."""
SHIPPED = ("0036", "0122", "0219", "0258", "0302", "0450")
START = {
    "title": "Pairings",
    "preset": "pairings_17_26",
    "oil": "atf",
    "conditions.torque_Nm": "50, 100, 150",
    "conditions.speed_rpm": "500 to 3000 in 6",
    "conditions.oil_temperature_C": "60",
    "surfaces.cutoff_mm": "0.8",
    "surfaces.short_cutoff_um": "2.5",
    "options.bands": "traces",
    "place.shipped:0036": "both",
    "place.shipped:0258": "both",
    "place.shipped:0450": "both",
}
"""Answers of a new form: the shipped study with three of its surfaces."""
SERIES = re.compile(r"\s*(\S+)\s+to\s+(\S+)\s+in\s+(\d+)\s*(?:steps?)?\s*")
Texts = Mapping[str, str]


def inputs() -> dict[str, list[dict[str, Any]]]:
    """Inputs of the form by section: key, text, example and choices, as the study file describes them."""
    sections = {"gears": GEARS, "lubricant": OIL, "surfaces": CUTOFFS, "conditions": CONDITIONS, "options": OPTIONS}
    sections["uncertainty"] = UNCERTAIN
    found = {
        section: [_input(section, table(StudyFile, section)[name]) for name in names]
        for section, names in sections.items()
    }
    found[""] = [_input("", table(StudyFile, "")["boundary_friction"])]
    return found


def _input(section: str, key: Key) -> dict[str, Any]:
    example = "" if key.example is None or isinstance(key.example, dict) else toml_value(key.example)
    words = key.words.partition(";")[0]
    return {
        "key": f"{section}.{key.name}".lstrip("."),
        "text": words[:1].upper() + words[1:],
        "example": example.strip("[]"),
        "choices": dict(key.values),
        "default": key.field.default if isinstance(key.field.default, str) else "",
    }


def presets() -> dict[str, str]:
    """Shipped gear pairs: name of the file and words."""
    return {name: shipped_gears(name).name for name in gear_names()}


def oils() -> dict[str, str]:
    """Shipped oils, and base stocks with their typical values."""
    stocks = {f"base:{name}": f"typical {words}" for name, words in STOCKS.items()}
    return {name: shipped_oil(name).name for name in oil_names()} | stocks


def kind_of_surface(file: Path) -> str:
    """Key of a surface for a file: ``profile`` of a trace, ``map`` of a height map; an error for any other file."""
    from profiles import Profile
    from profiles.maps import read_any

    return "profile" if isinstance(read_any(file), Profile) else "map"


def study_of(texts: Texts, files: Mapping[str, str]) -> dict[str, Any]:
    """Study file of a form; ``files``: files that were sent, each with its key of a surface."""
    gears = {"preset": texts["preset"]} if texts.get("preset") else {}
    oil = texts.get("oil", "")
    stock = oil.removeprefix("base:")
    lubricant: dict[str, Any] = {} if not oil else {"base": stock} if stock != oil else {"oil": oil}
    surfaces, pinion, gear, costs = _surfaces(texts, files)
    return {
        "schema": "mixedlub-study/1",
        "title": texts.get("title") or "Pairings",
        **_given(texts, "", ("boundary_friction",)),
        "gears": gears | _given(texts, "gears", GEARS),
        "lubricant": lubricant | _given(texts, "lubricant", OIL),
        "surfaces": surfaces,
        "pairings": {"every": pinion} if pinion == gear else {"pinion": pinion, "gear": gear},
        "conditions": {name: _levels(texts.get(f"conditions.{name}", ""), name) for name in CONDITIONS},
        "options": _given(texts, "options", OPTIONS),
        "uncertainty": _given(texts, "uncertainty", UNCERTAIN),
        "costs": costs,
    }


def study_text(study: Mapping[str, Any]) -> str:
    """Study as the text of a file; an error for a wrong key or value."""
    refuse_foreign_files({name: value for name, value in study.items() if name not in ("title", "description")})
    file = parse(StudyFile, study, "study")
    check_costs(file.costs, dict.fromkeys(name for both in pairings_of(file.pairings, file.surfaces) for name in both))
    return to_toml(study)


def _surfaces(texts: Texts, files: Mapping[str, str]) -> tuple[dict[str, Any], list[str], list[str], dict[str, Any]]:
    """Surfaces by name, the names of the pinion's and the gear's, and costs by name."""
    filters = _given(texts, "surfaces", CUTOFFS)
    every = {f"shipped:{name}": ("profile", f"shipped:{name}") for name in SHIPPED}
    every |= {name: (key, f"uploads/{name}") for name, key in files.items()}
    found: dict[str, Any] = {}
    costs: dict[str, Any] = {}
    wheels: dict[str, list[str]] = {"pinion": [], "gear": []}
    for name, (key, path) in every.items():
        place = texts.get(f"place.{name}", "neither")
        if place not in PLACES[:3]:
            continue
        known = name.removeprefix("shipped:").rpartition(".")[0] or name.removeprefix("shipped:")
        known = known if known not in found else name
        found[known] = {key: path, **filters}
        if cost := texts.get(f"cost.{name}", "").strip():
            costs[known] = value_of(cost)
        for wheel, names in wheels.items():
            if place in ("both", wheel):
                names.append(known)
    for wheel, names in wheels.items():
        if not names:
            raise InputError("choose at least one surface, or send a trace", where=f"surfaces of the {wheel}")
    return found, wheels["pinion"], wheels["gear"], costs


def _given(texts: Texts, section: str, names: Sequence[str]) -> dict[str, Any]:
    """Values of the inputs that are filled in."""
    keys = {name: table(StudyFile, section)[name] for name in names}
    filled = {name: texts.get(f"{section}.{name}".lstrip("."), "").strip() for name in names}
    return {
        name: value_of(text, toml_value(keys[name].example) if isinstance(keys[name].example, list | tuple) else "")
        for name, text in filled.items()
        if text
    }


def _levels(text: str, name: str) -> Any:
    """Levels of a condition.

    >>> _levels("50, 100", "torque_Nm"), _levels("500 to 3000 in 6", "speed_rpm"), _levels("60", "speed_rpm")
    ([50, 100], {'from': 500, 'to': 3000, 'count': 6}, [60])
    """
    series = SERIES.fullmatch(text)
    if series:
        low, high = (value_of(end) for end in series.groups()[:2])
        return {"from": low, "to": high, "count": int(series[3])}
    parts = [part for part in re.split(r"[,;\s]+", text.strip().strip("[]")) if part]
    if not parts:
        raise InputError("needs levels, as 50, 100, 150 or 500 to 3000 in 6", where=name)
    return [value_of(part) for part in parts]


def ranked(result: Path) -> dict[str, Any]:
    """Ranking of a result and its map as SVG."""
    import pandas as pd

    from mixedlub.report.ranking import ranking_map
    from mixedlub.report.style import as_svg

    found = pd.read_parquet(result / "ranking.parquet")
    return {"rows": found.to_dict("records"), "map": as_svg(ranking_map(found))}
