"""The pages: every block is one that the build runs, and numbers in the text are those of the code."""

import re
from pathlib import Path

import pytest

from mixedlub.diagnosis.settings.assessment import DRAWS, TIE
from mixedlub.diagnosis.settings.inference import OUTLIER_SHARE, SPIKE
from mixedlub.diagnosis.settings.search import MOST_INFLATION

DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted(p for p in DOCS.rglob("*.md") if not {"made"} & set(p.relative_to(DOCS).parts))
BUILT = {"run", "file", "picture", "figure", "toctree", "include", "literalinclude", "eval-rst"}
"""Directives of the build: what they show was run, or comes from a file."""
SHOWN = {
    *("contributing.md", "index.md", "howto/app.md", "howto/cluster.md"),
    *("validation/batteries.md", "validation/concealed.md"),
}
"""Pages with commands that install or take long, as text."""


def opened(text: str) -> list[str]:
    """What each fence of a page opens."""
    return re.findall(r"^```(\S.*)$", text, re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(DOCS)))
def test_every_block_is_run_by_the_build(page):
    for fence in opened(page.read_text(encoding="utf-8")):
        name = fence.partition("}")[0].lstrip("{")
        assert name in BUILT or (fence == "text" and str(page.relative_to(DOCS)) in SHOWN), fence


def test_numbers_of_the_inference_are_those_of_the_code():
    text = " ".join((DOCS / "method/inference.md").read_text(encoding="utf-8").split())
    assert f"prior probability of {100 * OUTLIER_SHARE:g} %" in text
    assert f"up to a factor of {MOST_INFLATION:g}" in text
    assert f"{DRAWS} recordings drawn" in text
    assert {0.1: "at least a tenth of its probability"}[TIE] in text
    assert {0.5: "half of its prior mass lies on this formula"}[SPIKE] in text


def test_real_recordings_are_called_a_development_set():
    for path in (DOCS / "validation/real.md", DOCS.parent / "examples/real/README.md"):
        text = path.read_text(encoding="utf-8").lower()
        assert "development set" in text
        assert "no independent proof" in text or "prove nothing" in text
