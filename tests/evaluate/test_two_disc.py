"""Two discs: traction, drag and exponents planted by an independent rig, contact of crowned discs, bad input."""

import math

import numpy as np
import pytest

from mixedlub.evaluate import evaluate
from mixedlub.kinds.disc import contact_inputs
from mixedlub.schema.system_file import Contact
from mixedlub.schema.table import Table
from mixedlub.validation.benches import two_discs as bench
from mixedlub.validation.benches.tables import as_csv
from profiles.errors import InputError
from tests.evaluate.helpers import assert_intervals_hold, written

SILENT = bench.Errors(**dict.fromkeys(bench.Errors.__dataclass_fields__, 0.0))
BOTH = {"meters": {"drag": "both_signs"}}


def found_of(folder, columns, **changed):
    return evaluate("two-disc", written(folder, "two-disc", {"readings.csv": as_csv(columns, 9)}, **changed))


def test_planted_friction_is_found_where_nothing_is_uncertain(tmp_path):
    columns, truth = bench.recorded(bench.Bench(errors=SILENT), 0)
    table = found_of(tmp_path, columns).tables["traction"]
    assert table["friction_coefficient"].to_numpy() == pytest.approx(truth, rel=1e-6)
    assert table["entrainment_speed_m_s"][0] == pytest.approx(bench.BASE["speed"], rel=1e-6)
    assert table["slide_roll_ratio"][0] == pytest.approx(bench.BASE["ratio"], rel=1e-6)


def test_drag_of_bearings_is_taken_off_by_both_signs_of_sliding(tmp_path):
    columns, truth = bench.recorded(bench.Bench(errors=SILENT, bearings=0.3, both_signs=True), 0)
    table = found_of(tmp_path, columns, **BOTH).tables["traction"]
    assert table["friction_coefficient"].to_numpy() == pytest.approx(truth, rel=1e-6)
    kept = found_of(tmp_path, columns).tables["traction"]["friction_coefficient"].to_numpy()
    assert np.abs(kept - truth).max() > 0.01


def test_exponents_of_single_sweeps_are_those_planted(tmp_path):
    columns, _ = bench.recorded(bench.Bench(errors=SILENT), 0)
    swept = found_of(tmp_path, columns).tables["sweeps"].set_index("swept")
    assert swept["exponent"]["entrainment_speed_m_s"] == pytest.approx(-0.15, abs=1e-6)
    assert swept["exponent"]["load_N"] == pytest.approx(0.10, abs=1e-6)
    assert swept["exponent"]["oil_temperature_C"] == pytest.approx(0.001, rel=0.05)
    assert swept["readings"].to_dict() == {
        "load_N": 6 + 3,
        "entrainment_speed_m_s": 6 + 3,
        "slide_roll_ratio": 7 + 3,
        "oil_temperature_C": 5 + 3,
    }


@pytest.mark.literature("Vaishya and Houser 1999, AGMA 99FTMS1, figure 3: fluid A has nearly half the friction of B")
def test_an_oil_of_half_the_friction_is_seen_as_such(tmp_path):
    columns, _ = bench.recorded(bench.Bench(oils=(("ground", 1.0), ("fluid_a", 0.5))), 3)
    surfaces = {name: {"m0_um2": 0.4, "m2": 0.0031, "m4_per_um2": 0.0021} for name in ("ground", "fluid_a")}
    table = found_of(tmp_path, columns, surfaces=surfaces).tables["traction"]
    mean = table.groupby("surface_1")["friction_coefficient"].mean()
    assert mean["fluid_a"] / mean["ground"] == pytest.approx(0.5, abs=0.05)


