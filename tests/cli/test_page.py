"""The page of a study: self-contained, and its chart does in a browser what its lists, legend and links offer."""

import csv
import itertools
import re
import shutil
import subprocess

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.report.equations import equation
from tests.cli.test_commands import STUDY

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    here = tmp_path_factory.mktemp("page")
    study = STUDY.replace('title = "Trial"', 'title = "Trial <of> a & page"')
    (here / "trial.toml").write_text(study + "[effects]\ninlet_shear_heating = { strength = 0.5 }\n")
    assert main(["study", str(here / "trial.toml"), "--out", str(here / "out")]) == 0
    return here / "out"


@pytest.fixture(scope="module")
def page(folder):
    return (folder / "index.html").read_text(encoding="utf-8")


SCRIPTS = re.compile(r"<script>.*?</script>", re.DOTALL)


def test_page_needs_nothing_from_elsewhere(page):
    text, count = SCRIPTS.subn("", page)
    assert count == 2
    assert "<script" not in text
    assert not re.search(r"""(?:src|href|url)\s*[=(]\s*["']?(?:https?:)?//""", text)
    links = {link.partition(",")[0] for link in re.findall(r'href="([^"#][^"]*)"', text)}
    assert links == {
        "results.csv",
        "ranking.csv",
        "results.parquet",
        "resolved.json",
        "figures/",
        "data:text/csv;charset=utf-8",
    }


def test_page_escapes_what_the_user_wrote(page):
    assert "Trial &lt;of&gt; a &amp; page" in page
    assert "<of>" not in page


def test_page_states_options_definitions_warnings_laws_and_effects(page):
    for words in (
        "dowson_toyoda_central",
        "mesh_integral",
        "mean over the path weighted by load times sliding speed",
        "plain mean over the path of contact",
        "asperities would carry more than the load",
        "D. Dowson, S. Toyoda",
        "J. A. Greenwood, J. B. P. Williamson",
        "P. K. Gupta",
        "inlet_shear_heating",
        "Composite roughness",
    ):
        assert words in page, words


def test_page_states_the_inputs_it_assumed_and_the_study_file(page, folder):
    import html

    inputs = page[page.index('id="inputs"') : page.index('id="options"')]
    for key, value in (("tip_diameter_mm", "80.43333 / 118.5333 mm"), ("centre_distance_mm", "91.01667 mm")):
        assert re.search(rf"<code>{key}</code></td><td>{value} <i>\(assumed\)</i>", inputs), key
    assert "<td>boundary friction coefficient</td><td>0.1 <i>(assumed)</i>" in inputs
    for words in ("helix_angle_deg", "profile_shift", "load_sharing", "transverse contact ratio"):
        assert words in inputs, words
    (given,) = re.findall(r"<details>.*?<pre>(.*?)</pre>", inputs, re.DOTALL)
    assert html.unescape(given).strip() == (folder.parent / "trial.toml").read_text(encoding="utf-8").strip()


def test_laws_are_told_without_names_of_the_program(page):
    laws = SCRIPTS.sub("", re.sub(r"<svg.*?</svg>", "", page[page.index('id="laws"') :], flags=re.DOTALL))
    assert "`" not in laws
    assert not re.search(r"\b(path_weight|contact_width|roughness\.guards|the last axis)\b", laws)
    assert "film thickness (effect: inlet shear heating)" in laws


def test_every_equation_is_set(page):
    laws = SCRIPTS.sub("", page[page.index('id="laws"') :])
    assert laws.count('class="equation"') > 10
    assert "<code>" not in laws


def test_arrows_are_set_as_arrows():
    drawn = equation(r"h \leftarrow \left(h\right)")
    assert "<svg" in drawn
    assert drawn.count("M") < equation(r"h arrow (h)").count("M")


def test_figures_lie_beside_the_page_as_files(folder, page):
    names = {p.name for p in (folder / "figures").iterdir()}
    assert {"power_loss_equal.svg", "loss_over_roughness.svg", "loss_over_film_parameter.svg"} <= names
    assert page.count("<figure") == len(names)


def test_same_study_gives_the_same_page(folder, tmp_path):
    assert main(["study", str(folder.parent / "trial.toml"), "--out", str(tmp_path / "again")]) == 0
    assert (tmp_path / "again" / "index.html").read_bytes() == (folder / "index.html").read_bytes()


@pytest.mark.skipif(CHROMIUM is None, reason="no chromium")
def test_page_opens_in_a_browser(folder, tmp_path):
    from matplotlib.image import imread

    shot = tmp_path / "page.png"
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1000,2400"]
    profile = f"--user-data-dir={tmp_path / 'browser'}"
    address = (folder / "index.html").as_uri()
    command = [str(CHROMIUM), *flags, profile, f"--screenshot={shot}", address]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    picture = imread(shot)[..., :3]
    assert picture.shape[:2] == (2400, 1000)
    inked = (picture < 0.95).any(axis=2)
    assert 0.02 < inked.mean() < 0.6
    assert inked[1200:].any()
    coloured = np.ptp(picture, axis=2) > 0.3
    assert coloured.sum() > 500


