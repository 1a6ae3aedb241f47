"""Seven measured profiles as flanks, straight from their files: what comes out makes sense."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from mixedlub.study import read_study, run_study

EXAMPLE = Path(__file__).parents[2] / "examples" / "study_bearing_steel.toml"


@pytest.fixture(scope="module")
def results(shared, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bearing")
    shutil.copy(EXAMPLE, folder)
    (folder / "bearing_steel").symlink_to(shared / "data" / "profiles" / "bearing_steel")
    return run_study(read_study(folder / EXAMPLE.name))


def test_28_pairings_at_18_conditions(results):
    assert results["power_loss"].shape == (28, 1, 3, 6)
    assert np.isfinite(results["power_loss"]).all()


def test_roughness_is_that_of_finished_bearing_steel(results):
    """Peers find Rq 0.09 to 0.21 um without a short cut-off; 8 um takes the shortest waves, never adds any."""
    rq = np.array([np.sqrt(s.m0) * 1e6 for s in results.study.surfaces.values()])
    assert np.all((rq > 0.05) & (rq < 0.21))


def test_slope_and_curvature_are_physical(results):
    for s in results.study.surfaces.values():
        assert 0.01 < np.sqrt(s.m2) < 0.15
        assert s.m0 * s.m4 / s.m2**2 > 1.5


def test_films_part_the_surfaces_at_speed_and_not_at_rest(results):
    ratio = results["area_ratio"][:, 0]
    assert ratio[:, :, 0].min() > 0.02
    assert ratio[:, :, 5].max() < 0.05


def test_friction_lies_between_film_and_boundary(results):
    assert results["mean_friction"].min() > 0.015
    assert results["mean_friction"].max() < 0.06
