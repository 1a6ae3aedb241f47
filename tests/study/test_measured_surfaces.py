"""Surfaces of a study from several traces, across and along the lay, and from height maps."""

import json
from pathlib import Path

import numpy as np
import pytest

from mixedlub.rig.surface import Surface, paired
from mixedlub.schema.findings import collected
from mixedlub.study import read_study, run_study
from mixedlub.study.record import resolved
from profiles import finishes
from profiles.errors import InputError
from profiles.read import read
from roughness import evaluation_profile, height_parameters, moments
from roughness.maps.moments import areal_moments
from roughness.maps.prepare import areal_roughness

STEP = 0.5e-6
KNOWN = {"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036}
RIDGED = KNOWN | {"m2_along": 0.0001, "m4_along_per_um2": 9e-6}


@pytest.fixture
def traces(tmp_path):
    """Files of ground traces of 0.3 um, and of smoother ones along the lay, with their heights."""

    def write(name, rms, rolloff, seed):
        made = finishes.ground(rms, points=9600, spacing=STEP, rolloff=rolloff, seed=seed).profile
        lines = "".join(f"{x * 1e3:.7f} {z * 1e6:.9f}\n" for x, z in zip(made.positions, made.heights))
        (tmp_path / name).write_text(f"# x mm, z um\n{lines}")
        return name

    across = [write(f"across_{k}.txt", 0.3e-6, 60e-6, k) for k in range(4)]
    return across, [write(f"along_{k}.txt", 0.2e-6, 300e-6, 10 + k) for k in range(3)]


def test_moments_of_several_traces_are_the_means(traces, write_study, tmp_path):
    study = read_study(write_study(surfaces={"a": {"traces": traces[0], "cutoff_mm": 0.8}}))
    each = [moments(evaluation_profile(read(tmp_path / name), cutoff=0.8e-3)) for name in traces[0]]
    for name in ("m0", "m2", "m4"):
        assert getattr(study.surfaces["a"], name) == pytest.approx(np.mean([getattr(m, name) for m in each]))


def test_one_trace_in_a_list_is_that_trace(traces, write_study):
    one = {"profile": traces[0][0], "cutoff_mm": 0.8}
    several = {"traces": traces[0][:1], "cutoff_mm": 0.8}
    first, second = (run_study(read_study(write_study(surfaces={"a": s}))) for s in (one, several))
    assert np.array_equal(first["power_loss"], second["power_loss"])


def test_traces_along_the_lay_have_the_cutoffs_of_those_across(traces, write_study):
    study = read_study(write_study(surfaces={"a": {"traces": traces[0], "traces_along": traces[1]}}))
    with collected():
        measured, found = study.rig.measured("a"), study.surfaces["a"]
    assert measured.along.filtered[0].cutoffs == pytest.approx(dict(measured.across.filtered[0].cutoffs))
    assert found.lay == "transverse"
    assert found.m2_along < found.m2
    assert found.m4_along < found.m4
    assert 0 < found.orientation < 1


def surface(name="a", **more):
    return Surface(name, 1e-14, 4e-3, 1.6e9, 0.0, 2.0, 46.0, 7800.0, 470.0, **more)


def test_a_lay_gives_geometric_means_of_moments_summed_by_direction():
    ridged = surface(lay="transverse", m2_along=1e-3, m4_along=1e8)
    plain = surface("b", lay="isotropic")
    both = paired([ridged], [plain])
    assert both["m2"] == pytest.approx(np.sqrt(8e-3 * 5e-3))
    assert both["m4"] == pytest.approx(np.sqrt(3.2e9 * 1.7e9))
    assert both["slope_share"] == pytest.approx(2.0 / (2.0 + 4.0))


def test_crossed_lays_add_ridges_to_plains():
    alike = paired(*[[surface(lay="transverse", m2_along=1e-3, m4_along=1e8)]] * 2)
    crossed = paired(
        [surface(lay="transverse", m2_along=1e-3, m4_along=1e8)],
        [surface(lay="longitudinal", m2_along=1e-3, m4_along=1e8)],
    )
    assert alike["m2"] == pytest.approx(4e-3)
    assert crossed["m2"] == pytest.approx(5e-3)


def test_an_isotropic_surface_is_as_one_without_a_stated_lay(write_study):
    plain, stated = (
        run_study(read_study(write_study(surfaces={"a": s}))) for s in (KNOWN, KNOWN | {"lay": "isotropic"})
    )
    assert np.array_equal(plain["power_loss"], stated["power_loss"])


def test_a_lay_lowers_the_summits_that_touch(write_study):
    plain, ridged = (run_study(read_study(write_study(surfaces={"a": s}))) for s in (KNOWN, RIDGED))
    assert (plain["area_ratio"] != ridged["area_ratio"]).all()


def test_a_result_computed_from_its_record_is_the_same(traces, write_study):
    study = read_study(write_study(surfaces={"a": {"traces": traces[0], "traces_along": traces[1]}}))
    recorded = json.loads(json.dumps(resolved(study)))
    again = read_study(write_study(name="again", surfaces=recorded["inputs"]["surfaces"]))
    assert run_study(again)["power_loss"] == pytest.approx(run_study(study)["power_loss"], rel=1e-10)
    assert recorded["traces"]["a"]["traces_along"] == traces[1]


@pytest.fixture
def area_file(tmp_path) -> Path:
    """An x3p map of ridges along y, 0.25 um rms."""
    import x3pio

    q = np.fft.fftfreq(500)
    radius = np.hypot(4.0 * q[:, None], q[None, :])
    power = np.where((radius > 1 / 80) & (radius < 1 / 12), np.maximum(radius, 1e-9) ** -2.5, 0.0)
    z = np.fft.ifft2(np.sqrt(power) * np.fft.fft2(np.random.default_rng(3).standard_normal(power.shape))).real
    x3pio.write(tmp_path / "ground.x3p", 0.25e-6 * z / z.std(), x_scale=STEP, y_scale=STEP)
    return tmp_path / "ground.x3p"


@pytest.mark.parametrize(("short", "applied"), [(8.0, 8.0), (0.5, None)])
def test_the_record_of_a_map_says_its_cutoffs(area_file, write_study, short, applied):
    """The short one is null where the spacing of 0.5 um does not show it."""
    study = read_study(write_study(surfaces={"a": {"map": area_file.name, "short_cutoff_um": short}}))
    recorded = json.loads(json.dumps(resolved(study)))["traces"]["a"]
    assert {"short_cutoff_um", "cutoff_mm"} <= recorded.keys()
    assert (recorded["short_cutoff_um"], recorded["cutoff_mm"]) == (applied, None)


def test_the_record_of_traces_says_their_cutoffs(traces, write_study):
    study = read_study(write_study(surfaces={"a": {"traces": traces[0], "cutoff_mm": 0.25, "short_cutoff_um": 2.5}}))
    recorded = json.loads(json.dumps(resolved(study)))["traces"]["a"]
    assert (recorded["short_cutoff_um"], recorded["cutoff_mm"]) == pytest.approx((2.5, 0.25))


def test_a_map_gives_the_moments_across_and_along_its_lay(area_file, write_study):
    from profiles.maps import read_map

    study = read_study(write_study(surfaces={"a": {"map": area_file.name, "short_cutoff_um": 2.5}}))
    found = study.surfaces["a"]
    known = areal_moments(areal_roughness(read_map(area_file), short_cutoff=2.5e-6))
    assert found.m2 == pytest.approx(known.profile(known.across_lay).m2)
    assert found.m2_along == pytest.approx(known.profile(known.across_lay + np.pi / 2).m2)
    assert found.orientation == pytest.approx(0.25, rel=0.1)
    assert "cutoff_assumed" in {note.code for note in study.notes}
    assert np.isfinite(run_study(study)["power_loss"]).all()


def test_heights_and_bands_of_a_map_are_those_of_the_whole(area_file, write_study):
    """A Gaussian map touches as its moments say; its scatter is that of its parts."""
    surfaces = {"a": {"map": area_file.name, "short_cutoff_um": 2.5}}
    found = {
        heights: run_study(read_study(write_study(surfaces=surfaces, options={"heights": heights, "bands": "both"})))
        for heights in ("gaussian", "measured", "auto")
    }
    normal, own = found["gaussian"], found["measured"]
    assert own["area_ratio"] == pytest.approx(normal["area_ratio"], rel=0.1)
    assert not np.array_equal(own["area_ratio"], normal["area_ratio"])
    assert np.array_equal(found["auto"]["area_ratio"], normal["area_ratio"])
    assert (own["lowest_power_loss"] < own["power_loss"]).all()
    assert (own["power_loss"] < own["highest_power_loss"]).all()


@pytest.mark.parametrize(("rows", "refused"), [(2, False), (300, True)])
def test_a_few_holes_of_a_map_are_left_out_and_said(area_file, write_study, tmp_path, rows, refused):
    import x3pio

    from profiles.maps import read_map

    holed = np.array(read_map(area_file).heights)
    holed[10 : 10 + rows, 30:230] = np.nan
    x3pio.write(tmp_path / "holed.x3p", holed, x_scale=STEP, y_scale=STEP)
    study = write_study(surfaces={"a": {"map": "holed.x3p"}})
    if refused:
        with pytest.raises(InputError, match=r"surfaces\.a.*60000 of 250000 points have no height"):
            read_study(study)
        return
    found = read_study(study)
    assert any(note.code == "trace_quality" and "400 of 250000" in note.text for note in found.notes)
    whole = read_study(write_study(surfaces={"a": {"map": area_file.name}})).surfaces["a"]
    for name in ("m0", "m2", "m4", "m2_along", "m4_along"):
        assert getattr(found.surfaces["a"], name) == pytest.approx(getattr(whole, name), rel=0.03)
    bands = write_study(surfaces={"a": {"map": "holed.x3p"}}, options={"heights": "measured", "bands": "both"})
    assert np.isfinite(run_study(read_study(bands))["highest_power_loss"]).all()


def test_a_lay_of_one_surface_of_two_is_refused(write_study):
    with pytest.raises(InputError, match=r"surfaces\.plain: its lay is unknown.*ridged"):
        read_study(write_study(surfaces={"ridged": RIDGED, "plain": KNOWN}))
    read_study(write_study(surfaces={"ridged": RIDGED, "plain": KNOWN}, pairings={"every": ["plain"]}))


def test_stated_moments_below_any_surface_are_refused(write_study):
    with pytest.raises(InputError, match=r"surfaces\.a: Nayak's m0 m4 / m2\^2 is 0\.576"):
        read_study(write_study(surfaces={"a": {"m0_um2": 0.001, "m2": 0.0025, "m4_per_um2": 0.0036}}))


@pytest.mark.parametrize(
    ("given", "named"),
    [
        (KNOWN | {"m2_along": 1e-4}, "both m2_along and m4_along_per_um2"),
        (KNOWN | {"lay": "transverse"}, "needs traces_along"),
        (RIDGED | {"lay": "isotropic"}, "has one direction"),
        (KNOWN | {"traces": ["a.txt"]}, "has both moments and a trace"),
        ({"profile": "a.txt", "traces": ["b.txt"]}, "has both profile and traces"),
        (KNOWN | {"traces_along": ["a.txt"]}, "belong to a profile or traces"),
        ({"traces": []}, "traces"),
        ({"map": "a.x3p", "outliers": 5.0}, "outliers"),
        ({"traces": ["nowhere.txt"]}, r"surfaces\.a\.traces: .*nowhere\.txt"),
    ],
)
def test_a_surface_that_contradicts_itself_is_refused(given, named, write_study):
    with pytest.raises(InputError, match=named):
        read_study(write_study(surfaces={"a": given}))


def test_traces_without_units_are_refused_with_the_key_that_helps(write_study, tmp_path):
    for name in ("a.txt", "b.txt"):
        np.savetxt(tmp_path / name, np.random.default_rng(0).standard_normal(4000))
    with pytest.raises(InputError, match=r"surfaces\.flank.* unit = '"):
        read_study(write_study(surfaces={"flank": {"traces": ["a.txt", "b.txt"], "spacing": "0.5 um"}}))


def test_a_lay_across_the_motion_thickens_the_film_and_one_along_it_thins_it(write_study):
    levels = {"conditions__torque_Nm": [50], "conditions__speed_rpm": [3000], "lubricant__temperature_C": [90.0, 130.0]}
    film = {}
    for lay in ("transverse", "longitudinal"):
        for chosen in ("none", "patir_cheng"):
            surface = RIDGED | {"m0_um2": 0.02, "m2": 2e-4, "m4_per_um2": 4e-4, "lay": lay, "m2_along": 8e-6}
            path = write_study(surfaces={"a": surface}, options__film_roughness=chosen, **levels)
            film[lay, chosen] = run_study(read_study(path))["film_thickness"].ravel()
    assert (film["transverse", "patir_cheng"] > 1.01 * film["transverse", "none"]).all()
    assert (film["longitudinal", "patir_cheng"] < film["longitudinal", "none"]).all()
    assert (film["longitudinal", "patir_cheng"] > 0.9 * film["longitudinal", "none"]).all()


def test_the_lay_in_the_film_goes_with_a_balance_and_is_flagged_in_thin_films(write_study):
    options = {"film_roughness": "patir_cheng", "balance": "johnson_greenwood_poon"}
    plain = run_study(read_study(write_study(surfaces={"a": RIDGED}, options={"balance": options["balance"]})))
    rough = run_study(read_study(write_study(surfaces={"a": RIDGED}, options=options)))
    assert rough["balance_error"].max() < 1e-8
    assert (rough["mean_asperity_load_share"] < plain["mean_asperity_load_share"]).all()
    path = write_study(surfaces={"a": RIDGED}, options={"film_roughness": "patir_cheng"}, conditions__speed_rpm=[50])
    flagged = run_study(read_study(path))
    assert "law_extrapolated:rough_film" in flagged.flags
    assert "options.film_roughness" in {one.place for one in flagged.findings}


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"surfaces": {"a": KNOWN}}, "needs the lay of every surface; unknown is that of a"),
        ({"surfaces": {"a": RIDGED}, "effects__roughness_lay": {"lay": 0.2}}, "roughness_lay"),
        ({"surfaces": {"a": RIDGED}, "options__friction": "schlenk"}, "goes with the base model's friction"),
    ],
)
def test_a_lay_in_the_film_that_is_unknown_or_twice_is_refused(changes, named, write_study):
    with pytest.raises(InputError, match=named):
        read_study(write_study(options__film_roughness="patir_cheng", **changes))


