"""Interpolation of channels between the rows of a recording."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.schema.table import Table

DECADE = 3.0
"""Judgement. Ratio of the largest to the smallest condition from which it is interpolated by its logarithm."""
NEIGHBOURS = 30
"""Cost limit. Rows on which an interpolated value depends."""


def interpolated(table: Table, recorded: Table, names: Sequence[str]) -> dict[str, np.ndarray]:
    """Channels at the rows of a table: thin-plate splines over the common numeric conditions of rows with equal names.

    Positive channels are interpolated by their logarithm. Where a spline has no answer, the nearest row has.

    >>> rows = Table({"run": np.arange(4), "speed_rpm": np.array([1.0, 2, 4, 8]), "y": np.array([1.0, 4, 16, 64])})
    >>> at = Table({"run": np.arange(2), "speed_rpm": np.array([3.0, 4.0])})
    >>> interpolated(at, rows, ["y"])["y"].round(3).tolist()
    [9.0, 16.0]
    """
    shared = [n for n in table.columns if n in recorded and n not in ("run", *names)]
    texts = [n for n in shared if recorded[n].dtype.kind in "US"]
    numbers = [n for n in shared if n not in texts and np.ptp(recorded[n]) > 0.0]
    values = np.column_stack([recorded[n] for n in names]).astype(float)
    positive = (values > 0.0).all(axis=0)
    values[:, positive] = np.log(values[:, positive])
    known, wanted = _axes(recorded, table, numbers)
    found = np.empty((len(table), len(names)))
    labels, asked = _labels(recorded, texts), _labels(table, texts)
    for label in np.unique(asked):
        rows, here = labels == label, asked == label
        rows = rows if rows.any() else np.ones(len(recorded), bool)
        found[here] = _at(known[rows], values[rows], wanted[here])
    found[:, positive] = np.exp(found[:, positive])
    return dict(zip(names, found.T, strict=True))


def _axes(recorded: Table, table: Table, numbers: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Conditions from 0 to 1 over the recording, on a logarithmic scale where they span decades."""
    known, wanted = [], []
    for name in numbers:
        own, asked = np.asarray(recorded[name], dtype=float), np.asarray(table[name], dtype=float)
        if own.min() > 0.0 and asked.min() > 0.0 and own.max() > DECADE * own.min():
            own, asked = np.log(own), np.log(asked)
        known.append((own - own.min()) / np.ptp(own))
        wanted.append((asked - own.min()) / np.ptp(own))
    if not known:
        return np.zeros((len(recorded), 1)), np.zeros((len(table), 1))
    return np.column_stack(known), np.column_stack(wanted)


def _labels(table: Table, texts: Sequence[str]) -> np.ndarray:
    labels = np.full(len(table), "", dtype=object)
    for name in texts:
        labels = labels + "/" + table[name].astype(object)
    return labels.astype(str)


def _at(known: np.ndarray, values: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Values at other points; repeated points count once, by their mean."""
    from scipy.interpolate import RBFInterpolator
    from scipy.spatial import KDTree

    points, group = np.unique(known.round(9), axis=0, return_inverse=True)
    count = np.bincount(group.ravel())[:, None]
    means = np.zeros((points.shape[0], values.shape[1]))
    np.add.at(means, group.ravel(), values)
    means /= count
    moves = np.ptp(points, axis=0) > 0.0
    points, wanted = points[:, moves], wanted[:, moves]
    if points.shape[1] and points.shape[0] > points.shape[1] + 1:
        try:
            spline = RBFInterpolator(points, means, neighbors=min(NEIGHBOURS, points.shape[0]), degree=1)
            return np.asarray(spline(wanted))
        except (np.linalg.LinAlgError, ValueError):
            pass
    if not points.shape[1]:
        return np.broadcast_to(means.mean(axis=0), (wanted.shape[0], means.shape[1])).copy()
    return np.asarray(means[KDTree(points).query(wanted)[1]])
