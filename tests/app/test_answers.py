"""Answers of the form: kept while they fit, dropped with another kind of recording; rankings and cut-offs."""

import asyncio
import io

import pandas as pd
import pytest

from mixedlub.study import ranking
from profiles import shipped
from roughness import trace_record
from roughness.over_cutoffs import over_cutoffs
from tests.app.recordings_of_all_kinds import MADE_UP

pytest.importorskip("fastapi")
from fastapi import UploadFile

from mixedlub.app import reading, recordings, study_form
from mixedlub.app.desk import Desk, environment
from mixedlub.app.jobs import FAILED, LOST, Jobs
from mixedlub.app.store import Store, read_record, write_record
from mixedlub.schema.toml_file import read_toml
from profiles.errors import InputError


class Here:
    """A worker in this process."""

    async def call(self, function, *arguments):
        return function(*arguments)


@pytest.fixture
def desk(tmp_path):
    store = Store(tmp_path)
    store.claim()
    made = Desk(store, Jobs(store), Here(), environment())
    yield made
    made.jobs.close()


def sent(desk, *names):
    files = [UploadFile(io.BytesIO(MADE_UP[name]().encode()), filename=f"{name}.csv") for name in names]
    return asyncio.run(recordings.created(desk, files))


FILM = {
    "kind": "film",
    "contact.geometry": "point",
    "contact.radius_mm": "9.525, inf",
    "contact.youngs_modulus_GPa": "207, 75",
    "contact.poisson_ratio": "0.3, 0.22",
}


def test_a_form_is_answered_at_once(desk):
    item = sent(desk, "films")
    assert len(read_record(item.folder / recordings.DRAFT)["open"]) == 5
    draft = asyncio.run(recordings.answered(desk, item, FILM))
    assert draft["open"] == []
    assert item.record["texts"] == {key: text for key, text in FILM.items() if key != "kind"}
    case = item.folder / "case" / "films"
    reading.write(*recordings._inputs(item), case)
    assert read_toml(case / "system.toml")["contact"]["radius_mm"] == [9.525, float("inf")]
    assert len(pd.read_csv(case / "recordings.csv")) == 20


def test_an_emptied_answer_is_taken_back_and_another_kind_drops_all(desk):
    item = sent(desk, "films")
    asyncio.run(recordings.answered(desk, item, FILM))
    draft = asyncio.run(recordings.answered(desk, item, {"contact.radius_mm": ""}))
    assert draft["open"] == ["contact.radius_mm"]
    draft = asyncio.run(recordings.answered(desk, item, {**FILM, "kind": "disc"}))
    assert item.record["texts"] == {"kind": "disc"}
    assert draft["kind"] in (None, "disc")


def test_a_german_file_needs_one_choice(desk):
    item = sent(desk, "german")
    draft = read_record(item.folder / recordings.DRAFT)
    assert draft["open"] == ["import.columns.friction_torque_Nm"]
    given = {"import.columns.friction_torque_Nm": "Reibmoment (Nm)", "import.columns.torque_Nm": "Lastmoment (Nm)"}
    draft = asyncio.run(recordings.answered(desk, item, given))
    assert (draft["open"], draft["count"]) == ([], 54)
    assert {one["name"] for one in draft["columns"]} >= {"speed_rpm", "torque_Nm", "friction_torque_Nm"}


def test_a_refused_answer_leaves_the_earlier_ones(desk):
    item = sent(desk, "films")
    asyncio.run(recordings.answered(desk, item, FILM))
    with pytest.raises(InputError, match=r"contact.radius_mm"):
        asyncio.run(recordings.answered(desk, item, {"contact.radius_mm": "-9.5, inf"}))
    assert item.record["texts"]["contact.radius_mm"] == "9.525, inf"


def test_a_run_that_was_cut_off_is_told_at_the_next_start(desk):
    item = sent(desk, "films")
    write_record(item.folder / "job.json", {"state": "running", "text": "searching"})
    again = Jobs(desk.store)
    assert again.state(item) == {"state": FAILED, "text": LOST}
    again.close()


