"""A SurfTest report: the parameters that the instrument printed beside the profile it stored."""

from dataclasses import replace

import pytest

from roughness import core_parameters, element_parameters, height_parameters, profile_record

# Mitutoyo SurfTest report, ISO 1997, cut-off 2.5 mm, short cut-off 8 um, 4 sampling lengths; um
HEIGHTS = {
    "Ra": (3.308, 3),
    "Rq": (3.959, 3),
    "Rz": (18.485, 3),
    "Rp": (8.244, 3),
    "Rv": (10.240, 3),
    "Rt": (22.233, 3),
    "Rz1max": (22.062, 3),
}
SHAPES = {"Rsk": (-0.144, 3), "Rku": (2.463, 3), "Rdq": (0.157, 3)}
CORE = {"Rk": 11.440, "Rpk": 2.912, "Rvk": 3.980}


@pytest.fixture
def report(mitutoyo):
    return replace(mitutoyo("mitutoyo_2_mock"), cutoffs={"cutoff": 2.5e-3, "short_cutoff": 8e-6})


@pytest.mark.literature("Mitutoyo SurfTest report printed beside the stored profile")
@pytest.mark.parametrize("symbol", [*HEIGHTS, *SHAPES])
def test_parameter_to_the_last_printed_digit(report, symbol):
    found = getattr(height_parameters(report, convention="Mitutoyo", sections=4), symbol)
    value, digits = (HEIGHTS | SHAPES)[symbol]
    # a tie between two last digits (18.48455) may fall either way in print
    assert found * (1e6 if symbol in HEIGHTS else 1) == pytest.approx(value, abs=0.501 * 10**-digits)


@pytest.mark.literature("Mitutoyo SurfTest report printed beside the stored profile")
@pytest.mark.parametrize("method", ["least squares", "class levels"])
@pytest.mark.parametrize("symbol", CORE)
def test_core_parameters_within_the_spread_between_programs(report, method, symbol):
    found = getattr(core_parameters(report, method=method), symbol) * 1e6
    assert found == pytest.approx(CORE[symbol], rel=0.08)


@pytest.mark.literature("Mitutoyo SurfTest report printed beside the stored profile")
def test_class_levels_are_the_instruments_convention_for_the_core(report):
    assert core_parameters(report, method="class levels").Rk * 1e6 == pytest.approx(11.440, rel=0.005)


@pytest.mark.literature("Mitutoyo SurfTest report printed beside the stored profile")
@pytest.mark.parametrize(("symbol", "value"), [("RSm", 419.9), ("Rc", 13.306)])
def test_elements_discriminated_by_total_height(report, symbol, value):
    found = element_parameters(report, discrimination="10 % of Rt", sections=4)
    assert getattr(found, symbol) * 1e6 == pytest.approx(value, rel=0.02)


def test_section_mean_is_not_the_whole(report):
    assert height_parameters(report, convention="NIST").Rku != pytest.approx(2.463, abs=0.05)


def test_report_whose_header_belongs_to_another_profile_is_caught(mitutoyo):
    trap = replace(
        mitutoyo("mitutoyo_mock"),
        cutoffs={"cutoff": 0.08e-3, "short_cutoff": 2.5e-6},
        origin={"stated": {"Ra": 0.018e-6, "Rq": 0.027e-6, "Rz": 0.191e-6}},
    )
    assert sum("the file states" in w for w in profile_record(trap)["warnings"]) == 3


def test_report_that_agrees_with_its_profile_is_not(report):
    stated = {"Ra": 3.308e-6, "Rq": 3.959e-6, "Rz": 18.485e-6}
    honest = replace(report, origin={"stated": stated, "sampling_lengths": 4})
    assert not any("the file states" in w for w in profile_record(honest)["warnings"])
