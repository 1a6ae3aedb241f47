"""A study file that is wrong is refused with its place, its value and the rule."""

import pytest

from mixedlub.study import read_study
from profiles.errors import InputError

WRONG = {
    "unknown key": ({"gears__teeht": [17, 26]}, "teeth"),
    "unknown table": ({"condition": {}}, "conditions"),
    "unit in the name": ({"conditions__torque_kNm": [1]}, "torque_Nm"),
    "negative module": ({"gears__normal_module_mm": -4.0}, "normal_module_mm"),
    "zero torque": ({"conditions__torque_Nm": [0, 50]}, "torque_Nm"),
    "negative speed": ({"conditions__speed_rpm": [-500]}, "speed_rpm"),
    "speed not a number": ({"conditions__speed_rpm": [float("nan")]}, "speed_rpm"),
    "no speeds": ({"conditions__speed_rpm": []}, "speed_rpm"),
    "speed twice": ({"conditions__speed_rpm": [500, 500]}, "speed_rpm"),
    "spread of wrong keys": ({"conditions__speed_rpm": {"from": 1, "to": 2, "steps": 3}}, "speed_rpm"),
    "spread of one": ({"conditions__speed_rpm": {"from": 1, "to": 2, "count": 1}}, "speed_rpm"),
    "temperature out of range": ({"conditions__oil_temperature_C": [900]}, "oil_temperature_C"),
    "no conditions": ({"conditions": None}, "conditions"),
    "no surfaces": ({"surfaces": {}}, "surfaces"),
    "surface in no list": ({"pairings__every": ["fine", "midd"]}, "'mid'"),
    "half a pairing": ({"pairings__pinion": ["fine"]}, "pinion"),
    "both ways of pairing": ({"pairings": {"every": ["fine"], "pinion": ["fine"], "gear": ["mid"]}}, "every"),
    "missing trace": ({"surfaces__fine": {"profile": "nowhere.csv"}}, "nowhere.csv"),
    "no such shipped trace": ({"surfaces__fine": {"profile": "shipped:0037"}}, "shipped:0037"),
    "moments and trace": ({"surfaces__fine__profile": "a.csv"}, "both"),
    "interference": ({"gears__teeth": [6, 60]}, "interference"),
    "tips that do not meet": ({"gears__centre_distance_mm": 150.0}, "trial.toml"),
    "form of a trace": (
        {"surfaces__fine": {"profile": "shipped:0036", "form": "cubic"}},
        "surfaces.fine: form: 'cubic'",
    ),
    "case instead": (
        {"schema": "mixedlub-case/1", "kind": "disc"},
        "schema: 'mixedlub-case/1': must be 'mixedlub-study",
    ),
    "switch for a number": ({"boundary_friction": True}, "boundary_friction: True: must be a number"),
    "unknown option": ({"options__film": "hamrock"}, "film"),
    "unknown effect": ({"effects__starvatoin": {}}, "starvatoin"),
    "unknown effect parameter": ({"effects__inlet_shear_heating": {"stength": 1.0}}, "'strength'"),
    "relief of rigid teeth": (
        {"gears__load_sharing": {"model": "rigid", "tip_relief_um": [20, 20], "relief_length_mm": [2, 2]}},
        'model = "ldp"',
    ),
    "crown of rigid teeth": (
        {"gears__load_sharing": {"model": "rigid", "lead_crown_um": 5}},
        "lead_crown_um acts only",
    ),
    "misalignment beside a share table": (
        {"gears__load_sharing": {"table": "share.csv", "misalignment_um": 5}},
        "misalignment_um acts only",
    ),
    "unknown law of an effect": ({"effects__churning": {"law": "Changenet"}}, "Changenet and Velex"),
    "law of an effect with one": ({"effects__film_heating": {"law": "Archard"}}, "film_heating"),
    "law against a number": ({"effects__churning": {"law": "Boness, laminar", "viscous": 0.5}}, "churning.viscous"),
    "number that is a name": ({"effects__churning": {"strength": "one"}}, "churning.strength"),
    "number that is none": ({"effects__churning": {"strength": True}}, "churning.strength"),
    "wrong schema": ({"schema": "mixedlub-case/1"}, "schema"),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_input_is_refused_naming_the_place(name, write_study):
    changes, named = WRONG[name]
    with pytest.raises(InputError) as refused:
        read_study(write_study(**changes))
    assert "trial.toml" in str(refused.value)
    assert named in str(refused.value)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.toml"):
        read_study(tmp_path / "none.toml")


def test_folder_is_refused(tmp_path):
    with pytest.raises(InputError, match="folder"):
        read_study(tmp_path)


@pytest.mark.parametrize(
    "body",
    ["0 0.1\n1 nan\n2 0.1\n3 0.2\n", "0 0.1\n2 0.3\n1 0.1\n3 0.2\n"],
    ids=["NaN in a trace", "unsorted x"],
)
def test_bad_trace_is_refused(body, write_study, tmp_path):
    (tmp_path / "bad.csv").write_text("# x um, z um\n" + body)
    with pytest.raises(InputError, match=r"bad\.csv"):
        read_study(write_study(surfaces__fine={"profile": "bad.csv"}))


def test_spread_is_spelt_out(write_study):
    study = read_study(write_study(conditions__speed_rpm={"from": 500, "to": 3000, "count": 6}))
    assert study.file.conditions.speed_rpm == (500, 1000, 1500, 2000, 2500, 3000)


def test_every_unordered_pair_is_the_default(write_study):
    pairings = read_study(write_study()).pairings
    assert len(pairings) == 6
    assert len({frozenset(p) for p in pairings}) == 6


def test_pinion_list_against_gear_list(write_study):
    study = read_study(write_study(pairings={"pinion": ["fine"], "gear": ["mid", "coarse"]}))
    assert study.pairings == (("fine", "mid"), ("fine", "coarse"))


def test_idle_surface_is_noted(write_study):
    study = read_study(write_study(pairings={"every": ["fine"]}))
    assert any(note.code == "surfaces_unused" and "mid, coarse" in note.text for note in study.notes)


def test_numbers_far_from_any_rig_are_noted(write_study):
    study = read_study(write_study(surfaces__fine__m0_um2=2000.0))
    assert [note.place for note in study.notes if note.code == "value_unusual"] == ["surfaces.fine.m0_um2"]
    assert read_study(write_study(name="sound", boundary_friction=0.1)).notes == ()


def test_an_input_that_is_not_finite_is_told_with_its_level(write_study):
    path = write_study(
        lubricant__kinematic_viscosity_mm2_s=[1e8, 0.31], conditions__oil_temperature_C=[60, -60], name="cold"
    )
    with pytest.raises(InputError, match=r"cold\.toml: conditions: oil_temperature_C -60: .*no finite viscosity"):
        read_study(path)


def test_a_modification_of_zero_is_accepted_by_every_sharing(write_study):
    sharing = {"model": "rigid", "lead_crown_um": 0, "tip_relief_um": [0, 0]}
    assert read_study(write_study(gears__load_sharing=sharing)).file.gears.load_sharing.model == "rigid"


@pytest.mark.parametrize(
    ("base", "viscosity", "per_GPa"), [("pao", [460, 45], [16.7, 12.2]), ("mineral", [34, 7.2], [16.2, 12.0])]
)
def test_the_pressure_viscosity_that_is_left_out_follows_the_viscosity(base, viscosity, per_GPa, write_study):
    """Gold's relation at the first viscosity of the oil, not of a typical one, and constant Z from there."""
    oil = {"base": base, "temperature_C": [40, 100], "kinematic_viscosity_mm2_s": viscosity}
    found = read_study(write_study(lubricant=oil)).oil.pressure_viscosity
    assert [1e9 * alpha for alpha in found] == pytest.approx(per_GPa, abs=0.051)
