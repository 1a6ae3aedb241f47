"""The page in a browser without a network: from a dropped file to an answer, with a wrong file for each page."""

import csv
import io
import json
import re
import shutil
import time
import urllib.request
import zipfile
from pathlib import Path

import pytest

import profiles
from profiles.read import read
from roughness import trace_record
from tests.app.recordings_of_all_kinds import MADE_UP, table

pytest.importorskip("fastapi")
playwright = pytest.importorskip("playwright.sync_api")
CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None
)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium")
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
MOST_CLICKS = 6
TRACES = Path(profiles.__file__).parent / "traces"
PATIENCE = 60_000


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as driver:
        opened = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield opened
        opened.close()


@pytest.fixture
def page(browser, served):
    """The page at its start, with everything that it asked for and complained of; nothing leaves this machine."""
    asked, told = [], []
    context = browser.new_context(viewport={"width": 1280, "height": 900}, accept_downloads=True)
    opened = context.new_page()
    opened.set_default_timeout(PATIENCE)
    opened.on("request", lambda request: asked.append(request.url))
    opened.on("pageerror", lambda error: told.append(str(error)))
    opened.on("console", lambda message: told.append(message.text) if message.type == "error" else None)
    opened.goto(served[0])
    yield opened
    context.close()
    elsewhere = [url for url in asked if not url.startswith((served[0], "data:", "blob:", "about:"))]
    assert not elsewhere
    # A page that refuses a file has the status 422, which the console repeats.
    assert not [text for text in told if "422" not in text]


def fetched(url, data=None):
    """Answer of REST."""
    headers = {"content-type": "application/json"}
    request = urllib.request.Request(url, json.dumps(data).encode() if data else None, headers)
    with urllib.request.urlopen(request, timeout=120) as answer:
        return json.load(answer)


def drop(page, place, *files):
    """Drop files of given names and contents on an input."""
    given = [{"name": name, "mimeType": "application/octet-stream", "buffer": content} for name, content in files]
    page.locator(f"{place} input[type=file]").set_input_files(given)


class Clicks:
    """Counter of the clicks of a user: a dropped file, an opened choice and its entry, a field, a button."""

    count = 0

    def drop(self, page, place, *files):
        self.count += 1
        drop(page, place, *files)

    def choose(self, page, key, value):
        self.count += 2
        page.locator(f"select[name='{key}']").select_option(value)

    def press(self, page, name):
        self.count += 1
        page.get_by_role("button", name=name, exact=True).click()

    def fill(self, page, **texts):
        """Fill inputs in turn; the tabulator leads from one to the next."""
        self.count += 1
        for key, text in texts.items():
            field = page.locator(f"[name='{key}']")
            if not field.is_visible():
                self.count += 1
                page.locator("details", has=field).locator("summary").first.click()
            field.fill(text)


CHOICES = {"films": ("contact.geometry", "point"), "german": ("import.columns.friction_torque_Nm", "Reibmoment (Nm)")}
TEXTS = {
    "films": {
        "contact.radius_mm": "9.525, inf",
        "contact.youngs_modulus_GPa": "207, 75",
        "contact.poisson_ratio": "0.3, 0.22",
    },
    "german": {"import.columns.torque_Nm": "Lastmoment (Nm)"},
}


def to_a_run(page, name):
    """Clicks from the dropped file to the start of the diagnosis."""
    clicks = Clicks()
    clicks.drop(page, "#recording", (f"{name}.csv", MADE_UP[name]().encode()))
    page.wait_for_url("**/recordings/*")
    if name in CHOICES:
        clicks.choose(page, *CHOICES[name])
        clicks.fill(page, **TEXTS[name])
    clicks.press(page, "Diagnose")
    page.wait_for_selector("[data-job]")
    assert page.locator("img.plot").evaluate("one => one.complete && one.naturalWidth > 100")
    return clicks


@pytest.mark.parametrize(
    "name",
    [
        name if name == "films" else pytest.param(name, marks=pytest.mark.long)
        for name in sorted(set(MADE_UP) - {"driven_and_back_driven"})
    ],
)
def test_a_recording_is_diagnosed_within_six_clicks(page, name):
    clicks = to_a_run(page, name)
    assert clicks.count <= MOST_CLICKS
    page.get_by_role("button", name="Cancel").click()
    page.wait_for_selector(".state.failed")
    assert page.locator(".error").text_content().strip() == "cancelled ended on request; earlier results are kept"


@pytest.mark.long
@pytest.mark.parametrize("name", sorted(set(MADE_UP) - {"driven_and_back_driven"}))
def test_a_recording_leads_to_a_verdict(page, name):
    to_a_run(page, name)
    page.wait_for_selector("#answer .verdict", timeout=10 * PATIENCE)


