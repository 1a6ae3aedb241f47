"""A sudden change stands anywhere between the readings that tell before from after."""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.change_points import (
    change_point_coordinates,
    change_point_posterior,
    profile_change_point,
)
from mixedlub.diagnosis.report.text.answer import effect_records
from mixedlub.effects import known_in

from .test_planted import ROLL, SMOOTH, film, planted_event

LEFT_IN = ("fringe_order", "inlet_shear_heating")


@pytest.fixture
def gap(make):
    """Orders counted wrong from somewhere between films of 200 and 320 nm, and films wanted at 210, 255 and 310 nm."""
    kept = (SMOOTH < 200.0) | (SMOOTH > 320.0)
    case = make(*film((SMOOTH + np.where(SMOOTH > 260.0, 200.0, 0.0))[kept], ROLL[kept]))
    speeds = (np.array([210.0, 255.0, 310.0]) / 380.0) ** (1.0 / 0.67)
    rows = [f"{1001 + i},50,{speed:.5g},0,40" for i, speed in enumerate(speeds)]
    head = "run,load_N,entrainment_speed_m_s,slide_roll_ratio,oil_temperature_C"
    (case.folder / "conditions.csv").write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    return diagnose_case(case.folder, exclude=[name for name in known_in("film") if name not in LEFT_IN])


def test_a_place_between_readings_is_as_open_as_they_leave_it(gap):
    """Its slope at the fit alone would put it within 12 nm."""
    assert gap.posterior.verdict == Explanation.of("fringe_order")
    (record,) = effect_records(gap)
    onset = record["parameters"][1]
    assert onset["low90"] < 225e-9
    assert 235e-9 < onset["value"] < 290e-9
    assert onset["high90"] > 290e-9


def test_between_them_both_values_are_predicted(gap):
    wanted = gap.wanted
    assert wanted.low90[1] < 260.0
    assert wanted.high90[1] > 450.0
    assert np.all(np.diff(wanted.predicted) > 0.0)
    assert wanted.predicted[0] < 270.0
    assert wanted.predicted[2] > 450.0
    assert np.all(gap.recorded.high90 - gap.recorded.low90 < 0.08 * gap.recorded.predicted)


def test_all_places_sum_to_the_same_however_closely_they_are_tried(make):
    """The evidence of a sharp change is found without being told where to look."""
    case = make(*planted_event())
    found = diagnose_case(case.folder).search
    problem, fit = found.problem, found.fits[Explanation.of("friction_event")]
    (place,) = change_point_coordinates(problem, fit.explanation)
    sums = []
    for more in (np.array([0.0]), np.linspace(-1.0, 1.0, 2001)):
        tried, log = profile_change_point(problem, fit, place, more)
        sums.append(np.trapezoid(np.exp(log - log.max()), tried[:, place]))
    assert sums[0] == pytest.approx(sums[1], rel=0.1)
    (stands,) = change_point_posterior(problem, fit)
    assert stands.at(0.05) < fit.z[place] < stands.at(0.95)