def test_files_of_a_surface_go_with_a_case(traces, tmp_path):
    """Into a folder of an import and out of a case: every trace, under its own key."""
    from mixedlub.importers.attachments import with_attachments

    surface = {"traces": [*traces[0], "shipped:0258"], "traces_along": traces[1]}
    answers = {"surfaces.a.traces": surface["traces"], "surfaces.a.traces_along": surface["traces_along"]}
    system, files = with_attachments(answers, [tmp_path])
    assert system["surfaces"]["a"] == surface
    assert set(files) == {*traces[0], *traces[1]}


def test_python_takes_surfaces_with_a_lay():
    """And so does the call from Python, with the same rule."""
    import mixedlub as ml

    pair = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.2333, face_width_mm=14.0)
    ridged, plain = ml.surface(**RIDGED), ml.surface(**KNOWN)
    keys = {"torque_Nm": 100, "speed_rpm": 1500, "oil_temperature_C": 80}
    assert ml.power_loss(pair, ml.oil("mineral"), ridged, **keys)["power_loss_W"].size == 1
    with pytest.raises(InputError, match="its lay is unknown"):
        ml.power_loss(pair, ml.oil("mineral"), (ridged, plain), **keys)


class TestMeanRoughness:
    """Laws that read Ra have the measured one; without a trace it is that of normal heights, which is said."""

    CODE = "mean_roughness_assumed"

    def studies(self, traces, write_study, friction):
        cut = {"cutoff_mm": 0.8}
        measured = {"a": {"traces": traces[0], **cut}, "b": {"traces": traces[1], **cut}}
        by_trace = read_study(write_study(surfaces=measured, options={"friction": friction}))
        stated = {
            name: {"m0_um2": one.m0 * 1e12, "m2": one.m2, "m4_per_um2": one.m4 * 1e-12}
            for name, one in by_trace.surfaces.items()
        }
        return by_trace, read_study(write_study(surfaces=stated, options={"friction": friction}))

    def test_schlenk_reads_the_measured_one(self, traces, write_study, tmp_path):
        """Ra^0.25 of both surfaces, against 0.798 Rq."""
        by_trace, stated = self.studies(traces, write_study, "schlenk")
        ra = {}
        for name, files in zip("ab", traces, strict=True):
            rough = [evaluation_profile(read(tmp_path / file), cutoff=0.8e-3) for file in files]
            ra[name] = np.mean([height_parameters(one).Ra for one in rough])
        rq = {name: one.m0**0.5 for name, one in stated.surfaces.items()}
        ratio = run_study(by_trace)["power_loss"] / run_study(stated)["power_loss"]
        for row, (a, b) in enumerate(by_trace.pairings):
            expected = ((ra[a] + ra[b]) / ((2.0 / np.pi) ** 0.5 * (rq[a] + rq[b]))) ** 0.25
            assert abs(expected - 1.0) > 1e-4
            assert ratio[row] == pytest.approx(expected, rel=1e-6)

    def test_the_assumption_is_said_once_where_a_law_reads_it(self, traces, write_study):
        for friction, counts in (("schlenk", (0, 1)), ("tallian_mixture", (0, 0))):
            studies = self.studies(traces, write_study, friction)
            assert tuple(sum(one.code == self.CODE for one in study.notes) for study in studies) == counts
