"""Figures of worm drives: efficiency and friction over speed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mixedlub.schema.result import Curve, Drawing, Panel

if TYPE_CHECKING:
    import pandas as pd

DIRECTIONS = {"worm_drives_efficiency_percent": "worm drives", "wheel_drives_efficiency_percent": "wheel drives"}
SPEED = "sliding speed (m/s)"


def worm_figures(table: pd.DataFrame) -> dict[str, Drawing]:
    """All figures by file name; friction and efficiency depend on the speed alone."""
    rows = table.drop_duplicates("worm_speed_rpm").sort_values("sliding_speed_m_s")
    speed = rows["sliding_speed_m_s"].to_numpy()
    both = tuple(
        Curve(speed, rows[name].to_numpy(), label, group=group, style="o-")
        for group, (name, label) in enumerate(DIRECTIONS.items())
    )
    friction = (Curve(speed, rows["mean_friction"].to_numpy(), style="o-"),)
    return {
        "efficiency": (
            Panel(SPEED, "efficiency of the mesh (%)", both),
            Panel(SPEED, "mean friction coefficient (-)", friction),
        )
    }
