"""Central film thickness of a contact, as interferometry reads it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub import bodies, config
from mixedlub.calibration import Calibration
from mixedlub.chain import Chain
from mixedlub.effect import LogNormal, Normal, Parameter
from mixedlub.kinds import unknown_oil
from mixedlub.kinds.disc import COLUMNS, contact_inputs
from mixedlub.kinds.kind import Inputs, Kind, bookkeeping_inputs, column, programme, varies
from mixedlub.laws import contact, film, load
from mixedlub.laws.film import LINE_EXPONENT, LINE_LOAD_EXPONENT, POINT_EXPONENT, POINT_LOAD_EXPONENT
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.table import Column, Table

FRINGE_NM = (167.0, 225.0)
"""One interference order, wavelength/(2 n): visible light of 500 to 620 nm, refractive index 1.38 to 1.5."""
MOST_SCATTER = 45.0
"""How far (nm) the noise of a reading may take it from a whole order and leave it one."""

KNOWN_OIL, UNNAMED_OIL = (0.015, 0.10, 0.006), (0.035, 0.25, 0.0125)
"""Spreads of the exponents of speed and of load as shares of them, and of the rise of the first with ln load.

By the first spreads the regressions for point contacts differ, 0.67 and -0.067 from 0.68 and -0.073. Over oils and
rigs in use nineteen solutions of twenty lie from 0.65 to 0.72 and from -0.11 to -0.04, and rise by up to 0.014.
"""
TIME = Column("time_s", required=False)
FRINGE_ORDER = Column("fringe_order", at_least=0.0, required=False)


def reading(film_thickness: np.ndarray) -> np.ndarray:
    """The rig reads the central film thickness (m).

    >>> float(reading(2e-7))
    2e-07
    """
    return film_thickness


def inputs(system: config.System, folder: Path, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table."""
    assert system.contact is not None
    temperature = column(table["oil_temperature_C"]) + ZERO_CELSIUS
    return {
        **contact_inputs(system.contact, table),
        **bodies.lubricant(system.lubricant).inputs(temperature),
        **bookkeeping_inputs(system, table),
        **programme(table, recorded),
        **_orders(table, recorded),
        **_middle(system, recorded),
        "oil_temperature": temperature,
    }


def _middle(system: config.System, recorded: Table) -> Inputs:
    """The exponents of the regression, and where in the recording others would turn the film about."""
    oil = bodies.lubricant(system.lubricant).inputs(column(recorded["oil_temperature_C"]) + ZERO_CELSIUS)
    flow = oil["viscosity"] * column(recorded["entrainment_speed_m_s"])
    unchanged = dict.fromkeys(("speed_exponent_change", "load_exponent_change", "exponents_cross"), 0.0)
    return {
        **unchanged,
        "middle_flow": float(np.exp(np.mean(np.log(flow)))),
        "middle_load": float(np.exp(np.mean(np.log(recorded["load_N"])))),
    }


def _orders(table: Table, recorded: Table) -> Inputs:
    """Interference orders, where the recording changes them; rows without one read as the lowest does."""
    if "fringe_order" not in recorded or np.ptp(recorded["fringe_order"]) == 0:
        return {}
    first = float(np.min(recorded["fringe_order"]))
    orders = table["fringe_order"] if "fringe_order" in table else np.full(len(table), first)
    return {"fringe_order": column(orders), "first_fringe_order": first}


def extra_calibration(system: config.System, recorded: Table) -> tuple[Calibration, ...]:
    """An unnamed oil takes broad priors; exponents of the film law are known as well as film laws agree on them."""
    oil = unknown_oil.calibrations(system, recorded["oil_temperature_C"] + ZERO_CELSIUS)
    return (*oil, *_exponents(system, recorded["load_N"]))


def _exponents(system: config.System, load: np.ndarray) -> Iterator[Calibration]:
    """What another film law would have: the exponent of speed, and those of load where it varies."""
    line, named = _is_line(system), not unknown_oil.missing(system)
    of_speed, of_load, cross = KNOWN_OIL if named else UNNAMED_OIL
    speed, loaded = (LINE_EXPONENT, LINE_LOAD_EXPONENT) if line else (POINT_EXPONENT, POINT_LOAD_EXPONENT)

    def change(name: str, nominal: float) -> Callable[[Mapping[str, Any], float], dict[str, Any]]:
        return lambda inputs, value: {name: nominal * (value - 1.0)}

    exponent = Parameter("film_exponent", "-", LogNormal(1.0, of_speed), "factor on the film's exponent of speed")
    yield Calibration(exponent, change("speed_exponent_change", speed), 1.0, ("speed_exponent_change",))
    if not varies(load):
        return
    exponent = Parameter("film_load_exponent", "-", LogNormal(1.0, of_load), "factor on the film's exponent of load")
    yield Calibration(exponent, change("load_exponent_change", loaded), 1.0, ("load_exponent_change",))
    rise = Parameter("film_cross_exponent", "-", Normal(0.0, cross), "rise of the exponent of speed with ln load")
    yield Calibration(rise, lambda inputs, value: {"exponents_cross": value}, 0.0, ("exponents_cross",))


def _is_line(system: config.System) -> bool:
    return system.contact is not None and system.contact.geometry == "line"


def chain(system: config.System, table: Table) -> Chain:
    """Hamrock-Dowson for a ball, Dowson-Toyoda for a roller."""
    if _is_line(system):
        contact_laws: Chain = (
            ("line_load", load.disc_line_load),
            ("hertz_pressure", contact.line_hertz_pressure),
            ("hertz_half_width", contact.line_hertz_half_width),
            ("regression_film", film.dowson_toyoda),
        )
    else:
        contact_laws = (
            ("hertz_pressure", contact.point_hertz_pressure),
            ("hertz_half_width", contact.point_hertz_half_width),
            ("regression_film", film.hamrock_dowson),
        )
    return (
        ("slide_roll_ratio", load.slide_roll_ratio),
        *contact_laws,
        ("film_thickness", film.with_other_exponents),
        ("reading", reading),
    )


def reading_fault(recorded: Table, row: int, excess: float, sd: float) -> str | None:
    """A reading that is off by one or two interference orders was miscounted, whatever the oil does.

    One below zero is no film, and nothing that an order explains.
    """
    if recorded["film_thickness_nm"][row] < 0.0:
        return None
    scatter = min(2.0 * sd, MOST_SCATTER)
    for orders in (1, 2):
        if orders * FRINGE_NM[0] - scatter <= abs(excess) <= orders * FRINGE_NM[1] + scatter:
            count = "one interference order" if orders == 1 else "two interference orders"
            side = "above" if excess > 0 else "below"
            return (
                f"{abs(excess):.0f} nm {side} what the other readings say: {count} (wavelength/2n, "
                f"{FRINGE_NM[0]:.0f} to {FRINGE_NM[1]:.0f} nm each) miscounted by the instrument"
            )
    if "fringe_order" in recorded and row > 0 and recorded["fringe_order"][row] != recorded["fringe_order"][row - 1]:
        return "off where the instrument changes its interference order: a change of order, not of the film"
    return None


KIND = Kind(
    name="film",
    quantities=("film_thickness_nm",),
    columns=(*COLUMNS, TIME),
    channels=(FRINGE_ORDER,),
    sections=("contact",),
    chain=chain,
    inputs=inputs,
    extra_calibration=extra_calibration,
    reading_fault=reading_fault,
)
