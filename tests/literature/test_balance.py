"""Film and asperities that share the load, against an independent computation of the shipped study with rigid teeth."""

from __future__ import annotations

from pathlib import Path

import pytest

from mixedlub.study import Results, read_study, run_study

pytestmark = pytest.mark.literature(
    "K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91, computed independently to the digits below"
)
EXAMPLE = Path(__file__).parents[2] / "examples" / "study_21_pairings.toml"
YIELDING = {"asperities": "chang_etsion_bogy", "hardness_GPa": 6.0}

# Pairing, torque (Nm) and speed (rpm); elastic and yielding asperities of 6 GPa: film over that which carries the whole
# load, area ratio, share of the load, friction by area, friction by load. All are means over the path of contact.
AUDIT = [
    (("0036", "0036"), 100, 1500, (1.00, 0.001, 0.00, 0.026, 0.026), (1.00, 0.001, 0.00, 0.026, 0.026)),
    (("0036", "0036"), 100, 500, (1.01, 0.026, 0.10, 0.026, 0.031), (1.02, 0.031, 0.13, 0.026, 0.034)),
    (("0036", "0258"), 100, 1500, (1.39, 0.071, 0.91, 0.029, 0.094), (1.26, 0.154, 0.82, 0.036, 0.087)),
    (("0258", "0302"), 100, 3000, (1.61, 0.056, 0.97, 0.029, 0.098), (1.30, 0.160, 0.85, 0.038, 0.090)),
    (("0258", "0302"), 100, 1500, (2.56, 0.058, 1.00, 0.025, 0.100), (1.89, 0.187, 0.99, 0.036, 0.099)),
    (("0258", "0302"), 100, 500, (5.45, 0.058, 1.00, 0.018, 0.100), (4.00, 0.189, 1.00, 0.031, 0.100)),
    (("0450", "0450"), 150, 500, (10.6, 0.056, 1.00, 0.018, 0.100), (7.10, 0.231, 1.00, 0.035, 0.100)),
]


def balanced(**options) -> Results:
    file = read_study(EXAMPLE).file
    sharing = type(file.gears.load_sharing)(model="rigid")
    given = {**file.options.model_dump(exclude_unset=True), "balance": "johnson_greenwood_poon", **options}
    changed = {
        "gears": file.gears.model_copy(update={"load_sharing": sharing}),
        "options": type(file.options)(**given),
    }
    return run_study(read_study(EXAMPLE, file.model_copy(update=changed)))


@pytest.fixture(scope="module", params=[{}, YIELDING], ids=["elastic", "yielding"])
def computed(request):
    """With friction by area, and by load; and the column of the audit."""
    results = balanced(**request.param), balanced(**request.param, mixture="load_weighted")
    return *results, 1 if request.param else 0


@pytest.mark.parametrize("row", AUDIT, ids=lambda row: f"{'/'.join(row[0])}-{row[1]}-{row[2]}")
def test_balance_is_that_of_an_independent_computation(computed, row):
    """To 0.4 % or 0.7 of the last printed digit: some of its means over the path are coarser than the digits."""
    by_area, by_load, column = computed
    pairing, torque, speed, *found = row
    levels = by_area.study.file.conditions
    place = (
        by_area.study.pairings.index(pairing),
        0,
        levels.torque_Nm.index(torque),
        levels.speed_rpm.index(speed),
    )
    thicker, area, share, friction_by_area, friction_by_load = found[column]
    assert by_area["film_over_unbalanced"][place] == pytest.approx(thicker, rel=4e-3)
    assert by_area["area_ratio"][place] == pytest.approx(area, abs=0.0008)
    assert by_area["mean_asperity_load_share"][place] == pytest.approx(share, abs=0.0055)
    assert by_area["mean_friction"][place] == pytest.approx(friction_by_area, abs=0.0007)
    assert by_load["mean_friction"][place] == pytest.approx(friction_by_load, abs=0.0006)


def test_asperities_and_film_carry_the_load(computed):
    for results in computed[:2]:
        assert results["balance_error"].max() < 1e-8
        assert results["asperity_load_ratio"].max() <= 1.0 + 1e-8
