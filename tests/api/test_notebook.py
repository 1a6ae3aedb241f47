"""In a notebook: names and keys complete, and objects show short escaped tables."""

import re
from inspect import Parameter, signature

import pytest

import mixedlub as ml
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import Gears
from profiles.errors import InputError

MOST_CHARACTERS = 3000
"""A table longer than this hides the cell above it."""
PAIR = {"teeth": (17, 26), "normal_module_mm": 4.2333, "face_width_mm": 14.0}


def cells(html: str) -> list[str]:
    return re.findall(r"<t[dh]>(.*?)</t[dh]>", html)


@pytest.mark.parametrize(
    ("function", "section", "first"),
    [(ml.gear_pair, Gears, []), (ml.oil, Lubricant, ["named"]), (ml.surface, SurfaceSection, ["profile"])],
)
def test_keys_of_the_file_complete(function, section, first) -> None:
    """IPython and Jupyter complete the names of ``inspect.signature``."""
    names = list(signature(function).parameters)
    assert names[: len(first)] == first
    assert set(names) == {*first, *section.model_fields}
    keys = [one for one in signature(function).parameters.values() if one.name not in first]
    assert all(one.kind is Parameter.KEYWORD_ONLY for one in keys)


def test_defaults_of_the_signature_are_those_of_the_file() -> None:
    found = signature(ml.gear_pair).parameters
    assert found["helix_angle_deg"].default == ml.gear_pair(**PAIR).helix_angle_deg == 0.0
    assert found["poisson_ratio"].default == (0.3, 0.3)


def test_a_keyword_beyond_the_keys_still_gets_the_nearest_name() -> None:
    with pytest.raises(InputError, match="face_width_mm"):
        ml.gear_pair(**PAIR, face_with_mm=14.0)


def test_only_public_names_complete() -> None:
    assert dir(ml) == sorted([*ml.PUBLIC, *ml.ROOMS, *ml.BESIDE])


def test_a_gear_shows_what_was_given() -> None:
    pair = ml.gear_pair(**PAIR, load_sharing={"model": "ldp", "tip_relief_um": (15.0, 15.0)})
    assert repr(pair) == (
        "Gears(teeth=(17, 26), normal_module_mm=4.2333, face_width_mm=14.0, "
        "load_sharing=LoadSharing(model='ldp', tip_relief_um=(15.0, 15.0)))"
    )
    shown = cells(pair._repr_html_())
    assert shown[:4] == ["key", "value", "unit", "meaning"]
    assert shown[4:7] == ["teeth", "17, 26", ""]
    assert shown[8:11] == ["normal_module_mm", "4.2333", "mm"]
    assert "poisson_ratio" not in shown


def test_surfaces_and_oils_show_what_was_given() -> None:
    assert "0.137" in cells(ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021)._repr_html_())
    assert repr(ml.surface("shipped:0258", cutoff_mm=0.8)) == "SurfaceSection(profile='shipped:0258', cutoff_mm=0.8)"
    assert "97.9, 8.61" in cells(ml.oil("n100")._repr_html_())


def test_texts_are_escaped_and_cut() -> None:
    html = ml.oil("mineral", name="<script>alert('oil')</script>" + 200 * "x")._repr_html_()
    assert "<script>" not in html
    assert "&lt;script&gt;" in html
    assert "…" in html


def test_a_case_shows_its_summary(drive) -> None:
    html = drive._repr_html_()
    assert html.startswith("<div><b>Case &#x27;drive&#x27;: friction_map")
    assert html.count("<li>") == len(repr(drive).splitlines()) - 1


def test_an_answer_shows_its_probabilities(answer) -> None:
    shown = cells(answer._repr_html_())
    assert shown[:2] == ["effect", "probability"]
    assert shown[2] == answer.probabilities.index[0] == "stribeck"
    assert 0.5 < float(shown[3]) <= 1.0


def test_results_and_fits_show_tables(two_flanks) -> None:
    results = ml.study.run(two_flanks(torque_Nm="[50]", speed_rpm="[3000]", oil_temperature_C="[60]"))
    assert "<b>Results of &#x27;Two flanks&#x27;: 3 pairings" in results._repr_html_()
    water = {"temperature_C": [0, 20, 40, 60, 80, 100], "viscosity_mPa_s": [1.792, 1.002, 0.653, 0.466, 0.354, 0.282]}
    fit = ml.fit_laws(water, relative_sd=0.005)
    assert cells(fit._repr_html_())[5] == "vogel"
    assert all(len(one._repr_html_()) < MOST_CHARACTERS for one in (results, fit))
