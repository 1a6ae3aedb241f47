"""Names with units: what the ending of a name stands for, and which column of a case a header means."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from profiles.errors import InputError

UNITS: dict[str, dict[str, tuple[float, float]]] = {
    "m_s": {"m/s": (1.0, 0.0), "mm/s": (1e-3, 0.0), "um/s": (1e-6, 0.0)},
    "N": {
        "N": (1.0, 0.0),
        "uN": (1e-6, 0.0),
        "mN": (1e-3, 0.0),
        "kN": (1e3, 0.0),
        "lbf": (4.4482216152605, 0.0),
        **dict.fromkeys(("gf", "g"), (9.80665e-3, 0.0)),
        **dict.fromkeys(("kgf", "kg"), (9.80665, 0.0)),
    },
    "C": {
        "degC": (1.0, 0.0),
        "C": (1.0, 0.0),
        "K": (1.0, -273.15),
        "degF": (5.0 / 9.0, -160.0 / 9.0),
        "F": (5.0 / 9.0, -160.0 / 9.0),
    },
    "rpm": {
        **dict.fromkeys(("rpm", "1/min", "r/min", "U/min", "rev/min"), (1.0, 0.0)),
        "rad/s": (30.0 / np.pi, 0.0),
        "deg/s": (1.0 / 6.0, 0.0),
        **dict.fromkeys(("rev/s", "rps", "U/s"), (60.0, 0.0)),
    },
    "Nm": {
        "N.m": (1.0, 0.0),
        "mN.m": (1e-3, 0.0),
        "N.mm": (1e-3, 0.0),
        "N.cm": (1e-2, 0.0),
        "kN.m": (1e3, 0.0),
        **dict.fromkeys(("lbf.ft", "lb.ft", "ft.lbf", "ft.lb"), (1.3558179483314004, 0.0)),
        **dict.fromkeys(("lbf.in", "lb.in", "in.lbf", "in.lb"), (0.1129848290276167, 0.0)),
    },
    "nm": {"nm": (1.0, 0.0), "um": (1e3, 0.0)},
    "mPa_s": {"mPa.s": (1.0, 0.0), "cP": (1.0, 0.0), "Pa.s": (1e3, 0.0)},
    "MPa": {
        "MPa": (1.0, 0.0),
        "Pa": (1e-6, 0.0),
        "kPa": (1e-3, 0.0),
        "GPa": (1e3, 0.0),
        "bar": (0.1, 0.0),
        "atm": (0.101325, 0.0),
        "psi": (6.894757293168361e-3, 0.0),
    },
    "s": {"s": (1.0, 0.0), "min": (60.0, 0.0), "h": (3600.0, 0.0)},
    "m": {"m": (1.0, 0.0), "mm": (1e-3, 0.0), "km": (1e3, 0.0)},
    "cycle": {"cycle": (1.0, 0.0), "cycles": (1.0, 0.0)},
    "W": {"W": (1.0, 0.0), "kW": (1e3, 0.0)},
    "deg": {"deg": (1.0, 0.0), "rad": (180.0 / np.pi, 0.0)},
    "ratio": {"-": (1.0, 0.0), "1": (1.0, 0.0), "%": (0.01, 0.0)},
    "percent": {"%": (1.0, 0.0), "-": (100.0, 0.0), "1": (100.0, 0.0)},
}
"""What each unit of a case's columns may be given in, and of what is counted for time: factor and what is added."""
UNSURE: dict[str, dict[str, tuple[str, ...]]] = {"rpm": {"1/s": ("rev/s", "rad/s")}}
"""By the unit of a column: what is written for more than one unit, and those."""
WEIGHED = {"g": "grams-force of 9.80665 mN", "kg": "kilograms-force of 9.80665 N"}
"""Units of mass that a load is given in, and what they then are."""
KINEMATIC = ("mm2/s", "cst", "st", "m2/s", "cm2/s")
"""Units, in small letters, in which viscosity is divided by density."""
SIGNS = str.maketrans({**dict.fromkeys("µμ", "u"), **dict.fromkeys("·⋅*", "."), **dict.fromkeys("⁻−", "-")})
SIGNS |= str.maketrans({"°": "deg", "¹": "1", "²": "2", "³": "3", "^": ""})
"""Signs of units as the table writes them."""


