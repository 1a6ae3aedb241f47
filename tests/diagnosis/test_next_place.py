"""Where an unnamed mismatch stands, and what to do next about it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.report.text import location_text, next_test_text, words
from mixedlub.effects import catalogue


def test_without_a_name_the_place_may_be_the_other_end(unnamed: Diagnosis, offset: Diagnosis) -> None:
    assert location_text.LEVEL in location_text.where(unnamed)
    assert location_text.LEVEL not in location_text.where(offset)
    everywhere = replace(unnamed.region, inside=np.ones_like(unnamed.region.inside))
    assert location_text.LEVEL not in location_text.where(replace(unnamed, region=everywhere))


def test_a_mismatch_that_goes_with_names_has_no_levels(unnamed: Diagnosis) -> None:
    by_name = replace(unnamed.search.discrepancy.best, axes=("surfaces",), at=None, waves=0.0)
    found = replace(unnamed.search, discrepancy=replace(unnamed.search.discrepancy, best=by_name))
    cut = {"column": "pinion_surface", "values": ["polished"]}
    d = replace(unnamed, search=found, region=replace(unnamed.region, where=(cut,)))
    assert words._form(d, "surfaces").startswith("differs between surfaces, as ")
    said = " ".join(next_test_text.next_test(d))
    assert "repeat readings with pinion surface polished and with others in its place." in said
    assert "levels" not in said
    assert "a column setup" in said
    both = replace(d, region=replace(d.region, where=(cut, {"column": "speed_rpm", "low": 1e3, "high": 2e3})))
    assert "refine and repeat the levels around speed 1000 to 2000 rpm." in next_test_text.next_test(both)[0]


def test_a_mismatch_over_numbers_asks_for_levels_and_no_set_ups(unnamed: Diagnosis) -> None:
    said = " ".join(next_test_text.next_test(unnamed))
    assert "speed 1500 rpm" in said
    assert "setup" not in said


def test_the_reference_that_tells_drift_serves_every_instrument() -> None:
    said = catalogue()["sensor_drift"].separated_by
    assert "reference oil" in said
    assert "flanks" not in said


def test_only_a_narrow_range_is_read_around(unnamed: Diagnosis) -> None:
    smooth = replace(unnamed.search.discrepancy.best, axes=(), at=None)
    d = replace(unnamed, search=replace(unnamed.search, discrepancy=replace(unnamed.search.discrepancy, best=smooth)))
    asked = {
        ("speed_rpm", 500.0, 1000.0): "refine and repeat the levels around speed 500 to 1000 rpm.",
        ("speed_rpm", 500.0, 2000.0): "read at more levels within speed 500 to 2000 rpm.",
        ("sequence", 0.0, 0.2): "run the programme again, with more readings within sequence 0 to 0.2.",
    }
    for (name, low, high), wanted in asked.items():
        cut = {"column": name, "low": low, "high": high}
        said = next_test_text.next_test(replace(d, region=replace(d.region, where=(cut,))))[0]
        assert said == f"To learn its form, {wanted}"
    nowhere = next_test_text.next_test(replace(d, region=replace(d.region, where=())))[0]
    assert nowhere == "To learn its form, refine and repeat the levels of all conditions."
