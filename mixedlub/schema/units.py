"""Table of units: meaning of name suffixes, accepted units and conversions."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from fractions import Fraction
from functools import cache
from types import MappingProxyType

import numpy as np

from profiles.units import METRES

Powers = tuple[int, int, int, int]
"""Powers of kilogram, metre, second and kelvin."""

BASES: Mapping[str, Powers] = {
    **{"kg": (1, 0, 0, 0), "m": (0, 1, 0, 0), "s": (0, 0, 1, 0), "K": (0, 0, 0, 1)},
    **dict.fromkeys(("1", "-", "rad", "cycle"), (0, 0, 0, 0)),
}
NAMED: Mapping[str, tuple[str | int | Fraction, str]] = {
    **{name: (str(size), "m") for name, size in METRES.items() if name != "m"},
    "ft": (12, "in"),
    "min": (60, "s"),
    "h": (3600, "s"),
    "g": ("1e-3", "kg"),
    "N": (1, "kg.m/s2"),
    "gf": ("9.80665e-3", "N"),
    "kgf": ("9.80665", "N"),
    "lbf": ("4.4482216152605", "N"),
    "J": (1, "N.m"),
    "W": (1, "J/s"),
    "Pa": (1, "N/m2"),
    "P": ("0.1", "Pa.s"),
    "bar": ("1e5", "Pa"),
    "atm": (101325, "Pa"),
    "psi": (1, "lbf/in2"),
    "deg": (Fraction(math.pi) / 180, "rad"),
    "rev": (360, "deg"),
    "rpm": (1, "rev/min"),
    "%": ("0.01", "1"),
    "degC": (1, "K"),
    "degF": ("5/9", "K"),
}
"""Units in terms of others, as exact numbers to round conversions only once."""
PREFIXES = {"T": 12, "G": 9, "M": 6, "k": 3, "c": -2, "m": -3, "u": -6, "n": -9}
ZEROS = {"degC": Fraction("273.15"), "degF": Fraction("459.67") * Fraction(5, 9)}
"""Zero points of temperature scales (K)."""

_TABLE = """
# ending | shown    | units that a column is read in, a spelling = the unit it is | units that a slip is recognised in
m_s      | m/s      | m/s, mm/s, um/s                                             | mm/s, um/s
N        | N        | N, uN, mN, kN, lbf, gf, g=gf, kgf, kg=kgf
C        | °C       | degC, C=degC, K, degF, F=degF                               | K, degF
rpm      | rpm      | rpm, 1/min=rpm, r/min=rpm, U/min=rpm, rev/min, rad/s, deg/s, rev/s, rps=rev/s, U/s=rev/s
Nm       | N m      | N.m, mN.m, N.mm, N.cm, kN.m, lbf.ft, lb.ft=lbf.ft, ft.lbf, ft.lb=lbf.ft, lbf.in, lb.in=lbf.in, \
in.lbf, in.lb=lbf.in
nm       | nm       | nm, um                                                      | um
mPa_s    | mPa s    | mPa.s, cP, Pa.s, P, mN.s/m2, N.s/m2, N.s.m-2=N.s/m2, kg/(m.s), kg/m/s=kg/(m.s), \
kg.m-1/s=kg/(m.s), g/(cm.s), g/cm/s=g/(cm.s) | uPa.s
MPa      | MPa      | MPa, Pa, kPa, GPa, bar, atm, psi                            | Pa, kPa, GPa
s        | s        | s, min, h
m        | m        | m, mm, km
cycle    |          | cycle, cycles=cycle
W        | W        | W, kW
deg      | °        | deg, rad                                                    | rad
ratio    |          | -, 1, %                                                     | %
percent  | %        | %, -, 1
GPa      | GPa      |                                                             | Pa, MPa, TPa
per_GPa  | 1/GPa    |                                                             | 1/Pa, 1/MPa
mm2_s    | mm²/s    | mm2/s, cSt=mm2/s, m2/s, cm2/s, St=cm2/s                     | m2/s, cm2/s
mm       | mm       |                                                             | m, um
um       | µm       |                                                             | m, mm, nm
um2      | µm²      |                                                             | m2, mm2, nm2
per_um2  | 1/µm²    |                                                             | 1/m2, 1/mm2, 1/nm2
kg_m3    | kg/m³    |                                                             | g/cm3
per_K    | 1/K      |                                                             | %/K
W_mK     | W/(m K)  |                                                             | mW/(m.K)
J_kgK    | J/(kg K) |                                                             | kJ/(kg.K)
Pa_s     | Pa s
N_mm     | N/mm
W_mm     | W/mm
mm_s     | mm/s
rad_s    | rad/s
deg_s    | °/s
mNm      | mN m
degC     | °C
degF     | °F
F        | °F
lbft     | lb ft
ftlb     | ft lb
L_min    | L/min
W_K      | W/K
um_m     | µm/m
um_N     | µm/N
N_um     | N/µm
Hz       | Hz
"""
_AS_WRITTEN = ("lbf", "kgf", "kg", "g", "psi", "kPa", "bar", "atm", "kN", "kW", "min", "K", "km", "h")
"""Header suffixes identical to the unit."""
UNSURE: dict[str, dict[str, tuple[str, ...]]] = {"rpm": {"1/s": ("rev/s", "rad/s")}}
"""Ambiguous spellings by the unit of a column, with their possible units."""
SIGNS = str.maketrans({**dict.fromkeys("µμ", "u"), **dict.fromkeys("·⋅*", "."), **dict.fromkeys("⁻−", "-")})
SIGNS |= str.maketrans({"°": "deg", "¹": "1", "²": "2", "³": "3", "^": ""})
"""Characters in spellings of units and their form in the table."""


@cache
def measure(unit: str) -> tuple[Fraction, Powers]:
    """Size of a unit in SI and its powers of kilogram, metre, second and kelvin; KeyError if unknown.

    >>> measure("mW/(m K)"), measure("1/GPa")
    ((Fraction(1, 1000), (1, 1, -3, -1)), (Fraction(1, 1000000000), (-1, 1, 2, 0)))
    """
    size, powers = Fraction(1), [0, 0, 0, 0]
    over, _, under = unit.replace("^", "").replace(".", " ").partition("/")
    for side, sign in ((over, 1), (under.strip("()"), -1)):
        for word in side.split():
            name, power = re.fullmatch(r"(1|\D+)(\d*)", word).groups()  # type: ignore[union-attr]
            one, own = _named(name)
            size *= one ** (sign * int(power or 1))
            powers = [p + sign * int(power or 1) * q for p, q in zip(powers, own, strict=True)]
    return size, (powers[0], powers[1], powers[2], powers[3])


def _named(name: str) -> tuple[Fraction, Powers]:
    if name in BASES:
        return Fraction(1), BASES[name]
    if name in NAMED:
        times, unit = NAMED[name]
        size, powers = measure(unit)
        return Fraction(times) * size, powers
    if len(name) < 2:
        raise KeyError(name)
    size, powers = measure(name[1:])
    return Fraction(10) ** PREFIXES[name[0]] * size, powers


def dimension(unit: str) -> Powers:
    """Powers of kilogram, metre, second and kelvin of a unit such as ``W/(m K)``.

    >>> dimension("Pa s"), dimension("1/m^2"), dimension("W/(m K)")
    ((1, -1, -1, 0), (0, -2, 0, 0), (1, 1, -3, -1))
    """
    return measure(unit)[1]


def change(unit: str, wanted: str) -> tuple[float, float]:
    """Factor and offset between units of the same dimension.

    >>> change("kPa", "MPa"), change("K", "degC"), change("um2", "mm2")
    ((0.001, 0.0), (1.0, -273.15), (1e-06, 0.0))
    """
    (size, powers), (own, others) = measure(unit), measure(wanted)
    assert powers == others, (unit, wanted)
    added = (ZEROS.get(unit, Fraction(0)) - ZEROS.get(wanted, Fraction(0))) / own
    return float(size / own), float(added)


def tidy(unit: str) -> str:
    """Unit in the spelling of the table.

    >>> tidy("µm"), tidy("°C"), tidy("N·m"), tidy("N m"), tidy("Pa s"), tidy("ft-lb")
    ('um', 'degC', 'N.m', 'N.m', 'Pa.s', 'ft.lb')
    >>> tidy("min⁻¹"), tidy("rad s^-1"), tidy("° / s"), tidy("mm².s⁻¹")
    ('1/min', 'rad/s', 'deg/s', 'mm2/s')
    """
    plain = re.sub(r"\s*/\s*", "/", unit.strip().translate(SIGNS))
    plain = re.sub(r"(?<=[a-z])-(?=[a-z])|\s+", ".", plain)
    return re.sub(r"(?:(.+)\.)?(s|min|h)-1", lambda found: f"{found[1] or 1}/{found[2]}", plain)


Changes = dict[str, tuple[float, float]]
"""Factor and offset to a unit, by the spelling of the source unit."""


def _read() -> tuple[dict[str, str], dict[str, Changes], dict[str, Changes]]:
    shown: dict[str, str] = {ending: ending for ending in _AS_WRITTEN}
    read: dict[str, Changes] = {}
    slips: dict[str, Changes] = {}
    for row in _TABLE.splitlines():
        if not row or row.startswith("#"):
            continue
        ending, unit, *cells = (cell.strip() for cell in row.split("|"))
        shown[ending] = unit
        for table, cell in zip((read, slips), cells):
            units = (written.partition("=") for written in filter(None, cell.split(", ")))
            found = {written: change(meant or written, tidy(unit) or "1") for written, _, meant in units}
            if found:
                table[ending] = found
    longest_first = sorted(filter(shown.get, shown), key=len, reverse=True)
    return {ending: shown[ending] for ending in longest_first}, read, slips


ENDINGS, UNITS, SLIPS = _read()
"""By name suffix, longer suffixes first: displayed unit; accepted units (``ratio``: dimensionless); probable units of
numbers outside their range."""


_STATED: ContextVar[Mapping[str, str]] = ContextVar("stated_units", default=MappingProxyType({}))


@contextmanager
def stated_units(units: Mapping[str, str]) -> Iterator[None]:
    """Units of columns without a unit in their name, stated by a case, within a block.

    >>> with stated_units({"preload": "N"}):
    ...     unit_of("preload")
    'N'
    """
    before = _STATED.set(units)
    try:
        yield
    finally:
        _STATED.reset(before)


def unit_of(name: str) -> str:
    """Unit at the end of a name, else as stated by the case at hand, or empty.

    >>> unit_of("oil_temperature_C"), unit_of("kinematic_viscosity_mm2_s"), unit_of("m4_per_um2"), unit_of("teeth")
    ('°C', 'mm²/s', '1/µm²', '')
    """
    return ENDINGS.get(ending_of(name)) or _STATED.get().get(name, "")


def without_unit(name: str) -> str:
    """Name without its unit suffix.

    >>> without_unit("oil_temperature_C"), without_unit("teeth")
    ('oil_temperature', 'teeth')
    """
    return name.removesuffix(f"_{ending_of(name)}")


def ending_of(name: str) -> str:
    """Unit suffix of a name, or empty."""
    return next((ending for ending in ENDINGS if name.endswith(f"_{ending}")), "")


def read_as(column: str) -> str:
    """Row of UNITS for the numbers of a column."""
    return ending_of(column) or "ratio"


def split(header: str) -> tuple[str, str | None]:
    """Words and unit (or None) of a header such as ``Rolling Speed (mm/s)``.

    >>> split("Rolling Speed (mm/s)"), split("temperature_degC"), split("Load")
    (('rolling speed', 'mm/s'), ('temperature', '°C'), ('load', None))
    >>> split("Dynamic viscosity [kg/(m s)]"), split("viscosity_m2_s")
    (('dynamic viscosity', 'kg/(m s)'), ('viscosity', 'm2/s'))
    """
    found = re.fullmatch(r"\s*(.*?)\s*[(\[]\s*((?:[^()\[\]]|/\s*\([^()\[\]]*\))*?)\s*[)\]]\s*", header)
    plain = header.strip()
    words, unit = (found.group(1), found.group(2)) if found else _of_name(plain)
    return re.sub(r"[\s_]+", " ", words).strip().lower(), unit or None


def _of_name(name: str) -> tuple[str, str | None]:
    """Words and unit of a name with underscores; quotients of units need no separate row in the table.

    >>> _of_name("speed_um_s"), _of_name("speed_m_s"), _of_name("shear_rate_1_s"), _of_name("time_s")
    (('speed', 'um/s'), ('speed', 'm/s'), ('shear_rate', '1/s'), ('time', 's'))
    """
    *words, over, under = ["", "", *name.rsplit("_", 2)]
    if words[-1] and "_" not in ending_of(name) and is_unit(f"{over}/{under}"):
        return words[-1], f"{over}/{under}"
    return without_unit(name), unit_of(name) or None


def words_of(header: str) -> str:
    """Words of a header without unit, channel name before a dot, and trailing dot.

    >>> words_of("DAQ.COF ()"), words_of("Test Time (s)"), words_of("friction coeff.")
    ('cof', 'test time', 'friction coeff')
    """
    return re.sub(r"^[a-z]+\.(?=\S)", "", split(header)[0]).rstrip(".")


def change_to(unit: str, wanted: str) -> tuple[float, float] | None:
    """Factor and offset from a written unit to a unit of UNITS; None if unknown.

    Case is ignored unless it distinguishes milli from mega or two of the units, or the unit is a single letter.

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
"""Accepted spellings by the unit of a column, with and without the dot of a product."""


