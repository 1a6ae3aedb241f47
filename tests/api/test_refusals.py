"""Wrong arguments from Python end in one plain sentence: the place, the value, the rule, and how to write it."""

import contextlib
import inspect
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
import profiles
import roughness
from profiles.errors import InputError

PAIR = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.0, face_width_mm=14.0)
OIL = ml.oil("mineral")
FINE = ml.surface(m0_um2=4e-4, m2=2e-4, m4_per_um2=4e-4)
CONDITION = {"torque_Nm": 100.0, "speed_rpm": 3000.0, "oil_temperature_C": 40.0}
HEIGHTS = 1e-6 * np.sin(0.1 * np.arange(4000.0))


def refused(call, *parts: str) -> None:
    """The call raises an input error of one line that contains every part."""
    with pytest.raises(InputError) as caught:
        call()
    said = str(caught.value)
    assert "\n" not in said
    for part in parts:
        assert part in said


def loss(gears=PAIR, oil=OIL, surfaces=FINE, call=ml.power_loss, **keys):
    return lambda: call(gears, oil, surfaces, **{**CONDITION, **keys})


def path(**keys):
    return loss(call=ml.along_path, **keys)


def test_a_condition_without_a_pressure_viscosity_is_named() -> None:
    oil = ml.oil("mineral", pressure_viscosity_per_GPa=[18.8, 13.9])
    refused(loss(oil=oil, oil_temperature_C=[60, 300]), "lubricant.pressure_viscosity_per_GPa", "below zero at 300 °C")


def test_one_viscosity_of_two_is_asked_for_at_both_temperatures() -> None:
    refused(
        lambda: ml.oil("mineral", kinematic_viscosity_mm2_s=5),
        "oil: kinematic_viscosity_mm2_s: 5: must be two numbers, at the two temperatures",
    )


@pytest.mark.parametrize("values", [[100, 200], [100.0], np.array([50.0]), (1, 2)])
def test_a_path_is_of_one_condition(values) -> None:
    refused(path(torque_Nm=values), "along_path: torque_Nm", "one number", "power_loss")


@pytest.mark.parametrize("values", [[[1], [2, 3]], [[1, 2], [3, 4]], np.ones((2, 2)), {"from": 1}, "100", None, [None]])
def test_levels_are_a_number_or_a_list_of_numbers(values) -> None:
    refused(loss(torque_Nm=values), "power_loss", "torque_Nm", "number")


@pytest.mark.parametrize("surfaces", [(FINE, FINE, FINE), (), [FINE], None, 7, {"pinion": FINE, "gear": FINE}])
def test_surfaces_are_one_or_two(surfaces) -> None:
    for call in (loss, path):
        refused(call(surfaces=surfaces), "surfaces", "one surface for both", "pinion and gear")


@pytest.mark.parametrize("surfaces", ["shipped:0450", ("shipped:0450", FINE), (FINE, Path("shipped:0450"))])
def test_the_name_of_a_trace_is_no_surface_yet(surfaces) -> None:
    refused(loss(surfaces=surfaces), "surfaces", "write ml.surface('shipped:0450')")


def test_other_things_are_no_surface() -> None:
    refused(loss(surfaces=(FINE, profiles.Profile(HEIGHTS, 1e-6))), "surfaces", "ml.surface(...)")


def test_the_name_of_a_base_stock_is_no_oil_yet() -> None:
    refused(loss(oil="mineral"), "power_loss: oil", "write ml.oil('mineral')")
    refused(path(oil=None), "along_path: oil", "ml.oil(...)")


@pytest.mark.parametrize("gears", [None, "gears.toml", (17, 26), OIL])
def test_gears_are_those_of_gear_pair(gears) -> None:
    refused(loss(gears=gears), "power_loss: gears", "ml.gear_pair(...)")


@pytest.mark.parametrize(
    ("key", "value"), [("options", "paper"), ("effects", ["churning"]), ("effects", {"churning": 1})]
)
def test_options_and_effects_are_tables(key, value) -> None:
    refused(loss(**{key: value}), f"power_loss: {key}", "table of keys")


@pytest.mark.parametrize("given", [None, {}, 5, b"study.toml", ["a.toml"]])
@pytest.mark.parametrize(
    ("call", "where"),
    [
        (profiles.read, "profiles.read"),
        (ml.study.run, "study.run"),
        (ml.study.read_study, "study.read_study"),
        (ml.case.read, "case.read"),
        (ml.diagnose, "diagnose"),
        (ml.simulate, "simulate"),
    ],
)
def test_a_path_is_text(call, where: str, given) -> None:
    refused(lambda: call(given), where, "path", f"not {given!r}")


