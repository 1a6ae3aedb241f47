"""Films between rough surfaces with a lay: the first order of the flow factor, and the closed form of the inlet."""

import numpy as np
import pytest

from mixedlub.laws.rough_film import pressure_flow_factor, rough_film


@pytest.mark.literature("J. H. Tripp, J. Lubr. Technol. 105 (1983) 458: first order of the flow factor")
@pytest.mark.parametrize(("gamma", "tolerance"), [(1 / 9, 0.025), (1 / 3, 0.01), (1.0, 0.01), (9.0, 0.01)])
def test_flow_factors_are_near_the_first_order_at_five_sigma(gamma, tolerance):
    """Beyond it the fit of Patir and Cheng to simulated surfaces departs: at 3 sigma, transverse, by 0.15."""
    assert pressure_flow_factor(5.0, gamma) == pytest.approx(1 - 3 * (2 - gamma) / (1 + gamma) / 25, abs=tolerance)


@pytest.mark.literature("A. N. Grubin, 1949, with Tripp's first order: [1 + (7/9)(2 - gamma)/(1 + gamma)/H^2]^(3/4)")
@pytest.mark.parametrize("gamma", [1 / 9, 1 / 3, 1.0, 3.0])
@pytest.mark.parametrize("ratio", [2.5, 3.0, 4.0])
def test_the_film_follows_the_closed_form_of_the_inlet(gamma, ratio):
    """The integrals of Grubin's inlet are beta functions, whose ratio is 7/27 for the second order in sigma/h."""
    closed = (1 + 7 / 9 * (2 - gamma) / (1 + gamma) / ratio**2) ** 0.75
    assert float(rough_film(ratio, 1.0, np.array(gamma))) / ratio == pytest.approx(closed, abs=0.025)
