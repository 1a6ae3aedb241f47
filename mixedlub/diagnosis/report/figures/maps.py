"""Maps: residuals over the test conditions and over roll angle, and similarity of the effects."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.diagnosis.assessment.identifiability import Confusion
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import amount, axis_label, effect_words, number, words_of
from mixedlub.diagnosis.report.figures.binning import together
from mixedlub.diagnosis.report.figures.style import DIVERGING, INK, MUTED, OUTLIER, PAPER, blank
from mixedlub.diagnosis.settings.assessment import VISIBLE
from mixedlub.diagnosis.settings.inference import LIKELY
from mixedlub.diagnosis.settings.report import SIMILAR
from mixedlub.recording.conditions import noisy_set_point

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

ACROSS = ("speed_rpm", "entrainment_speed_m_s", "sliding_speed_m_s", "time_s", "pressure_MPa", "torque_Nm", "load_N")
UP = ("torque_Nm", "slide_roll_ratio", "load_N", "temperature_C", "oil_temperature_C")
PANELS = ("oil_temperature_C", "temperature_C", "load_N", "slide_roll_ratio", "torque_Nm")
MOST_LEVELS = 14
MOST_PANELS = 4
MOST_TILES = 2000
MOST_ROWS = 40
MOST_EFFECTS = 26
BLOCK = 0.92
"""Width of a block of tiles; the distance between blocks is 1."""
LIMIT = 5.0
DRIFT = 0.05


@dataclass(frozen=True)
class Frame:
    """Conditions along x, along y and over the panels of a map; an empty name marks an unused axis."""

    across: str
    up: str
    panel: str


def frame_of(d: Diagnosis) -> Frame:
    """Axes of the map: the varied conditions, in conventional places."""
    varied = _varied(d)
    # In a history of friction time matters most: it comes before the set points.
    chosen = [n for n in ("time_s",) if n in varied and d.case.kind.is_history]
    for wanted in (ACROSS, UP, PANELS)[len(chosen) :]:
        name = next((n for n in wanted if n in varied and n not in chosen), "")
        chosen.append(name)
    rest = [n for n in varied if n not in chosen and n != "roll_angle_deg"]
    filled = [name or (rest.pop(0) if rest else "") for name in chosen]
    return Frame(*filled)


def _varied(d: Diagnosis) -> list[str]:
    """Numeric conditions that were varied by more than drift or noise about a set point."""
    table = d.recorded.table
    names = [c.name for c in d.case.kind.columns if c.dtype != "name" and c.name in table]
    moved = [n for n in names if np.ptp(table[n]) > DRIFT * np.max(np.abs(table[n]))]
    return [n for n in moved if noisy_set_point(n, table[n]) is None]


def residual_map(d: Diagnosis) -> Figure | None:
    """Residuals over the conditions: calibrated base model in the upper row, the answer in the lower."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    frame = frame_of(d)
    if not frame.across or "roll_angle_deg" in d.recorded.table:
        return None
    table = d.recorded.table
    label, panels = _levels(table[frame.panel] if frame.panel else np.zeros(len(table)), MOST_PANELS, frame.panel)
    before, after = d.residuals
    outlier = d.outlier_chance > LIKELY
    limit = _limit(before[d.counted])
    norm = Normalize(-limit, limit)
    figure = blank(1.4 + 2.35 * max(len(panels), 2), 4.9)
    axes = figure.subplots(2, len(panels), sharex=True, sharey=True, squeeze=False)
    for row, (z, what) in enumerate(((before, "before: calibrated base model"), (after, "after: with the answer"))):
        for column, name in enumerate(panels):
            here = label == column
            _tiles(axes[row, column], d, frame, here, z, norm, outlier)
            axes[row, column].set_title(f"{what if column == 0 else ''}\n{name}", fontsize=8.5)
            if row == 1:
                axes[row, column].set_xlabel(axis_label(frame.across))
            if column == 0 and frame.up:
                axes[row, column].set_ylabel(axis_label(frame.up))
    bar = figure.colorbar(ScalarMappable(norm, DIVERGING), ax=axes, extend="both", shrink=0.7, aspect=30, pad=0.02)
    bar.set_label("(recorded − simulated) / sd of a reading")
    bar.outline.set_visible(False)
    return figure


