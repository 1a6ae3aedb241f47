"""Material ratio curve and Rk family against closed forms."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import core_parameters, material_ratio, material_ratio_curve, profile_record
from roughness.material_ratio import CORE_METHODS, core_profile


def normal_heights(points=40_000):
    from scipy.special import ndtri

    z = ndtri((np.arange(points) + 0.5) / points)
    return Profile(np.random.default_rng(0).permutation(z), 1e-6)


@pytest.mark.parametrize("percent", [5, 20, 50, 93])
def test_ratio_of_normal_heights_is_that_of_the_normal_law(percent):
    from scipy.special import ndtri

    height = float(ndtri(1.0 - percent / 100.0))
    assert material_ratio(normal_heights(), height) == pytest.approx(percent, abs=0.01)


def test_curve_falls():
    ratio, heights = material_ratio_curve(normal_heights())
    assert (np.diff(ratio) > 0).all()
    assert (np.diff(heights) <= 0).all()


@pytest.mark.parametrize("method", CORE_METHODS)
def test_core_of_normal_heights(method):
    """The secant of the middle 40 % of a normal law spans 2.5 x 2 x 0.5244 sigma."""
    c = core_parameters(normal_heights(), method=method)
    assert c.Rk == pytest.approx(2.5 * 2 * 0.524401, rel=0.02)
    assert c.Mr1 == pytest.approx(100 - c.Mr2, abs=1.0)
    assert c.Rpk == pytest.approx(c.Rvk, rel=0.1)
    assert c.s_shaped


@pytest.mark.parametrize("method", CORE_METHODS)
def test_reduced_heights_are_triangles_of_equal_area(method, gaussian_trace):
    c = core_parameters(gaussian_trace(), method=method)
    assert c.Rpk == pytest.approx(2 * c.A1 / (c.Mr1 / 100))
    assert c.Rvk == pytest.approx(2 * c.A2 / (1 - c.Mr2 / 100))


def test_plateau_has_deep_valleys(plateau_trace):
    c = core_parameters(plateau_trace())
    assert c.Rvk > 2 * c.Rpk


@pytest.mark.parametrize("method", CORE_METHODS)
@pytest.mark.parametrize(
    "wave",
    [np.sin(2 * np.pi * np.arange(8000) / 400), np.sign(np.sin(2 * np.pi * (np.arange(8000) + 0.5) / 400))],
)
def test_sine_and_square_are_flagged(method, wave):
    assert not core_parameters(Profile(wave, 1e-6), method=method).s_shaped


def test_unknown_method_is_refused():
    with pytest.raises(InputError, match="nearest known: 'class levels'"):
        core_parameters(normal_heights(100), method="levels")


class TestEvaluationLength:
    """The Rk family is read off one evaluation length: five sampling lengths in the middle of a longer trace."""

    def trace(self) -> Profile:
        rng = np.random.default_rng(3)
        heights = rng.normal(size=4800)
        heights[:400] *= 20.0  # a defect within the first sampling length, outside the evaluation length
        return Profile(heights * 1e-7, 1e-6, cutoffs={"cutoff": 0.8e-3})

    def test_a_record_takes_the_middle_five_and_says_so(self):
        trace = self.trace()
        found = profile_record(trace)["parameters"]
        middle = core_parameters(Profile(trace.heights[400:4400], 1e-6))
        assert found["Rk_length_mm"] == pytest.approx(4.0)
        for name in ("Rk", "Rpk", "Rvk"):
            assert found[f"{name}_um"] == pytest.approx(getattr(middle, name) * 1e6)
        assert core_parameters(trace).Rpk > 1.2 * middle.Rpk

    @pytest.mark.parametrize("choice", [{"sections": 6}, {"convention": "NIST"}])
    def test_a_stated_length_is_the_evaluation_length(self, choice):
        assert profile_record(self.trace(), **choice)["parameters"]["Rk_length_mm"] == pytest.approx(4.8)

    def test_a_short_trace_gives_all_its_sampling_lengths(self):
        short = Profile(self.trace().heights[:2000], 1e-6, cutoffs={"cutoff": 0.8e-3})
        assert core_profile(short).heights.size == 1600
