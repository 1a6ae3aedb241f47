"""The table of bounds: every key of `system.toml` has its row, and slips of the unit fall outside it."""

from __future__ import annotations

from pathlib import Path
from typing import Any, get_args, get_origin

import pytest

from mixedlub.ehl.file import AsperitySection, Bodies
from mixedlub.kinds import KINDS, kind
from mixedlub.schema import ranges, system_file, toml_file
from mixedlub.schema.section import Section, plain, tables
from mixedlub.skew_gears.file import SkewGears
from mixedlub.study.schema import StudyFile
from mixedlub.worm_gears.file import Worm
from profiles.errors import InputError

FREE = {"gears.teeth"}
"""Numbers without a row: the geometry judges them."""
TRACTION = "lubricant.traction."
"""Before the names of the numbers of a traction part, which has rules of its own."""

RECORDED = "recordings."
"""Before the names of columns, which bound themselves: their rows hold what is usual."""


def numbers_in(annotation: Any) -> bool:
    """Whether a key holds numbers, by itself or in a list."""
    of = plain(annotation)
    return of in (int, float) or (get_origin(of) is tuple and numbers_in(get_args(of)[0]))


def test_every_number_of_a_file_has_its_row_and_every_row_its_number() -> None:
    keys = {
        f"{table.name}.{key.name}".lstrip(".") if key.range is None else key.range.key
        for file in (system_file.System, StudyFile)
        for table in tables(file)
        for key in table.fields
        if numbers_in(key.type) and not f"{table.name}.".startswith(TRACTION)
    }
    assert keys - FREE == {key for key in ranges.ranges() if not key.startswith(RECORDED)}


@pytest.mark.parametrize("file", [system_file.System, StudyFile])
def test_a_key_has_the_row_of_its_own_place(file: type[Section]) -> None:
    for table in tables(file):
        for key in table.fields:
            assert key.range is None or key.range.key == f"{table.name}.{key.name}".lstrip(".")


def test_rows_of_recordings_are_columns_of_a_kind() -> None:
    columns = {c for k in KINDS for c in (*(column.name for column in kind(k).columns), *kind(k).quantities)}
    assert {key.removeprefix(RECORDED) for key in ranges.ranges() if key.startswith(RECORDED)} <= columns


@pytest.mark.parametrize("key", ranges.ranges())
def test_what_is_usual_is_possible(key: str) -> None:
    found = ranges.ranges()[key]
    assert found.possible[0] <= found.typical[0] < found.typical[1] <= found.possible[1]


@pytest.mark.parametrize(
    ("section", "key", "limits"),
    [
        (SkewGears, "youngs_modulus_GPa", (0.1, 2000.0)),
        (Worm, "youngs_modulus_GPa", (0.1, 2000.0)),
        (Bodies, "youngs_modulus_GPa", (0.1, 2000.0)),
        (SkewGears, "poisson_ratio", (0.0, 0.4999)),
        (Worm, "poisson_ratio", (0.0, 0.4999)),
        (AsperitySection, "hardness_GPa", (0.01, 150.0)),
    ],
)
def test_bodies_of_other_files_have_the_bounds_of_a_case(section, key, limits) -> None:
    within = ranges.range_of(section.model_fields[key])
    assert within is not None
    assert within.possible == limits


def system(section: str, key: str, value: object) -> dict:
    """A film case with one key of one section set."""
    data: dict = {
        "schema": "mixedlub-case/1",
        "kind": "disc",
        "contact": {"geometry": "point", "radius_mm": [10.0, float("inf")]},
        "lubricant": {},
        "surfaces": {"a": {"m0_um2": 0.01, "m2": 0.001, "m4_per_um2": 0.001}},
        "recording": {"quantity": "friction_coefficient"},
    }
    (data["surfaces"]["a"] if section == "surfaces" else data.setdefault(section, {}) if section else data)[key] = value
    return data