@pytest.fixture(scope="module")
def filled():
    """A batch of tests filled in by the law of the drive."""

    def of(text):
        rows = list(csv.DictReader(io.StringIO(text)))
        for row in rows:
            speed, load = float(row["speed_rpm"]), float(row["torque_Nm"])
            sign, driven = (1 if speed > 0 else -1), (speed * load > 0) - (speed * load < 0)
            friction = sign * (2.0 + 0.03 * abs(speed) + 0.15 * abs(load) * (1 - 0.25 * driven))
            row["friction_torque_Nm"] = f"{friction:.5f}"
        return table(rows[0].keys(), [row.values() for row in rows])

    return of


@pytest.mark.long
def test_from_a_dropped_file_to_a_verdict_its_files_and_added_readings(page, served, filled):
    to_a_run(page, "driven_and_back_driven")
    address = page.url
    assert page.locator("[data-job] .text").text_content()
    page.goto("about:blank")
    # The run goes on without its page, and is found again.
    page.goto(served[0])
    assert "driven_and_back_driven.csv" in page.locator(".busy").text_content()
    page.get_by_role("link", name="driven_and_back_driven.csv").first.click()
    assert page.url == address
    page.wait_for_selector("#answer .verdict", timeout=10 * PATIENCE)
    assert "back driving" in page.locator("#answer .verdict").first.text_content()

    id = address.rpartition("/")[2]
    answer = fetched(f"{served[0]}/api/recordings/{id}/answer")
    written = served[1] / "recordings" / id / "answer" / "diagnosis.json"
    assert answer == json.loads(written.read_text(encoding="utf-8"))
    shown = page.locator("#answer tr", has_text="back driving").first.locator("td").last.text_content()
    assert float(shown) == pytest.approx(answer["probabilities"]["back_driving"], abs=0.005)
    report = page.frame_locator("iframe").locator("h1")
    assert "What does the simulation of this rig leave out?" in report.text_content()

    saved = {}
    for name in ("Report", "Improved model", "next_tests.csv", "Case", "All files"):
        with page.expect_download() as waiting:
            page.locator("#answer").get_by_role("link", name=name, exact=True).click()
        saved[name] = waiting.value.path().read_bytes()
    assert b"<html" in saved["Report"]
    packed = zipfile.ZipFile(io.BytesIO(saved["Improved model"]))
    assert {"system.toml", "recordings.csv"} <= set(packed.namelist())
    case = zipfile.ZipFile(io.BytesIO(saved["Case"]))
    assert "driven_and_back_driven/system.toml" in case.namelist()
    assert "report.html" in zipfile.ZipFile(io.BytesIO(saved["All files"])).namelist()

    drop(page, "#add", ("wrong.csv", b"nothing,of\nthe,kind\n"))
    page.wait_for_selector(".state.failed", timeout=PATIENCE)
    assert "wrong.csv" in page.locator(".error").text_content()
    assert page.locator("#answer .verdict").count() == 1
    drop(page, "#add", ("next_tests.csv", filled(saved["next_tests.csv"].decode()).encode()))
    page.wait_for_selector("#compared", timeout=10 * PATIENCE)
    before, after = page.locator("#compared .verdict").all_text_contents()
    campaign = json.loads((written.parent / "campaign.json").read_text(encoding="utf-8"))
    assert before == f"Before: {' + '.join(campaign['before']['verdict'])}".replace("_", " ")
    assert after == f"After: {' + '.join(campaign['after']['verdict'])}".replace("_", " ")


def test_a_wrong_recording_is_one_sentence_on_the_page(page, tmp_path):
    drop(page, "#recording", ("picture.png", b"\x89PNG\r\n\x1a\n" + bytes(4000)))
    assert page.locator(".error").text_content().startswith("picture.png: is not a text file or workbook")
    large = tmp_path / "large.csv"
    large.write_bytes(b"1,2\n" * (51 * 2**18))
    page.locator("#recording input[type=file]").set_input_files(large)
    page.wait_for_function("document.querySelector('#recording .drop span').textContent.includes('50 MB')")


def test_an_answer_out_of_range_is_one_sentence_and_the_form_is_kept(page):
    drop(page, "#recording", ("films.csv", MADE_UP["films"]().encode()))
    page.wait_for_url("**/recordings/*")
    page.get_by_role("button", name="Diagnose").click()
    assert "still to be answered" in page.locator(".error").text_content()
    page.locator("[name='contact.radius_mm']").fill("-9.5, inf")
    page.get_by_role("button", name="Update the preview").click()
    assert "contact.radius_mm" in page.locator(".error").text_content()
    page.locator("[name='contact.radius_mm']").fill("9.5, inf")
    page.get_by_role("button", name="Update the preview").click()
    page.wait_for_url("**/recordings/*")
    assert page.locator("[name='contact.radius_mm']").input_value() in ("9.5, inf", "[9.5, inf]")


