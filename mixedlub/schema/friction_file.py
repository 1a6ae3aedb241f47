"""File of a fitted friction law: name, source of the fit, error and coefficients."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from pydantic import ValidationInfo

from mixedlub.schema.section import Number, Section, key
from mixedlub.schema.toml_file import named_file, parse, read_toml

SCHEMA, SUFFIX = "mixedlub-friction/1", ".toml"


class FrictionFile(Section):
    """Coefficients of a friction law fitted to solutions or measurements with one oil."""

    schema_: Literal["mixedlub-friction/1"] = key("format of the file", example=SCHEMA, alias="schema")
    law: Literal["condensed", "loepenhaus"] = key(
        "the friction law that these are coefficients of", example="condensed"
    )
    oil: str = key("the oil of the solutions or measurements", example="m100")
    fit: Mapping[str, Number] = key("what it was fitted to: how many, and the errors", example={})
    coefficients: Mapping[str, Number] = key("coefficients by their names", example={"c_0": -4.0})


def coefficients_of(value: Any, info: ValidationInfo) -> Any:
    """Coefficients as given, or from a named file."""
    if not isinstance(value, str):
        return value
    folder = (info.context or {}).get("folder")
    if folder is None:
        raise ValueError("is a file, which no folder is known for; give its coefficients")
    path = named_file(folder, value, "friction_coefficients")
    found = parse(FrictionFile, read_toml(path), str(path))
    wanted = info.data.get("friction", found.law)
    if wanted != found.law:
        raise ValueError(f"{value} has coefficients of friction = {found.law!r}, not of {wanted!r}")
    return dict(found.coefficients)