def test_the_form_of_a_new_study_is_a_study_file(tmp_path):
    text = study_form.study_text(study_form.study_of(study_form.START, {}))
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    study = read_toml(tmp_path / "study.toml")
    assert study["pairings"] == {"every": ["0036", "0258", "0450"]}
    assert study["conditions"]["speed_rpm"] == {"from": 500, "to": 3000, "count": 6}
    one_sided = {**study_form.START, "place.shipped:0036": "pinion", "place.shipped:0450": "gear"}
    pairings = study_form.study_of(one_sided, {"own.csv": "profile"})["pairings"]
    assert pairings == {"pinion": ["0036", "0258"], "gear": ["0258", "0450"]}
    with pytest.raises(InputError, match="surfaces of the pinion: choose at least one surface"):
        study_form.study_of({key: t for key, t in study_form.START.items() if not key.startswith("place.")}, {})


def test_a_study_may_not_name_a_file_elsewhere():
    study = study_form.study_of(study_form.START, {})
    study["surfaces"]["0036"]["profile"] = "../../secret.txt"
    with pytest.raises(InputError, match="names a file outside this page"):
        study_form.study_text(study)


@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("title", "A: ground vs polished"),
        ("rig.name", "../old rig"),
        ("import.columns.speed_rpm", "n: 1/min"),
        ("import.columns.torque_Nm", "/Torque"),
        ("import.units.speed_rpm", "n: 1/min"),
    ],
)
def test_a_text_that_is_no_path_is_taken(key, text):
    assert reading.answers_of({key: text}, {}, []) == {key: text}


@pytest.mark.parametrize("text", ["C:/secret.txt", r"c:\secret.txt", r"\\host\share\a.txt", "/etc/passwd", "a/../../b"])
def test_a_path_outside_the_page_is_refused(text):
    with pytest.raises(InputError, match="names a file outside this page"):
        reading.answers_of({"surfaces.ground.profile": text}, {}, [])


def test_a_ranking_counts_where_a_pairing_is_best_and_inside_the_range():
    rows = [("a", "a", 1, 10.0, ""), ("a", "a", 2, 30.0, "not_quantitative; x"), ("b", "b", 1, 12.0, "")]
    rows += [("b", "b", 2, 20.0, "extrapolated_little")]
    names = ["pinion_surface", "gear_surface", "torque_Nm", "power_loss_W", "validity"]
    table = pd.DataFrame(rows, columns=names).assign(speed_rpm=500, oil_temperature_C=60)
    found = ranking(table)
    assert found["pinion_surface"].tolist() == ["b", "a"]
    assert found["mean_loss_W"].tolist() == [16.0, 20.0]
    assert found["over_best_percent"].tolist() == [0.0, 25.0]
    assert found["best_at_percent"].tolist() == [50.0, 50.0]
    assert found["quantitative_percent"].tolist() == [100.0, 50.0]
    with pytest.raises(InputError, match=r"'power_loss_W': is no table of a study|a column is missing"):
        ranking(table.drop(columns="power_loss_W"))


def test_costs_and_uncertainties_of_the_form_reach_the_study():
    texts = {**study_form.START, "uncertainty.viscosity": "0.06"}
    costs = {f"cost.shipped:{name}": cost for name, cost in (("0036", "3"), ("0258", "2"), ("0450", "1"))}
    study = study_form.study_of({**texts, **costs}, {})
    assert study["uncertainty"] == {"viscosity": 0.06}
    assert study["costs"] == {"0036": 3, "0258": 2, "0450": 1}
    study_form.study_text(study)
    with pytest.raises(InputError, match="costs: needs the cost of every surface in a pairing; missing: 0036"):
        study_form.study_text(study_form.study_of({**texts, **costs, "cost.shipped:0036": ""}, {}))
    with pytest.raises(InputError, match=r"costs\.0036"):
        study_form.study_text(study_form.study_of({**texts, **costs, "cost.shipped:0036": "cheap"}, {}))


def test_a_row_over_cutoffs_is_the_record_at_that_cutoff():
    trace = shipped("shipped:0258")
    row = next(one for one in over_cutoffs(trace, 0.4e-3) if one["cutoff_mm"] == 0.4)
    _, record = trace_record(trace, cutoff=0.4e-3)
    assert row["Ra_um"] == record["parameters"]["Ra_um"]
    assert row["density_per_mm2"] == record["asperities"]["density_per_mm2"]
