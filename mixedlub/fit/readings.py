"""Readings of a table or case: measured quantity, its noise, and the quantities that laws read."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.base_model.chains import LINE, POINT
from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.chain.model import ChainError, Model
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.fit.headers import Meaning, meaning
from mixedlub.importers.cell_columns import is_numeric
from mixedlub.importers.input_file import open_file
from mixedlub.importers.text_table import Sheet
from mixedlub.laws import film, load, oil
from mixedlub.schema.cells import is_missing
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.units import to_si, unit_of
from profiles.errors import InputError, nearest
from profiles.units import number_of

FITTED: Mapping[str, str] = {
    "friction": "friction_coefficient",
    "friction_torque": "friction_torque_Nm",
    "film_thickness": "film_thickness_nm",
    "contact_viscosity": "viscosity_mPa_s",
}
"""Quantities that laws are fitted to, with the column of each; the first present in a table is taken."""
UNSIGNED = ("slide_roll_ratio", "sliding_speed")
AMBIENT = 101325.0
"""Definition. Standard atmosphere (Pa), taken for a viscosity without a pressure."""
VARIED = 0.02
"""Judgement. Least span of a condition, over its largest size, that makes more than one level."""
SPEEDS = ("entrainment_speed", "sliding_speed", "drive_speed", "pitch_line_speed")
"""Speeds of a Stribeck curve, the first known is taken."""
BEARING = ("line_load", "mean_pressure", "pressure", "load")
"""Loads of a Hersey number, the first known is taken."""
MADE = ("speed", "hersey_number")
"""Quantities of Stribeck laws beyond the glossary."""


def _ratio(sliding_speed: np.ndarray, entrainment_speed: np.ndarray) -> np.ndarray:
    return sliding_speed / entrainment_speed


RULES: tuple[tuple[str, Callable[..., Any]], ...] = (
    ("slide_roll_ratio", _ratio),
    ("sliding_speed", lambda slide_roll_ratio, entrainment_speed: slide_roll_ratio * entrainment_speed),
    ("kinematic_viscosity", oil.kinematic),
    ("viscosity", lambda kinematic_viscosity, oil_density: kinematic_viscosity * oil_density),
    ("line_load", load.disc_line_load),
    ("moes_load", film.moes_load),
    ("isoviscous_ratio", film.isoviscous_ratio),
)
"""Quantities that follow from columns, beside the laws of the base chains."""


@dataclass(frozen=True, eq=False)
class Readings:
    """Measured values in SI and their conditions.

    ``quantity``: name in the glossary; ``values``: measured; ``sd``: standard deviations, None if unknown; ``state``:
    known quantities by name; ``columns``: conditions as the table has them, by header; ``sense``: direction of a drive,
    by which its torque is made positive; ``whole``: values of all readings, of which these are a part.
    """

    source: str
    quantity: str
    values: np.ndarray
    sd: np.ndarray | None
    state: dict[str, np.ndarray]
    columns: Mapping[str, np.ndarray]
    forward: Forward | None = None
    notes: tuple[Finding, ...] = ()
    sense: np.ndarray | None = None
    whole: np.ndarray | None = None
    _absent: set[str] = field(default_factory=set)

    def __len__(self) -> int:
        return self.values.size

    @property
    def column(self) -> str:
        """Column of the measured quantity, with its unit."""
        return FITTED[self.quantity]

    @property
    def factor(self) -> float:
        """Factor from SI to the unit of that column."""
        unit = unit_of(self.column)
        return 1.0 / to_si(unit)[0] if unit else 1.0

    @property
    def is_logarithmic(self) -> bool:
        """Whether laws are compared by the logarithm: all readings are positive, also those left out."""
        return bool((self._all > 0.0).all())

    @property
    def median_size(self) -> float:
        """Median size of all readings, also those left out; 1 if it is zero."""
        return float(np.median(np.abs(self._all))) or 1.0

    @property
    def _all(self) -> np.ndarray:
        return self.values if self.whole is None else self.whole

    def take(self, rows: np.ndarray) -> Readings:
        """Some of the readings."""

        def part(values: np.ndarray) -> np.ndarray:
            return values[rows] if values.size == len(self) else values

        state = {name: part(values) for name, values in self.state.items()}
        columns = {name: values[rows] for name, values in self.columns.items()}
        sd = None if self.sd is None else self.sd[rows]
        values = self.values[rows]
        return replace(self, values=values, sd=sd, state=state, columns=columns, forward=None, whole=self._all)

    def varied(self) -> dict[str, np.ndarray]:
        """Conditions with more than one level, by header."""
        return {
            name: values
            for name, values in self.columns.items()
            if np.ptp(values) > VARIED * np.max(np.abs(values)) and np.unique(values).size > 1
        }

    def get(self, name: str) -> np.ndarray | None:
        """A quantity in SI: a column, or a quantity that follows from columns or from the case; None if unknown."""
        if name in self.state:
            return self.state[name]
        if name in self._absent or name == self.quantity:
            return None
        self._absent.add(name)
        found = self._made(name) if name in MADE else self._from_case(name)
        if found is None and name not in MADE:
            found = self._derived(name)
        if found is not None:
            self._absent.discard(name)
            self.state[name] = np.asarray(found, dtype=float)
        return found

    def _from_case(self, name: str) -> np.ndarray | None:
        if self.forward is None:
            return None
        try:
            found = Model(self.forward.chain, tuple(self.forward.inputs), (name,))(self.forward.inputs)[name]
        except (ChainError, KeyError):
            return None
        array = np.asarray(found, dtype=float)
        if array.ndim > 1 and array.shape[-1] > 1:
            return None
        return array.reshape(-1) if array.size == len(self) else array.reshape(-1)[:1]

    def _derived(self, name: str) -> np.ndarray | None:
        point = self.get("transverse_radius") is not None and self.get("contact_width") is None
        for made, law in (*RULES, *(POINT if point else LINE)):
            if made == name and (point or made != "film_thickness" or self.quantity != "film_thickness"):
                given = [self.get(argument) for argument in inspect.signature(law).parameters]
                if all(value is not None for value in given):
                    with np.errstate(all="ignore"):
                        return np.asarray(law(*given))
        return None

    def _made(self, name: str) -> np.ndarray | None:
        parts = [part for one in self.written(name) if (part := self.get(one)) is not None]
        if name == "speed":
            return np.abs(parts[0]) if parts else None
        if len(parts) < 3:
            return None
        viscosity, speed, bearing = parts
        return np.asarray(viscosity * np.abs(speed) / bearing)

    def written(self, name: str) -> tuple[str, ...]:
        """Quantities of the glossary that a Stribeck law reads as the speed or as the Hersey number; empty if absent.

        The Hersey number is viscosity times speed over load per length or area, for a load alone in 1/m.
        """
        speed = next((one for one in SPEEDS if self.get(one) is not None), None)
        if speed is None or name == "speed":
            return () if speed is None else (speed,)
        bearing = next((one for one in BEARING if self.get(one) is not None), None)
        return ("viscosity", speed, bearing) if bearing and self.get("viscosity") is not None else ()


def read_readings(
    source: Path, quantity: str | None, constants: Mapping[str, float], relative_sd: float | None
) -> Readings:
    """Readings of a table of text or a workbook, or of a case folder.

    ``quantity``: column to fit; ``constants``: values of all rows by column with unit; ``relative_sd``: relative
    standard deviation of every reading.
    """
    if source.is_dir():
        if constants:
            rule = "a case has its conditions in its own files; constants are for tables"
            raise InputError(rule, where="constant", value=next(iter(constants)))
        found = _of_case(source, quantity)
    else:
        file = open_file(source, {})
        found = _of_sheet(file.table(), quantity, constants)
        found = replace(found, notes=(*file.notes, *found.notes))
    return checked(found, relative_sd)


def checked(found: Readings, relative_sd: float | None) -> Readings:
    """The readings with a stated noise; raise an error for readings that tell no law."""
    if relative_sd is not None:
        if not 0.0 < relative_sd < 1.0:
            raise InputError("must lie above 0 and below 1", where="relative_sd", value=relative_sd)
        found = replace(found, sd=relative_sd * np.abs(found.values))
    where = f"{found.source}: {found.column}"
    if len(found) < 3:
        raise InputError(f"{len(found)} readings are fewer than any law has parameters; 3 are the least", where=where)
    bad = np.flatnonzero(found.values <= 0.0)
    if found.quantity in ("contact_viscosity", "film_thickness") and bad.size:
        value = float(f"{found.values[bad[0]] * found.factor:.6g}")
        raise InputError("must be above 0", where=f"{where}, reading {bad[0] + 1}", value=value)
    if found.sd is not None and (found.sd == 0.0).any():
        place = f"{where}, reading {int(np.argmin(found.sd)) + 1}"
        raise InputError("a reading of 0 has no relative noise; state an absolute one", where=place, value=0.0)
    if np.ptp(found.values) == 0.0:
        raise InputError(
            f"all {len(found)} readings are the same; a law is told by readings that change",
            where=where,
            value=float(found.values[0] * found.factor),
        )
    if not found.varied():
        known = ", ".join(found.columns) or "no column"
        raise InputError(
            f"no condition has a second level ({known}); a law is told by readings at several levels", where=where
        )
    return found


def _of_case(folder: Path, quantity: str | None) -> Readings:
    case = read_case(folder)
    forward = Forward(case, case.recordings) if case.recordings is not None else None
    assert case.recordings is not None
    assert forward is not None
    table, column = case.recordings, case.quantity
    name = next((q for q, known in FITTED.items() if known == column), None)
    if name is None:
        rule = f"laws are fitted to {', '.join(FITTED.values())}"
        raise InputError(rule, where=f"{folder}: recording.quantity", value=column)
    if quantity not in (None, column):
        raise InputError(f"the case records {column}", where="quantity", value=quantity)
    scale = 1.0 / case.kind.scale
    values = table[column] * scale
    sd = None
    noise = case.system.recording.noise
    if f"{column}_sd" in table:
        own = table[f"{column}_sd"] * scale
        sd = own if np.isfinite(own).all() and (own > 0.0).all() else None
    elif noise is not None and noise.of_single:
        sd = np.hypot((noise.relative or 0.0) * np.abs(values), (noise.absolute or 0.0) * scale)
    conditions = {c.name for c in case.kind.columns}
    columns = {n: v for n, v in table.columns.items() if n in conditions and v.dtype.kind == "f"}
    found = Readings(str(folder / "recordings.csv"), name, values, sd, {}, columns, forward, forward.notes)
    if name == "contact_viscosity":
        found.state["pressure"] = np.asarray(forward.inputs["hertz_pressure"]).reshape(-1)
    return _turned(found)


def _turned(found: Readings) -> Readings:
    """Torque and friction of a drive, positive against the motion in both directions."""
    speed = found.get("drive_speed")
    if found.quantity not in ("friction", "friction_torque") or speed is None or (speed >= 0.0).all():
        return found
    sense = np.where(speed < 0.0, -1.0, 1.0)
    text = "readings of both directions are taken as one: positive against the motion"
    note = finding("file_read", text, found.source)
    return replace(found, values=found.values * sense, sense=sense, notes=(*found.notes, note))


def of_columns(
    columns: Mapping[str, Sequence[Any]], quantity: str | None, constants: Mapping[str, float], name: str = "table"
) -> Readings:
    """Readings of columns in memory, with units in their names."""
    cells = {str(header): [str(value) for value in values] for header, values in columns.items()}
    lengths = {len(column) for column in cells.values()}
    if len(lengths) != 1:
        raise InputError("columns must be of one length", where=name, value=sorted(lengths))
    lines = tuple(range(1, lengths.pop() + 1))
    return _of_sheet(Sheet(name, cells, lines), quantity, constants)


def _of_sheet(sheet: Sheet, quantity: str | None, constants: Mapping[str, float]) -> Readings:
    where = sheet.name
    meanings: dict[str, Meaning] = {}
    unknown = []
    for header in sheet.cells:
        if header == "run" or _is_sd(header):
            continue
        found = meaning(header, f"{where}: header") if is_numeric(sheet.cells[header]) else None
        if found is None:
            unknown.append(header)
        elif any(other.quantity == found.quantity for other in meanings.values()):
            raise InputError(f"a second column of {found.quantity}", where=f"{where}: header", value=header)
        else:
            meanings[header] = found
    by_quantity = {one.quantity: header for header, one in meanings.items()}
    for viscosity in ("viscosity", "kinematic_viscosity"):
        if viscosity in by_quantity and not set(FITTED) & set(by_quantity):
            by_quantity["contact_viscosity"] = by_quantity.pop(viscosity)
    name = _fitted(by_quantity, quantity, unknown, where)
    if name == "contact_viscosity" and "contact_viscosity" not in by_quantity:
        by_quantity["contact_viscosity"] = by_quantity.pop("viscosity")
    numbers = {q: _numbers(sheet, header) for q, header in by_quantity.items()}
    kept = np.all([np.isfinite(values) for values in numbers.values()], axis=0)
    state, columns = {}, {}
    for q, header in by_quantity.items():
        one = meanings[header]
        si = numbers[q][kept] * one.factor + one.added
        state[q] = np.abs(si) if q in UNSIGNED else si
        if q != name:
            columns[header] = numbers[q][kept]
    for header, value in constants.items():
        found = meaning(header, "constant")
        if found is None:
            raise InputError(f"no such quantity; {nearest(header, GLOSSARY)}", where="constant", value=header)
        if found.quantity in state and found.quantity not in by_quantity:
            raise InputError(f"{found.quantity} is set twice", where="constant", value=header)
        if found.quantity in state:
            rule = f"is a column of the table too: {by_quantity[found.quantity]!r}"
            raise InputError(rule, where="constant", value=header)
        state[found.quantity] = np.array([value * found.factor + found.added])
    header = by_quantity[name]
    spread = _sd_header(sheet, header, meanings[header])
    unknown += [other for other in sheet.cells if _is_sd(other) and other != spread]
    notes = [finding("columns_unknown", f"columns not used: {', '.join(unknown)}", where)] if unknown else []
    if not kept.all():
        text = f"rows with an empty cell left out: {int((~kept).sum())} of {kept.size}"
        notes.append(finding("rows_left_out", text, where))
    if name == "contact_viscosity" and "pressure" not in state:
        state["pressure"] = np.array([AMBIENT])
    values, sd = state.pop(name), None if spread is None else _sd(sheet, spread, kept, meanings[header].factor)
    if meanings[header].quantity == "kinematic_viscosity":
        if "oil_density" not in state:
            rule = "a kinematic viscosity is fitted with the density of the oil: --set density_kg_m3=860, or a column"
            raise InputError(rule, where=f"{where}: {header}")
        values = values * state["oil_density"]
        sd = None if sd is None else sd * state["oil_density"]
    return _turned(Readings(where, name, values, sd, state, columns, notes=tuple(notes)))


def _fitted(known: Mapping[str, str], quantity: str | None, unknown: Sequence[str], where: str) -> str:
    """Quantity to fit: the named one, else the first present."""
    if quantity is not None:
        name = next((q for q, column in FITTED.items() if quantity in (q, column)), None)
        if name is None:
            rule = f"laws are fitted to {', '.join(FITTED.values())}; {nearest(quantity, FITTED.values())}"
            raise InputError(rule, where="quantity", value=quantity)
        if name in known or (name == "contact_viscosity" and "viscosity" in known):
            return name
        raise InputError(f"the table has no such column; it has {', '.join(known)}", where=where, value=quantity)
    name = next((q for q in FITTED if q in known), None)
    if name is not None:
        return name
    hints = [
        f"{header!r}: {hint}" for header in unknown if (hint := nearest(header, FITTED.values())).startswith("nearest")
    ]
    rule = f"has no column to fit laws to: {', '.join(FITTED.values())}"
    raise InputError(f"{rule}; {'; '.join(hints)}" if hints else rule, where=f"{where}: header")


def _numbers(sheet: Sheet, header: str) -> np.ndarray:
    cells = sheet.cells[header]
    return np.array([np.nan if is_missing(cell) else number_of(cell) for cell in cells])


def _is_sd(header: str) -> bool:
    return header.lower().endswith(("_sd", " sd"))


def _sd_header(sheet: Sheet, header: str, measured: Meaning) -> str | None:
    """Column of the standard deviations of the measured one: of the same header, else of the same quantity and unit."""
    found = [one for one in sheet.cells if _is_sd(one) and one[:-3].lower() == header.lower()]
    for one in sheet.cells:
        if _is_sd(one) and is_numeric(sheet.cells[one]):
            with suppress(InputError):
                found += [one] if meaning(one[:-3], "") == measured else []
    return next(iter(found), None)


def _sd(sheet: Sheet, found: str, kept: np.ndarray, factor: float) -> np.ndarray:
    values = _numbers(sheet, found)[kept] * factor
    if not (np.isfinite(values) & (values > 0.0)).all():
        raise InputError("standard deviations must be above 0 in every row", where=f"{sheet.name}: {found}")
    return np.asarray(values)
