"""Check numbers of the McCool relations, and how real surfaces move with the short cut-off."""

import numpy as np
import pytest

from roughness import Moments, cutoff_for, height_parameters, mccool_asperities, moments, roughness_profile
from roughness.filters import gaussian_transmission

# m0, m2, m4, alpha, D, R, sigma_s, z_s: recomputed from the closed forms in any consistent unit
ROWS = [
    (0.0625, 0.0018, 1.04e-4, 2.006173, 1.769698e-3, 65.176275, 0.185906, 0.398328),
    (0.16, 0.01, 0.004, 6.4, 1.225175e-2, 10.509359, 0.370918, 0.356825),
    (1.0, 1.0, 2.0, 2.0, 6.125877e-2, 0.469993, 0.742696, 1.595769),
]


@pytest.mark.literature("McCool (1986), Wear 107, 37, doi:10.1016/0043-1648(86)90045-1")
@pytest.mark.parametrize(("m0", "m2", "m4", "alpha", "density", "radius", "sigma", "offset"), ROWS)
def test_mccool_rows(m0, m2, m4, alpha, density, radius, sigma, offset):
    a = mccool_asperities(Moments(m0, m2, m4))
    assert a.nayak == pytest.approx(alpha, rel=1e-6)
    assert a.density == pytest.approx(density, rel=1e-6)
    assert a.radius == pytest.approx(radius, rel=1e-6)
    assert a.sigma == pytest.approx(sigma, abs=1e-6)
    assert a.plane_offset == pytest.approx(offset, abs=1e-6)


@pytest.mark.literature(
    "McCool (1986), Wear 107, 37, doi:10.1016/0043-1648(86)90045-1, as eliminated in the CEB and KE models"
)
@pytest.mark.parametrize("alpha", [1.6, 2.5, 6.0, 40.0])
def test_forms_in_density_times_radius(alpha):
    """The eliminated forms of the CEB, KE and slider codes: 2412.74, 3.717e-4, 0.045944."""
    a = mccool_asperities(Moments(1.0, 1.0, alpha))
    product = a.density * a.radius
    assert 2412.74 * product**2 == pytest.approx(alpha, rel=1e-5)
    assert 1.0 - 3.717e-4 / product**2 == pytest.approx(a.sigma**2, rel=1e-3)
    assert 0.045944 / product == pytest.approx(a.plane_offset, rel=1e-4)


@pytest.mark.literature("McCool (1986), Wear 107, 37, doi:10.1016/0043-1648(86)90045-1")
def test_packing_identity():
    """D R sigma = 0.020358 sqrt(alpha), sigma that of the surface."""
    a = mccool_asperities(Moments(4.0, 1.0, 3.0))
    assert a.density * a.radius * 2.0 == pytest.approx(0.020358 * np.sqrt(12.0), rel=1e-4)


# Short cut-off (um; None: none), m0 (um2), m2, m4 (1/um2), alpha, R (um), D (1/mm2) by differences after a
# Gaussian cut-off of 0.8 mm, half a cut-off trimmed
BANDS = [
    ("mill", None, 0.0405, 6.26e-4, 1.64e-2, 1694, 5.2, 801545),
    ("mill", 2.5, 0.0405, 1.82e-4, 2.37e-4, 290, 43, 39876),
    ("mill", 8.0, 0.0403, 8.16e-5, 1.21e-5, 73, 191, 4534),
    ("mill", 25.0, 0.0391, 4.67e-5, 4.03e-7, 7.2, 1047, 264),
    ("edm", None, 0.2804, 1.09e-2, 2.96e-2, 70, 3.9, 83151),
    ("edm", 2.5, 0.2782, 9.49e-3, 3.19e-3, 9.9, 11.8, 10305),
    ("edm", 8.0, 0.2627, 6.38e-3, 8.72e-4, 5.6, 22.5, 4184),
    ("edm", 25.0, 0.1979, 1.96e-3, 6.75e-5, 3.5, 81, 1055),
]


@pytest.mark.parametrize(("name", "short", "m0", "m2", "m4", "alpha", "radius", "density"), BANDS)
def test_short_cutoff_decides_slope_and_curvature(nist, name, short, m0, m2, m4, alpha, radius, density):
    profile = roughness_profile(
        nist(name)[0],
        cutoff=0.8e-3,
        short_cutoff=None if short is None else short * 1e-6,
        trim_cutoffs=0.5,
    )
    m = moments(profile)
    a = mccool_asperities(m)
    assert m.m0 * 1e12 == pytest.approx(m0, rel=0.01)
    assert m.m2 == pytest.approx(m2, rel=0.01)
    assert m.m4 * 1e-12 == pytest.approx(m4, rel=0.01)
    assert m.bandwidth == pytest.approx(alpha, rel=0.02)
    assert a.radius * 1e6 == pytest.approx(radius, rel=0.02)
    assert a.density * 1e-6 == pytest.approx(density, rel=0.01)


# Gaussian 0.8 mm, half a cut-off trimmed, six sections, ISO 4287; um
@pytest.mark.parametrize(
    ("name", "ra", "rq", "rz"), [("mill", 0.1642, 0.2011, 0.8916), ("edm", 0.4394, 0.5267, 2.2541)]
)
def test_roughness_of_the_softgauges(nist, name, ra, rq, rz):
    p = height_parameters(roughness_profile(nist(name)[0], cutoff=0.8e-3, trim_cutoffs=0.5), sections=6)
    assert [round(v * 1e6, 4) for v in (p.Ra, p.Rq, p.Rz)] == pytest.approx([ra, rq, rz], abs=1.01e-4)


def test_sine_amplitude_after_twice_its_wavelength(nist):
    p = height_parameters(roughness_profile(nist("sine")[0], cutoff=0.8e-3, trim_cutoffs=0.5))
    assert p.Rt / 2 * 1e6 == pytest.approx(1 - gaussian_transmission(0.4e-3, 0.8e-3), abs=1e-4)
    assert p.Ra * 1e6 == pytest.approx(0.5968, abs=1e-4)


@pytest.mark.literature("ISO 4288:1996")
@pytest.mark.parametrize(("ra_um", "cutoff_mm"), [(0.036, 0.25), (0.122, 0.8), (0.219, 0.8), (0.450, 0.8), (3.3, 2.5)])
def test_cutoffs_of_the_gear_flanks(ra_um, cutoff_mm):
    """ISO 4288 for the flanks of Hong, Aneshansley and Talbot (Ra 0.036 to 0.450 um)."""
    assert cutoff_for("Ra", ra_um * 1e-6) == cutoff_mm * 1e-3