SLIPS = [
    ("", "boundary_friction", 10, "10 % would be 0.1"),
    ("lubricant", "kinematic_viscosity_mm2_s", [30e-6, 6e-6], "3e-05 m2/s would be 30 mm²/s"),
    ("lubricant", "temperature_C", [40.0, 373.15], "373.15 K would be 100 °C"),
    ("lubricant", "pressure_viscosity_per_GPa", [2e-8, 1e-8], "2e-08 1/Pa would be 20 1/GPa"),
    ("lubricant", "pressure_viscosity_per_GPa", [0.02, 0.01], "0.02 1/MPa would be 20 1/GPa"),
    ("lubricant", "eyring_stress_MPa", 5e6, "5e+06 Pa would be 5 MPa"),
    ("lubricant", "density_15C_kg_m3", 0.85, "0.85 g/cm3 would be 850 kg/m³"),
    ("lubricant", "specific_heat_J_kgK", 2.0, "2 kJ/(kg K) would be 2000 J/(kg K)"),
    ("lubricant", "thermal_conductivity_W_mK", 140, "140 mW/(m K) would be 0.14 W/(m K)"),
    ("contact", "youngs_modulus_GPa", [206e3, 206.0], "206000 MPa would be 206 GPa"),
    ("surfaces", "m0_um2", 130000, "130000 nm2 would be 0.13 µm²"),
    ("surfaces", "m4_per_um2", 2.1e9, "2.1e+09 1/m2 would be 0.0021 1/µm²"),
    ("uncertainty", "viscosity", 6, "6 % would be 0.06"),
    ("recording", "ambient_temperature_C", 298.15, "298.15 K would be 25 °C"),
]


@pytest.mark.parametrize(("section", "key", "value", "said"), SLIPS)
def test_a_slip_of_the_unit_is_refused_with_the_unit_that_fits(section, key, value, said) -> None:
    with pytest.raises(InputError) as refused:
        toml_file.parse(system_file.System, system(section, key, value), "system.toml")
    place = {"": key, "surfaces": f"surfaces.a.{key}"}.get(section, f"{section}.{key}")
    assert str(refused.value).startswith(f"system.toml: {place}: ")
    assert said in str(refused.value)


ODD_BUT_RIGHT = [
    ("", "boundary_friction", 0.01),
    ("", "boundary_friction", 0.4),
    ("contact", "youngs_modulus_GPa", [75.0, 400.0]),
    ("contact", "youngs_modulus_GPa", [1.0, 5.0]),
    ("contact", "youngs_modulus_GPa", [1100.0, 206.0]),
    ("lubricant", "kinematic_viscosity_mm2_s", [1e6, 0.5]),
    ("lubricant", "pressure_viscosity_per_GPa", [0.6, 45.0]),
    ("lubricant", "temperature_C", [-54.0, 200.0]),
    ("lubricant", "density_15C_kg_m3", 1950.0),
    ("lubricant", "eyring_stress_MPa", 20.0),
    ("surfaces", "thermal_conductivity_W_mK", 0.2),
]


@pytest.mark.parametrize(("section", "key", "value"), ODD_BUT_RIGHT)
def test_an_unusual_rig_is_neither_refused_nor_doubted(section, key, value) -> None:
    found = toml_file.parse(system_file.System, system(section, key, value), "system.toml")
    assert list(ranges.unusual(found)) == []


FAR_OFF = [
    ("", "boundary_friction", 1.5, "boundary_friction: 1.5, where rigs have 0.003 to 0.8: 1.5 % would be 0.015"),
    ("contact", "youngs_modulus_GPa", [206.0, 0.206], "entry 2: 0.206, where rigs have 0.3 to 1300 GPa: 0.206 TPa w"),
    (
        "contact",
        "radius_mm",
        [0.01, 20.0],
        "contact.radius_mm, entry 1: 0.01, where rigs have at least 0.1 mm: 0.01 m",
    ),
    (
        "surfaces",
        "m0_um2",
        1300,
        "surfaces.a.m0_um2: 1300, where rigs have 1e-08 to 400 µm²: 1300 nm2 would be 0.0013",
    ),
]


@pytest.mark.parametrize(("section", "key", "value", "said"), FAR_OFF)
def test_a_possible_number_far_from_any_rig_is_doubted_with_what_is_usual(section, key, value, said) -> None:
    found = toml_file.parse(system_file.System, system(section, key, value), "system.toml")
    (doubt,) = ranges.unusual(found)
    assert doubt.code == "value_unusual"
    assert said in str(doubt)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), "50", True])
def test_what_is_no_finite_number_is_refused(value) -> None:
    with pytest.raises(InputError, match=r"system\.toml: lubricant\.eyring_stress_MPa: "):
        toml_file.parse(system_file.System, system("lubricant", "eyring_stress_MPa", value), "system.toml")


def test_practice_cases_lie_within_what_is_usual(shared: Path) -> None:
    for folder in sorted((shared / "cases").glob("case_*")):
        found = toml_file.parse(system_file.System, toml_file.read_toml(folder / "system.toml"), folder.name)
        assert list(ranges.unusual(found)) == []
