"""Columns of a study's tables: name with unit, meaning, and conversion from an output in SI.

Files, pages and labelled arrays all use this description.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from mixedlub.chain.quantities import GLOSSARY
from mixedlub.chain.ranges import GRADES, VALID
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.result import ResultColumn, described
from mixedlub.schema.section import table
from mixedlub.study.bands import HIGH, LOW
from mixedlub.study.bands import column as band_column
from mixedlub.study.schema import StudyFile

VALIDITY = "validity"
"""Column with the validity of a condition: reasons for being outside the range of the model."""


def _of_glossary(output: str, name: str, factor: float = 1.0) -> ResultColumn:
    return ResultColumn(output, name, GLOSSARY[output].meaning, factor)


FIRST = (
    ResultColumn(
        "power_loss",
        "power_loss_W",
        "total power loss, mean over a mesh cycle: the mesh and every loss that is switched on as an effect",
    ),
    ResultColumn(
        "mean_friction",
        "mean_friction",
        "friction coefficient of the mesh: mean over the path weighted by load times sliding speed",
    ),
    ResultColumn(
        "area_ratio",
        "boundary_area_ratio",
        "boundary area ratio, plain mean over the path of contact as far as it carries load",
    ),
    ResultColumn(
        "film_thickness",
        "film_thickness_um",
        "film thickness, plain mean over the path of contact as far as it carries load",
        1e6,
    ),
    ResultColumn("film_parameter", "film_parameter", "mean film thickness over composite roughness"),
    _of_glossary("composite_roughness", "composite_roughness_um", 1e6),
    _of_glossary("mesh_loss", "mesh_loss_W"),
    _of_glossary("rolling_loss", "rolling_loss_W"),
    ResultColumn(
        "other_loss",
        "other_loss_W",
        "power lost outside the mesh by effects that are switched on: bearings, seals, churning, windage",
    ),
    ResultColumn("hertz_pressure", "hertz_pressure_MPa", "largest Hertz pressure of the path of contact", 1e-6),
    ResultColumn(
        "asperity_load_ratio",
        "asperity_load_ratio",
        "pressure that asperities would carry over mean Hertz pressure, the largest of the places that carry at "
        "least a tenth of the largest line load; above 1 the film would have to give way, which it does with "
        'balance = "johnson_greenwood_poon"',
    ),
    ResultColumn(
        "asperity_real_pressure",
        "asperity_real_pressure_MPa",
        "pressure of the asperities over their real contact area, where they carry most among the places that "
        "carry at least a tenth of the largest line load; 0 where none touch",
        1e-6,
    ),
    ResultColumn(
        "mean_asperity_load_share",
        "mean_asperity_load_share",
        "share of the load that asperities carry, plain mean over the path of contact as far as it carries load; only "
        "with a balance of load",
    ),
    ResultColumn(
        "film_over_unbalanced",
        "film_over_unbalanced_film",
        "film thickness over that of a film which carries the whole load, plain mean over the path of contact as far "
        "as it carries load; only with a balance of load",
    ),
)
"""Columns before the validity, in order; some need an option."""
FURTHER = (
    ResultColumn("normalised_loss", "normalised_loss", "power loss over the largest of the study"),
    ResultColumn("input_power", "input_power_W", "power that the pinion takes in: its torque times its angular speed"),
    ResultColumn("efficiency", "efficiency", "1 less total power loss over input power"),
    ResultColumn(
        "tooth_efficiency", "tooth_efficiency", "1 less the losses of the mesh, sliding and rolling, over input power"
    ),
    ResultColumn(
        "loss_factor",
        "loss_factor_H_V",
        "tooth loss factor of rigid teeth that share the load equally, after Ohlendorf; spur gears of a contact ratio "
        "up to 2",
    ),
    ResultColumn(
        "load_loss_factor",
        "loss_factor_H_VL",
        "tooth loss factor of the load sharing at hand: load times sliding speed, mean over a mesh cycle, over input "
        "power; spur gears",
    ),
    ResultColumn(
        "plain_mean_friction",
        "plain_mean_friction",
        "friction coefficient, plain mean over the path of contact as far as it carries load: the average of Hong, "
        "Aneshansley and Talbot",
    ),
    ResultColumn(
        "least_film",
        "minimum_film_thickness_um",
        "least film thickness of the path of contact as far as it carries load",
        1e6,
    ),
    ResultColumn(
        "least_film_parameter", "minimum_film_parameter", "that least film thickness over composite roughness"
    ),
    ResultColumn(
        "asperity_load_share",
        "asperity_load_share",
        "share of the load that asperities carry, at most 1, the largest of the places that carry at least a tenth "
        "of the largest line load",
    ),
    ResultColumn(
        "flash_temperature",
        "flash_temperature_K",
        "largest rise of the flanks above their bulk by sliding, after Blok, anywhere in the contact and on the path",
    ),
    ResultColumn(
        "flash_safety",
        "scuffing_safety_flash",
        "rise to the scuffing temperature over the largest rise of the contact, both above the oil, as in "
        "ISO/TS 6336-20 with friction and flash of this model; only with scuffing_temperature_C",
    ),
    ResultColumn(
        "integral_temperature",
        "integral_temperature_C",
        "bulk temperature and flash_weight times the mean flash temperature along the path, as in ISO/TS 6336-21 with "
        "those of this model",
        zero=ZERO_CELSIUS,
    ),
    ResultColumn(
        "integral_safety",
        "scuffing_safety_integral",
        "integral scuffing temperature over the integral temperature, in degC; only with "
        "integral_scuffing_temperature_C",
    ),
    ResultColumn(
        "least_specific_film",
        "micropitting_film_ratio",
        "least film of ISO/TS 6336-22 on the path over the mean roughness Ra of both surfaces, with pressure, bulk and "
        "flash temperature of this model; only with permissible_film_ratio",
    ),
    ResultColumn("micropitting_safety", "micropitting_safety", "that ratio over the permissible one"),
    ResultColumn(
        "bulk_temperature",
        "bulk_temperature_C",
        "temperature of the teeth; only with the effect bulk_temperature",
        zero=ZERO_CELSIUS,
    ),
    ResultColumn(
        "contact_temperature",
        "contact_temperature_C",
        "largest temperature of the flanks: that rise above their bulk, which without the effect bulk_temperature is "
        "as warm as the oil at the inlet",
        zero=ZERO_CELSIUS,
    ),
)
"""Columns after the validity; columns impossible in a study are left out."""


def ends_of_bands(columns: Iterable[ResultColumn]) -> list[ResultColumn]:
    """Columns of both ends of the bands of columns.

    >>> [column.name for column in ends_of_bands(FIRST[:1])]
    ['power_loss_low_W', 'power_loss_high_W']
    """
    ends = ((LOW, "low", "lower"), (HIGH, "high", "upper"))
    return [
        replace(c, output=end + c.output, name=band_column(c.name, word), meaning=f"{which} end of its band: {c.name}")
        for c in columns
        for end, word, which in ends
    ]


COLUMNS = {c.output: c for c in (*FIRST, *ends_of_bands(FIRST), *FURTHER, *ends_of_bands(FURTHER))}
"""Columns of all outputs other than the losses of effects, in the order of the table."""
CHECKS = {
    "largest_area_ratio": "boundary area ratio where asperities carry most, as asperity_load_ratio has it",
    "balance_error": "part of the load by which film and asperities together miss it, the largest of the same places",
    "share_lacking": "least load share that the film law is for over the film's own, where asperities carry 5 %",
}
"""Meaning of the checks of a computation that are in no table."""
OF_VALIDITY = ResultColumn(
    VALIDITY,
    VALIDITY,
    f"'{VALID}', or how far the condition is outside the model's range ({', '.join(GRADES[1:])}) and, behind "
    "semicolons, the kinds of findings that say why",
    given_unit="text",
)


def loss_of(effect: str) -> str:
    """Name of the output with the loss of an effect.

    >>> loss_of("windage"), loss_columns(["windage"])[0].name
    ('windage_loss', 'windage_loss_W')
    """
    return f"{effect}_loss"


def loss_columns(effects: Iterable[str]) -> list[ResultColumn]:
    """Columns of the power lost by effects."""
    return [
        ResultColumn(loss_of(name), f"{loss_of(name)}_W", f"power lost by the effect {name}, part of other_loss_W")
        for name in effects
    ]


def condition_columns() -> list[ResultColumn]:
    """Columns of the pairing and the conditions."""
    levels = {key.name: key.meaning for key in table(StudyFile, "conditions").fields}
    sides = described(**{f"{side}_surface": f"text: surface of the {side}" for side in ("pinion", "gear")})
    return [*sides, *(ResultColumn("", name, meaning) for name, meaning in levels.items())]


def every_column(effects: Sequence[str] = (), *, bands: bool = True) -> list[ResultColumn]:
    """All possible columns of a table of results, in order."""
    if not bands:
        return [*condition_columns(), *FIRST, OF_VALIDITY, *FURTHER, *loss_columns(effects)]
    first, further = ([*some, *ends_of_bands(some)] for some in (FIRST, FURTHER))
    return [*condition_columns(), *first, OF_VALIDITY, *further, *loss_columns(effects)]