ENDINGS = {
    "per_GPa": "1/GPa",
    "per_um2": "1/µm²",
    "per_K": "1/K",
    "kg_m3": "kg/m³",
    "mm2_s": "mm²/s",
    "mPa_s": "mPa s",
    "Pa_s": "Pa s",
    "mm_s": "mm/s",
    "rad_s": "rad/s",
    "deg_s": "°/s",
    "m_s": "m/s",
    "W_mK": "W/(m K)",
    "J_kgK": "J/(kg K)",
    "um2": "µm²",
    "mNm": "mN m",
    "Nm": "N m",
    "percent": "%",
    "degC": "°C",
    "C": "°C",
    "degF": "°F",
    "F": "°F",
    "lbft": "lb ft",
    "ftlb": "ft lb",
    "deg": "°",
    "um": "µm",
    **{
        unit: unit
        for unit in (
            "lbf",
            "kgf",
            "kg",
            "g",
            "psi",
            "MPa",
            "GPa",
            "kPa",
            "bar",
            "atm",
            "nm",
            "mm",
            "rpm",
            "kN",
            "kW",
            "min",
            "K",
            "N",
            "W",
            "km",
            "m",
            "s",
            "h",
        )
    },
}
"""Ending of a name and the unit it stands for, longer endings before those they end in."""


def unit_of(name: str) -> str:
    """The unit at the end of a name; empty where it has none.

    >>> unit_of("oil_temperature_C"), unit_of("kinematic_viscosity_mm2_s"), unit_of("m4_per_um2"), unit_of("teeth")
    ('°C', 'mm²/s', '1/µm²', '')
    """
    return ENDINGS.get(_ending(name), "")


def without_unit(name: str) -> str:
    """A name less the unit at its end.

    >>> without_unit("oil_temperature_C"), without_unit("teeth")
    ('oil_temperature', 'teeth')
    """
    return name.removesuffix(f"_{_ending(name)}")


def _ending(name: str) -> str:
    return next((ending for ending in ENDINGS if name.endswith(f"_{ending}")), "")


@dataclass(frozen=True)
class Target:
    """A column of a case, its unit, the headers under which instruments write it, and others that may mean it."""

    name: str
    unit: str
    spoken: tuple[str, ...]
    offered: tuple[str, ...] = ()


TARGETS = (
    Target("load_N", "N", ("load", "ball load", "pin load", "normal load", "normal force"), ("fn", "fz")),
    Target("entrainment_speed_m_s", "m_s", ("rolling speed", "entrainment speed", "mean speed")),
    Target("sliding_speed_m_s", "m_s", ("sliding speed",)),
    Target(
        "slide_roll_ratio",
        "ratio",
        ("srr", "slide roll ratio", "slide to roll ratio", "slide/roll", "slide/roll ratio"),
    ),
    Target(
        "oil_temperature_C", "C", ("oil temperature", "oil temp", "lubricant temperature", "lube temp", "lube rtd temp")
    ),
    Target("temperature_C", "C", ("temperature", "temp")),
    Target("pressure_MPa", "MPa", ("pressure",)),
    Target("time_s", "s", ("test time", "elapsed time", "timestamp", "time", "step time")),
    Target("speed_rpm", "rpm", ("speed", "motor speed", "rotational speed")),
    Target("torque_Nm", "Nm", ("torque", "load torque", "pinion torque")),
    Target("motor_torque_Nm", "Nm", ("motor torque",)),
    Target(
        "friction_torque_Nm",
        "Nm",
        ("friction torque", "torque loss", "loss torque", "drag torque", "frictional torque"),
        ("loss", "drag"),
    ),
    Target(
        "friction_coefficient",
        "ratio",
        (
            "traction coeff",
            "friction coefficient",
            "cof",
            "friction coeff",
            "traction coefficient",
            "coefficient of friction",
            "coeff. of friction",
            *("mu", "µ", "μ"),
        ),
    ),
    Target("film_thickness_nm", "nm", ("average film", "film thickness", "film", "central film thickness")),
    Target("viscosity_mPa_s", "mPa_s", ("viscosity", "dynamic viscosity")),
    Target("power_loss_W", "W", ("power loss", "loss")),
    Target("roll_angle_deg", "deg", ("roll angle",)),
    Target("position_deg", "deg", ("position", "angle", "shaft angle")),
    Target("fringe_order", "ratio", ("order", "fringe order")),
    Target("additive_percent", "percent", ("additive", "additive content", "additive concentration")),
)
BY_NAME = {t.name: t for t in TARGETS}
TEXT_COLUMNS = ("rig", "setup", "surface_1", "surface_2", "pinion_surface", "gear_surface")


