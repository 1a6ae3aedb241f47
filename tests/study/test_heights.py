"""Height distributions of the traces in the contact of a study, and the verdict that chooses them."""

import numpy as np
import pytest

from mixedlub.laws.contact import area_per_overlap
from mixedlub.schema.findings import codes, collected
from mixedlub.study import read_study, run_study
from profiles import Profile, finishes
from profiles.errors import InputError
from roughness.mccool import plane_offset, summit_density, summit_radius, summit_sigma

STEP = 0.5e-6
KNOWN = {"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036}
LEVELS = {"conditions__torque_Nm": [100], "conditions__oil_temperature_C": [80]}


@pytest.fixture
def study_of(monkeypatch, write_study):
    """A study of surfaces with these heights (m)."""

    def make(traces, *, moments=None, **options):
        profiles = {name: (Profile(z, STEP, name=name),) for name, z in traces.items()}
        surfaces = {name: {"profile": name, "cutoff_mm": 0.8, "short_cutoff_um": 2.5} for name in traces}
        monkeypatch.setattr("mixedlub.rig.build.traces", lambda name, *_: profiles[name])
        return read_study(write_study(surfaces=surfaces | (moments or {}), options=options, **LEVELS))

    return make


@pytest.fixture(scope="module")
def honed():
    return finishes.honed(6e-8, 6e-7, plateau_share=0.8, points=9600, spacing=STEP, seed=3).profile.heights


@pytest.fixture(scope="module")
def ground():
    return finishes.ground(3e-7, points=9600, spacing=STEP, seed=1, rolloff=30e-6).profile.heights


def test_normal_traces_are_computed_as_by_default_where_the_plot_decides(ground, study_of):
    default, decided = (run_study(study_of({"a": ground}, heights=h)) for h in ("gaussian", "auto"))
    assert np.array_equal(default["power_loss"], decided["power_loss"])
    assert any("Gaussian heights taken" in n.text for n in decided.findings if n.code == "heights_chosen")


def test_a_plateau_is_found_and_said(honed, ground, study_of):
    study = study_of({"honed": honed, "ground": ground}, heights="auto")
    chosen = {n.place: n.text for n in study.notes if n.code == "heights_chosen"}
    assert chosen["surfaces.honed"].startswith("a bi-Gaussian plateau taken")
    assert chosen["surfaces.ground"].startswith("Gaussian heights taken")
    assert study.plan.heights.rows.tolist() == [0, 1, -1]


def test_the_plot_decides_for_measured_heights_where_they_are_neither(ground, study_of):
    study = study_of({"a": np.exp(ground / 7e-7) * 1e-6}, heights="auto")
    assert "its measured heights taken" in next(n.text for n in study.notes if n.code == "heights_chosen")


@pytest.mark.parametrize("heights", ["plateau", "measured"])
def test_a_plateau_carries_less_in_a_thick_film(heights, honed, study_of):
    normal, own = (run_study(study_of({"a": honed}, heights=h)) for h in ("gaussian", heights))
    assert (own["area_ratio"] < normal["area_ratio"]).all()
    assert (own["power_loss"] < normal["power_loss"]).all()
    assert np.array_equal(own["film_thickness"], normal["film_thickness"])


def test_the_area_is_the_overlap_of_the_traces_own_heights(honed, study_of):
    """One rough trace against a surface a thousand times smoother, at the film of each point of the path."""
    smooth = {"smooth": {"m0_um2": 1e-7, "m2": 1e-7, "m4_per_um2": 1e-5}}
    study = study_of({"a": honed}, moments=smooth, heights="measured")
    model, inputs = study.plan.model(), study.plan.inputs
    model.want = ("area_ratio", "film_thickness", "m0", "m2", "m4")
    found = model(inputs)
    with collected():
        z = study.rig.profile("a").heights
    z = (z - z.mean()) / z.std()
    row = study.pairings.index(("a", "smooth"))
    m0, m2, m4 = (float(np.asarray(inputs[k])[row, 0, 0, 0, 0]) for k in ("m0", "m2", "m4"))
    film = found["film_thickness"][0, 0, 0, 1, ::6]
    gap = (film - plane_offset(m0, m2, m4)) / summit_sigma(m0, m2, m4)
    overlap = np.maximum(z[:, None] - gap, 0.0).mean(axis=0)
    known = overlap * area_per_overlap(summit_density(m2, m4), summit_radius(m4), summit_sigma(m0, m2, m4))
    assert found["area_ratio"][row, 0, 0, 1, ::6] == pytest.approx(known, rel=2e-2)


def test_heights_go_with_a_balance_and_with_bands(honed, study_of):
    normal = run_study(study_of({"a": honed}, balance="johnson_greenwood_poon"))
    own = run_study(study_of({"a": honed}, heights="measured", bands="traces", balance="johnson_greenwood_poon"))
    assert own["balance_error"].max() < 1e-8
    assert (own["mean_asperity_load_share"] != normal["mean_asperity_load_share"]).all()
    assert (own["lowest_power_loss"] < own["power_loss"]).all()


def test_stated_moments_stay_normal_and_that_is_said(honed, study_of):
    study = study_of({"a": honed}, moments={"b": KNOWN}, heights="measured")
    assert "heights_chosen" in codes(study.notes)
    assert study.plan.heights.rows.tolist() == [0, 1, -1]


def test_heights_that_nothing_measures_or_reads_are_refused(honed, study_of, write_study):
    with pytest.raises(InputError, match=r"options\.heights.*needs surfaces given by traces"):
        read_study(write_study(options__heights="auto"))
    with pytest.raises(InputError, match=r'acts only with asperities = "greenwood_williamson"'):
        study_of({"a": honed}, heights="measured", asperities="kogut_etsion", hardness_GPa=6.0)
    trace, skewed = {"a": {"profile": "shipped:0258"}}, {"skewness": -1.0}
    path = write_study(surfaces=trace, options__heights="measured", effects__skewed_heights=skewed)
    with pytest.raises(InputError, match=r"skewed_heights.*heights"):
        read_study(path)


def test_the_contact_along_the_path_has_the_same_heights(tmp_path, monkeypatch):
    """The plain mean of the local area ratio is the one of the table."""
    import mixedlub as ml

    monkeypatch.chdir(tmp_path)
    long = finishes.honed(6e-8, 6e-7, plateau_share=0.8, points=9600, spacing=STEP, seed=3).profile
    np.savetxt("honed.txt", np.column_stack((1e3 * long.positions, 1e6 * long.heights)), fmt="%.7f")
    pair = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.2333, face_width_mm=14.0)
    honed = ml.surface("honed.txt", unit="mm, um", cutoff_mm=0.8)
    keys = {"torque_Nm": 100, "speed_rpm": 1500, "oil_temperature_C": 80}
    at = {
        heights: ml.along_path(pair, ml.oil("mineral"), honed, **keys, options={"heights": heights})[
            "boundary_area_ratio"
        ]
        for heights in ("gaussian", "measured")
    }
    assert (at["measured"] != at["gaussian"]).any()
    table = ml.power_loss(pair, ml.oil("mineral"), honed, **keys, options={"heights": "measured"})
    low, high = float(at["measured"].min()), float(at["measured"].max())
    assert low < float(table["boundary_area_ratio"].squeeze()) < high
