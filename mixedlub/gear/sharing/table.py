"""Load shared by a table: from an outside gear program or a measurement."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.gear.checks import column
from mixedlub.gear.contact_lines import contact_limits, mid_face_path
from mixedlub.gear.geometry import GearPair
from mixedlub.gear.mesh import Mesh
from mixedlub.gear.sharing.model import SharingModel
from mixedlub.schema.findings import Finding, Severity, finding, report
from mixedlub.schema.section import Section, key
from mixedlub.schema.table import Column, read_table
from mixedlub.schema.toml_file import named_file
from profiles.errors import InputError

COVERED = 0.98
"""Least share of the path of contact in a table, apart from the rounding of its ends."""
MEAN_OFF = 0.03
"""Largest deviation from 1 of the mean sum of the shares of all pairs in contact."""
GRAVE_IMBALANCE = 0.1
"""Sums of shares within this distance of 1 occur in gear programs under tip relief, or from rounding."""
PLACE = "load share table"
OFTEN, OFTEN_OFF = 0.8, 0.05
"""Least part of a base pitch, and distance of its sums from 1; steps of the share between rows are off by more."""
COLUMNS = (Column("torque_Nm", above=0.0), Column("roll_angle_deg"), Column("load_share", at_least=0.0, at_most=1.5))


class Keys(Section):
    table: str | None = key(
        "CSV of torque_Nm, roll_angle_deg, load_share; this or model", None, example="load_share.csv", alternative=True
    )


def _pairs_in_contact(pair: GearPair) -> tuple[np.ndarray, np.ndarray]:
    """Positions (m) of the tooth pairs at 64 phases inside one base pitch, and which are in contact."""
    start, end = mid_face_path(pair)
    phase = start + pair.base_pitch * (np.arange(64) + 0.5) / 64
    position = phase[:, None] + pair.base_pitch * np.arange(int((end - start) / pair.base_pitch) + 1)
    return position, position <= end


def _roll_angles(pair: GearPair) -> tuple[float, float]:
    """Roll angles (rad) between which a tooth pair is in contact."""
    start, end = mid_face_path(pair)
    return start / pair.base_radius[0], end / pair.base_radius[0]


@dataclass(frozen=True, eq=False)
class TableSharing:
    """A tabulated share, from an outside gear program or a measurement.

    The entries of three arrays are rows: pinion ``torque`` (N m), pinion ``roll_angle`` (rad) and the ``share`` of the
    base-tangent force T1/r_b1 on one tooth pair there; for a helical pair, the angle is taken at the middle of the
    face, and the share spreads evenly over the contact line. Used without correction: linear in roll angle between the
    rows of a torque; the first and last value hold for one more row spacing, then the share is zero. A torque without
    rows takes the nearest tabulated torque, with a finding (`torque_not_tabulated`). ``source``: file name for
    messages.
    """

    torque: np.ndarray
    roll_angle: np.ndarray
    share: np.ndarray
    source: str = ""

    def __post_init__(self) -> None:
        columns = {"torque_Nm": self.torque, "roll_angle_deg": self.roll_angle, "load_share": self.share}
        arrays = {key: column(self._at_column(key), values) for key, values in columns.items()}
        if len({array.size for array in arrays.values()}) != 1:
            raise InputError("the three columns need the same number of rows", where=self._at_column("load_share"))
        if np.any(arrays["torque_Nm"] <= 0):
            lowest = float(arrays["torque_Nm"].min())
            raise InputError("a torque is above zero", where=self._at_column("torque_Nm"), value=lowest)
        shares = arrays["load_share"]
        if np.any((shares < 0) | (shares > 1.5)):
            worst = float(shares[np.argmax(np.abs(shares - 0.5))])
            raise InputError("a load share is a fraction from 0 to 1", where=self._at_column("load_share"), value=worst)
        order = np.lexsort((arrays["roll_angle_deg"], arrays["torque_Nm"]))
        for name, values in zip(("torque", "roll_angle", "share"), arrays.values()):
            sorted_column = values[order]
            sorted_column.flags.writeable = False
            object.__setattr__(self, name, sorted_column)
        for value, angle, _ in self._curves:
            if angle.size < 2:
                said = "at least two rows a torque are needed"
                raise InputError(said, where=self._at_column("torque_Nm"), value=value)
            if np.any(np.diff(angle) <= 0):
                twice = float(np.degrees(angle[1:][np.diff(angle) <= 0][0]))
                said = "one row a roll angle and torque"
                raise InputError(said, where=self._at_column("roll_angle_deg"), value=twice)

    def _at_column(self, name: str) -> str:
        """Place of a column in a message."""
        return f"{self.source}: {name}" if self.source else name

    @cached_property
    def _curves(self) -> list[tuple[float, np.ndarray, np.ndarray]]:
        """(torque, roll angles, shares) of each torque, in rising order."""
        values, starts = np.unique(self.torque, return_index=True)
        blocks = zip(values, np.split(self.roll_angle, starts[1:]), np.split(self.share, starts[1:]))
        return [(float(value), angle, share) for value, angle, share in blocks]

    def default_slices(self, pair: GearPair) -> int:
        """One slice, as the table has no data on the face; several for the oblique lines of helical gears."""
        return 1 if pair.helix_angle == 0 else 17

    def check(self, pair: GearPair) -> tuple[Finding, ...]:
        """Raise an error for tables of another gear or of a part; report missing ends and sums other than 1."""
        curves = range(len(self._curves))
        for curve in curves:
            self._refuse_gap(pair, curve)
        return (*self._short(pair, curves), *self._unbalanced(pair, curves))

    def _imbalance(self, pair: GearPair) -> float:
        """Largest deviation from 1, over the torques, of the sum of the shares of the pairs in contact, averaged over a
        base pitch."""
        return max(abs(float(self._sum_over_pairs(pair, curve).mean()) - 1.0) for curve in range(len(self._curves)))

    def _refuse_gap(self, pair: GearPair, curve: int) -> None:
        """Raise an error if rows are missing for all pairs in contact at some place: the load would have no support."""
        value, angle, _ = self._curves[curve]
        position, inside = _pairs_in_contact(pair)
        told = (inside & self._told(curve, position / pair.base_radius[0])).any(axis=1)
        if told.all():
            return
        start, end = np.degrees(_roll_angles(pair))
        first, last = np.degrees(angle[[0, -1]])
        raise InputError(
            f"the rows at {value:g} N m ({first:.4g} to {last:.4g} deg) leave out a part of the path of contact "
            f"({start:.4g} to {end:.4g} deg) where no other carries the load, {np.mean(~told):.0%} of a base pitch",
            where=self._at_column("roll_angle_deg"),
        )

    def _short(self, pair: GearPair, curves: range) -> Iterator[Finding]:
        """Finding of rows that end before the path of contact, for the torque with the shortest rows."""
        start, end = _roll_angles(pair)
        angles = [angle for _, angle, _ in self._curves]
        covered = [(min(angle[-1], end) - max(angle[0], start)) / (end - start) for angle in angles]
        worst = min(curves, key=lambda curve: covered[curve])
        if covered[worst] < COVERED:
            text = (
                f"the rows at {self._curves[worst][0]:g} N m cover only {covered[worst]:.0%} of the path of contact "
                f"({np.degrees(start):.4g} to {np.degrees(end):.4g} deg); beyond them the share is taken as 0"
                f"{_others([share < COVERED for share in covered])}"
            )
            yield finding("load_share_short", text, PLACE)

    def _unbalanced(self, pair: GearPair, curves: range) -> Iterator[Finding]:
        """Finding of shares that do not add up to the load, for the torque with the largest deviation."""
        sums = [self._sum_over_pairs(pair, curve) for curve in curves]
        off = [max(abs(s.mean() - 1.0) / MEAN_OFF, np.quantile(np.abs(s - 1.0), OFTEN) / OFTEN_OFF) for s in sums]
        worst = max(curves, key=lambda curve: off[curve])
        if off[worst] > 1.0:
            low, high, mean = sums[worst].min(), sums[worst].max(), sums[worst].mean()
            text = (
                f"at {self._curves[worst][0]:g} N m the pairs in contact carry together {low:.2f} to {high:.2f} of the "
                f"load, {mean:.3f} on average, where it should be 1{_others([o > 1.0 for o in off])}"
            )
            grave = self._imbalance(pair) > GRAVE_IMBALANCE
            yield finding("load_share_sum", text, PLACE, Severity.DOUBT if grave else None)

    def _sum_over_pairs(self, pair: GearPair, curve: int) -> np.ndarray:
        """Sum of the shares of all pairs in contact, phase by phase."""
        position, inside = _pairs_in_contact(pair)
        return (self._at(curve, position / pair.base_radius[0]) * inside).sum(axis=1)

    def _told(self, curve: int, roll_angle: np.ndarray) -> np.ndarray:
        """Range of the rows of a torque: between them, and one row spacing further out."""
        _, angle, _ = self._curves[curve]
        outside = np.maximum(angle[0] - roll_angle, roll_angle - angle[-1])
        return outside <= np.diff(angle).max()

    def _at(self, curve: int, roll_angle: np.ndarray) -> np.ndarray:
        _, angle, share = self._curves[curve]
        return np.where(self._told(curve, roll_angle), np.interp(roll_angle, angle, share), 0.0)

    def breakpoints(self, pair: GearPair) -> np.ndarray:
        """Rows with a significant change of slope at any torque; for helical pairs, contact limits (slices pass rows
        apart)."""
        if pair.helix_angle != 0:
            return contact_limits(pair)
        kinks = []
        for _, angle, share in self._curves:
            slope = np.diff(share) / np.diff(angle)
            bend = np.abs(np.diff(slope)) * np.minimum(np.diff(angle)[1:], np.diff(angle)[:-1])
            kinks.append(angle[1:-1][bend > 0.01])
        return np.concatenate(kinks) * pair.base_radius[0]

    def nearest(self, torque: np.ndarray) -> np.ndarray:
        """Index of the tabulated torque nearest to each torque; the lower of two equally near."""
        tabulated = np.array([value for value, _, _ in self._curves])
        return np.abs(np.asarray(torque)[..., None] - tabulated).argmin(axis=-1)

    def load_share(self, mesh: Mesh, torque: np.ndarray) -> np.ndarray:
        """Share of the table at the roll angles of the mesh, spread evenly over the slices in contact."""
        chosen = self.nearest(torque)
        tabulated = np.array([value for value, _, _ in self._curves])
        missing = np.abs(tabulated[chosen] - torque) > 1e-6 * tabulated[chosen]
        if np.any(missing):
            asked, used = np.asarray(torque)[missing].flat[0], tabulated[chosen][missing].flat[0]
            more = f" (and {int(missing.sum()) - 1} more torques)" if missing.sum() > 1 else ""
            text = f"no rows at {asked:g} N m, nearest torque {used:g} N m used{more}"
            report(finding("torque_not_tabulated", text, PLACE))
        angle, part = mesh.roll_angle, mesh.face_fraction
        if mesh.pair.helix_angle != 0:
            angle, part = _along_line(mesh)
        curves = np.stack([self._at(i, angle) for i in range(len(self._curves))])
        return curves[chosen] * part


def _along_line(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Roll angle at the middle of the face while each point touches, and the point's share of the slices in contact."""
    pair = mesh.pair
    tangent = np.tan(abs(pair.base_helix_angle))
    middle = mesh.position - (mesh.face_position - pair.face_width / 2) * tangent
    across = ((np.arange(mesh.slices) + 0.5) / mesh.slices - 0.5) * pair.face_width
    lines, rounding = middle[:, None] + across * tangent, 1e-9 * pair.base_pitch
    touching = (lines >= pair.path_start - rounding) & (lines <= pair.path_end + rounding)
    return middle / pair.base_radius[0], 1 / np.maximum(touching.sum(axis=1), 1)


def _others(affected: Sequence[bool]) -> str:
    """Number of further torques for which a sentence about one of them holds.

    >>> _others([True, True, True]), _others([True, False])
    (' (so at 2 more torques)', '')
    """
    more = sum(map(bool, affected)) - 1
    return f" (so at {more} more torque{'s' if more > 1 else ''})" if more > 0 else ""


def read_sharing(section: Any, folder: Path) -> TableSharing:
    """Sharing by the table named in a file."""
    file = named_file(folder, section.table, "gears.load_sharing.table")
    table = read_table(file, COLUMNS, key=("torque_Nm", "roll_angle_deg"))
    return TableSharing(
        torque=table["torque_Nm"],
        roll_angle=np.radians(table["roll_angle_deg"]),
        share=table["load_share"],
        source=str(file),
    )


MODEL = SharingModel(name="table", meaning="a table", build=read_sharing, keys=Keys, chosen_by="table")
