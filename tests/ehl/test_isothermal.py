"""Isothermal films against reference solutions of another program, limits with exact answers, and Moes' formula."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from mixedlub.ehl.flow import flow
from mixedlub.ehl.grid import grid
from mixedlub.ehl.levels import solve_levels
from mixedlub.ehl.measures import measures
from mixedlub.ehl.oil import shear
from mixedlub.laws.film import moes_line
from tests.ehl.contacts import EYRING, TEMPERATURE, by_moes, contacts, roelands_oil

TABLE = {
    (3, 3): (3.5629, 3.6327, 2.7496, 3.6465, 3.5367, 2.7681),
    (3, 10): (6.1325, 6.1429, 4.7102, 6.3325, 5.6297, 4.6841),
    (10, 3): (2.9556, 2.9568, 2.2419, 3.0285, 2.7934, 2.2528),
    (10, 6): (4.0900, 4.0902, 3.0860, 4.2110, 3.7053, 3.0788),
    (10, 10): (5.4560, 5.4561, 4.1250, 5.6188, 4.7579, 4.0740),
    (10, 15): (7.0072, 7.0072, 5.3131, 7.2022, 5.9225, 5.1935),
    (30, 3): (2.5090, 2.5090, 1.8909, 2.5746, 2.2868, 1.8989),
    (30, 6): (3.5631, 3.5631, 2.6715, 3.6705, 3.0960, 2.6594),
    (30, 10): (4.8294, 4.8294, 3.6256, 4.9729, 4.0463, 3.5704),
    (30, 15): (6.2687, 6.2687, 4.7157, 6.4402, 5.1139, 4.5959),
    (100, 3): (2.1010, 2.1010, 1.5765, 2.1589, 1.8329, 1.5818),
    (100, 6): (3.0454, 3.0454, 2.2752, 3.1393, 2.5388, 2.2602),
    (100, 10): (4.1777, 4.1777, 3.1243, 4.3026, 3.3812, 3.0693),
    (300, 3): (1.7864, 1.7864, 1.3368, 1.8376, 1.4999, 1.3401),
    (300, 6): (2.6290, 2.6290, 1.9605, 2.7111, 2.1265, 1.9440),
    (1, 6): (5.3463, 4.5535, 4.2904, 5.5237, 4.6078, 4.3539),
}
"""By Moes' M and L: flow film, central and minimum film in his units, incompressible and compressible.

Extrapolated from 241 and 481 nodes by another program for the same equations; Roelands' exponent 0.65, 20 per GPa.
"""
FILMS = ("flow_film", "central_film", "minimum_film")
NUMBERS = np.array(list(TABLE), dtype=float)


def films(oil, cases, level="fine", nodes=(61, 121, 241)):
    """Films in Moes' units, a row a contact."""
    solved = solve_levels(oil, cases, thermal=False, nodes=nodes)
    assert not np.any(solved.stopped_at)
    found = measures(oil, cases, getattr(solved, level), thermal=False)
    load, _ = cases.moes(*oil.at_ambient(cases.oil_temperature))
    unit = np.pi * cases.gap_unit / (8.0 * load)
    return np.stack([found[name] / unit for name in FILMS], axis=1), found


@pytest.mark.parametrize("compressible", [False, True])
def test_films_of_the_table(compressible):
    found, _ = films(roelands_oil(compressible=compressible), by_moes(*NUMBERS.T))
    wanted = np.array(list(TABLE.values()))[:, 3:] if compressible else np.array(list(TABLE.values()))[:, :3]
    assert np.max(np.abs(found / wanted - 1.0)) < 0.01


@pytest.mark.literature("H. Moes, Lubrication and Beyond, University of Twente (2000), line contact in all regimes")
def test_the_flow_film_is_that_of_moes_in_every_regime():
    load, material = np.meshgrid([0.3, 1.0, 10.0, 100.0, 300.0], [1.0, 6.0, 15.0, 22.0])
    load, material = load.ravel(), material.ravel()
    found, _ = films(roelands_oil(compressible=False), by_moes(load, material))
    assert np.all(np.abs(moes_line(load, material) / found[:, 0] - 1.0) < 0.07)


