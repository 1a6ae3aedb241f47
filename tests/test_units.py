"""The one table of units: sizes by definition, conversions that round once, endings of every key and column."""

import pytest

from mixedlub.chain.quantities import GLOSSARY
from mixedlub.kinds import KINDS, kind
from mixedlub.schema.section import tables
from mixedlub.schema.system_file import System
from mixedlub.schema.units import ENDINGS, SLIPS, UNITS, change, dimension, ending_of, measure, read_as, tidy, unit_of
from mixedlub.study.schema import StudyFile
from profiles.units import METRES

BY_DEFINITION = [
    ("psi", "MPa", 4.4482216152605 / 0.0254**2 * 1e-6),
    ("lbf.ft", "N.m", 4.4482216152605 * 0.3048),
    ("kgf", "N", 9.80665),
    ("atm", "MPa", 0.101325),
    ("cP", "mPa.s", 1.0),
    ("rev/s", "rpm", 60.0),
    ("deg/s", "rpm", 1.0 / 6.0),
    ("cm2/s", "mm2/s", 100.0),
    ("kJ/(kg.K)", "J/(kg.K)", 1e3),
]


@pytest.mark.parametrize(("unit", "wanted", "factor"), BY_DEFINITION)
def test_a_unit_has_the_size_of_its_definition(unit, wanted, factor):
    assert change(unit, wanted) == (pytest.approx(factor, rel=4e-16), 0.0)


@pytest.mark.parametrize(("fahrenheit", "celsius"), [(32.0, 0.0), (212.0, 100.0), (-40.0, -40.0)])
def test_degrees_fahrenheit_meet_those_of_celsius(fahrenheit, celsius):
    factor, added = change("degF", "degC")
    assert factor * fahrenheit + added == pytest.approx(celsius, abs=1e-13)


def test_lengths_are_those_of_the_traces():
    assert {unit: float(measure(unit)[0]) for unit in METRES} == METRES


def test_every_quantity_of_the_glossary_has_a_known_unit():
    assert all(len(dimension(q.unit)) == 4 for q in GLOSSARY.values() if q.unit != "*")


@pytest.mark.parametrize("unit", ["furlong", "mX", "N furlong"])
def test_an_unknown_unit_has_no_size(unit):
    with pytest.raises(KeyError):
        measure(unit)


def test_every_ending_that_is_read_is_shown_and_read_as_itself():
    for table in (UNITS, SLIPS):
        for ending, units in table.items():
            assert ending in ENDINGS or ending in ("ratio", "cycle")
            assert (1.0, 0.0) in units.values() or table is SLIPS


@pytest.mark.parametrize("name", KINDS)
def test_every_column_of_a_kind_is_read_in_some_unit(name):
    found = kind(name)
    assert all(read_as(c.name) in UNITS for c in (*found.columns, *found.instrument_channels, *found.readings))


@pytest.mark.parametrize("file", [System, StudyFile])
def test_the_unit_of_a_key_is_known(file):
    for key in (key for table in tables(file) for key in table.keys if ending_of(key.name)):
        assert dimension(tidy(unit_of(key.name)))