GEAR, SHARING = ml.gear.GearPair((17, 26), 4e-3, 0.4, 14e-3), ml.gear.LdpSharing()
OIL_OF_CONTACTS = ml.ehl.example_oil()
CONTACT = {"radius": 8.7e-3, "line_load": 2e5, "oil_temperature": 333.0, "speed": 2.0}
BOTH = {"bulk_temperature": (333.0, 333.0), "youngs_modulus": (2e11, 2e11), "density": (7800.0, 7800.0)}
WAVES = {"oil": OIL_OF_CONTACTS, "contacts": ml.ehl.contacts(**CONTACT), "wavelengths": [1e-4], "wave_speed": [2.0]}
TORQUE = {"pair": GEAR, "sharing": SHARING, "torque": 50.0, "phases": 4, "slices": 1}
CALLS = [
    (ml.gear_pair, {"teeth": (17, 26), "normal_module_mm": 4.0, "face_width_mm": 14.0}),
    (ml.surface, {"m0_um2": 4e-4, "m2": 2e-4, "m4_per_um2": 4e-4}),
    (ml.power_loss, {"gears": PAIR, "oil": OIL, "surfaces": FINE, **CONDITION, "options": {}, "effects": {}}),
    (ml.along_path, {"gears": PAIR, "oil": OIL, "surfaces": FINE, **CONDITION, "options": {}, "effects": {}}),
    (ml.plot, {"results": None, "quantity": "power_loss_W", "over": "speed_rpm"}),
    (ml.case.case_of, {"system": {}, "recordings": {}}),
    (ml.case.read, {"folder": "nowhere"}),
    (ml.simulate, {"case": "nowhere"}),
    (ml.diagnose, {"case": "nowhere"}),
    (ml.effects.find, {"ids": "starvation"}),
    (ml.effects.page, {"effect_id": "starvation"}),
    (ml.ehl.contacts, {**CONTACT, **BOTH}),
    (ml.ehl.solve, {"oil": OIL_OF_CONTACTS, "thermal": False, **CONTACT}),
    (ml.ehl.wave_amplitudes, WAVES),
    (ml.ehl.read_oil, {"path": "nowhere.toml"}),
    (ml.friction.find, {"name": "schlenk"}),
    (ml.gear.mesh, {"pair": GEAR, "sharing": SHARING, "points": 8, "slices": 1}),
    (ml.gear.at_roll_angle, {"pair": GEAR, "sharing": SHARING, "roll_angle": 0.4, "slices": 1}),
    (ml.gear.transmission_error, TORQUE),
    (ml.study.read_study, {"path": "nowhere.toml"}),
    (ml.study.run, {"study": "nowhere.toml"}),
    (ml.study.run_study, {"study": None}),
    (ml.study.factors, {"study": None}),
]


@pytest.mark.parametrize(("call", "keys", "wrong"), [(c, k, w) for c, k in CALLS for w in k])
@pytest.mark.parametrize("value", ["nowhere.toml", None, 1, [1], {"a": 1}, object()])
def test_a_wrong_argument_is_named_or_serves(call, keys, wrong, value, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    with contextlib.suppress(InputError, TypeError):
        call(**{**keys, wrong: value})


def test_parts_of_other_kinds_say_what_is_needed(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    refused(lambda: ml.gear.mesh(1, 2), "gear.mesh: pair", "ml.gear.GearPair(...)", "not int")
    refused(lambda: ml.gear.mesh(GEAR, 2), "gear.mesh: sharing", "ml.gear.RigidSharing()", "not int")
    refused(lambda: ml.study.read_study("x"), "x: no such file")
    refused(lambda: ml.study.read_study(None), "study.read_study", "needs a path")
    refused(lambda: ml.study.run_study("x"), "study.run_study: study", "ml.study.read_study(...)", "not str")
    refused(lambda: ml.ehl.solve("oil.toml", **CONTACT), "ehl.solve: oil", "ml.ehl.read_oil(...)")
    refused(lambda: ml.ehl.contacts(**{**CONTACT, "density": (1.0,)}), "ehl.contacts: density", "one for each body")


@pytest.mark.parametrize("given", [b"flank.txt", 5, {"heights": HEIGHTS}])
def test_a_surface_is_of_a_path_or_a_profile(given) -> None:
    refused(lambda: ml.surface(given), "surface: profile", "path", "profiles.Profile")


@pytest.mark.parametrize("heights", [HEIGHTS, list(HEIGHTS[:9]), pd.Series(HEIGHTS)])
def test_heights_alone_have_no_spacing(heights) -> None:
    refused(lambda: ml.surface(heights), "surface: profile", "ml.surface(profiles.Profile(heights, spacing))")


def test_a_trace_that_is_not_there_is_refused_at_once(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "flank_1.txt").write_text("0 0\n")
    refused(lambda: ml.surface("flank_2.txt"), "surface: profile: 'flank_2.txt'", "no such file", "'flank_1.txt'")
    refused(lambda: ml.surface(tmp_path), "surface: profile", "is a folder")
    refused(lambda: ml.surface("shipped:0451"), "surface: profile: 'shipped:0451'", "nearest known: '0450'")


def test_a_profile_has_its_own_spacing() -> None:
    trace = profiles.Profile(HEIGHTS, 1e-6)
    refused(lambda: ml.surface(trace, spacing="1 um"), "surface: spacing", "leave it out")
    refused(lambda: ml.surface(trace, cutof_mm=0.8), "surface: cutof_mm", "nearest known: 'cutoff_mm'")
    refused(lambda: ml.surface(trace, m2=0.1), "surface", "moments and a profile")


def test_a_profile_is_made_of_numbers() -> None:
    for heights, spacing in (("abc", 1e-6), (HEIGHTS, "1 um"), (HEIGHTS, None), ([[1.0], [2.0, 3.0]], 1e-6)):
        refused(lambda h=heights, s=spacing: profiles.Profile(h, s), "heights and spacing must be numbers")


def test_a_unit_is_text(tmp_path) -> None:
    refused(lambda: profiles.read(tmp_path / "flank.txt", unit=5), "unit: 5", "one unit")


def test_effects_are_found_by_one_name_or_several() -> None:
    assert [e.id for e in ml.effects.find("starvation")] == ["starvation"]
    refused(lambda: ml.effects.page(["starvation"]), "no such effect")
    refused(lambda: ml.effects.page("starv"), "nearest known: 'starvation'")


TAKES_PROFILE = [
    name
    for name in roughness.__all__
    if inspect.isfunction(getattr(roughness, name))
    and next(iter(inspect.signature(getattr(roughness, name)).parameters.values())).annotation == "Profile"
]


@pytest.mark.parametrize("name", TAKES_PROFILE)
def test_heights_alone_are_no_profile(name: str) -> None:
    call = getattr(roughness, name)
    needed = [p for p in list(inspect.signature(call).parameters.values())[1:] if p.default is p.empty]
    keys = {p.name: 1e-5 for p in needed}
    refused(lambda: call(HEIGHTS, **keys), f"roughness.{name}", "profiles.Profile(heights, spacing)")


def test_all_that_take_a_profile_are_found() -> None:
    assert {"moments", "evaluation_profile", "normal_probability", "short_cutoff_band"} <= set(TAKES_PROFILE)


DRIVE = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.01}}}
SPEEDS = np.array([10.0, 50, 100, 200, 300, 400])
ROWS = {"speed_rpm": SPEEDS, "friction_torque_Nm": 0.5 + 2e-3 * SPEEDS}


