"""The page of published numbers is what its script writes."""

import runpy
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "examples" / "published"


@pytest.mark.long
def test_page_is_what_the_script_writes():
    script = runpy.run_path(str(FOLDER / "points.py"))
    assert (FOLDER / "points.md").read_text(encoding="utf-8") == script["page"]()
