"""What keeping the ends of a trace costs, against cutting half a cut-off as instruments do, by simulation."""

import numpy as np
import pytest

from profiles import Profile
from profiles.synthesise import self_affine
from roughness import moments, roughness_profile, trim

CUTOFF, SHORT = 0.8e-3, 2.5e-6


@pytest.mark.parametrize("rolloff", [30e-6, 100e-6, 400e-6])
def test_kept_ends_estimate_at_least_as_well_as_cut_ones(rolloff):
    """Six cut-offs of a surface whose moments are known from eight times that, kept whole or cut to five."""
    errors = []
    for seed in range(16):
        long = self_affine(
            3e-7, hurst=0.7, rolloff=rolloff, shortest=2e-6, points=76_800, spacing=0.5e-6, seed=seed
        ).profile
        true = moments(roughness_profile(long, cutoff=CUTOFF, short_cutoff=SHORT, ends="periodic"))
        for start in (0, 24_000, 48_000):
            piece = Profile(long.heights[start : start + 9601], long.spacing)
            kept = roughness_profile(piece, cutoff=CUTOFF, short_cutoff=SHORT)
            found = [moments(p) for p in (kept, trim(kept, CUTOFF / 2, CUTOFF / 2))]
            errors.append([[(m.m0 / true.m0) ** 0.5 - 1, m.m2 / true.m2 - 1, m.m4 / true.m4 - 1] for m in found])
    kept_error, cut_error = np.sqrt(np.mean(np.square(errors), axis=0))
    assert (kept_error < 1.1 * cut_error).all()
    assert kept_error[1:] == pytest.approx(np.zeros(2), abs=0.05)
