"""Faults found in other programs, one test each that this one does not have them."""

import numpy as np
import pytest

from profiles import Profile
from roughness import (
    autocorrelation,
    core_parameters,
    correlation_length,
    height_parameters,
    mccool_asperities,
    moments,
    profile_record,
    roughness_profile,
)


@pytest.mark.parametrize("length", [1.0, 10.0, 100.0])
@pytest.mark.parametrize("estimator", ["differences", "spectral"])
def test_moments_do_not_depend_on_the_length(length, estimator):
    """rfgen 0.2.3 divides by the length: m0 0.05 for a unit cosine over 10."""
    spacing = 1e-3
    x = np.arange(round(length / spacing)) * spacing
    m = moments(Profile(np.cos(2 * np.pi * 10 * x), spacing), estimator=estimator)
    assert m.m0 == pytest.approx(0.5, rel=5e-3)
    assert m.m2 == pytest.approx(0.5 * (20 * np.pi) ** 2, rel=5e-3)


def test_summit_density_is_one_over_area():
    """rfgen 0.2.3 takes the root of m4/m2, which is one over length."""
    wave = np.random.default_rng(0).normal(size=5000)
    one, half = (mccool_asperities(moments(Profile(wave, dx))).density for dx in (1.0, 0.5))
    assert half == pytest.approx(4 * one)


def test_frequency_is_angular():
    """tamaas 2.9 returns m2 = 8 for cos(2 pi 4 x/L): wave number 4 squared, halved."""
    x = np.arange(4096) / 4096
    assert moments(Profile(np.cos(2 * np.pi * 4 * x), 1 / 4096)).m2 == pytest.approx(8 * (2 * np.pi) ** 2, rel=2e-3)


def test_all_parameters_share_their_sampling_lengths():
    """surfalize 0.19.2 takes Rp and Rv by sections but Ra, Rq, Rsk, Rku over the whole, re-centred."""
    x = np.arange(8000)
    z = np.sin(2 * np.pi * x / 200) * np.repeat([1.0, 3.0], 4000)
    p = height_parameters(Profile(z, 1e-6), sections=2)
    assert p.Rp == pytest.approx(2.0, rel=1e-3)
    assert p.Rq == pytest.approx(2.0 * 0.5**0.5, rel=1e-3)
    assert p.Rku == pytest.approx(1.5, rel=1e-3)


@pytest.mark.parametrize("wave", ["sine", "square"])
def test_core_parameters_of_waves_are_not_passed_off(wave):
    """surfalize 0.19.2 gives Rpk 0.44 for a sine and Rvk up to 3.75 for a unit square without a word."""
    z = np.sin(2 * np.pi * (np.arange(8000) + 0.5) / 400)
    profile = Profile(1e-6 * (z if wave == "sine" else np.sign(z)), 0.5e-6)
    record = profile_record(profile)
    assert not core_parameters(profile).s_shaped
    assert record["parameters"]["Rvk_um"] is None
    assert any("Rk family is undefined" in w for w in record["warnings"])


def test_unfiltered_roughness_is_not_called_filtered():
    """SurfaceTopography calls the unfiltered rms Rq; here the band is part of the result."""
    z = np.sin(2 * np.pi * np.arange(8000) / 8000) + 0.01 * np.sin(2 * np.pi * np.arange(8000) / 50)
    raw = Profile(1e-6 * z, 0.5e-6)
    assert profile_record(raw)["moments"]["cutoff_mm"] is None
    assert any("no cut-off" in w for w in profile_record(raw)["warnings"])
    filtered = profile_record(roughness_profile(raw, cutoff=0.25e-3))
    assert filtered["moments"]["cutoff_mm"] == pytest.approx(0.25)
    assert filtered["parameters"]["Rq_um"] < 0.02


def test_white_noise_has_a_correlation_length():
    """slippy 0.5.2 gives Sal = 0 and raises on Str for white noise."""
    noise = Profile(np.random.default_rng(0).normal(size=5000), 1e-6)
    assert autocorrelation(noise)[0] == 1
    assert 0 < correlation_length(noise) < 1e-6


def test_white_noise_has_a_core():
    """slippy 0.5.2 has not implemented Sk."""
    noise = Profile(np.random.default_rng(0).normal(size=50_000), 1e-6)
    assert core_parameters(noise).Rk == pytest.approx(2.62, rel=0.05)


def test_import_is_light():
    """A thousand lines of import are a fault too: numpy only until something is computed."""
    import subprocess
    import sys

    code = "import sys, roughness; print([m for m in ('scipy', 'matplotlib', 'pandas') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
