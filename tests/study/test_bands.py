"""Bands of the results: they hold what the spectrum behind the traces gives, as often as they say."""

import numpy as np
import pytest

from mixedlub.schema.findings import codes
from mixedlub.study import read_study, run_study
from mixedlub.study.columns import COLUMNS
from profiles import Profile
from profiles.errors import InputError
from profiles.synthesise import from_spectrum

STEP, POINTS, POOL = 0.5e-6, 9600, 2000
LONG, SHORT = 0.8e-3, 2.5e-6
ALPHA = np.sqrt(np.log(2.0) / np.pi)


def spectrum(q):
    """Flat to a roll-off at 40 um, then falling, smooth below 6 um (SI, angular wavenumber)."""
    f = q / (2 * np.pi)
    return 1e-20 * (1 + (f * 40e-6) ** 2) ** -1.3 * np.exp(-((f * 6e-6) ** 2))


def true_moments(scale=1.0, short=SHORT):
    """m0, m2, m4 of the spectrum after the Gaussian filters of ISO 16610-21, as differences see them."""
    step = 2 * np.pi / (200 * POINTS * STEP)
    q = step * np.arange(1, 100 * POINTS)
    low = np.exp(-np.pi * (ALPHA * short * q / (2 * np.pi)) ** 2)
    high = 1 - np.exp(-np.pi * (ALPHA * LONG * q / (2 * np.pi)) ** 2)
    power = scale * spectrum(q) * (low * high) ** 2 * step
    slope = 2 * np.sin(q * STEP / 2) / STEP
    return [float((power * slope**n).sum()) for n in (0, 2, 4)]


@pytest.fixture(scope="module")
def pool():
    """Traces cut from one long surface, which are independent of each other but for their neighbours."""
    heights = from_spectrum(spectrum, points=POOL * POINTS, spacing=STEP, seed=5).profile.heights
    return [Profile(z, STEP, name=f"trace {k}") for k, z in enumerate(np.split(heights, POOL))]


@pytest.fixture
def of_profiles(monkeypatch, write_study):
    """A study whose surfaces have these profiles as traces."""

    def make(profiles, **changes):
        names = {name: {"traces": [f"{name}_{k}" for k in range(len(p))]} for name, p in profiles.items()}
        surfaces = {name: one | {"cutoff_mm": 0.8, "short_cutoff_um": 2.5} for name, one in names.items()}
        monkeypatch.setattr("mixedlub.rig.build.traces", lambda name, *_: tuple(profiles[name]))
        changes = {"conditions__torque_Nm": [100], "conditions__oil_temperature_C": [80]} | changes
        return read_study(write_study(surfaces=surfaces, **changes))

    return make


@pytest.mark.long
@pytest.mark.parametrize(("traces", "surfaces"), [(1, 250), (4, 250)], ids=["sampling lengths", "four traces"])
def test_a_band_of_90_percent_holds_the_true_value_of_84_to_96(traces, surfaces, pool, of_profiles, write_study):
    m0, m2, m4 = true_moments()
    known = {"m0_um2": m0 * 1e12, "m2": m2, "m4_per_um2": m4 * 1e-12}
    levels = {"conditions__torque_Nm": [100], "conditions__oil_temperature_C": [80], "options__path_points": 12}
    truth = run_study(read_study(write_study(name="truth", surfaces={"a": known, "b": known}, **levels)))
    held = {name: [] for name in ("power_loss", "mean_friction", "area_ratio", "composite_roughness")}
    for first in range(0, surfaces * 2 * traces, 2 * traces):
        mine = {"a": pool[first:][:traces], "b": pool[first + traces :][:traces]}
        found = run_study(of_profiles(mine, options={"bands": "traces", "path_points": 12}))
        for name, counts in held.items():
            within = (found["lowest_" + name] <= truth[name]) & (truth[name] <= found["highest_" + name])
            counts.append(within.reshape(3, -1))
    for name, counts in held.items():
        for pairing, share in enumerate(np.mean(counts, axis=(0, 2))):
            assert 0.84 <= share <= 0.97, (name, pairing)


def test_columns_stand_behind_the_others_with_units(pool, of_profiles):
    found = run_study(of_profiles({"a": pool[:3]}, options__bands="traces"))
    table = found.to_pandas()
    own = list(table)
    assert own.index("power_loss_low_W") > own.index("asperity_real_pressure_MPa")
    for name, column in COLUMNS.items():
        if "lowest_" + name in found.values:
            low, high = COLUMNS["lowest_" + name].name, COLUMNS["highest_" + name].name
            assert (table[low] <= table[column.name]).all()
            assert (table[column.name] <= table[high]).all()
    assert (table["power_loss_low_W"] < table["power_loss_high_W"]).all()
    assert (table["hertz_pressure_low_MPa"] == table["hertz_pressure_MPa"]).all()