def split(header: str) -> tuple[str, str | None]:
    """Words and unit of a header such as ``Rolling Speed (mm/s)``; the unit is None where there is none.

    >>> split("Rolling Speed (mm/s)"), split("temperature_degC"), split("Load")
    (('rolling speed', 'mm/s'), ('temperature', '°C'), ('load', None))
    """
    found = re.fullmatch(r"\s*(.*?)\s*[(\[]\s*([^()\[\]]*?)\s*[)\]]\s*", header)
    plain = header.strip()
    words, unit = (found.group(1), found.group(2)) if found else (without_unit(plain), unit_of(plain) or None)
    return re.sub(r"[\s_]+", " ", words).strip().lower(), unit or None


def words_of(header: str) -> str:
    """The words of a header without its unit, the name of a channel before a dot and a dot at the end.

    >>> words_of("DAQ.COF ()"), words_of("Test Time (s)"), words_of("friction coeff.")
    ('cof', 'test time', 'friction coeff')
    """
    return re.sub(r"^[a-z]+\.(?=\S)", "", split(header)[0]).rstrip(".")


def target_of(header: str) -> Target | None:
    """The column that a header means, by the words instruments use; an exact column name is itself."""
    if header.strip() in BY_NAME:
        return BY_NAME[header.strip()]
    words = words_of(header)
    return next((t for t in TARGETS if words in t.spoken), None)


def tidy(unit: str) -> str:
    """A unit as the table writes it.

    >>> tidy("µm"), tidy("°C"), tidy("N·m"), tidy("N m"), tidy("Pa s"), tidy("ft-lb")
    ('um', 'degC', 'N.m', 'N.m', 'Pa.s', 'ft.lb')
    >>> tidy("min⁻¹"), tidy("rad s^-1"), tidy("° / s"), tidy("mm².s⁻¹")
    ('1/min', 'rad/s', 'deg/s', 'mm2/s')
    """
    plain = re.sub(r"\s*/\s*", "/", unit.strip().translate(SIGNS))
    plain = re.sub(r"(?<=[a-z])-(?=[a-z])|\s+", ".", plain)
    return re.sub(r"(?:(.+)\.)?(s|min|h)-1", lambda found: f"{found[1] or 1}/{found[2]}", plain)


def change_to(unit: str, wanted: str) -> tuple[float, float] | None:
    """Factor and what is added, from a unit as written to a unit of UNITS; None where it is not one that is read.

    Capitals are overlooked where they tell nothing: not where milli and mega, or two of the units, differ by them
    only, nor in a single letter.

    >>> change_to("N mm", "Nm"), change_to("RPM", "rpm"), change_to("mPa", "MPa"), change_to("nm", "Nm")
    ((0.001, 0.0), (1.0, 0.0), None, None)
    """
    written, forms = tidy(unit), FORMS[wanted]
    if written in forms or len(written) == 1:
        return forms.get(written)
    alike = {form for known in FORMS.values() for form in known if form.lower() == written.lower()}
    if len(alike) != 1:
        return None
    form = alike.pop()
    return forms.get(form) if written[:1] == form[:1] or form[:1] not in "mM" else None