@pytest.mark.literature("H. M. Martin, Engineering 102 (1916) 119: h = 4.895 eta u R/w at the minimum")
def test_rigid_and_isoviscous_is_martin():
    cases = by_moes(0.3, 0.1)
    found, _ = films(roelands_oil(compressible=False), cases)
    load = 0.3
    assert found[0, 0] == pytest.approx(3.0009 / load, rel=0.01)
    assert found[0, 2] == pytest.approx(4.895 / (2.0 * load), rel=0.01)


@pytest.mark.literature(
    "H. Hertz, J. reine angew. Math. 92 (1882) 156: the pressure of a dry line contact is an ellipse"
)
def test_a_thin_film_has_the_pressure_of_hertz():
    _, found = films(roelands_oil(), by_moes(300.0, 6.0))
    cases = by_moes(300.0, 6.0)
    place = found["position"][0] / cases.half_width
    inside = np.abs(place) < 0.8
    wanted = np.sqrt(1.0 - place[inside] ** 2)
    assert np.max(np.abs(found["pressure"][0, inside] / cases.pressure / wanted - 1.0)) < 0.02


def test_the_error_falls_with_the_square_of_the_spacing():
    """Differences of three nested grids, and what two of them extrapolate to."""
    cases, oil = by_moes([10.0, 100.0], [10.0, 6.0]), roelands_oil(compressible=False)
    coarse, _ = films(oil, cases, "coarse")
    middle, _ = films(oil, cases)
    fine, _ = films(oil, cases, nodes=(61, 121, 241, 481))
    ratio = (middle - coarse)[:, :2] / (fine - middle)[:, :2]
    assert np.all((ratio > 3.5) & (ratio < 4.5))
    assert (middle + (middle - coarse) / 3.0)[:, 0] == pytest.approx([5.4560, 3.0454], rel=1e-3)


def test_random_contacts_are_solved_and_keep_load_and_mass():
    random = np.random.default_rng(7)
    load, material = 10.0 ** random.uniform(0.0, np.log10(300.0), 24), random.uniform(3.0, 22.0, 24)
    _, found = films(roelands_oil(), by_moes(load, material))
    assert np.max(np.abs(found["load_imbalance"])) < 1e-9
    assert np.max(np.abs(found["mass_imbalance"])) < 1e-6
    assert np.all(found["minimum_film"] > 0.0)


def test_slopes_of_the_flow_are_those_of_small_changes():
    """The flow of a state off its solution, changed node by node, for every law of shear."""
    cases = contacts(0.01, 2e5, 2.0, 3.0, TEMPERATURE)
    mesh = grid(np.array([-3.0]), np.array([0.1]), 31)
    for law, scale in ((shear.newton, 1e9), (EYRING[5], 5e6)):
        oil = roelands_oil(law, scale=scale)
        state = solve_levels(oil, cases, thermal=False, nodes=(31, 61)).coarse.state
        state = replace(state, pressure=0.9 * state.pressure)
        gap = state.gap(mesh)
        now = flow(oil, cases, mesh, state, gap)
        for node in (5, 14, 20):
            pressure, height = state.pressure.copy(), gap.copy()
            pressure[0, node] += 1e-6
            height[0, node] += 1e-7
            by_pressure = (flow(oil, cases, mesh, replace(state, pressure=pressure), gap).mass - now.mass)[0] / 1e-6
            by_gap = (flow(oil, cases, mesh, state, height).mass - now.mass)[0] / 1e-7
            for numeric, slopes in ((by_pressure, now.by_pressure), (by_gap, now.by_gap)):
                exact = [slopes[2][0, node - 1], slopes[1][0, node], slopes[0][0, node + 1]]
                assert numeric[node - 1 : node + 2] == pytest.approx(exact, rel=1e-3, abs=1e-6)


def test_a_nearer_inlet_starves_the_contact():
    flooded = by_moes(30.0, 10.0)
    cases = [replace(flooded, inlet=np.array([inlet])) for inlet in (-2.0, -1.3, -1.1)]
    flows = [films(roelands_oil(), case)[0][0, 0] for case in (flooded, *cases)]
    assert all(one > two for one, two in pairwise(flows))
    assert flows[3] < 0.8 * flows[0]
