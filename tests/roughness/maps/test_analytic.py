"""Areal parameters of surfaces whose values are known in closed form."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.special import erfcx
from scipy.stats import norm

from profiles import InputError
from profiles.maps import HeightMap
from roughness.maps import (
    height_parameters,
    hybrid_parameters,
    material_parameters,
    texture_direction,
    texture_parameters,
)
from roughness.maps.prepare import areal_roughness

A, B, STEP, PERIOD = 1e-6, 0.6e-6, 1e-6, 50
K = 2 * np.pi / (PERIOD * STEP)


def grid(rows=500, columns=600):
    return np.mgrid[0:rows, 0:columns] * STEP


def made(heights):
    return HeightMap(heights, STEP, STEP, "made")


def gaussian(size=1024, length_x=12.0, length_y=12.0, sigma=1e-6, seed=0):
    """A Gaussian map with the autocorrelation exp(-(x/lx)^2 - (y/ly)^2), lengths in points."""
    q = 2 * np.pi * np.fft.fftfreq(size)
    amplitude = np.exp(-((q[None, :] * length_x) ** 2 + (q[:, None] * length_y) ** 2) / 8.0)
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal((size, size)))
    z = np.fft.ifft2(amplitude * noise).real
    return made(sigma * z / np.sqrt((amplitude**2).mean()))


def test_a_sine():
    """Sq = A/sqrt 2, Sa = 2A/pi, Ssk = 0, Sku = 3/2, Sdq = A k/sqrt 2."""
    _, x = grid()
    p = height_parameters(made(A * np.sin(K * (x + 0.5 * STEP))))
    assert p.Sq == pytest.approx(A / math.sqrt(2), rel=1e-12)
    assert p.Sa == pytest.approx(2 * A / math.pi, rel=1e-3)
    assert (p.Ssk, p.Sku) == pytest.approx((0.0, 1.5), abs=1e-9)
    assert (p.Sp, p.Sv, p.Sz) == pytest.approx((A, A, 2 * A), rel=3e-3)
    _, x = grid(40, 606)  # three points are lost at either end
    assert hybrid_parameters(made(A * np.sin(K * x))).Sdq == pytest.approx(A * K / math.sqrt(2), rel=1e-6)


def test_two_crossing_sines():
    """Sq^2 = (A^2 + B^2)/2, Sku by the fourth moments, Sdr by quadrature over a period."""
    y, x = grid(600, 600)
    area = made(A * np.sin(K * x) + B * np.sin(K * y))
    p = height_parameters(area)
    fourth = 3 / 8 * (A**4 + B**4) + 1.5 * A**2 * B**2
    assert p.Sq == pytest.approx(math.sqrt((A**2 + B**2) / 2), rel=1e-9)
    assert p.Sku == pytest.approx(fourth / ((A**2 + B**2) / 2) ** 2, rel=1e-9)
    y, x = grid(606, 606)
    slopes = hybrid_parameters(made(A * np.sin(K * x) + B * np.sin(K * y)))
    assert slopes.Sdq == pytest.approx(K * math.sqrt((A**2 + B**2) / 2), rel=1e-6)

    def excess(u, v):
        return math.sqrt(1 + (A * K * math.cos(u)) ** 2 + (B * K * math.cos(v)) ** 2) - 1

    exact = dblquad(excess, 0, math.pi, 0, math.pi)[0] / math.pi**2
    assert slopes.Sdr == pytest.approx(exact, rel=1e-6)


def test_a_saddle():
    """z = H (u^2 - v^2) over a square: <z^2> = 8/45 H^2, <z^4> = H^4 (2/9 - 8/21 + 6/25), Sdq^2 = 8/3 (H/L)^2."""
    size = 801
    weights = 1.0 / (size - 1)  # midpoints, so that means of points are integrals
    u = np.linspace(-1 + weights, 1 - weights, size - 1)
    z = 1e-6 * (u[None, :] ** 2 - u[:, None] ** 2)
    step = (u[1] - u[0]) * 1e-4
    p = height_parameters(HeightMap(z, step, step))
    assert p.Sq == pytest.approx(1e-6 * math.sqrt(8 / 45), rel=1e-5)
    assert p.Sku == pytest.approx((2 / 9 - 8 / 21 + 6 / 25) / (8 / 45) ** 2, rel=1e-4)
    slopes = hybrid_parameters(HeightMap(z, step, step))
    inner = 1 - 3 * (u[1] - u[0])  # three points are lost at either end
    assert slopes.Sdq == pytest.approx(1e-2 * math.sqrt(8 / 3) * inner, rel=2e-3)


def test_developed_area_of_a_gaussian_surface():
    """Squared gradients are exponential: Sdr = sqrt(pi s)/2 erfcx(1/sqrt s), s = Sdq^2; s/2 - s^2/4 for small s."""
    for sigma, rel in ((1e-6, 0.01), (6e-6, 0.01)):
        p = hybrid_parameters(gaussian(sigma=sigma))
        s = p.Sdq**2
        assert s == pytest.approx(4 * (sigma / (12 * STEP)) ** 2, rel=0.05)
        assert p.Sdr == pytest.approx(math.sqrt(math.pi * s) / 2 * erfcx(1 / math.sqrt(s)), rel=rel)
    small = hybrid_parameters(gaussian(sigma=0.3e-6))
    assert small.Sdr == pytest.approx(small.Sdq**2 / 2 - small.Sdq**4 / 4, rel=1e-3)


@pytest.mark.parametrize(("along", "across"), [(12.0, 12.0), (40.0, 10.0)])
def test_texture_of_a_known_autocorrelation(along, across):
    """exp(-(x/lx)^2 - (y/ly)^2) falls to 0.2 at lx sqrt(ln 5): Sal = l sqrt(ln 5), Str = lx/ly."""
    found = texture_parameters(gaussian(1500, across, along, seed=3))
    assert found.Sal == pytest.approx(across * STEP * math.sqrt(math.log(5)), rel=0.03)
    assert found.Str == pytest.approx(across / along, rel=0.08)
    assert not found.is_bound


@pytest.mark.parametrize("degrees", [0, 30, 77, 120, 179])
def test_direction_of_the_lay(degrees):
    y, x = grid(400, 500)
    lay = math.radians(degrees)
    ridges = np.sin(K * (x * math.sin(lay) - y * math.cos(lay)) * 2.0)
    found = math.degrees(texture_direction(made(A * ridges)))
    assert (found - degrees + 90) % 180 - 90 == pytest.approx(0.0, abs=1.0)


def test_functional_parameters_of_gaussian_heights():
    """Vmp = sigma [phi(q) - 0.1 q] at 10 %; the valleys at 80 % by symmetry with peaks at 20 %."""
    p = material_parameters(gaussian(1500, 6.0, 6.0, seed=5))
    peak, valley = (norm.pdf(norm.isf(share)) - share * norm.isf(share) for share in (0.1, 0.2))
    assert p.Vmp == pytest.approx(1e-6 * peak, rel=0.02)
    assert p.Vvv == pytest.approx(1e-6 * valley, rel=0.02)
    assert p.Vvc + p.Vvv == pytest.approx(1e-6 * (norm.isf(0.1) + peak), rel=0.01)
    assert p.Sxp == pytest.approx(1.959964e-6, rel=0.01)
    assert p.Smr1 + p.Smr2 == pytest.approx(100.0, abs=1.0)


def test_a_flat_distribution_is_all_core():
    """Heights spread evenly from 0 to H: Sk = H, no peaks and valleys, Vmp = 0.1^2/2 H, Vvv = 0.2^2/2 H."""
    z = np.random.default_rng(0).permutation(np.linspace(0, 1e-6, 250_000)).reshape(500, 500)
    p = material_parameters(made(z))
    assert p.Sk == pytest.approx(1e-6, rel=1e-3)
    assert (p.Spk, p.Svk) == pytest.approx((0.0, 0.0), abs=2e-9)
    assert (p.Vmp, p.Vvv) == pytest.approx((0.005e-6, 0.02e-6), rel=1e-4)


def test_a_flat_map_is_refused():
    for function in (height_parameters, texture_parameters):
        with pytest.raises(InputError, match="flat"):
            function(made(np.zeros((40, 40))))
        with pytest.raises(InputError, match="flat"):
            function(made(np.full((40, 40), 1.3e-6)))


@pytest.mark.parametrize("slope", [0.0, 1e-7])
def test_a_flat_or_tilted_map_has_no_roughness(slope):
    """Rounding leaves Sq near 1e-22 m of a plane; a wave of 1 nm on it is kept."""
    y, x = np.mgrid[0:64, 0:64]
    plane = 1.3e-6 + slope * x + 2.0 * slope * y
    with pytest.raises(InputError, match="is flat: it has no roughness"):
        areal_roughness(made(plane))
    assert areal_roughness(made(plane + 1e-9 * (-1.0) ** (x + y))).heights.std() == pytest.approx(1e-9, rel=1e-3)
