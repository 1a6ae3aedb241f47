"""Figures of a loaded tooth contact: load share, transmission error, stiffness, load over the face, contact pattern."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.style import SMALL, WIDTH, legend_above, panels, shades, styled

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from mixedlub.gear.analysis import ToothContact

MOST_LINES = 6
"""Most torques that are drawn, spread evenly over those that were computed."""


def _drawn(found: ToothContact, most: int) -> np.ndarray:
    """Indices of the torques that are drawn."""
    return np.unique(np.linspace(0, found.torque.size - 1, min(most, found.torque.size)).round().astype(int))


def distribution_figure(title: str, found: ToothContact, transmission: pd.DataFrame) -> Figure:
    """Load share of a tooth pair and load over the face; of elastic teeth also transmission error and stiffness."""
    chosen = _drawn(found, MOST_LINES)
    elastic = len(transmission) > 0
    with styled():
        figure, axes, _ = panels(4 if elastic else 2, 2, sharex=False, sharey=False)
        for index, colour in zip(chosen, shades(chosen.size), strict=True):
            torque = found.torque[index]
            axes[0].plot(np.degrees(found.roll_angle), found.load_share[index], color=colour, label=f"{torque:.4g}")
            edges = np.linspace(0, found.pair.face_width * 1e3, found.face.size + 1)
            axes[1].stairs(found.face_load[index] * 1e-3, edges, color=colour, baseline=None)
            if elastic:
                one = transmission[transmission["torque_Nm"] == torque]
                axes[2].plot(one["base_pitches"], one["transmission_error_um"], color=colour)
                axes[3].plot(one["base_pitches"], one["mesh_stiffness_N_um"], color=colour)
        labels = [
            ("roll angle of the pinion, middle of the face (deg)", "load share of a tooth pair (-)"),
            ("place over the face, from the front (mm)", "mean load per face width (N/mm)"),
            ("turn of the mesh (base pitches)", "transmission error (µm)"),
            ("turn of the mesh (base pitches)", "mesh stiffness (N/µm)"),
        ]
        for axis, (across, up) in zip(axes, labels, strict=False):
            axis.set_xlabel(across)
            axis.set_ylabel(up)
        axes[0].set_ylim(bottom=0.0)
        axes[1].set_ylim(bottom=0.0)
        legend_above(figure, axes[0], f"{title}: torque on the pinion (N m)")
    return figure


def loss_factor_figure(title: str, factors: pd.DataFrame) -> Figure:
    """Loss factor of the local load over torque, and the closed ones that hold."""
    local = factors[factors["torque_Nm"].notna()]
    closed = factors[factors["torque_Nm"].isna() & ~factors["outside_range"].astype(bool)]
    with styled():
        figure, (axis,), _ = panels(1, 1, height=2.9)
        axis.plot(local["torque_Nm"], local["value"], "o-", color="C0", label="local load")
        lines = zip(closed["loss_factor"], closed["value"].to_numpy(float), shades(len(closed)), strict=True)
        for name, value, colour in lines if len(closed) else ():
            axis.axhline(float(value), color=colour, linestyle="--", linewidth=0.9, label=str(name))
        axis.set_xlabel("torque on the pinion (N m)")
        axis.set_ylabel("tooth loss factor (-)")
        axis.set_ylim(bottom=0.0)
        legend_above(figure, axis, title, columns=3)
    return figure


def pattern_figure(title: str, found: ToothContact) -> Figure:
    """Hertz pressure over the flank, a panel a torque: where a tooth pair touches on its way through the mesh."""
    from matplotlib.figure import Figure

    chosen = _drawn(found, 4)
    with styled():
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
