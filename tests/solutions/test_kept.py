"""The kept solutions: solved again, inside their ranges, and next to an average over the contact of another make."""

import numpy as np
import pandas as pd
import pytest

from mixedlub.commands.law_errors import RIGS, SEED
from mixedlub.ehl.oil.file import read_oil
from mixedlub.ehl.solve import CONVERGED, Way
from mixedlub.solutions import kept as solutions
from mixedlub.solutions import ratios, rigs

ROW = ("pao_vg100", 3)
"""Oil and rig of which contacts are solved again."""


@pytest.fixture(scope="module")
def kept() -> pd.DataFrame:
    return solutions.read_solutions(solutions.KEPT)


@pytest.mark.filterwarnings("ignore:lubricant")
def test_kept_solutions_are_those_of_the_solver(kept: pd.DataFrame) -> None:
    oil, rig = ROW
    rows = kept[(kept["oil"] == oil) & (kept["rig"] == rig) & (kept["thermal_status"] == CONVERGED)].iloc[[1, 5, 9]]
    found = solutions.solve_both(read_oil(oil), solutions.contacts_of(rows), Way())
    for name in solutions.columns()[7:]:
        if name.endswith(("_nm", "friction", "_W_m", "_K")):
            assert found[name] == pytest.approx(rows[name].to_numpy(), rel=2e-3), name


@pytest.mark.filterwarnings("ignore:lubricant")
def test_kept_solutions_cover_the_range_of_gears_and_are_small(kept: pd.DataFrame) -> None:
    assert solutions.KEPT.stat().st_size < 200_000
    assert kept["oil"].nunique() >= 2
    share = (kept[["isothermal_status", "thermal_status"]] == CONVERGED).mean()
    assert (share > 0.99).all()
    for oil, rows in kept.groupby("oil"):
        of = read_oil(str(oil))
        found = solutions.contacts_of(rows)
        load, material = found.moes(*of.at_ambient(found.oil_temperature))
        for value, (low, high) in ((load, rigs.LOADS), (material, rigs.MATERIALS), (found.pressure, rigs.PRESSURES)):
            assert (value > 0.99 * low).all()
            assert (value < 1.01 * high).all()
        assert load.max() > 50.0
        assert material.max() > 12.0


@pytest.mark.filterwarnings("ignore")
def test_traction_of_the_contact_is_that_of_hertz_pressure_and_an_even_film(kept: pd.DataFrame) -> None:
    rows = kept[kept["oil"] == "atf"]
    oil = read_oil("atf")
    _, fitted = ratios.by_contact(rows, {"atf": oil})
    heavy = (fitted["moes_load"] > 20.0).to_numpy() & (rows["isothermal_status"] == CONVERGED).to_numpy()
    place = np.linspace(-1.0, 1.0, 2001)
    found = solutions.contacts_of(rows[heavy])
    pressure = found.pressure[:, None] * np.sqrt(1.0 - place**2)
    viscosity = np.exp(oil.log_viscosity(pressure, found.oil_temperature[:, None])[0])
    film = 1e-9 * rows.loc[heavy, "isothermal_central_film_nm"].to_numpy()
    stress = 5e6 * np.arcsinh(viscosity * (np.abs(found.sliding) / film)[:, None] / 5e6)
    mean = np.trapezoid(stress, place) / np.trapezoid(pressure, place)
    peak = stress[:, place.size // 2] / found.pressure
    even = mean / peak
    solved = fitted["traction_mean_over_peak"].to_numpy()[heavy]
    assert heavy.sum() > 20
    assert solved == pytest.approx(even, rel=0.06)


@pytest.mark.filterwarnings("ignore:lubricant")
def test_the_kept_contacts_are_those_that_the_command_draws(kept: pd.DataFrame) -> None:
    place, oil = 2, list(kept["oil"].unique())[2]
    drawn = solutions.conditions(rigs.draw(read_oil(oil), RIGS, SEED + place).contacts)
    rows = kept[kept["oil"] == oil]
    for name in solutions.CONDITIONS:
        assert rows[name].to_numpy() == pytest.approx(drawn[name].to_numpy(), rel=1e-3), name


@pytest.mark.filterwarnings("ignore")
def test_options_of_the_base_model_are_those_of_a_study(kept: pd.DataFrame) -> None:
    by_contact, _ = ratios.by_contact(kept[kept["oil"] == "atf"], {"atf": read_oil("atf")})
    base, mean = by_contact["base model, isothermal"], by_contact["contact_pressure = mean"]
    assert (mean / base).dropna().to_numpy() == pytest.approx(4.0 / np.pi)
    assert (by_contact["viscosity_pressure = mean"].dropna() < base.dropna()).all()
    # the solver has Roelands' law for an oil without constants of another
    assert by_contact["viscosity law of the oil"].dropna().to_numpy() == pytest.approx(base.dropna().to_numpy())
