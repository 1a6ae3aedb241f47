"""The code against itself: no number of the shipped study moves unnoticed."""

import pandas as pd
import pytest

from .study_map import MAP, computed

pytestmark = pytest.mark.golden


def test_the_378_conditions_are_as_they_were() -> None:
    golden = pd.read_csv(MAP, dtype={"pinion_surface": str, "gear_surface": str})
    assert len(golden) == 378
    pd.testing.assert_frame_equal(computed(), golden, check_dtype=False, rtol=1e-9, atol=0.0)
