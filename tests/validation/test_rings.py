"""Ring gears and planetary meshes of the validation against the package's own gears and trains."""

import numpy as np
import pandas as pd
import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.cli import main
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.gear import GearPair
from mixedlub.validation.battery import make, plan
from mixedlub.validation.case_folder import write
from mixedlub.validation.contact import Calibration
from mixedlub.validation.rigs import KINDS, RINGS, gears, rings
from mixedlub.validation.sample_case import Order

from .helpers import readings, truth_of

PAIRS = (*rings.RINGS, *rings.MESHES)
NAMES = ["/".join(str(z) for z in pair["teeth"]) for pair in PAIRS]


@pytest.mark.parametrize("pair", PAIRS, ids=NAMES)
def test_the_path_of_contact_is_the_package_s(pair):
    own = gears.gears_of({"gears": pair})
    path = gears.path_of_contact(own)
    other = GearPair(
        own.teeth, own.module, own.pressure_angle, own.face_width, profile_shift=own.shift, tip_radius=own.tip
    )
    assert path.contact_ratio == pytest.approx(other.contact_ratio, rel=1e-12)
    assert (path.start, path.pitch, path.end) == pytest.approx(
        (other.path_start, other.pitch_point, other.path_end), rel=1e-12
    )
    assert path.pitch_radii == pytest.approx(sum(abs(radius) for radius in other.operating_radius), rel=1e-12)


@pytest.mark.parametrize("pair", PAIRS, ids=NAMES)
def test_a_clean_rig_reads_what_the_package_simulates(pair, tmp_path):
    """Without effects and calibration: 0.05 %, with 20,000 points where sharing jumps."""
    case = gears.draw_case(np.random.default_rng(7), False, [pair])
    expected = readings(gears.inputs_of(case, 20_000), Calibration(case.settings["boundary_friction"]))
    write(tmp_path, case, {"power_loss_W": expected}, np.arange(len(expected)) == 0, {})
    read = read_case(tmp_path)
    assert Forward(read, read.recordings).predict() == pytest.approx(expected[1:], rel=5e-4)


def test_a_ring_gear_case_is_simulated_and_all_effects_are_finite_on_it(tmp_path):
    case = gears.draw_case(np.random.default_rng(2), True, rings.RINGS)
    expected = readings(gears.inputs_of(case, 2_000), Calibration(case.settings["boundary_friction"]))
    write(tmp_path / "case", case, {"power_loss_W": expected}, np.arange(len(expected)) % 20 > 0, {})
    assert main(["simulate", str(tmp_path / "case"), "--out", str(tmp_path / "out")]) == 0
    simulated = pd.read_csv(tmp_path / "out" / "simulation.csv").set_index("run")["power_loss_W"]
    assert simulated[case.columns["run"]].to_numpy() == pytest.approx(expected, rel=5e-3)
    read = read_case(tmp_path / "case")
    forward = Forward(read, read.recordings)
    for effect in forward.effects():
        assert np.isfinite(forward.predict(None, {effect.id: effect.prior_medians})).all(), effect.id


@pytest.mark.parametrize("of", rings.SETS, ids=lambda of: "/".join(str(z) for z in of["teeth"].values()))
def test_a_planetary_set_can_be_assembled_and_its_meshes_fit(of):
    sun, planet, ring = (of["teeth"][name] for name in ("sun", "planet", "ring"))
    assert ring == sun + 2 * planet
    assert (sun + ring) % of["planets"] == 0
    apart = (sun + planet) * of["normal_module_mm"] * np.sin(np.pi / of["planets"])
    assert apart > of["tip_diameter_mm"]["planet"]


def test_speeds_against_the_carrier_are_those_of_two_rolling_circles():
    """Sun 28, planet 23, ring 74 held: speeds of the tooth circles on the turning carrier, without Willis."""
    teeth, sun = {"sun": 28, "planet": 23, "ring": 74}, 1000.0
    seen = rings.from_carrier(teeth, 3, 90.0, sun)
    # The planet rolls in the held ring: at its centre half the speed of the sun's rim, by which the carrier turns.
    carrier = 0.5 * sun * teeth["sun"] / (teeth["sun"] + teeth["planet"])
    assert seen["sun"] == pytest.approx((30.0, sun - carrier), rel=1e-12)
    assert seen["planet"][1] * teeth["planet"] == pytest.approx(carrier * teeth["ring"], rel=1e-12)
    assert np.prod(seen["planet"]) == pytest.approx(np.prod(seen["sun"]), rel=1e-12)


def test_they_are_dealt_only_by_name():
    assert not {order.kind for order in plan(3, 60)} & set(RINGS)
    assert {order.kind for order in plan(3, 40, RINGS)} == set(RINGS)
    assert set(RINGS) < set(KINDS)


@pytest.mark.long
@pytest.mark.parametrize(("place", "kind", "effect"), [(0, "ring_gear", "film_heating"), (1, "planetary", "churning")])
def test_a_planted_effect_is_named_on_the_mesh_of_a_ring_and_of_a_planet(tmp_path, place, kind, effect):
    order = Order("case", kind, "single", (effect,), "clear", small=True)
    make(3, place, order, tmp_path)
    case, truth = read_case(tmp_path / "case"), truth_of(tmp_path / "case")
    nominal = dict(zip(truth["rows"]["run"], truth["rows"]["nominal"]))
    expected = [nominal[int(run)] for run in case.recordings["run"]]
    assert Forward(case, case.recordings).predict() == pytest.approx(expected, rel=5e-3)
    assert (case.kind.name, truth["rig"], truth["identifiable"]) == ("gear_pair", kind, True)
    answer = diagnose_case(tmp_path / "case")
    assert [list(key.ids) for key in answer.posterior.tied] == [[effect]]
