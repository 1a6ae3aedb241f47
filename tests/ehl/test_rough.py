"""Waves on a surface that the film flattens: a published table, and the limits of long and short waves."""

import numpy as np
import pytest

from mixedlub.ehl import wave_amplitudes
from tests.ehl.contacts import MODULUS, TEMPERATURE, contacts, roelands_oil

COEFFICIENT = 22e-9
VISCOSITY = float(np.exp(COEFFICIENT * 1.96e8 / 0.68 - 9.67))
LENGTHS = np.array([4.0, 2.0, 1.0, 0.5, 0.25, 0.125])
"""Over the half width."""


@pytest.fixture(scope="module")
def amplitudes():
    """At M 100 and L 11, in pure rolling, with Roelands' exponent 0.68."""
    twice = (11.0 / (COEFFICIENT * MODULUS)) ** 4.0
    speed = twice * MODULUS * 0.01 / (2.0 * VISCOSITY)
    case = contacts(0.01, 100.0 * np.sqrt(twice) * MODULUS * 0.01, speed, speed, TEMPERATURE)
    return wave_amplitudes(roelands_oil(eta=VISCOSITY, alpha=COEFFICIENT), case, LENGTHS * case.half_width)[0]


@pytest.mark.literature(
    "C. H. Venner, F. Couhier, A. A. Lubrecht, J. A. Greenwood, Tribology Series 32 (1997) 103, table 1, amplitude 0.1"
)
def test_amplitudes_of_the_table(amplitudes):
    assert amplitudes == pytest.approx([0.030, 0.073, 0.183, 0.394, 0.660, 0.839], rel=0.03)


def test_amplitudes_of_another_program(amplitudes):
    """The linearised equations on another grid."""
    assert amplitudes == pytest.approx([0.0306, 0.0713, 0.1780, 0.3851, 0.6612, 0.8437], rel=0.03)


def test_a_wave_that_the_grid_cannot_show_has_no_amplitude():
    case = contacts(0.01, 2e5, 2.0, 2.0, TEMPERATURE)
    found = wave_amplitudes(roelands_oil(), case, np.array([1.0, 0.02]) * case.half_width[0])[0]
    assert np.isfinite(found[0])
    assert np.isnan(found[1])
