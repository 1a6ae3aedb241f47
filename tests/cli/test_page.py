"""The page of a study: self-contained, and it opens in a real browser."""

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


def test_page_needs_nothing_from_elsewhere(page):
    assert "<script" not in page
    assert not re.search(r"""(?:src|href|url)\s*[=(]\s*["']?(?:https?:)?//""", page)
    links = {link for link in re.findall(r'href="([^"#][^"]*)"', page) if not link.startswith("#")}
    assert links == {"results.csv", "results.parquet", "resolved.json", "figures/"}


def test_page_escapes_what_the_user_wrote(page):
    assert "Trial &lt;of&gt; a &amp; page" in page
    assert "<of>" not in page


def test_page_states_options_definitions_warnings_laws_and_effects(page):
    for words in (
        "dowson_toyoda_central",
        "mesh_integral",
        "mean over the path weighted by load times sliding speed",
        "plain mean over the path of contact",
        "times the mean Hertz pressure",
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
    for words in ("helix_angle_deg", "profile_shift", "load_sharing", "transverse contact ratio"):
        assert words in inputs, words
    (given,) = re.findall(r"<details>.*?<pre>(.*?)</pre>", inputs, re.DOTALL)
    assert html.unescape(given).strip() == (folder.parent / "trial.toml").read_text(encoding="utf-8").strip()


def test_laws_are_told_without_names_of_the_program(page):
    laws = re.sub(r"<svg.*?</svg>", "", page[page.index('id="laws"') :], flags=re.DOTALL)
    assert "`" not in laws
    assert not re.search(r"\b(path_weight|contact_width|roughness\.guards|the last axis)\b", laws)
    assert "film thickness (effect: inlet shear heating)" in laws


def test_every_equation_is_set(page):
    laws = page[page.index('id="laws"') :]
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
