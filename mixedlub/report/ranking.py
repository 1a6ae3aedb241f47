"""Map of a ranking: mean power loss of every pairing of surfaces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.style import WIDTH, styled

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

WRITTEN = 14
"""Largest number of surfaces of a wheel for which the losses are written into the map."""


def ranking_map(ranked: pd.DataFrame) -> Figure:
    """Mean power loss over pinion and gear surface, for the table of `mixedlub.study.ranking`."""
    from matplotlib.figure import Figure

    pinions, gears = (sorted(dict.fromkeys(ranked[f"{wheel}_surface"])) for wheel in ("pinion", "gear"))
    losses = np.full((len(pinions), len(gears)), np.nan)
    for row in ranked.itertuples():
        losses[pinions.index(row.pinion_surface), gears.index(row.gear_surface)] = row.mean_loss_W
    with styled():
        side = min(WIDTH, 1.9 + 0.62 * len(gears))
        figure = Figure(figsize=(side + 1.2, 1.2 + 0.42 * len(pinions)), layout="constrained")
        axes: Any = figure.subplots()
        image = axes.imshow(losses, cmap="viridis_r", aspect="auto")
        axes.grid(False)
        axes.set_xticks(range(len(gears)), gears, rotation=40, ha="right")
        axes.set_yticks(range(len(pinions)), pinions)
        axes.set_xlabel("gear surface")
        axes.set_ylabel("pinion surface")
        figure.colorbar(image, label="mean power loss (W)", shrink=0.9)
        if max(losses.shape) <= WRITTEN:
            middle = (np.nanmin(losses) + np.nanmax(losses)) / 2
            for (p, g), value in np.ndenumerate(losses):
                if np.isfinite(value):
                    axes.text(g, p, f"{value:.3g}", ha="center", va="center", color="w" if value > middle else "0.1")
    return figure
