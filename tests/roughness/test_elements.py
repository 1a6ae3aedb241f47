"""Profile elements on waves whose elements are plain to see."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import element_parameters

X = np.arange(5000) + 0.5


def test_triangle_wave():
    wave = Profile(np.abs((X % 100) - 50) / 25 - 1, 2e-6)
    e = element_parameters(wave)
    assert e.RSm == pytest.approx(200e-6, rel=1e-6)
    assert e.Rc == pytest.approx(2, abs=0.05)  # one step of the wave is 0.04
    assert e.width_variation < 1e-6


def test_ripple_below_the_discrimination_makes_no_elements():
    wave = np.sin(2 * np.pi * X / 500) + 0.05 * np.sin(2 * np.pi * X / 11)
    assert element_parameters(Profile(wave, 1e-6)).RSm == pytest.approx(500e-6, rel=0.01)


def test_ripple_above_it_does():
    wave = np.sin(2 * np.pi * X / 500) + 0.6 * np.sin(2 * np.pi * X / 11)
    assert element_parameters(Profile(wave, 1e-6)).RSm < 100e-6


def test_gaussian_trace_crosses_at_rices_rate(gaussian_trace):
    """Without discrimination the up-crossings are sqrt(m2/m0)/2 pi a length; 10 % of Rz leaves fewer."""
    from roughness import moments

    p = gaussian_trace(100_000, roll=20e-6, short=15e-6)
    m = moments(p)
    rice = 2 * np.pi * np.sqrt(m.m0 / m.m2)
    assert rice < element_parameters(p, sections=20).RSm < 2.0 * rice


@pytest.mark.parametrize("z", [np.ones(100), np.linspace(-1, 1, 100)])
def test_no_element_is_said_so(z):
    e = element_parameters(Profile(z, 1e-6))
    assert e.count == 0
    assert np.isnan(e.RSm)


def test_unknown_discrimination_is_refused():
    with pytest.raises(InputError, match="10 % of Rz, 10 % of Rt"):
        element_parameters(Profile(np.sin(X), 1e-6), discrimination="5 %")