def to_si(unit: str) -> tuple[float, float]:
    """Factor and offset from a written unit to SI; KeyError if unknown.

    >>> [tuple(round(x, 6) for x in to_si(unit)) for unit in ("N mm", "Nm", "°C", "W/(m K)")]
    [(0.001, 0.0), (1.0, 0.0), (1.0, 273.15), (1.0, 0.0)]
    """
    written = tidy(unit)
    try:
        return float(measure(written)[0]), float(ZEROS.get(written, 0))
    except (KeyError, AttributeError):
        wanted = next((wanted for wanted, forms in FORMS.items() if written in forms), None)
    if wanted is None:
        raise KeyError(unit)
    (factor, added), (size, zero) = FORMS[wanted][written], to_si(ENDINGS[wanted] or "1")
    return factor * size, added * size + zero


def open_units(unit: str, wanted: str) -> tuple[str, ...]:
    """Possible units of an ambiguous spelling; empty if unambiguous.

    >>> open_units("s⁻¹", "rpm"), open_units("1/min", "rpm")
    (('rev/s', 'rad/s'), ())
    """
    return UNSURE.get(wanted, {}).get(tidy(unit), ())


def fits(unit: str, wanted: str) -> bool:
    """Whether a text may be a unit of a column."""
    return change_to(unit, wanted) is not None or bool(open_units(unit, wanted))


def units_of(wanted: str) -> tuple[str, ...]:
    """Units accepted for a column, each in one spelling.

    >>> units_of("rpm"), units_of("ratio")
    (('rpm', 'rad/s', 'deg/s', 'rev/s'), ('-', '%'))
    """
    known = UNITS[wanted]
    return tuple(unit for unit, change in known.items() if unit == next(u for u, c in known.items() if c == change))


def is_unit(text: str) -> bool:
    """Whether a text is a known unit."""
    return any(fits(text, wanted) for wanted in UNITS)


DIGITS = 15
"""Decimal digits that a double always represents."""


def rounded(values: np.ndarray, beside: float = 0.0) -> np.ndarray:
    """Values rounded to 15 significant digits, of the larger of each value and ``beside``, to which values were added.

    >>> rounded(np.array([0.1 + 0.2])).tolist(), rounded(np.array([3600.0 + 0.7 - 3600.0]), 3600.0).tolist()
    ([0.3], [0.7])
    """
    sizes = np.maximum(np.abs(values), beside)
    return np.array(
        [
            round(v, DIGITS - 1 - math.floor(math.log10(s))) if 0.0 < s < math.inf else v
            for v, s in zip(values.tolist(), sizes.tolist(), strict=True)
        ]
    )
