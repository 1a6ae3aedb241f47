"""Monte Carlo of the summit relations: summits counted, and predicted from profile moments."""

import numpy as np
import pytest

from roughness import Moments, mccool_asperities


def surface(size, longest, shortest, slope, seed):
    """Periodic Gaussian isotropic surface with power q^slope between two wavelengths (in points)."""
    q = np.fft.fftfreq(size)
    radius = np.hypot(q[:, None], q[None, : size // 2 + 1])
    power = np.where((radius >= 1 / longest) & (radius <= 1 / shortest), np.maximum(radius, 1e-9) ** slope, 0.0)
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal(power.shape) + 1j * rng.standard_normal(power.shape)
    z = np.fft.irfft2(np.sqrt(power) * noise, (size, size))
    return z / z.std()


def profile_moments(z):
    """Mean of both directions, by the spectrum: exact for a periodic band-limited surface."""
    size = z.shape[0]
    power = np.abs(np.fft.rfft2(z)) ** 2
    power[:, 1:-1] *= 2
    power /= size**4
    squares = (
        (2 * np.pi * np.fft.fftfreq(size)[:, None]) ** 2,
        (2 * np.pi * np.arange(size // 2 + 1) / size) ** 2,
    )
    m2 = np.mean([(power * s).sum() for s in squares])
    m4 = np.mean([(power * s**2).sum() for s in squares])
    return Moments(float(power.sum()), float(m2), float(m4))


def summits(z):
    """Heights and mean curvatures of the points above their eight neighbours."""
    top = np.ones(z.shape, bool)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            if i or j:
                top &= z > np.roll(z, (i, j), (0, 1))
    neighbours = sum(np.roll(z, s, a) for a in (0, 1) for s in (-1, 1))
    far = sum(np.roll(z, s, a) for a in (0, 1) for s in (-2, 2))
    # fourth order, for the second difference is 3 % low at twelve points a wave
    laplacian = (16 * neighbours - far - 60 * z) / 12
    return z[top], -laplacian[top] / 2


@pytest.mark.parametrize(
    ("longest", "shortest", "slope"),
    [(40.0, 12.0, -1.0), (60.0, 12.0, -3.0), (150.0, 12.0, -3.0), (300.0, 12.0, -3.6)],
)
def test_summits_are_mccools_within_three_percent(longest, shortest, slope):
    z = surface(2048, longest, shortest, slope, seed=7)
    predicted = mccool_asperities(profile_moments(z))
    heights, curvature = summits(z)
    assert heights.size / z.size == pytest.approx(predicted.density, rel=0.03)
    assert heights.mean() == pytest.approx(predicted.plane_offset, rel=0.03)
    assert heights.std() == pytest.approx(predicted.sigma, rel=0.03)
    assert 1 / curvature.mean() == pytest.approx(predicted.radius, rel=0.03)


def test_bandwidths_cover_narrow_to_broad():
    found = [
        profile_moments(surface(1024, *band, seed=1)).bandwidth for band in ((40.0, 12.0, -1.0), (300.0, 12.0, -3.6))
    ]
    assert found[0] < 2.2
    assert found[1] > 6


def test_a_profile_carries_the_surfaces_moments():
    """The moments by differences of single rows, averaged, are those of the surface."""
    from profiles import Profile
    from roughness import moments

    z = surface(1024, 80.0, 24.0, -2.0, seed=3)
    rows = [moments(Profile(row, 1.0)) for row in z[::8]]
    true = profile_moments(z)
    assert np.mean([r.m2 for r in rows]) == pytest.approx(true.m2, rel=0.03)
    assert np.mean([r.m4 for r in rows]) == pytest.approx(true.m4, rel=0.03)