MARKS = "#chart :is(g.within_marks, g.outside_marks) > path"
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
AT_FIRST = {"at_speed": "3000", "at_torque": "150"}


@pytest.fixture(scope="module")
def rows(folder):
    with (folder / "results.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def noticed():
    """What the page fetches, and what it complains of."""
    return []


@pytest.fixture(scope="module")
def opened(folder, noticed):
    if CHROMIUM is None:
        pytest.skip("no chromium")
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        page = browser.new_context(viewport={"width": 1280, "height": 1000}, offline=True).new_page()
        page.set_default_timeout(30_000)
        page.on("request", lambda request: noticed.append(request.url))
        page.on("console", lambda message: noticed.append(message.text))
        page.on("pageerror", lambda error: noticed.append(str(error)))
        page.goto((folder / "index.html").as_uri())
        page.wait_for_selector("#chart svg")
        yield page
        browser.close()


@pytest.fixture
def chart(opened):
    """The page as it is when it opens."""
    for name in opened.locator("#chart select").evaluate_all("all => all.map(one => one.name)"):
        choose(opened, name, AT_FIRST.get(name))
    opened.locator("#chart g.role-legend-label text").first.dblclick()
    opened.mouse.move(5, 5)
    return opened


def choose(page, name, text=None):
    """Choose from a list of the chart; without a text the first entry."""
    page.locator(f"#chart select[name={name}]").select_option(**({"label": text} if text else {"index": 0}))


def texts(page):
    return page.locator("#chart svg text").all_text_contents()


def drawn(page):
    """Abscissa, quantity and colour of every mark, as a screen reader has them."""
    labels = page.locator(MARKS).evaluate_all("all => all.map(one => one.getAttribute('aria-label'))")
    parts = [dict(part.split(": ", 1) for part in label.split("; ")) for label in labels]
    return {(float(one["x"]), float(one["y"]), one["colour"]) for one in parts}


def expected(rows, abscissa, quantity, **held):
    """The same marks by the table of the study."""
    return {
        (float(row[abscissa]), float(f"{float(row[quantity]):.5g}"), f"{row['pinion_surface']} / {row['gear_surface']}")
        for row in rows
        if all(float(row[name]) == level for name, level in held.items())
    }


def test_nothing_is_fetched_and_nothing_fails(chart, folder, noticed):
    assert noticed == [(folder / "index.html").as_uri()]


def test_it_opens_with_the_loss_over_speed_at_the_highest_torque(chart, rows):
    assert {"power loss (W)", "pinion speed (rpm)", "torque 150 N m, oil temperature 60 °C"} <= set(texts(chart))
    assert drawn(chart) == expected(rows, "speed_rpm", "power_loss_W", torque_Nm=150)
    hollow = sum(row["validity"] != "valid" for row in rows if float(row["torque_Nm"]) == 150)
    assert chart.locator("#chart g.outside_marks > path").count() == hollow > 0


@pytest.mark.parametrize(
    ("quantity", "text"),
    [
        ("mean_friction", "mean friction (-)"),
        ("minimum_film_parameter", "minimum film parameter (-)"),
        ("boundary_area_ratio", "boundary area ratio (-)"),
    ],
)
def test_quantity_is_chosen(chart, rows, quantity, text):
    choose(chart, "quantity", text)
    assert text in texts(chart)
    assert drawn(chart) == expected(rows, "speed_rpm", quantity, torque_Nm=150)


def test_abscissa_and_conditions_are_chosen(chart, rows):
    choose(chart, "abscissa", "pinion torque (N m)")
    choose(chart, "at_speed", "500")
    assert {"pinion torque (N m)", "speed 500 rpm, oil temperature 60 °C"} <= set(texts(chart))
    assert drawn(chart) == expected(rows, "torque_Nm", "power_loss_W", speed_rpm=500)
    choose(chart, "abscissa", "composite roughness (µm)")
    choose(chart, "at_torque", "all")
    marks = {(y, colour) for _, y, colour in drawn(chart)}
    assert marks == {(y, colour) for _, y, colour in expected(rows, "torque_Nm", "power_loss_W", speed_rpm=500)}
    assert chart.locator("#chart g.lines_marks").count() == 0


def test_colours_are_of_pairings_or_of_a_condition(chart):
    choose(chart, "at_torque", "all")
    choose(chart, "colour_by", "torque")
    assert chart.locator("#chart g.role-legend-label text").all_text_contents() == ["50 N m", "150 N m"]
    assert chart.locator("#chart g.lines_marks").count() == 6


def test_surfaces_are_chosen(chart, rows):
    choose(chart, "one_surface", "coarse")
    assert {colour for *_, colour in drawn(chart)} == {"fine / coarse", "coarse / coarse"}
    choose(chart, "other_surface", "fine")
    assert {colour for *_, colour in drawn(chart)} == {"fine / coarse"}


def opacities(page):
    lines = page.locator("#chart g.lines_marks > path")
    found = lines.evaluate_all("all => all.map(one => [one.getAttribute('aria-label'), one.getAttribute('opacity')])")
    return {label.partition("colour: ")[2].partition(";")[0]: float(opacity) for label, opacity in found}


def test_names_of_the_legend_single_out_lines(chart):
    legend = chart.locator("#chart g.role-legend-label text")
    assert set(opacities(chart).values()) == {1.0}
    legend.filter(has_text="fine / coarse").click()
    assert opacities(chart) == {"fine / fine": 0.08, "fine / coarse": 1.0, "coarse / coarse": 0.08}
    legend.filter(has_text="fine / fine").click()
    assert opacities(chart) == {"fine / fine": 1.0, "fine / coarse": 1.0, "coarse / coarse": 0.08}
    legend.filter(has_text="fine / fine").click()
    assert opacities(chart) == {"fine / fine": 0.08, "fine / coarse": 1.0, "coarse / coarse": 0.08}
    choose(chart, "colour_by", "speed")
    choose(chart, "colour_by")
    assert set(opacities(chart).values()) == {1.0}


def test_a_mark_shows_every_number_of_its_row(chart, rows):
    chart.locator("#chart g.outside_marks > path").first.scroll_into_view_if_needed()
    box = chart.locator("#chart g.outside_marks > path").first.bounding_box()
    chart.mouse.move(box["x"] + box["width"] / 2 + 2, box["y"] + box["height"] / 2 + 2)
    tip = chart.locator("#vg-tooltip-element.visible")
    tip.wait_for()
    title = tip.locator("h2").inner_text()
    cells = dict(zip(tip.locator("td.key").all_inner_texts(), tip.locator("td.value").all_inner_texts(), strict=True))
    shown = {key.strip(": "): value for key, value in cells.items()}
    (row,) = [
        row
        for row in rows
        if f"{row['pinion_surface']} / {row['gear_surface']}" == title
        and (row["speed_rpm"], row["torque_Nm"]) == (shown["pinion speed (rpm)"], "150")
    ]
    assert row["validity"] == shown["validity"] != "valid"
    assert float(shown["power loss (W)"]) == pytest.approx(float(row["power_loss_W"]), rel=5e-5)
    assert float(shown["contact temperature (°C)"]) == pytest.approx(float(row["contact_temperature_C"]), rel=5e-5)
    assert len(shown) == len(row) - 2


def test_it_is_saved_as_a_picture(chart):
    choose(chart, "quantity", "mean friction (-)")
    for form, start in (("SVG", b"<svg"), ("PNG", b"\x89PNG")):
        with chart.expect_download() as saving:
            chart.get_by_text(f"Save as {form}").click()
        assert saving.value.suggested_filename == f"trial.{form.lower()}"
        assert saving.value.path().read_bytes().startswith(start)


def test_all_its_rows_are_saved_as_a_table(chart, rows):
    choose(chart, "one_surface", "fine")
    with chart.expect_download() as saving:
        chart.get_by_text("Save all these conditions as CSV").click()
    assert saving.value.suggested_filename == "trial_chart.csv"
    with saving.value.path().open(encoding="utf-8") as file:
        saved = list(csv.DictReader(file))
    assert len(saved) == len(rows)
    assert saved[0].keys() == rows[0].keys()
    losses = [sorted(float(row["power_loss_W"]) for row in table) for table in (saved, rows)]
    assert losses[0] == pytest.approx(losses[1], rel=5e-5)


def test_ticks_and_names_stand_apart(chart):
    """Ticks of the abscissa by at least 50 pixels, rows of the legend by at least 4."""
    ticks = (
        chart.locator("#chart g.role-axis-label")
        .first.locator("text")
        .evaluate_all("all => all.map(one => one.getBoundingClientRect().x)")
    )
    assert 4 <= len(ticks) <= 12
    assert np.diff(ticks).min() > 50
    choose(chart, "colour_by", "pairing")
    names = chart.locator("#chart g.role-legend-label text").evaluate_all(
        "all => all.map(one => { const b = one.getBoundingClientRect(); return [b.left, b.right, b.top, b.bottom]; })"
    )
    for one, other in itertools.combinations(names, 2):
        beside = one[1] + 14 < other[0] or other[1] + 14 < one[0]
        assert beside or one[3] + 4 <= other[2] or other[3] + 4 <= one[2]


def test_it_fits_a_narrow_window(chart):
    chart.set_viewport_size({"width": 400, "height": 900})
    chart.wait_for_function("document.querySelector('#chart svg').clientWidth < 400")
    assert chart.evaluate("document.documentElement.scrollWidth") == 400
    chart.set_viewport_size({"width": 1280, "height": 1000})
    chart.wait_for_function("document.querySelector('#chart svg').clientWidth > 900")
