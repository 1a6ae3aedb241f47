"""Viscosity index: the worked examples and the table of the standard."""

from itertools import pairwise

import numpy as np
import pytest

from mixedlub.laws.viscosity_index import REFERENCE_OILS, viscosity_index

# ASTM D2270: viscosity at 100 degC, and at 40 degC of the oils of index 0 and 100, all in mm^2/s.
TABLE = [
    (2.0, 7.994, 6.394),
    (5.0, 40.23, 28.49),
    (10.0, 147.7, 82.87),
    (18.9, 445.7, 211.0),
    (30.0, 1023.0, 421.7),
    (50.0, 2618.0, 919.6),
    (70.0, 4905.0, 1558.0),
]


@pytest.mark.parametrize(("at_40", "at_100", "index"), [(73.30, 8.86, 92), (22.83, 5.05, 156)])
def test_worked_examples_of_the_standard(at_40, at_100, index):
    assert round(viscosity_index(at_40 * 1e-6, at_100 * 1e-6)) == index


@pytest.mark.parametrize(("at_100", "low", "high"), TABLE)
def test_oils_of_the_table_have_index_0_and_100(at_100, low, high):
    assert viscosity_index(low * 1e-6, at_100 * 1e-6) == pytest.approx(0.0, abs=0.5)
    assert viscosity_index(high * 1e-6, at_100 * 1e-6) == pytest.approx(100.0, abs=0.5)


def test_stretches_meet():
    for row, beyond in pairwise(REFERENCE_OILS):
        for i in (1, 4):
            assert np.polyval(row[i : i + 3], row[0]) == pytest.approx(np.polyval(beyond[i : i + 3], row[0]), rel=2e-3)


def test_thin_oils_have_none():
    assert np.isnan(viscosity_index(4e-6, 1.5e-6))
