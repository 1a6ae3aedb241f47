"""What the standard rigs can and cannot tell apart."""

from __future__ import annotations

import numpy as np

from mixedlub.case import reference_rigs
from mixedlub.effects import catalogue
from mixedlub.report.effect_pages import lookalikes, shown, signature, signatures


class TestLookalikes:
    """What the standard rigs can and cannot tell apart."""

    def test_rolling_and_churning_by_viscosity_look_alike_on_a_gear(self) -> None:
        """Both are drag of a film then; churning by inertia is further off."""
        forward = reference_rigs.forward("gear_pair")
        base = forward.predict()

        def sign(name: str, values: dict[str, float]) -> np.ndarray:
            return signature(forward.predict(None, {name: values}) - base, "gear_pair")[0]

        rolling = sign("rolling_resistance", shown(catalogue()["rolling_resistance"]))
        laws = catalogue()["churning"].special_cases
        alike = {
            law: float(rolling @ sign("churning", {"strength": 1.0, "surplus": 0.0, **values}))
            for law, values in laws.items()
        }
        assert alike["Boness, laminar"] > 0.94 > alike["Changenet and Velex"] > alike["Boness, turbulent"]

    def test_windage_does_not_look_like_churning(self) -> None:
        assert "churning" not in lookalikes("windage", "gear_pair")

    def test_calibration_hides_a_gain_and_leaves_starvation(self) -> None:
        left = {name: kept for name, (_, kept) in signatures("gear_pair").items()}
        assert left["sensor_gain"] < 0.05 < 0.4 < left["starvation"]

    def test_shown_values_are_never_null(self) -> None:
        for effect in catalogue().values():
            values = shown(effect)
            assert all(values[p.name] != p.null for p in effect.parameters), effect.id
