"""Columns and explanations in words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

from mixedlub.diagnosis.settings.report import COLDEST
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.recording.set_points import one_point
from mixedlub.schema.units import stated_units, unit_of, without_unit

P = ParamSpec("P")
R = TypeVar("R")

STAGE_WORDS = {
    "film": "the oil film",
    "shear": "shear of the film",
    "contact": "asperity contact",
    "boundary": "boundary friction",
    "load": "load and its sharing",
    "loss": "losses other than sliding friction",
    "property": "properties of the oil",
    "law": "a law of the base model, in place of which another fits",
    "measurement": "the instrument",
}


def in_units_of_case(function: Callable[Concatenate[Any, P], R]) -> Callable[Concatenate[Any, P], R]:
    """Function of a diagnosis with labels in the units of the case."""

    @wraps(function)
    def labelled(d: Any, *args: P.args, **kwargs: P.kwargs) -> R:
        with stated_units(d.case.kind.units):
            return function(d, *args, **kwargs)

    return labelled


def words_of(column: str) -> str:
    """A column's name in words, without its unit.

    >>> words_of("oil_temperature_C"), words_of("slide_roll_ratio")
    ('oil temperature', 'slide-roll ratio')
    """
    words = without_unit(column).replace("_", " ")
    return words.replace("slide roll", "slide-roll").replace("pressure viscosity", "pressure-viscosity")


def axis_label(column: str) -> str:
    """Words and unit for the axis of a figure.

    >>> axis_label("torque_Nm"), axis_label("friction_coefficient")
    ('torque (N m)', 'friction coefficient (-)')
    """
    return f"{words_of(column)} ({unit_of(column) or '-'})"


def amount(value: float, column: str) -> str:
    """A number with its column's unit.

    >>> amount(2000.0, "speed_rpm"), amount(0.1, "slide_roll_ratio")
    ('2000 rpm', '0.1')
    """
    unit = unit_of(column)
    return f"{_four(value)}{'' if unit in ('', '°') else ' '}{unit}"


def _four(value: float) -> str:
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e7 else f"{value:.4g}"


def number(value: float) -> str:
    """A number to three digits, or to an integer from 100.

    >>> number(0.10412), number(1234.5), number(169.9), number(0.0)
    ('0.104', '1234', '170', '0')
    """
    return f"{value:.0f}" if 100 <= abs(value) < 1e6 else f"{value:.3g}"


def conditions_text(conditions: Mapping[str, float | str]) -> str:
    """The conditions of one reading in words.

    >>> conditions_text({"torque_Nm": 50.0, "pinion_surface": "ground"})
    'torque 50 N m, pinion surface ground'
    """
    return ", ".join(
        f"{words_of(name)} {value if isinstance(value, str) else amount(value, name)}"
        for name, value in conditions.items()
    )


def range_text(cut: Mapping[str, Any]) -> str:
    """One cut of a region in words.

    >>> range_text({"column": "speed_rpm", "low": 2000.0, "high": 3000.0})
    'speed 2000 to 3000 rpm'
    """
    name = cut["column"]
    if "values" in cut:
        return f"{words_of(name)} {' or '.join(cut['values'])}"
    point = one_point(cut["low"], cut["high"])
    if point is not None:
        return f"{words_of(name)} {amount(point, name)}"
    return f"{words_of(name)} {_four(cut['low'])} to {amount(cut['high'], name)}"


def effect_words(name: str) -> str:
    """An effect's id in words.

    >>> effect_words("inlet_shear_heating")
    'inlet shear heating'
    """
    special = {
        "none": "nothing missing",
        "unknown": "something unknown",
        "micro_ehl": "micro-EHL",
        "stribeck": "Stribeck",
    }
    return special.get(name, name.replace("_", " "))


def explanation_words(names: Sequence[str]) -> str:
    """An explanation in words.

    >>> explanation_words(["churning", "sensor_offset"])
    'churning and sensor offset'
    """
    return enumerated([effect_words(name) for name in names])


def enumerated(words: Sequence[str]) -> str:
    """Words in a row.

    >>> enumerated(["windage"]), enumerated(["seals", "bearings", "windage"])
    ('windage', 'seals, bearings and windage')
    """
    return " and ".join([*([", ".join(words[:-1])] if len(words) > 1 else []), *words[-1:]])


def with_names(words: str, first: bool = True) -> str:
    """Words with capitalised proper names, and a capital first letter at the beginning of a sentence.

    >>> with_names("micro-EHL"), with_names("the eyring stress", first=False)
    ('Micro-EHL', 'the Eyring stress')
    """
    words = words.replace("eyring", "Eyring")
    return f"{words[:1].upper()}{words[1:]}" if first else words


def in_reach(values: Sequence[float], unit: str, usual: float) -> tuple[tuple[float, ...], str]:
    """SI numbers in customary units: small lengths in µm, temperatures in °C; ``usual`` is a typical size.

    >>> in_reach((5.61e-5, 3.4e-5), "m", 4e-5), in_reach((371.15,), "K", 365.0), in_reach((8.0,), "K", 8.0)
    (((56.1, 34.0), 'µm'), ((98.0,), '°C'), ((8.0,), 'K'))
    """
    if unit == "m" and max(map(abs, values)) < 1e-3:
        return tuple(round(1e6 * x, 12) for x in values), "µm"
    if unit == "K" and usual > COLDEST:
        return tuple(round(x - ZERO_CELSIUS, 12) for x in values), "°C"
    return tuple(values), unit