def test_crowned_discs_touch_over_the_ellipse_of_both_radii(tmp_path):
    """The ellipse that is found bends the surfaces by both curvatures: the potential of Hertz, by quadrature.

    A pressure p0 sqrt(1 - (x/a)^2 - (y/b)^2) gives curvatures p0 a b/E* times the integrals below.
    """
    columns, _ = bench.recorded(bench.Bench(errors=SILENT), 0)
    row = found_of(tmp_path, columns).tables["traction"].iloc[3]
    a, pressure = row["hertz_half_width_um"] * 1e-6, row["hertz_pressure_MPa"] * 1e6
    b = 1.5 * row["load_N"] / (math.pi * a * pressure)
    contact_modulus = 206e9 / (1 - 0.3**2) / 2
    # With s = (b tan t)^2 the integrals over s from 0 to infinity become integrals over an angle.
    t = (np.arange(20000) + 0.5) / 20000 * math.pi / 2
    s = (b * np.tan(t)) ** 2
    step = 2 * b**2 * np.tan(t) / np.cos(t) ** 2 * math.pi / 2 / 20000 / np.sqrt(s)
    along = (step / ((a**2 + s) ** 1.5 * (b**2 + s) ** 0.5)).sum()
    across = (step / ((a**2 + s) ** 0.5 * (b**2 + s) ** 1.5)).sum()
    scale = pressure * a * b / (2 * contact_modulus)
    assert 1 / (2 * scale * along) == pytest.approx(15.24e-3, rel=2e-3)
    assert 1 / (2 * scale * across) == pytest.approx(38.1e-3, rel=2e-3)


def test_the_case_of_crowned_discs_computes_with_both_radii():
    contact = Contact(geometry="point", radius_mm=(25.4, 38.1), transverse_radius_mm=(76.2, 76.2))
    rows = Table(
        {"load_N": np.array([300.0]), "entrainment_speed_m_s": np.array([2.0]), "slide_roll_ratio": np.zeros(1)}
    )
    found = contact_inputs(contact, rows)
    assert found["radius"] == pytest.approx(15.24e-3, rel=1e-9)
    assert found["transverse_radius"] == pytest.approx(38.1e-3, rel=1e-9)


BAD = [
    ({"load_N": 0.0}, {}, "load_N: 0.0: load_N must be above 0"),
    ({"speed_1_rpm": 0.0, "speed_2_rpm": 0.0}, {}, "speed_1_rpm and speed_2_rpm: 0.0: mean surface speed of the discs"),
    ({"speed_1_rpm": -900.0, "speed_2_rpm": 0.0}, {}, "mean surface speed of the discs (m/s) must be above 0: they"),
    ({}, BOTH, "run 1: 1.08: no reading with the opposite slide-to-roll ratio, -1.08"),
    ({"surface_1": "honed"}, {}, "surface_1: 'honed': the file has no such surface"),
    ({}, {"contact": {"geometry": "line", "width_mm": 6.0}}, 'transverse_radius_mm acts only with geometry = "point"'),
    (
        {},
        {"contact": {"radius_mm": [math.inf, 38.1]}},
        "contact.radius_mm: (inf, 38.1): both discs need a",
    ),
    ({}, {"contact": {"transverse_radius_mm": [math.inf, math.inf]}}, "contact.transverse_radius_mm"),
]


@pytest.mark.parametrize(("column", "changed", "said"), BAD, ids=[said[:30] for *_, said in BAD])
def test_bad_input_is_refused_with_the_number_that_is_wrong(tmp_path, column, changed, said):
    columns, _ = bench.recorded(bench.Bench(), 0)
    columns |= {name: [value] * len(columns["run"]) for name, value in column.items()}
    with pytest.raises(InputError) as error:
        found_of(tmp_path, columns, **changed)
    assert said in str(error.value)


@pytest.mark.long
@pytest.mark.parametrize("both", [False, True])
def test_intervals_of_traction_and_exponents_hold_in_200_runs(tmp_path, both):
    rig = bench.Bench(both_signs=both, bearings=0.1 if both else 0.0)
    truth, value, low, high = ([] for _ in range(4))
    for seed in range(3000, 3200):
        columns, real = bench.recorded(rig, seed)
        found = found_of(tmp_path, columns, **(BOTH if both else {}))
        rows, swept = found.tables["traction"].iloc[::3], found.tables["sweeps"]
        swept = swept[swept["swept"] == "entrainment_speed_m_s"].iloc[0]
        truth.append([*real[::3], rig.speed_exponent])
        for ends, end in ((value, ""), (low, "_low90"), (high, "_high90")):
            ends.append([*rows[f"friction_coefficient{end}"], swept[f"exponent{end}"]])
    assert_intervals_hold(*map(np.array, (truth, value, low, high)))
