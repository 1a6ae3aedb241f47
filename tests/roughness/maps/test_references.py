"""Areal parameters against numbers of others: profiles of NIST as ridges, and surfalize."""

import numpy as np
import pytest

from profiles.maps import HeightMap
from roughness.maps import height_parameters, hybrid_parameters, material_parameters, texture_parameters

# NIST surface metrology service: Pa, Pq, Psk, Pku, Pz (um) of its reference profiles
NIST = {
    "edm": (0.46434, 0.55994, -0.13265, 2.36461, 2.86230),
    "sine": (0.63663, 0.70711, None, 1.49998, 2.0),
    "mill": (0.19942, 0.24942, None, None, None),
}


@pytest.mark.literature("NIST surface metrology algorithm testing system, physics.nist.gov/VSC")
@pytest.mark.parametrize("name", NIST)
def test_a_reference_profile_as_ridges_has_its_values(nist, name):
    """A map of equal rows has the parameters of its row, to the digit; the milled one by NIST's filtered heights.

    Its skewness and kurtosis by NIST are about zero, ours about the mean.
    """
    profile, filtered = nist(name)
    row = profile.heights if name != "mill" else filtered
    p = height_parameters(HeightMap(np.tile(row, (16, 1)), profile.spacing, profile.spacing))
    found = (p.Sa * 1e6, p.Sq * 1e6, p.Ssk, p.Sku, p.Sz * 1e6)
    for ours, known in zip(found, NIST[name], strict=True):
        if known is not None:
            assert ours == pytest.approx(known, abs=0.51e-5)


@pytest.fixture(scope="module")
def pair():
    """A map of Gaussian ridges, resolved by 20 points a wave and more, for us and for surfalize (um)."""
    surfalize = pytest.importorskip("surfalize")
    size = 600
    q = 2 * np.pi * np.fft.fftfreq(size)
    amplitude = np.exp(-((q[None, :] * 12) ** 2 + (q[:, None] * 24) ** 2) / 8.0)
    z = np.fft.ifft2(amplitude * np.fft.fft2(np.random.default_rng(1).standard_normal((size, size)))).real
    z *= 0.5 / z.std()
    return HeightMap(z * 1e-6, 0.5e-6, 0.5e-6), surfalize.Surface(z, 0.5, 0.5)


def test_heights_are_those_of_surfalize(pair):
    ours, theirs = height_parameters(pair[0]), pair[1]
    for name in ("Sa", "Sq", "Sz", "Sp", "Sv"):
        assert getattr(ours, name) * 1e6 == pytest.approx(getattr(theirs, name)(), rel=1e-9)
    for name in ("Ssk", "Sku"):
        assert getattr(ours, name) == pytest.approx(getattr(theirs, name)(), rel=1e-9, abs=1e-9)


def test_slopes_are_those_of_surfalize_on_resolved_waves(pair):
    """Its differences between neighbours lose (pi/N)^2/3 on N points a wave."""
    ours = hybrid_parameters(pair[0])
    assert ours.Sdq == pytest.approx(pair[1].Sdq(), rel=0.02)
    assert 100 * ours.Sdr == pytest.approx(pair[1].Sdr(), rel=0.03)


def test_texture_is_that_of_surfalize(pair):
    """It wraps the map round, and takes whole points."""
    ours = texture_parameters(pair[0])
    assert ours.Sal * 1e6 == pytest.approx(pair[1].Sal(), rel=0.06)
    assert ours.Str == pytest.approx(pair[1].Str(), rel=0.12)


def test_functional_parameters_are_those_of_surfalize(pair):
    """It counts heights in classes."""
    ours, theirs = material_parameters(pair[0]), pair[1]
    for name in ("Sk", "Spk", "Svk", "Sxp", "Vmp", "Vmc", "Vvc", "Vvv"):
        assert getattr(ours, name) * 1e6 == pytest.approx(getattr(theirs, name)(), rel=0.03), name
    assert ours.Smr1 == pytest.approx(theirs.Smr1(), abs=0.5)
    assert ours.Smr2 == pytest.approx(theirs.Smr2(), abs=0.5)
