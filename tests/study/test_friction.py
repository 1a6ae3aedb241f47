"""A study follows the friction law that it names, says where that law does not hold, and ignores nothing."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from mixedlub.chain.friction_law import FrictionLaw
from mixedlub.friction import BASE, catalogue, condensed
from mixedlub.schema.findings import codes
from mixedlub.schema.toml_file import to_toml
from mixedlub.study import read_study, run_study
from mixedlub.study.record import resolved
from mixedlub.study.validity import out_of_range
from profiles.errors import InputError

GIVEN: Mapping[str, Mapping[str, float]] = {
    "constant": {"friction": 0.05},
    "arana": {"limiting_stress_ratio": 0.047},
    "evans_johnson": {"limiting_stress_ratio": 0.047, "shear_modulus_GPa": 0.5},
    "doleschel": {"film_friction": 0.0093},
    "matsumoto": {"film_friction": 0.0093, "rz_sum_um": 3.0},
    "iso_tr_14179_1": {"divisor": 5.0, "viscosity_exponent": -0.2, "load_exponent": -0.3, "speed_exponent": 0.5},
    "loepenhaus": {"c1": 0.1, "c2": -0.1, "c3": 0, "c4": 0, "c5": 0, "c6": 1, "c7": 0.2, "c8": 0.1, "c9": 0.01},
    "condensed": {
        **{c.name: 0.0 for c in condensed.COEFFICIENTS},
        **{end: value for one in condensed.INPUTS for end, value in zip(one.ends, (1e-6, 1e6), strict=True)},
        "c_0": -3.5,
    },
}
"""Coefficients that a user would give."""
LAWS = [law for law in catalogue().values() if law.name != BASE]
each = pytest.mark.parametrize("law", LAWS, ids=[law.name for law in LAWS])


def study(write_study: Any, friction: str, **changes: Any) -> Any:
    options = {"friction": friction, "friction_coefficients": dict(GIVEN.get(friction, {}))}
    return read_study(write_study(options=options | changes.pop("options", {}), **changes))


@each
def test_loss_of_the_mesh_is_the_path_integral_of_the_law(write_study: Any, law: FrictionLaw) -> None:
    found = run_study(study(write_study, law.name))
    assert np.all(found["mesh_loss"] > 0.0)
    sliding = found["mesh_loss"] / found["mean_friction"]
    base = run_study(read_study(write_study()))
    assert sliding == pytest.approx(base["mesh_loss"] / base["mean_friction"], rel=1e-12)
    assert found["film_thickness"] == pytest.approx(base["film_thickness"], rel=1e-12)


def test_the_base_model_by_name_is_the_base_model(write_study: Any) -> None:
    named, base = run_study(read_study(write_study(options={"friction": BASE}))), run_study(read_study(write_study()))
    assert all(np.array_equal(named[name], values, equal_nan=True) for name, values in base.values.items())


def test_a_constant_is_the_mean_friction(write_study: Any) -> None:
    found = run_study(study(write_study, "constant"))
    assert found["mean_friction"] == pytest.approx(np.full(found["mean_friction"].shape, 0.05), rel=1e-12)


def test_rougher_flanks_rub_more_by_the_fourth_root(write_study: Any) -> None:
    """Of surfaces against themselves, Ra is proportional to the root of m0."""
    found = run_study(study(write_study, "schlenk", pairings={"every": ["fine", "coarse"]}))
    rise = found["mean_friction"][2] / found["mean_friction"][0]
    assert rise == pytest.approx(np.full(rise.shape, (0.3 / 0.02) ** 0.125), rel=1e-12)


@each
def test_a_condition_outside_the_range_is_flagged(write_study: Any, law: FrictionLaw) -> None:
    """Far beyond the speed that any of the printed ranges reaches, and at points without sliding."""
    slow = run_study(study(write_study, law.name, conditions__speed_rpm=[15_000]))
    code = f"law_extrapolated:{law.name}"
    limited = {"pitch_line_speed", "entrainment_speed", "slide_roll_ratio"} & set(law.valid)
    assert (code in slow.flags) == bool(limited)
    if limited:
        assert slow.flags[code].all()
        assert any(f"{law.name} is used outside" in str(one) for one in out_of_range(slow))


def test_negative_friction_is_flagged(write_study: Any) -> None:
    found = run_study(study(write_study, "benedict_kelley", conditions__speed_rpm=[1500, 100_000]))
    assert found.flags["law_extrapolated:benedict_kelley"].any(axis=(0, 1, 2)).tolist() == [False, True]


def test_flags_of_a_law_follow_its_limits(write_study: Any) -> None:
    found = run_study(study(write_study, "schlenk", conditions__speed_rpm=[13_000, 14_000]))
    radius = found.study.pair.operating_radius[0]
    speeds = radius * np.array([13_000, 14_000]) * np.pi / 30.0
    assert speeds[0] < 50.0 < speeds[1]
    assert found.flags["law_extrapolated:schlenk"].any(axis=(0, 1, 2)).tolist() == [False, True]


@pytest.mark.parametrize(
    ("friction", "options", "said"),
    [
        ("misharin", {"mixture": "tallian"}, "options.mixture: 'tallian': friction = 'misharin' does not read it"),
        ("misharin", {"contact_pressure": "mean"}, "options.contact_pressure"),
        ("misharin", {"viscosity_pressure": "mean"}, "options.viscosity_pressure"),
        ("crook", {"effective_viscosity": "secant"}, "options.effective_viscosity"),
        ("misharin", {"friction_coefficients": {"c1": 1}}, "no such coefficient of misharin; it has none"),
        ("schlenk", {"friction_coefficients": {"lubricant_facto": 1}}, "nearest known: 'lubricant_factor'"),
        ("constant", {"friction_coefficients": {}}, "needs friction: no source prints them"),
        (BASE, {"friction_coefficients": {"c1": 1}}, "no such coefficient of tallian_mixture"),
        ("misharn", {}, "nearest known: 'misharin'"),
    ],
)
def test_what_a_law_would_ignore_is_refused(write_study: Any, friction: str, options: Any, said: str) -> None:
    with pytest.raises(InputError) as error:
        study(write_study, friction, options=options)
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("friction", "options"),
    [("crook", {"viscosity_law": "barus"}), ("evans_johnson", {"effective_viscosity": "secant"}), ("arana", {})],
)
def test_what_a_law_reads_may_be_chosen(write_study: Any, friction: str, options: Any) -> None:
    assert run_study(study(write_study, friction, options=options))["mesh_loss"].min() > 0.0


def test_effects_on_what_a_law_does_not_read_are_refused(write_study: Any) -> None:
    with pytest.raises(InputError, match="would change nothing, as friction = 'misharin' does not read it"):
        study(write_study, "misharin", effects={"film_heating": {}})
    heated = study(write_study, "misharin", effects={"windage": {}})
    assert run_study(heated)["other_loss"].min() > 0.0


def test_notes_say_what_is_assumed_unread_and_divergent(write_study: Any) -> None:
    said = {one.code: str(one) for one in study(write_study, "benedict_kelley", boundary_friction=0.1).notes}
    assert "benedict_kelley does not read it" in said["boundary_friction_unread"]
    assert "pitch point" in said["friction_diverges"]
    said = {one.code: str(one) for one in study(write_study, "schlenk").notes}
    assert "lubricant_factor = 1" in said["friction_coefficient_assumed"]
    assert not {"boundary_friction_unread", "friction_diverges", "boundary_friction_assumed"} & said.keys()
    said = {one.code: str(one) for one in read_study(write_study()).notes}
    assert said["boundary_friction_assumed"] == "boundary_friction: 0.1 assumed"
    assert "boundary_friction_assumed" not in codes(read_study(write_study(boundary_friction=0.1)).notes)


def test_the_record_of_a_study_runs_again(write_study: Any, tmp_path: Any) -> None:
    first = study(write_study, "misharin")
    inputs = json.loads(json.dumps(resolved(first)["inputs"]))
    path = tmp_path / "again.toml"
    path.write_text(to_toml(inputs), encoding="utf-8")
    assert inputs["options"]["friction_coefficients"] == {}
    schlenk = resolved(study(write_study, "schlenk"))["inputs"]["options"]
    assert schlenk["friction_coefficients"] == {"lubricant_factor": 1.0}
    assert "mixture" not in schlenk
    assert tomllib.loads(path.read_text(encoding="utf-8"))["options"]["friction"] == "misharin"
    again = run_study(read_study(path))
    assert again["mesh_loss"] == pytest.approx(run_study(first)["mesh_loss"], rel=1e-12)


def test_every_law_diverges_where_it_says_so() -> None:
    """At the zero of a quantity that it names friction is not finite, and close to it larger than away from it."""
    state = dict.fromkeys({name for law in LAWS for name in law.reads}, 1.0)
    state |= {"viscosity": 0.01, "kinematic_viscosity": 1e-5, "line_load": 4e5, "mesh_line_load": 4e5, "radius": 0.01}
    state |= {"composite_roughness": 1e-7, "mean_roughness": 1e-7, "pressure_viscosity": 1e-8, "hertz_pressure": 1e9}
    for law in LAWS:
        own = law.with_coefficients(GIVEN.get(law.name, {}))
        for name in law.diverges:
            with np.errstate(all="ignore"):
                at = [float(own(*(np.array({**state, name: v}[n]) for n in law.reads))[0]) for v in (0.0, 1e-9, 1.0)]
            assert not np.isfinite(at[0]), (law.name, name)
            assert at[1] > 2 * at[2], (law.name, name)