@pytest.fixture(scope="module")
def case():
    return ml.case.case_of(DRIVE, ROWS)


def test_columns_by_name_are_a_table(case) -> None:
    frame = pd.DataFrame({"speed_rpm": [150.0, 250.0]})
    for same in ({"speed_rpm": [150.0, 250.0]}, {"speed_rpm": np.array([150.0, 250.0])}):
        pd.testing.assert_frame_equal(ml.simulate(case, at=same), ml.simulate(case, at=frame))
    assert ml.simulate(case, at={"speed_rpm": 150.0})["speed_rpm"].tolist() == [150.0]


@pytest.mark.parametrize(
    "at", [[1, 2], 5, "conditions.csv", np.ones((2, 2)), {"speed_rpm": [1.0], "setup": ["a", "b"]}]
)
def test_what_is_no_table_is_refused(case, at) -> None:
    refused(lambda: ml.simulate(case, at=at), "conditions", "DataFrame")
    refused(lambda: ml.diagnose(case, at), "conditions", "DataFrame")
    refused(lambda: ml.case.case_of(DRIVE, at), "recordings", "DataFrame")


def test_a_system_is_a_table_of_keys() -> None:
    refused(lambda: ml.case.case_of("system.toml", ROWS), "system", "table of keys")


def test_an_effect_is_excluded_by_one_name_or_several(case) -> None:
    refused(lambda: ml.diagnose(case, exclude="stribeck_"), "exclude: 'stribeck_'", "nearest known: 'stribeck'")
    refused(lambda: ml.diagnose(case, exclude=["stribeck", "stribek"]), "exclude: 'stribek'", "'stribeck'")
    refused(lambda: ml.diagnose(case, exclude=5), "exclude", "list of effect ids")
    refused(lambda: ml.diagnose(case, exclude=[5]), "exclude", "list of effect ids")


def test_one_name_is_one_effect(case) -> None:
    assert ml.diagnose(case, exclude="stribeck").diagnosis.excluded == ("stribeck",)


@pytest.mark.parametrize("level", [5, 0, -1, float("nan"), "x", None, True, 0.51, [0.01]])
def test_a_level_is_the_one_of_the_command(case, level) -> None:
    refused(lambda: ml.diagnose(case, level=level), "level", "must be a number from 1e-09 to 0.5")


def test_the_command_says_its_levels() -> None:
    from mixedlub.diagnosis.settings.assessment import LEVELS

    source = inspect.getsource(__import__("mixedlub.commands.diagnose", fromlist=["command"]).command)
    assert [float(x) for x in re.search(r"from (\S+) to (\S+)\.", source).groups()] == list(LEVELS)


def test_masked_numbers_are_refused() -> None:
    """Taken as plain numbers, masked ones would count."""
    masked = np.ma.array([50.0, 1e6, 50.0], mask=[False, True, False])
    refused(loss(torque_Nm=masked), "torque_Nm", "1 masked entry")
    refused(lambda: profiles.Profile(1e-9 * masked, 1e-6), "profile", "1 masked entry")