FORMS = {
    wanted: {form: change for known, change in units.items() for form in (tidy(known), tidy(known).replace(".", ""))}
    for wanted, units in UNITS.items()
}
"""By the unit of a column: what stands for a unit that it may be given in, with and without the dot of a product."""


def open_units(unit: str, wanted: str) -> tuple[str, ...]:
    """The units between which one as written leaves open; none where it is sure.

    >>> open_units("s⁻¹", "rpm"), open_units("1/min", "rpm")
    (('rev/s', 'rad/s'), ())
    """
    return UNSURE.get(wanted, {}).get(tidy(unit), ())


def fits(unit: str, wanted: str) -> bool:
    """Whether what is written may be a unit of a column."""
    return change_to(unit, wanted) is not None or bool(open_units(unit, wanted))


def units_of(wanted: str) -> tuple[str, ...]:
    """The units that a column may be given in, each in one way of writing it.

    >>> units_of("rpm"), units_of("ratio")
    (('rpm', 'rad/s', 'deg/s', 'rev/s'), ('-', '%'))
    """
    known = UNITS[wanted]
    return tuple(unit for unit, change in known.items() if unit == next(u for u, c in known.items() if c == change))


def is_unit(text: str) -> bool:
    """Whether a text is one of the units that are read."""
    return any(fits(text, wanted) for wanted in UNITS)


def is_of_another(unit: str, target: Target) -> bool:
    """Whether a unit is one of another quantity than a column's; a kinematic viscosity is still one of viscosity.

    >>> is_of_another("mPa s", BY_NAME["friction_coefficient"]), is_of_another("mm2/s", BY_NAME["viscosity_mPa_s"])
    (True, False)
    """
    if tidy(unit).lower() in KINEMATIC:
        return target.unit != "mPa_s"
    return is_unit(unit) and not fits(unit, target.unit)


def unknown_unit(unit: str, target: Target) -> str:
    """Why a unit is not taken as that of a column, and what could be."""
    meant = open_units(unit, target.unit)
    if meant:
        return f"as unit of {target.name} leaves open which is meant; say {' or '.join(meant)}"
    if target.unit == "mPa_s" and tidy(unit).lower() in KINEMATIC:
        hint = "this is a kinematic viscosity: in mm²/s, times the density in g/cm³, it is in mPa s"
    else:
        hint = f"it could be {', '.join(units_of(target.unit))}"
    return f"unit of {target.name} is not known; {hint}"


def convert(values: np.ndarray, unit: str, target: Target, where: str) -> np.ndarray:
    """Values in the unit of the target's column, free of the last digits that only conversion made.

    >>> convert(np.array([1.5]), "mm/s", BY_NAME["entrainment_speed_m_s"], "file").tolist()
    [0.0015]
    >>> 300.1 - 273.15, convert(np.array([300.1]), "K", BY_NAME["temperature_C"], "file").tolist()
    (26.950000000000045, [26.95])
    """
    change = change_to(unit, target.unit)
    if change is None:
        raise InputError(unknown_unit(unit, target), where=where, value=unit)
    factor, added = change
    return values if change == (1.0, 0.0) else rounded(values * factor + added, abs(added))


DIGITS = 15
"""Decimal digits that a double always holds."""


def rounded(values: np.ndarray, beside: float = 0.0) -> np.ndarray:
    """Values to 15 significant digits, of the larger where they were added to ``beside``.

    >>> rounded(np.array([0.1 + 0.2])).tolist(), rounded(np.array([3600.0 + 0.7 - 3600.0]), 3600.0).tolist()
    ([0.3], [0.7])
    """
    sizes = np.maximum(np.abs(values), beside)
    return np.array(
        [
            round(v, DIGITS - 1 - int(np.floor(np.log10(s)))) if 0.0 < s < np.inf else v
            for v, s in zip(values.tolist(), sizes.tolist(), strict=True)
        ]
    )
