"""Figures of a loaded tooth contact: load share, transmission error, stiffness, load over the face, contact pattern."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.style import SMALL, WIDTH
from mixedlub.schema.result import Curve, Drawing, Panel, curve

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from mixedlub.gear.analysis import ToothContact

MOST_LINES = 6
"""Largest number of torques drawn, spread evenly over the computed torques."""


def _drawn(found: ToothContact, most: int) -> np.ndarray:
    """Indices of the drawn torques."""
    return np.unique(np.linspace(0, found.torque.size - 1, min(most, found.torque.size)).round().astype(int))


def gear_figures(title: str, found: ToothContact, tables: Mapping[str, pd.DataFrame]) -> dict[str, Drawing]:
    """All figures by file name."""
    return {
        "load_distribution": _distribution(found, tables.get("transmission_error")),
        "contact_pattern": partial(pattern_figure, title, found),
        "loss_factors": _loss_factors(tables["loss_factors"]),
    }


def _distribution(found: ToothContact, transmission: pd.DataFrame | None) -> tuple[Panel, ...]:
    """Load share of a tooth pair and load over the face; for elastic teeth also transmission error and stiffness."""
    chosen = _drawn(found, MOST_LINES)
    edges = np.linspace(0, found.pair.face_width * 1e3, found.face.size + 1).repeat(2)[1:-1]
    share, face = (
        tuple(Curve(x, y, f"{found.torque[i]:.4g} N m", group=group) for group, (i, x, y) in enumerate(drawn))
        for drawn in (
            [(i, np.degrees(found.roll_angle), found.load_share[i]) for i in chosen],
            [(i, edges, found.face_load[i].repeat(2) * 1e-3) for i in chosen],
        )
    )
    panels = (
        Panel(
            "roll angle of the pinion, middle of the face (deg)",
            "load share of a tooth pair (-)",
            share,
            from_zero=True,
        ),
        Panel("place over the face, from the front (mm)", "mean load per face width (N/mm)", face, from_zero=True),
    )
    if transmission is None:
        return panels
    turns = [transmission[transmission["torque_Nm"] == found.torque[i]] for i in chosen]
    across = "turn of the mesh (base pitches)"
    elastic = {"transmission_error_um": "transmission error (µm)", "mesh_stiffness_N_um": "mesh stiffness (N/µm)"}
    return panels + tuple(
        Panel(across, up, tuple(curve(one, "base_pitches", name, group=group) for group, one in enumerate(turns)))
        for name, up in elastic.items()
    )


def _loss_factors(factors: pd.DataFrame) -> tuple[Panel, ...]:
    """Loss factor of the local load over torque, and the valid closed-form loss factors."""
    local = factors[factors["torque_Nm"].notna()]
    closed = factors[factors["torque_Nm"].isna() & ~factors["outside_range"].astype(bool)]
    reach = local["torque_Nm"].to_numpy()[[0, -1]]
    lines = [
        Curve(reach, np.full(2, float(row["value"])), str(row["loss_factor"]), group=group, style="--")
        for group, row in enumerate(closed.to_dict("records"), start=1)
    ]
    curves = (curve(local, "torque_Nm", "value", "local load", style="o-"), *lines)
    return (Panel("torque on the pinion (N m)", "tooth loss factor (-)", curves, from_zero=True),)


def pattern_figure(title: str, found: ToothContact) -> Figure:
    """Hertz pressure over the flank, a panel per torque: contact pattern of a tooth pair in the mesh."""
    from matplotlib.figure import Figure

    chosen = _drawn(found, 4)
    columns = min(2, chosen.size)
    rows = -(-chosen.size // columns)
    figure = Figure(figsize=(WIDTH, 2.4 * rows + 0.4), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel()
    most = found.pressure[chosen].max() * 1e-6
    for axis, index in zip(axes, chosen, strict=False):
        pressure = np.where(found.force[index] > 0, found.pressure[index] * 1e-6, np.nan)
        # A slice is drawn at its own place on the path, whatever the obliquity of the line.
        image = axis.pcolormesh(
            np.degrees(found.position / found.pair.base_radius[0]),
            np.broadcast_to(found.face * 1e3, found.position.shape),
            pressure,
            cmap="viridis_r",
            vmin=0.0,
            vmax=most,
            shading="nearest" if found.face.size == 1 else "gouraud",
            rasterized=True,
        )
        axis.set_title(f"{found.torque[index]:.4g} N m")
        axis.set_xlabel("roll angle of the pinion (deg)")
        axis.set_ylabel("face (mm)")
    for axis in axes[chosen.size :]:
        axis.set_visible(False)
    figure.colorbar(image, ax=list(axes), label="Hertz pressure (MPa)")
    figure.suptitle(f"{title}: contact pattern", fontsize=SMALL)
    return figure