@pytest.mark.long
def test_traces_show_parameters_and_the_consequences_of_cutoffs(page, tmp_path):
    contents = [(f"{name}.txt", (TRACES / f"{name}.txt").read_bytes()) for name in ("0036", "0258")]
    drop(page, "#surface", *contents, ("wrong.csv", b"no,trace\nat,all\n"))
    page.wait_for_selector("#parameters", timeout=PATIENCE)
    # One bad file is one sentence, and the others are done.
    assert "wrong.csv" in page.locator(".error").text_content()
    trace = tmp_path / "0036.txt"
    trace.write_bytes(contents[0][1])
    _, record = trace_record(read(trace))
    shown = page.locator("#parameters tr", has_text=re.compile("^Ra")).locator("td").nth(1).text_content()
    assert float(shown) == pytest.approx(record["parameters"]["Ra_um"], rel=1e-3)
    assert page.locator("img.plot").count() == 8
    row = page.locator("#over tr", has_text=re.compile("^0.8"))
    asked = float(row.locator("td").nth(1).text_content())
    row.get_by_role("button", name="take").click()
    page.wait_for_selector("#over tr.chosen:has-text('0.8')", timeout=PATIENCE)
    shown = page.locator("#parameters tr", has_text=re.compile("^Ra")).locator("td").nth(1).text_content()
    assert float(shown) == pytest.approx(asked, rel=0.01)


def test_a_wrong_trace_alone_is_one_sentence(page):
    drop(page, "#surface", ("wrong.csv", b"no,trace\nat,all\n"))
    page.wait_for_selector(".state.failed", timeout=PATIENCE)
    assert "wrong.csv" in page.locator(".error").text_content()


@pytest.mark.long
def test_pairings_are_ranked_by_their_mean_loss(page, served):
    page.goto(f"{served[0]}/pairings")
    drop(page, "main", ("wrong.csv", b"no,trace\nat,all\n"))
    page.get_by_role("button", name="Run the study").click()
    assert "wrong.csv" in page.locator(".error").text_content()
    page.locator("[name='conditions.torque_Nm']").fill("50, 150")
    page.locator("[name='conditions.speed_rpm']").fill("500 to 3000 in 2")
    page.get_by_role("button", name="Run the study").click()
    page.wait_for_selector("#ranking", timeout=10 * PATIENCE)
    id = page.url.rpartition("/")[2]
    with page.expect_download() as waiting:
        page.get_by_role("link", name="results.csv").first.click()
    rows = list(csv.DictReader(io.StringIO(waiting.value.path().read_text(encoding="utf-8"))))
    losses = {}
    for row in rows:
        losses.setdefault((row["pinion_surface"], row["gear_surface"]), []).append(float(row["power_loss_W"]))
    expected = sorted((sum(one) / len(one), *pair) for pair, one in losses.items())
    shown = page.locator("#ranking tr").all_inner_texts()[1:]
    assert len(shown) == len(expected) == 6
    for text, (loss, pinion, gear) in zip(shown, expected, strict=True):
        cells = text.split()
        assert cells[1:3] == [pinion, gear]
        assert float(cells[3]) == pytest.approx(loss, rel=1e-3)
    for plot in page.locator("#ranking img.plot").all():
        assert plot.evaluate("one => one.complete && one.naturalWidth > 100")
    assert page.locator("#ranking img.plot").count() == 3
    ranking = fetched(f"{served[0]}/api/pairings/{id}")["ranking"]
    assert ranking[0]["mean_loss_W"] == pytest.approx(expected[0][0])
    assert ranking[0]["place_low90"] == 1
    assert page.frame_locator("iframe").locator("h1").text_content() == "Pairings"


@pytest.mark.long
def test_two_runs_at_once_go_one_after_the_other(served):
    study = {
        "schema": "mixedlub-study/1",
        "title": "Two",
        "gears": {"preset": "fzg_c"},
        "lubricant": {"oil": "atf"},
        "surfaces": {"fine": {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036}},
        "conditions": {"torque_Nm": [50], "speed_rpm": [500], "oil_temperature_C": [60]},
    }

    def ask(path, data=None):
        return fetched(f"{served[0]}/api/{path}", data)

    first, second = (ask("pairings", {**study, "title": name})["id"] for name in ("one", "two"))
    seen = set()
    while True:
        states = tuple(ask(f"pairings/{id}/job")["state"] for id in (first, second))
        seen.add(states)
        if states[1] not in ("waiting", "running"):
            break
        time.sleep(0.1)
    assert ("running", "waiting") in seen
    assert ("running", "running") not in seen
    assert states == ("done", "done")
