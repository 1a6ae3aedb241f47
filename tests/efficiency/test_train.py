"""Planetary trains: ratios, torques and efficiencies against closed forms and printed numbers."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from mixedlub.efficiency.train import CARRIER, Coupling, PlanetaryTrain
from profiles.errors import InputError
from tests.efficiency.planetary import meshed, simple, two_suns, wolfrom

INNER, OUTER = 0.98, 0.99
ETA0 = INNER * OUTER


class TestLiterature:
    def test_the_power_split_of_a_hybrid(self) -> None:
        """Sun 30, ring 78: 28 % of the torque on the carrier goes to the sun and 72 % to the ring, as printed."""
        couplings = Coupling("a", ("sun", "planet"), (30, 23)), Coupling("b", ("planet", "ring"), (23, -78))
        train = PlanetaryTrain(couplings, ("planet",), CARRIER, "ring", "sun")
        torque = train.flow(np.ones(1), np.ones((2, 1))).torque
        assert [round(-100.0 * torque[member][0]) for member in ("sun", "ring")] == [28, 72]
        assert 1.0 / PlanetaryTrain(couplings, ("planet",), "sun", CARRIER, "ring").speeds[CARRIER] == pytest.approx(
            3.6
        )


class TestClosedForms:
    """Mueller's efficiencies of trains with two central wheels, i0 the ratio and eta0 the efficiency at rest of the
    carrier."""

    @pytest.mark.parametrize(
        ("roles", "ratio", "efficiency"),
        [
            (("sun", CARRIER, "ring"), 5.0, (1 + 4 * ETA0) / 5),
            ((CARRIER, "sun", "ring"), 0.2, 5 / (1 + 4 / ETA0)),
            (("ring", CARRIER, "sun"), 1.25, (1 + ETA0 / 4) / 1.25),
            ((CARRIER, "ring", "sun"), 0.8, 1.25 / (1 + 1 / (4 * ETA0))),
            (("sun", "ring", CARRIER), -4.0, ETA0),
            (("ring", "sun", CARRIER), -0.25, ETA0),
        ],
    )
    def test_simple_trains(self, roles: tuple[str, str, str], ratio: float, efficiency: float) -> None:
        train = simple(*roles)
        assert 1.0 / train.speeds[roles[1]] == pytest.approx(ratio, rel=1e-12)
        assert train.efficiency([INNER, OUTER]) == pytest.approx(efficiency, rel=1e-9)

    def test_circulating_power_costs_more_than_the_meshes_suggest(self) -> None:
        """i0 = 0.9996: the carrier delivers 1.3 % of its power, and 2499 times its power rolls in the meshes."""
        i0 = 49 * 51 / 50**2
        train = two_suns(CARRIER, "a")
        assert train.speeds["a"] == pytest.approx(1 - i0, rel=1e-9)
        assert train.efficiency([INNER, OUTER]) == pytest.approx((1 - i0) / (1 - i0 * ETA0), rel=1e-9)
        flow = train.flow(np.ones(1), np.ones((2, 1)))
        assert train.rolling_power(flow) == pytest.approx(i0 / (1 - i0), rel=1e-6)

    @pytest.mark.parametrize(("eta0", "locks"), [(0.99, True), (0.9995, True), (0.9997, False), (0.99999, False)])
    def test_a_train_locks_where_its_closed_form_turns_negative(self, eta0: float, locks: bool) -> None:
        """The sun drives: (1 - i0/eta0)/(1 - i0) falls below zero once eta0 is below i0 = 0.9996."""
        i0 = 49 * 51 / 50**2
        closed = (1 - i0 / eta0) / (1 - i0)
        assert (closed < 0) == locks
        assert two_suns("a", CARRIER).efficiency([eta0, 1.0]) == pytest.approx(max(closed, 0.0), rel=1e-9)

    @pytest.mark.parametrize("eta", [(1.0, 1.0, 1.0), (0.985, 0.992, 0.994)])
    def test_wolfrom_by_the_balance_of_three_wheels(self, eta: tuple[float, float, float]) -> None:
        """T_s + T_1 + T_2 = 0 with a free carrier, and the planet takes in as much power as it gives."""
        train = wolfrom()
        speeds = train.speeds
        i1, i2 = 72 / 18, 72 * 24 / (27 * 69)
        assert 1 / speeds["second"] == pytest.approx((1 + i1) / (1 - i2), rel=1e-12)
        sun, first, second = (speeds[name] - speeds[CARRIER] for name in ("sun", "first", "second"))
        flow = train.flow(np.ones(1), np.array(eta)[:, None])
        assert flow.first_drives[:, 0].tolist() == [True, True, False]
        # Relative to the carrier sun and second ring drive, the fixed ring takes.
        a = np.array([[1.0, 1.0], [first / eta[1], eta[2] * second]])
        one, two = np.linalg.solve(a, [-1.0, -eta[0] * sun])
        assert train.efficiency(eta) == pytest.approx(-two * speeds["second"], rel=1e-9)
        assert flow.torque["first"] == pytest.approx(one, rel=1e-9)

    def test_planets_in_mesh_reverse_the_ratio(self) -> None:
        """i0 = +z_r/z_s: with the ring fixed 1 - 3 = -2, and eta = (1 - i0 eta0)/(1 - i0) for the driving sun."""
        train, eta0 = meshed("sun", CARRIER, "ring"), 0.98 * 0.985 * 0.99
        assert 1 / train.speeds[CARRIER] == pytest.approx(-2.0, rel=1e-12)
        assert train.efficiency([0.98, 0.985, 0.99]) == pytest.approx((3 * eta0 - 1) / 2, rel=1e-9)


TRAINS = [
    *(simple(*roles) for roles in permutations(("sun", "ring", CARRIER))),
    *(meshed(*roles) for roles in permutations(("sun", "ring", CARRIER))),
    wolfrom(),
]


class TestBalance:
    @pytest.mark.parametrize("train", TRAINS, ids=lambda t: f"{t.input}-{t.output}-{len(t.couplings)}")
    def test_power_in_is_power_out_and_what_the_meshes_lose(self, train: PlanetaryTrain) -> None:
        eta = np.full((len(train.couplings), 2), 0.985)
        torque = np.array([3.0, 70.0])
        drag = {train.planets[0]: np.array([0.1, 0.2])}
        flow = train.flow(torque, eta, drag=drag)
        powers = sum(flow.torque[member] * train.speeds[member] for member in train.members)
        lost = np.sum((1 - eta) * train.rolling_power(flow), axis=0)
        turning = abs(train.speeds[train.planets[0]] - train.speeds[CARRIER])
        assert powers == pytest.approx(lost + drag[train.planets[0]] * turning, rel=1e-9)
        assert sum(flow.torque.values()) == pytest.approx(
            0.0, abs=1e-9 * max(1.0, abs(flow.torque[train.output]).max())
        )

    def test_drag_of_a_free_carrier_loads_the_train(self) -> None:
        train = wolfrom()
        flow = train.flow(np.array([10.0]), np.ones((3, 1)), drag={CARRIER: np.array([2.0])})
        assert flow.torque[CARRIER] == pytest.approx(-2.0 * np.sign(train.speeds[CARRIER]), rel=1e-9)


class TestRefusals:
    def test_too_few_meshes(self) -> None:
        couplings = (Coupling("a", ("sun", "planet"), (18, 27)), Coupling("b", ("lost", "ring"), (27, -72)))
        train = PlanetaryTrain(couplings, ("planet", "lost"), "sun", CARRIER, "ring")
        with pytest.raises(InputError, match=r"5 bodies .* need 3 meshes"):
            train.check()

    def test_an_output_that_does_not_turn(self) -> None:
        couplings = Coupling("a", ("sun", "planet"), (20, 20)), Coupling("b", ("planet", "other"), (20, 20))
        with pytest.raises(InputError, match="no ratio exists"):
            PlanetaryTrain(couplings, ("planet",), "sun", CARRIER, "other").check()
