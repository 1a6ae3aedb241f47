"""The chart of a study's page: its rows are those of the table, thinned by a rule where there are too many."""

import io
import json
import sys
from urllib.parse import unquote

import pandas as pd
import pytest

from mixedlub.report.chart_rows import SIDES, chart_rows
from mixedlub.report.interactive import explorer, library, specification
from mixedlub.report.page import write_page
from mixedlub.study import read_study, run_study
from tests.study.conftest import study_file


@pytest.fixture(scope="module")
def usual(tmp_path_factory):
    return run_study(read_study(study_file(tmp_path_factory.mktemp("usual"))))


def single(folder):
    """A study of one pairing at one condition."""
    conditions = {"torque_Nm": [50], "speed_rpm": [500], "oil_temperature_C": [60]}
    surfaces = {"only": {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036}}
    return run_study(read_study(study_file(folder, conditions=conditions, surfaces=surfaces)))


@pytest.fixture(scope="module")
def large(tmp_path_factory):
    surfaces = {f"s{i}": {"m0_um2": 0.3 - 0.012 * i, "m2": 0.0025, "m4_per_um2": 0.0036} for i in range(20)}
    conditions = {
        "torque_Nm": {"from": 10, "to": 200, "count": 20},
        "speed_rpm": [3000, 500, 1500],
        "oil_temperature_C": [60],
    }
    return run_study(read_study(study_file(tmp_path_factory.mktemp("large"), surfaces=surfaces, conditions=conditions)))


@pytest.fixture(scope="module")
def spec(usual):
    return described(usual)


def described(results):
    return specification(results, chart_rows(results))


def parameters(spec):
    return {one["name"]: one for one in spec["params"] if "name" in one}


def test_rows_of_a_small_study_are_those_of_its_table(usual):
    rows = chart_rows(usual)
    order = [*SIDES, "oil_temperature_C", "torque_Nm", "speed_rpm"]
    ours, table = (t.sort_values(order).reset_index(drop=True) for t in (rows.table, usual.to_pandas()))
    pd.testing.assert_frame_equal(ours, table, rtol=5e-5, check_dtype=False)
    assert rows.choice.startswith("The chart has every condition (72)")


def test_a_large_study_is_thinned_evenly_and_says_so(large):
    rows = chart_rows(large, most=600)
    pairings = rows.table.drop_duplicates(list(SIDES))
    everything = large.to_pandas()
    assert len(rows.table) == len(pairings) * rows.table.torque_Nm.nunique() * 3 <= 600
    assert len(pairings) > 3 * rows.table.torque_Nm.nunique()
    for column in ("torque_Nm", "speed_rpm", "composite_roughness_um"):
        ends = [[t[column].min(), t[column].max()] for t in (rows.table, everything)]
        assert ends[0] == pytest.approx(ends[1], rel=5e-5)
    assert pairings.composite_roughness_um.is_monotonic_increasing
    for words in (
        f"{len(rows.table)} of the {len(everything)} conditions",
        f"{len(pairings)} of 210 pairings",
        f"{rows.table.torque_Nm.nunique()} of 20 torques",
        "results.csv",
    ):
        assert words in rows.choice, words
    assert "speeds" not in rows.choice


def test_the_text_of_the_rows_is_bounded(large):
    rows = chart_rows(large, most_bytes=100_000)
    assert 50_000 < len(rows.text) + len(rows.address) <= 100_000
    assert len(chart_rows(large, most_bytes=10).table) == 1


def test_the_file_of_the_rows_is_their_table(usual):
    rows = chart_rows(usual)
    start, text = rows.address.split(",", 1)
    assert start == "data:text/csv;charset=utf-8"
    pd.testing.assert_frame_equal(pd.read_csv(io.StringIO(unquote(text))), rows.table, check_dtype=False)


def test_specification_is_the_same_every_time(usual, spec):
    assert json.dumps(described(usual)) == json.dumps(spec)


def test_specification_offers_every_quantity_and_condition(usual, spec):
    found = parameters(spec)
    offered = found["quantity"]["bind"]["options"]
    assert set(offered) == {column.name for column in usual.columns}
    assert offered[:3] == ["power_loss_W", "mean_friction", "film_parameter"]
    assert found["at_torque"]["bind"]["options"] == [50, 150, None]
    assert found["at_torque"]["value"] == 150
    assert found["at_oil_temperature"]["value"] == 60
    assert found["one_surface"]["bind"]["labels"] == ["all", "fine", "mid", "coarse"]


def test_its_addresses_are_those_of_the_schema_alone(spec):
    text = json.dumps(spec)
    assert text.count("//") == text.count("https://vega.github.io/schema/") == 1


def test_one_condition_needs_no_lists_of_conditions(tmp_path):
    found = parameters(described(single(tmp_path)))
    assert {name for name, one in found.items() if "bind" in one} == {"quantity", "abscissa", "picked"}
    assert found["abscissa"]["value"] == "composite_roughness_um"


def test_conditions_of_the_gear_are_named_so(tmp_path):
    study = run_study(read_study(study_file(tmp_path, options={"conditions_of": "gear"})))
    assert "gear speed (rpm)" in parameters(described(study))["abscissa"]["bind"]["labels"]


def test_bands_are_layers_of_their_own(spec, tmp_path):
    surfaces = {"traced": {"profile": "shipped:0258", "cutoff_mm": 0.8}}
    banded = run_study(read_study(study_file(tmp_path, surfaces=surfaces, options={"bands": "traces"})))
    with_bands = described(banded)
    assert {"bands", "bars"} <= {layer.get("name") for layer in with_bands["layer"]}
    assert not {"bands", "bars"} & {layer.get("name") for layer in spec["layer"]}
    found = parameters(with_bands)
    low, high = found["low"]["value"]["power_loss_W"], found["high"]["value"]["power_loss_W"]
    table = banded.to_pandas()
    assert (table[low] <= table.power_loss_W).all()
    assert (table.power_loss_W <= table[high]).all()
    assert low not in found["quantity"]["bind"]["options"]


@pytest.mark.usefixtures("undrawn")
def test_a_page_without_the_library_of_the_chart_says_how_to_add_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "vl_convert", None)
    library.cache_clear()
    study = single(tmp_path)
    chart = explorer(study)
    assert (chart.library, chart.specification) == ("", {})
    assert len(chart.rows.table) == 1
    write_page(study, tmp_path, [])
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "pip install '.[interactive]'" in page
    assert "vegaEmbed" not in page