def _limit(z: np.ndarray) -> float:
    """Limit of the colour scale, which covers nearly all residuals and keeps noise pale."""
    return float(np.clip(np.quantile(np.abs(z), 0.95) if z.size else 0.0, 3.0, 3.0 * LIMIT))


def _levels(values: np.ndarray, most: int, name: str) -> tuple[np.ndarray, list[str]]:
    """Level of each value, and the names of the levels; many levels are binned."""
    if not name:
        return np.zeros(values.size, int), [""]
    label, centres = together(values, most)
    ends = [[number(float(end(values[label == k]))) for end in (np.min, np.max)] for k in range(centres.size)]
    spans = [f"{'' if low == high else f'{low} to '}{amount(float(high), name)}" for low, high in ends]
    return label, [f"{words_of(name)} {span}" for span in spans]


def _tiles(
    axes: Axes, d: Diagnosis, frame: Frame, here: np.ndarray, z: np.ndarray, norm: Normalize, outlier: np.ndarray
) -> None:
    """Draw a panel: a block for every pair of levels, a tile for every reading or, with very many, every few."""
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

    table = d.recorded.table
    across, across_names = _ticks(table[frame.across])
    up, up_names = _ticks(table[frame.up]) if frame.up else (np.zeros(len(table), int), [""])
    groups: dict[tuple[int, int], list[int]] = {}
    for i in np.flatnonzero(here).tolist():
        groups.setdefault((int(across[i]), int(up[i])), []).append(i)
    patches, colours, crosses = [], [], []
    most = max(MOST_TILES // (len(groups) * MOST_PANELS), 4)
    for (x, y), members in groups.items():
        members.sort(key=lambda i: _order(d, i))
        shared = [part.tolist() for part in np.array_split(members, min(len(members), most))]
        for (left, low, wide, tall), tile_members in zip(_block(len(shared)), shared, strict=True):
            sound = [i for i in tile_members if not outlier[i]]
            patches.append(Rectangle((x + left, y + low), wide, tall))
            colours.append(float(np.mean(z[sound])) if sound else np.nan)
            if not sound:
                crosses.append((x + left + 0.5 * wide, y + low + 0.5 * tall))
    axes.set_facecolor(PAPER)
    axes.grid(False)
    tiles = PatchCollection(patches, cmap=DIVERGING, norm=norm, edgecolor="white", linewidth=0.4)
    tiles.set_array(np.array(colours))
    axes.add_collection(tiles)
    if crosses:
        marks = np.array(crosses)
        axes.scatter(marks[:, 0], marks[:, 1], marker="x", s=22, color=OUTLIER, linewidths=1.2)
    axes.set_xlim(-0.55, len(across_names) - 0.45)
    axes.set_ylim(-0.55, len(up_names) - 0.45)
    axes.set_xticks(range(len(across_names)), across_names, rotation=90 if len(across_names) > 6 else 0)
    axes.set_yticks(range(len(up_names)), up_names)
    axes.tick_params(length=0)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)


def _block(count: int) -> list[tuple[float, float, float, float]]:
    """Tiles (left, bottom, width, height) in even rows of a block around the origin."""
    side = BLOCK
    rows = max(1, round(float(np.sqrt(count / 1.8))))
    tiles, start = [], -0.5 * side
    for row in range(rows):
        columns = count * (row + 1) // rows - count * row // rows
        width, bottom = side / columns, start + side * row / rows
        tiles += [(start + side * k / columns, bottom, width, side / rows) for k in range(columns)]
    return tiles


