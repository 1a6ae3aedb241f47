"""Gears by name: every one can be built, and has the numbers that its source prints of it beside."""

import math

import pytest

from mixedlub.gear.build import gear_pair
from mixedlub.schema.findings import collected
from mixedlub.schema.gear_file import gear_names, shipped_gears
from mixedlub.schema.system_file import Gears
from mixedlub.schema.toml_file import parse
from profiles.errors import InputError


def built(name, **keys):
    return gear_pair(parse(Gears, {"preset": name, **keys}, "gears"))


@pytest.mark.parametrize("name", gear_names())
def test_every_preset_is_a_working_pair(name):
    with collected() as found:
        pair = built(name)
    assert pair.contact_ratio + pair.overlap_ratio > 1
    assert abs(pair.backlash) < 0.02 * pair.normal_module
    assert not [one for one in found if one.code != "value_unusual"]
    assert shipped_gears(name).source


@pytest.mark.literature("Sources of the presets")
@pytest.mark.parametrize(
    ("name", "contact_ratio", "centre_distance"),
    [
        ("fzg_c", 1.4375, 91.5e-3),
        ("h501", 1.46, 91.5e-3),
        ("h701", 1.52, 91.5e-3),
        ("h951", 0.93, 91.5e-3),
        ("high_speed_a", 2.00, 203.330e-3),
        ("high_speed_b", 2.04, 203.330e-3),
        ("nasa", 1.638, 88.9e-3),
        ("measured_40_40", 1.4280, 91.5e-3),
    ],
)
def test_contact_ratio_and_centre_distance(name, contact_ratio, centre_distance):
    pair = built(name)
    assert pair.contact_ratio == pytest.approx(contact_ratio, abs=6e-3)
    assert pair.working_centre_distance == pytest.approx(centre_distance, rel=1e-4)


@pytest.mark.literature("Petry-Johnson 2007: angle of contact 26.495 degrees, path 9.184 mm")
def test_path_of_the_measured_gears():
    pair = built("measured_40_40")
    assert math.degrees(pair.working_pressure_angle) == pytest.approx(26.495, abs=1e-3)
    assert pair.path_end - pair.path_start == pytest.approx(9.184e-3, rel=1e-3)
    assert pair.loss_factor == pytest.approx(0.09293, rel=2e-3)


def test_the_section_wins_and_a_note_says_so():
    with collected() as found:
        assert built("fzg_c", face_width_mm=20.0).face_width == pytest.approx(20e-3)
    assert [one.code for one in found] == ["gears_overridden"]
    assert "face_width_mm in place of 14" in found[0].text


def test_an_unknown_name_gets_the_nearest():
    with pytest.raises(InputError, match=r"preset: 'fzg_d': .*'fzg_"):
        built("fzg_d")
