"""Figures of bevel and hypoid gears: efficiency over torque, contact lines, and what varies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.schema.result import Curve, Drawing, Panel

if TYPE_CHECKING:
    import pandas as pd

EFFICIENCY = "tooth efficiency (%)"
AXES = {
    "offset_mm": "offset (mm)",
    "spiral_angle_deg": "spiral angle (deg)",
    "wheel_teeth": "teeth of the wheel (-)",
    "roughness_factor": "factor on the roughness (-)",
}


def bevel_figures(tables: Mapping[str, pd.DataFrame]) -> dict[str, Drawing]:
    """All figures by file name."""
    figures: dict[str, Drawing] = {
        "efficiency": _efficiency(tables["map"]),
        "contact": _contact(tables["contact"]),
        "mesh_cycle": _cycle(tables["mesh_cycle"]),
    }
    if "vary" in tables and (panels := _varied(tables["vary"])):
        figures["vary"] = panels
    return figures


def _efficiency(table: pd.DataFrame) -> tuple[Panel, ...]:
    """Efficiency and mean friction over torque, a curve per speed at the last oil temperature."""
    last = table[table["oil_temperature_C"] == table["oil_temperature_C"].iloc[-1]]
    panels = []
    for name, up in (("tooth_efficiency_percent", EFFICIENCY), ("mean_friction", "mean friction coefficient (-)")):
        curves = tuple(
            Curve(rows["torque_Nm"].to_numpy(), rows[name].to_numpy(), f"{speed:.4g} rpm", group=group, style="o-")
            for group, (speed, rows) in enumerate(last.groupby("speed_rpm"))
        )
        panels.append(Panel("torque of the pinion (N m)", up, curves))
    return tuple(panels)


def _cycle(table: pd.DataFrame) -> tuple[Panel, ...]:
    """Efficiency and friction over one pitch."""
    return tuple(
        Panel("turn of the mesh (base pitches)", up, (Curve(table["base_pitches"].to_numpy(), table[name].to_numpy()),))
        for name, up in (("tooth_efficiency_percent", EFFICIENCY), ("mean_friction", "friction coefficient (-)"))
    )


def _contact(table: pd.DataFrame) -> tuple[Panel, ...]:
    """Contact lines on the flank at three positions of one pitch; sliding, pressure and friction along them."""
    positions = np.unique(table["base_pitches"])
    chosen = positions[np.unique(np.linspace(0, positions.size - 1, 3).round().astype(int))]
    return tuple(
        Panel("along the face from the mean point (mm)", up, tuple(_lines(table, chosen, name)), from_zero=zero)
        for name, up, zero in (
            ("height_mm", "height above the pitch plane (mm)", False),
            ("sliding_mm_rad", "sliding over pinion speed (mm/rad)", True),
            ("hertz_pressure_MPa", "Hertz pressure (MPa)", True),
            ("friction", "friction coefficient (-)", True),
        )
    )


def _lines(table: pd.DataFrame, positions: np.ndarray, name: str) -> Iterator[Curve]:
    """A quantity along each contact line at some positions of the mesh."""
    for group, position in enumerate(positions):
        for number, (_, rows) in enumerate(table[table["base_pitches"] == position].groupby("tooth_pair")):
            label = f"{position:.2g} pitches" if number == 0 else ""
            yield Curve(rows["face_position_mm"].to_numpy(), rows[name].to_numpy(), label, group=group)


def _varied(table: pd.DataFrame) -> tuple[Panel, ...]:
    """Efficiency over each number that varies."""
    known = table[table["tooth_efficiency_percent"].notna()]
    return tuple(
        Panel(
            AXES[str(name)],
            EFFICIENCY,
            (Curve(rows["value"].to_numpy(), rows["tooth_efficiency_percent"].to_numpy(), style="o-"),),
        )
        for name, rows in known.groupby("varied", sort=False)
    )