def _ticks(values: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """Level of each value, and the tick labels; many levels are binned."""
    label, places = together(values, MOST_LEVELS)
    return label, [number(float(v)) for v in places]


def _order(d: Diagnosis, row: int) -> tuple[str, ...]:
    """Sort key of a reading in a block: its conditions, so that all blocks have the same order."""
    table = d.recorded.table
    names = [c.name for c in d.case.kind.columns if c.name in table]
    return tuple(f"{table[n][row]:012.4f}" if table[n].dtype.kind == "f" else str(table[n][row]) for n in names)


def roll_angle_map(d: Diagnosis) -> Figure | None:
    """Residuals of tooth friction over roll angle, one row per test condition, before and after."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    table = d.recorded.table
    if "roll_angle_deg" not in table:
        return None
    others = [n for n in _varied(d) if n != "roll_angle_deg"]
    names = [c.name for c in d.case.kind.columns if c.dtype == "name" and c.name in table]
    used = [*others, *(n for n in names if np.unique(table[n]).size > 1)]
    texts = np.array([" · ".join(_short(n, table[n][i]) for n in used) or "all readings" for i in range(len(table))])
    keys = [table[n] for n in reversed(used)] or [np.zeros(len(table))]
    order = np.lexsort(keys)
    rows = list(dict.fromkeys(texts[order].tolist()))
    row_of = {text: i for i, text in enumerate(rows)}
    row = np.array([row_of[text] for text in texts.tolist()])
    before, after = d.residuals
    outlier = d.outlier_chance > LIKELY
    limit = _limit(before[d.counted])
    norm = Normalize(-limit, limit)
    figure = blank(8.6, 1.4 + 0.24 * min(len(rows), MOST_ROWS))
    axes = figure.subplots(1, 2, sharex=True, sharey=True)
    for panel, z, what in zip(
        axes, (before, after), ("before: calibrated base model", "after: with the answer"), strict=True
    ):
        _cells(panel, np.asarray(table["roll_angle_deg"], dtype=float), row, z, norm)
        if outlier.any():
            panel.scatter(table["roll_angle_deg"][outlier], row[outlier], marker="x", s=14, color=OUTLIER)
        panel.set_title(what)
        panel.set_xlabel(axis_label("roll_angle_deg"))
        panel.set_facecolor(PAPER)
        panel.grid(False)
    step = -(-len(rows) // MOST_ROWS)
    axes[0].set_yticks(range(0, len(rows), step), rows[::step], fontsize=7.5 if len(rows) <= 20 else 5.5)
    axes[0].set_ylim(-0.7, len(rows) - 0.3)
    bar = figure.colorbar(ScalarMappable(norm, DIVERGING), ax=axes, extend="both", aspect=30, pad=0.02)
    bar.set_label("(recorded − simulated) / sd")
    bar.outline.set_visible(False)
    return figure


def _cells(axes: Axes, x: np.ndarray, row: np.ndarray, z: np.ndarray, norm: Normalize) -> None:
    """Draw a tile for every reading, up to half way to its neighbours in the row."""
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

    widest = float(np.median(np.diff(np.unique(x)))) if np.unique(x).size > 1 else 1.0
    patches, colours = [], []
    for k in np.unique(row):
        members = np.flatnonzero(row == k)
        members = members[np.argsort(x[members], kind="stable")]
        gap = np.minimum(np.diff(x[members]), 2.0 * widest) / 2.0
        left, right = np.append(widest / 2.0, gap), np.append(gap, widest / 2.0)
        for i, before, after in zip(members, left, right, strict=True):
            patches.append(Rectangle((x[i] - before, k - 0.44), before + after, 0.88))
            colours.append(z[i])
    tiles = PatchCollection(patches, cmap=DIVERGING, norm=norm, edgecolor="white", linewidth=0.3)
    tiles.set_array(np.array(colours))
    tiles.set_rasterized(len(patches) > MOST_TILES)
    axes.add_collection(tiles)
    axes.set_xlim(x.min() - widest, x.max() + widest)


def _short(name: str, value: float | str) -> str:
    return str(value) if isinstance(value, str) else amount(float(value), name)


def confusability(alike: Confusion, emphasised: tuple[str, ...]) -> Figure | None:
    """Cosines between the effects' signatures, and how visible each is at its typical strength."""
    if len(alike.ids) < 2:
        return None
    chosen = _chosen(alike, emphasised, MOST_EFFECTS)
    order = chosen[_similarity_order(alike.cosine[np.ix_(chosen, chosen)])]
    cosine = alike.cosine[np.ix_(order, order)]
    names = [effect_words(alike.ids[i]) for i in order]
    count = len(order)
    cell = 0.235 if count > 12 else 0.33
    figure = blank(4.4 + cell * count, 2.6 + cell * count)
    figure.set_layout_engine("constrained", w_pad=0.1)
    grid = figure.add_gridspec(1, 2, width_ratios=(cell * count, 1.7))
    axes, side = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    mesh = axes.pcolormesh(np.where(np.eye(count) > 0, np.nan, cosine), cmap=DIVERGING, vmin=-1, vmax=1, lw=0.4)
    mesh.set_edgecolor("white")
    axes.set_facecolor(PAPER)
    for i in range(count):
        for j in range(count):
            if i != j and abs(cosine[i, j]) >= SIMILAR:
                text = f"{cosine[i, j]:.2f}".replace("0.", ".")
                axes.text(
                    j + 0.5, i + 0.5, text, ha="center", va="center", fontsize=5.5 if count > 12 else 7, color="white"
                )
    axes.set_xticks(np.arange(count) + 0.5, names, rotation=90)
    axes.set_yticks(np.arange(count) + 0.5, names)
    for ticks in (axes.get_xticklabels(), axes.get_yticklabels()):
        for tick, i in zip(ticks, order, strict=True):
            if alike.ids[i] in emphasised:
                tick.set_fontweight("bold")
    axes.invert_yaxis()
    axes.grid(False)
    axes.tick_params(length=0)
    bar = figure.colorbar(mesh, ax=axes, location="top", aspect=30, pad=0.01)
    bar.outline.set_visible(False)
    bar.set_label("cosine between signatures (1: indistinguishable)")
    side.barh(np.arange(count) + 0.5, np.maximum(alike.visibility[order], 0.05), height=0.62, color=MUTED)
    side.axvline(VISIBLE, color=INK, lw=0.8, ls="--")
    side.set_xscale("log")
    side.set_ylim(axes.get_ylim())
    side.set_yticks([])
    side.set_xlabel(f"size left after\ncalibration (sigma);\nbelow {VISIBLE:g}: not testable")
    side.grid(axis="y", visible=False)
    return figure


def _chosen(alike: Confusion, emphasised: tuple[str, ...], most: int) -> np.ndarray:
    """Indices of the effects shown: the answer and the effects most similar to it, or else the most visible effects."""
    if len(alike.ids) <= most:
        return np.arange(len(alike.ids))
    answer = [alike.ids.index(name) for name in emphasised if name in alike.ids]
    likeness = np.abs(alike.cosine[answer]).max(axis=0) if answer else alike.visibility / alike.visibility.max()
    rank = np.argsort(-(likeness + 10.0 * np.isin(np.arange(len(alike.ids)), answer)), kind="stable")
    return np.sort(rank[:most])


def _similarity_order(cosine: np.ndarray) -> np.ndarray:
    """Order of the effects that makes similar effects neighbours."""
    from scipy.cluster.hierarchy import leaves_list, linkage
    from scipy.spatial.distance import squareform

    distance = np.clip(1.0 - np.abs(cosine), 0.0, None)
    np.fill_diagonal(distance, 0.0)
    return np.asarray(leaves_list(linkage(squareform(0.5 * (distance + distance.T)), "average", optimal_ordering=True)))
