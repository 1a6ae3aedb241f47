"""Doubts about an oil: data-sheet temperatures in Fahrenheit, and viscosities untypical of lubricants."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator

import numpy as np

from mixedlub.laws.oil import ZERO_CELSIUS, modulus_rise
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema.findings import Finding, finding

IN_USE = (40.0 + ZERO_CELSIUS, 150.0 + ZERO_CELSIUS)
"""Judgement. Temperatures (K) of an oil in use: from the first of a data sheet to hot flanks."""
LARGEST_PRESSURE = 2e9
"""Judgement. Largest Hertz pressure (Pa) of gears and of viscosity laws in use."""
FAHRENHEIT = ((100.0, 104.0), (210.0, 212.0))
"""Definition. Data-sheet temperatures in degrees Fahrenheit: 100 and 210 in old sheets, 40 and 100 °C in new sheets."""
KINEMATIC = (0.21e-6, 0.1)
"""Judgement. Kinematic viscosities (m^2/s): ASTM D341 ends at 0.21 mm^2/s; the thickest lubricants, polybutenes, have
some 1e4 mm^2/s at 40 °C; ten times more is another substance or unit."""
REFERENCE_PRESSURE, MOST_RISE = 1e9, 1e8
"""Judgement. Rise of the viscosity to 1 GPa at 40 °C: 1e3 to 1e7 in lubricating oils, up to 9e7 by Roelands and Gold in
mineral oils to ISO VG 3200; with a larger rise an oil solidifies before."""
Log = Callable[[np.ndarray, np.ndarray], np.ndarray]


def doubts(oil: Lubricant, unread: Collection[str] = ()) -> Iterator[Finding]:
    """Findings on an oil, with its name; ``unread`` keys of its section are not judged."""
    celsius = [t - ZERO_CELSIUS for t in oil.temperature]
    if all(min(abs(t - f) for f in sheet) < 0.3 for t, sheet in zip(sorted(celsius), FAHRENHEIT, strict=True)):
        meant = " and ".join(f"{(t - 32.0) / 1.8:.3g}" for t in celsius)
        text = f"{celsius[0]:g} and {celsius[1]:g} °C of {oil.name} are {meant} °C in Fahrenheit: which unit is meant?"
        yield finding("oil_fahrenheit", text, "lubricant.temperature_C")
    ends = np.array(IN_USE)
    for kelvin, nu in zip(ends, oil.viscosity(ends) / oil.density(ends)):
        if not KINEMATIC[0] <= nu <= KINEMATIC[1]:
            text = (
                f"{oil.name} has {nu * 1e6:.3g} mm2/s at {kelvin - ZERO_CELSIUS:g} °C, where lubricants have "
                f"{KINEMATIC[0] * 1e6:g} to {KINEMATIC[1] * 1e6:g}"
            )
            yield finding("oil_viscosity_implausible", text, "lubricant.kinematic_viscosity_mm2_s")
    if "pressure_viscosity_per_GPa" not in unread:
        yield from _of_coefficient(oil)


def _of_coefficient(oil: Lubricant) -> Iterator[Finding]:
    """Findings on the viscosity under pressure."""
    place = "lubricant.pressure_viscosity_per_GPa"
    (cold, low), (hot, high) = sorted(zip(oil.temperature, oil.pressure_viscosity, strict=True))
    if high > low:
        text = (
            f"pressure-viscosity coefficient of {oil.name} rises from {low * 1e9:.3g} at {cold - ZERO_CELSIUS:g} °C to "
            f"{high * 1e9:.3g} 1/GPa at {hot - ZERO_CELSIUS:g} °C; in lubricating oils it falls: is the order right?"
        )
        yield finding("oil_coefficient_rises", text, place)
    yield from under_pressure(oil.name, oil.log_under_pressure, "Roelands' law", place)
    if oil.pressure_modulus is not None:
        yield from under_pressure(oil.name, _by_modulus(oil), "the modulus equation", "lubricant.pressure_modulus_MPa")


def _by_modulus(oil: Lubricant) -> Log:
    """Logarithm of the viscosity by the modulus equation, for an oil with its constants."""

    def log(pressure: np.ndarray, temperature: np.ndarray) -> np.ndarray:
        known = oil.inputs(temperature)
        rise = modulus_rise(np.asarray(known["pressure_modulus"]), np.asarray(known["modulus_slope"]), pressure)
        return np.asarray(np.log(known["viscosity"]) + rise)

    return log


def under_pressure(
    name: str,
    log: Log,
    law: str,
    place: str,
    temperatures: tuple[float, float] = IN_USE,
    largest_pressure: float = LARGEST_PRESSURE,
) -> Iterator[Finding]:
    """Findings on ln viscosity as a function of pressure (Pa) and temperature (K) in its range of use."""
    kelvin, pressure = np.linspace(*temperatures, 45), np.linspace(0.0, largest_pressure, 21)[1:]
    with np.errstate(all="ignore"):
        values = log(pressure[:, None], kelvin)
        reference = min(REFERENCE_PRESSURE, largest_pressure), float(np.clip(IN_USE[0], *temperatures))
        ambient, usual = (float(log(np.array(p), np.array(reference[1]))) for p in (0.0, reference[0]))
    rising = np.argwhere(np.diff(values, axis=1) > 0.0)
    if len(rising):
        (at, first), last = rising[0], rising[:, 1].max()
        text = (
            f"viscosity of {name} under pressure rises with temperature by {law}, as from "
            f"{kelvin[first] - ZERO_CELSIUS:.0f} to {kelvin[last + 1] - ZERO_CELSIUS:.0f} °C above "
            f"{pressure[at] * 1e-9:.2g} GPa: the pressure-viscosity coefficient falls too little"
        )
        yield finding("oil_thickens", text, place)
    if usual - ambient > np.log(MOST_RISE):
        text = (
            f"{name} has {np.exp(usual):.2g} Pa s at {reference[0] * 1e-9:g} GPa and "
            f"{reference[1] - ZERO_CELSIUS:g} °C by {law}, {np.exp(usual - ambient):.2g} times the ambient one; "
            f"lubricating oils become solid before {MOST_RISE:.0e} times"
        )
        yield finding("oil_viscosity_implausible", text, place)
