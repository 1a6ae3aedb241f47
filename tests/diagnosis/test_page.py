"""The page stands alone: opened offline in a browser it shows everything."""

from __future__ import annotations

import re
import shutil
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.report.html import _cards, render
from mixedlub.diagnosis.report.text import words
from mixedlub.diagnosis.report.text.headline import chance, percent
from mixedlub.schema.findings import finding

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Reader(HTMLParser):
    """Collects ids, tags, links and visible text."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.tags: list[str] = []
        self.links: list[str] = []
        self.text: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        for name, value in attrs:
            if name == "id":
                self.ids.append(value or "")
            if name in ("src", "href", "xlink:href"):
                self.links.append(value or "")

    def handle_data(self, data: str) -> None:
        self.text.append(data)


@pytest.fixture(scope="module")
def page(offset_files: dict[str, str]) -> str:
    """The page of the offset rig."""
    return offset_files["report.html"]


@pytest.fixture(scope="module")
def read(page: str) -> Reader:
    """The page, parsed."""
    reader = Reader()
    reader.feed(page)
    return reader


def test_page_needs_nothing_beside_itself(read: Reader) -> None:
    assert all(link.startswith(("#", "data:image/png;")) for link in read.links)
    assert not {"script", "link", "img", "iframe"} & set(read.tags)


def test_ids_of_all_drawings_are_unique(read: Reader) -> None:
    assert len(read.ids) == len(set(read.ids))


def test_drawings_refer_only_to_what_is_there(page: str, read: Reader) -> None:
    used = set(re.findall(r"url\(#([^)]+)\)", page)) | {link[1:] for link in read.links if link[0] == "#"}
    assert used <= set(read.ids)


def test_every_figure_stands_in_the_page(offset_files: dict[str, str], page: str) -> None:
    names = [n.removeprefix("figures/").removesuffix(".svg") for n in offset_files if n.startswith("figures/")]
    assert page.count("<figure>") == len(names)
    for name in names:
        assert f'id="{name}-figure_1"' in page


def test_every_figure_has_a_caption(page: str) -> None:
    assert page.count("<figcaption>") == page.count("<figure>")


def test_every_table_scrolls_where_it_does_not_fit(page: str) -> None:
    assert page.count("<table>") == page.count('<div class="scroll"><table>') > 0
    assert ".scroll { overflow-x: auto; }" in page


def test_page_and_text_say_the_same(offset: Diagnosis, read: Reader) -> None:
    shown = re.sub(r"\s+", " ", " ".join(read.text))
    for section in words.sections(offset):
        for sentence in (*section.alarms, *section.sentences, *section.items):
            if not sentence.startswith("Equation:"):
                assert sentence in shown


def test_page_of_an_unnamed_mismatch_is_written(unnamed_files: dict[str, str]) -> None:
    page = unnamed_files["report.html"]
    assert "If it is something unknown" in page
    assert 'id="absorbing_stages-figure_1"' in page


def test_bars_of_evidence_are_not_called_a_fitted_form(unnamed_files: dict[str, str]) -> None:
    page = unnamed_files["report.html"]
    assert "against the empirical form" not in page
    assert "the longer the bar" in page


def test_doubts_stand_above_the_headline_of_the_page(offset: Diagnosis) -> None:
    doubtful = replace(offset, warnings=(finding("readings_in_other_unit", "check the unit"),))
    page = render(doubtful, words.sections(doubtful), {})
    assert page.index('<p class="alarm">Doubtful: check the unit.</p>') < page.index('<p class="verdict">')


def test_list_and_heading_of_a_tie_stand_in_the_page(offset: Diagnosis) -> None:
    weights = {
        **offset.posterior.weights,
        Explanation.of("sensor_offset"): 0.5,
        Explanation.of("inlet_shear_heating"): 0.4,
    }
    pair = (Explanation.of("sensor_offset"), Explanation.of("inlet_shear_heating"))
    tied = replace(offset, posterior=replace(offset.posterior, weights=weights, verdict=pair[0], tied=pair))
    page = render(tied, words.sections(tied), {})
    assert page.count("<li>") == 2
    assert f"<h2>{words.BEST_TIED}</h2>" in page


def test_case_text_is_escaped(offset: Diagnosis) -> None:
    system = offset.case.system.model_copy(update={"description": "<b>loss & more</b>"})
    named = replace(offset, case=replace(offset.case, system=system))
    assert "&lt;b&gt;loss &amp; more&lt;/b&gt;" in render(named, words.sections(named), {})


def test_no_probability_is_certain(offset: Diagnosis) -> None:
    verdict = offset.posterior.verdict
    for weight, shown in ((0.99999, ">99 %"), (0.001, "<1 %"), (0.42, "42 %")):
        weights = {**offset.posterior.weights, verdict: weight}
        sure = replace(offset, posterior=replace(offset.posterior, weights=weights))
        assert _cards(sure)[1][0] == shown


@pytest.mark.parametrize("p", [0.0, 0.005, 0.0055, 0.006, 0.125, 0.285, 0.42, 0.994, 0.9945, 0.995, 0.9951, 1.0])
def test_cards_and_text_round_a_probability_alike(p: float) -> None:
    said, card = chance(p), percent(p)
    ends = {"above 0.99": ">99 %", "below 0.01": "<1 %"}
    assert card == (ends[said] if said in ends else f"{100 * float(said):.0f} %")


def test_what_has_no_name_is_not_drawn_as_left_out(unnamed_files: dict[str, str]) -> None:
    page = unnamed_files["report.html"]
    assert 'id="missing_part-figure_1"' in page
    assert f"<h2>{words.LEFT_OUT}</h2>" not in page


def test_residuals_of_nothing_missing_stand_with_the_test_for_it(complete: Diagnosis) -> None:
    page = render(complete, words.sections(complete), {"residual_map": '<svg id="drawn"/>'})
    assert f"<h2>{words.WHERE}</h2>" not in page
    assert page.index(f"<h2>{words.MISMATCH}</h2>") < page.index("drawn") < page.index(f"<h2>{words.ALIKE}</h2>")


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here")
def test_browser_shows_the_page_offline(page: str, tmp_path: Path) -> None:
    assert CHROMIUM is not None
    path = tmp_path / "report.html"
    path.write_text(page, encoding="utf-8")
    picture = tmp_path / "page.png"
    command = [
        CHROMIUM,
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--hide-scrollbars",
        "--host-resolver-rules=MAP * ~NOTFOUND",
        f"--user-data-dir={tmp_path / 'browser'}",
        "--window-size=900,3000",
        f"--screenshot={picture}",
        path.as_uri(),
    ]
    subprocess.run(command, check=True, capture_output=True, timeout=90)
    from matplotlib.image import imread

    seen = imread(picture)[..., :3]
    blocks = [seen[top : top + 600].std() for top in range(0, 3000, 600)]
    assert min(blocks) > 0.02, "a part of the page is blank"
