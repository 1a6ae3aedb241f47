"""A number in the wrong unit is refused where it is read."""

import pytest

from mixedlub.schema import system_file, toml_file
from profiles.errors import InputError


@pytest.mark.parametrize(
    ("section", "values", "key"),
    [
        (system_file.Lubricant, {"density_15C_kg_m3": 0.85}, "density_15C_kg_m3"),
        (
            system_file.Gears,
            {"teeth": [17, 26], "normal_module_mm": 4.2, "face_width_mm": 14.0, "youngs_modulus_GPa": [206e3, 206e3]},
            "youngs_modulus_GPa",
        ),
    ],
)
def test_another_unit_is_refused(section: type, values: dict[str, object], key: str) -> None:
    with pytest.raises(InputError, match=key):
        toml_file.parse(section, values, "system.toml")
