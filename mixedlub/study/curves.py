"""Curves along the path of contact: load, film, contact, friction and heat at every point of every condition."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.chain.quantities import GLOSSARY
from mixedlub.schema.result import ResultColumn
from mixedlub.schema.table_files import LongTable
from mixedlub.study import checkpoint
from mixedlub.study.columns import condition_columns
from mixedlub.study.pieces import taken
from mixedlub.study.plan import Study
from mixedlub.study.results import about_table
from profiles.errors import InputError

if TYPE_CHECKING:
    import pyarrow as pa


def _of(output: str, name: str = "", factor: float = 1.0) -> ResultColumn:
    return ResultColumn(output, name or output, GLOSSARY[output].meaning, factor)


PLACES = (
    ResultColumn("roll_angle", "roll_angle_deg", GLOSSARY["roll_angle"].meaning, float(np.degrees(1.0))),
    ResultColumn("face_position", "face_position_mm", "place across the face, from its front", 1e3),
)
"""Columns of the position of a contact point."""
ALONG_PATH = (
    _of("path_weight"),
    _of("load_share"),
    _of("line_load", "line_load_N_mm", 1e-3),
    _of("radius", "radius_mm", 1e3),
    _of("entrainment_speed", "entrainment_speed_m_s"),
    _of("sliding_speed", "sliding_speed_m_s"),
    _of("hertz_pressure", "hertz_pressure_MPa", 1e-6),
    _of("film_thickness", "film_thickness_um", 1e6),
    _of("composite_roughness", "composite_roughness_um", 1e6),
    _of("area_ratio", "boundary_area_ratio"),
    _of("asperity_pressure", "asperity_pressure_MPa", 1e-6),
    _of("shear_stress", "shear_stress_MPa", 1e-6),
    _of("fluid_friction"),
    _of("friction"),
    _of("friction_line_load", "friction_line_load_N_mm", 1e-3),
    _of("film_rise", "film_rise_K"),
    _of("flash_temperature", "flash_temperature_K"),
)
"""Columns of the quantities at a contact point."""
OF_POINTS = tuple(c.output for c in ALONG_PATH)
MOST_ROWS = 5_000_000
"""Largest number of rows of curves written."""
MOST_CSV_ROWS = 50_000
"""Largest number of rows of curves written as CSV beside Parquet: 15 MB."""
_ROWS = 100_000


def curve_columns() -> list[ResultColumn]:
    """All columns of the curves, in order."""
    return [*condition_columns(), *PLACES, *ALONG_PATH]


def curves(study: Study) -> Iterator[pa.Table]:
    """The curves as tables of bounded size, by pairing, condition and point."""
    import pyarrow as pa

    plan, points, levels = study.plan, study.mesh, study.file.conditions
    model = plan.model(OF_POINTS)
    grid = np.meshgrid(levels.oil_temperature_C, levels.torque_Nm, levels.speed_rpm, points.roll_angle, indexing="ij")
    theta, torque, speed, angle = (axis.ravel() for axis in grid)
    place = {"roll_angle": angle, "face_position": np.tile(points.face_position, angle.size // plan.points)}
    step = max(1, _ROWS // angle.size)
    for start in range(0, len(study.pairings), step):
        pairings = study.pairings[start : start + step]
        shape = (len(pairings), *plan.shape[1:], plan.points)
        with np.errstate(all="ignore"):
            state = model(taken(plan.inputs, (slice(start, start + step),)), plan.parameters)
        columns = {
            f"{side}_surface": checkpoint.words(names, np.arange(len(pairings)).repeat(angle.size))
            for side, names in zip(("pinion", "gear"), zip(*pairings, strict=True), strict=True)
        }
        along = {"torque_Nm": torque, "speed_rpm": speed, "oil_temperature_C": theta}
        along |= {c.name: c.of(place[c.output]) for c in PLACES}
        columns |= {name: checkpoint.floats(np.tile(values, len(pairings))) for name, values in along.items()}
        columns |= {c.name: checkpoint.floats(np.broadcast_to(c.of(state[c.output]), shape)) for c in ALONG_PATH}
        yield pa.table(columns)


def refuse_too_many(study: Study) -> None:
    """Raise an error if the curves of a study would fill a disk."""
    rows = study.conditions * study.plan.points
    if rows > MOST_ROWS:
        rule = f"the curves would have {rows} rows, of at most {MOST_ROWS}; take fewer conditions, or fewer path_points"
        raise InputError(rule, where="--curves")


def curve_table(study: Study) -> LongTable:
    """The curves of a study with metadata for writing; short ones also as CSV."""
    return LongTable(
        lambda: curves(study),
        tuple(c.name for c in curve_columns()),
        about_table(study),
        study.needs_quotes,
        tuple(c.name for c in condition_columns()),
        csv=study.conditions * study.plan.points <= MOST_CSV_ROWS,
    )