def test_what_follows_from_the_surfaces_has_bands_and_what_does_not_has_none(pool, of_profiles):
    limits = {
        "scuffing_temperature_C": 250.0,
        "integral_scuffing_temperature_C": 200.0,
        "flash_weight": 1.5,
        "permissible_film_ratio": 0.3,
    }
    changes = {"options__bands": "traces", "safety": limits, "effects": {"bulk_temperature": {}}}
    table = run_study(of_profiles({"a": pool[:3], "b": pool[3:6]}, **changes)).to_pandas()
    followed = (
        "contact_temperature{}_C",
        "efficiency{}",
        "tooth_efficiency{}",
        "normalised_loss{}",
        "minimum_film_parameter{}",
        "asperity_load_share{}",
        "scuffing_safety_flash{}",
        "integral_temperature{}_C",
        "scuffing_safety_integral{}",
        "micropitting_film_ratio{}",
        "micropitting_safety{}",
    )
    for name in followed:
        low, own, high = (table[name.format(end)] for end in ("_low", "", "_high"))
        assert ((low <= own) & (own <= high)).all(), name
        assert (low < high).any(), name
    loss = table["power_loss_high_W"] / table["power_loss_W"]
    assert (table["normalised_loss_high"] / table["normalised_loss"]).to_numpy() == pytest.approx(loss.to_numpy())
    alone = ("input_power_W", "loss_factor_H_V", "loss_factor_H_VL", "bulk_temperature_C")
    banded = {name.replace("_low", "") for name in table if "_low" in name}
    assert set(alone) <= set(table)
    assert not banded & set(alone)


def test_without_bands_there_are_no_such_columns(pool, of_profiles):
    assert not [c for c in run_study(of_profiles({"a": pool[:3]})).to_pandas() if "_low" in c or "_high" in c]


def test_a_band_leaves_the_results_as_they_are(pool, of_profiles):
    with_band = run_study(of_profiles({"a": pool[:3], "b": pool[3:6]}, options__bands="both"))
    without = run_study(of_profiles({"a": pool[:3], "b": pool[3:6]}))
    for name, values in without.values.items():
        assert np.array_equal(values, with_band[name], equal_nan=True), name


def test_the_band_of_short_cutoffs_ends_at_half_one_and_two(pool, of_profiles):
    kept = {"a": pool[:1]}
    found = run_study(of_profiles(kept, options__bands="short_cutoff"))
    section = {"traces": ["a_0"], "cutoff_mm": 0.8}
    each = [
        run_study(of_profiles(kept, surfaces__a=section | {"short_cutoff_um": short}))["power_loss"]
        for short in (1.25, 2.5, 5.0)
    ]
    assert found["lowest_power_loss"] == pytest.approx(np.min(each, axis=0), rel=1e-9)
    assert found["highest_power_loss"] == pytest.approx(np.max(each, axis=0), rel=1e-9)


def test_both_holds_each(pool, of_profiles):
    ends = {
        kind: run_study(of_profiles({"a": pool[:4]}, options__bands=kind))
        for kind in ("traces", "short_cutoff", "both")
    }
    for name in ("power_loss", "area_ratio"):
        for kind in ("traces", "short_cutoff"):
            assert (ends["both"]["lowest_" + name] <= ends[kind]["lowest_" + name]).all()
            assert (ends["both"]["highest_" + name] >= ends[kind]["highest_" + name]).all()


def test_more_traces_make_a_narrower_band(pool, of_profiles):
    few, many = (run_study(of_profiles({"a": pool[:n]}, options__bands="traces")) for n in (3, 40))
    width = [f["highest_power_loss"] - f["lowest_power_loss"] for f in (few, many)]
    assert (width[1] < 0.5 * width[0]).all()


def test_what_a_band_rests_on_is_reported(pool, of_profiles, write_study):
    study = of_profiles(
        {"a": pool[:2]}, options__bands="both", surfaces__b={"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036}
    )
    assert {"band_of_sampling_lengths", "band_stated_moments"} <= set(codes(study.notes))
    with pytest.raises(InputError, match=r"options\.bands.*needs surfaces given by traces"):
        read_study(write_study(name="stated", options__bands="traces"))


def test_too_short_a_trace_has_no_scatter(pool, of_profiles):
    short = Profile(pool[0].heights[:3600], STEP)
    with pytest.raises(InputError, match=r"surfaces\.a: the scatter needs three traces"):
        of_profiles({"a": [short]}, options__bands="traces")


def test_a_band_resumes_and_runs_in_blocks(pool, of_profiles, tmp_path, monkeypatch):
    whole = run_study(of_profiles({"a": pool[:3], "b": pool[3:6]}, options__bands="traces"))
    monkeypatch.setattr("mixedlub.study.batch.BLOCK_POINTS", 200)
    study = of_profiles({"a": pool[:3], "b": pool[3:6]}, options__bands="traces")
    parts = tmp_path / "parts"
    parts.mkdir()
    first = run_study(study, parts=parts)
    again = run_study(study, parts=parts)
    for found in (first, again):
        assert found["lowest_power_loss"] == pytest.approx(whole["lowest_power_loss"], rel=1e-12)


@pytest.mark.parametrize("kind", ["none", "traces"])
def test_curves_are_shaded_where_there_is_a_band(kind, pool, of_profiles):
    from mixedlub.report.figures import figures
    from mixedlub.report.plots import over_speed

    found = run_study(of_profiles({"a": pool[:3]}, options__bands=kind))
    panel = over_speed(found, "power_loss", [0], 0).axes[0]
    shades = [c for c in panel.collections if type(c).__name__ in ("PolyCollection", "FillBetweenPolyCollection")]
    assert len(shades) == (kind == "traces")
    if shades:
        top = shades[0].get_paths()[0].vertices[:, 1].max()
        assert top == pytest.approx(found["highest_power_loss"].max())
    captions = {one.name: one.caption for one in figures(found)}
    assert ("Shaded: in 90 of 100" in captions["power_loss_equal"]) == bool(shades)
