"""Central film thickness of a contact, as interferometry reads it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub import bodies, config
from mixedlub.calibration import Calibration
from mixedlub.chain import Chain
from mixedlub.effect import LogNormal, Parameter
from mixedlub.kinds import unknown_oil
from mixedlub.kinds.disc import COLUMNS, contact_inputs
from mixedlub.kinds.kind import Inputs, Kind, bookkeeping_inputs, column, programme
from mixedlub.laws import contact, film, load
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.table import Column, Table

FRINGE_NM = (167.0, 225.0)
"""One interference order, wavelength/(2 n): visible light of 500 to 620 nm, refractive index 1.38 to 1.5."""
MOST_SCATTER = 45.0
"""How far (nm) the noise of a reading may take it from a whole order and leave it one."""

KNOWN_OIL, UNNAMED_OIL = 0.015, 0.035
"""Spread of the exponent of speed. By the first the regressions for point contacts differ, 0.67 and 0.68; over oils
and rigs in use nineteen solutions of twenty lie from 0.65 to 0.72, twice the second on the far side."""

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
    """The exponent of the regression, and where in the recording another one would turn the film about."""
    oil = bodies.lubricant(system.lubricant).inputs(column(recorded["oil_temperature_C"]) + ZERO_CELSIUS)
    flow = np.log(oil["viscosity"] * column(recorded["entrainment_speed_m_s"]))
    return {"exponent_change": 0.0, "middle_flow": float(np.exp(np.mean(flow)))}


def _orders(table: Table, recorded: Table) -> Inputs:
    """Interference orders, where the recording changes them; rows without one read as the lowest does."""
    if "fringe_order" not in recorded or np.ptp(recorded["fringe_order"]) == 0:
        return {}
    first = float(np.min(recorded["fringe_order"]))
    orders = table["fringe_order"] if "fringe_order" in table else np.full(len(table), first)
    return {"fringe_order": column(orders), "first_fringe_order": first}


def extra_calibration(system: config.System, recorded: Table) -> tuple[Calibration, ...]:
    """An unnamed oil takes broad priors; the exponent of speed is known as well as film laws agree on it."""
    usual = film.LINE_EXPONENT if _is_line(system) else film.POINT_EXPONENT
    spread = UNNAMED_OIL if unknown_oil.missing(system) else KNOWN_OIL
    exponent = Parameter("film_exponent", "-", LogNormal(1.0, spread), "factor on the exponent of speed")

    def apply(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        return {"exponent_change": usual * (value - 1.0)}

    oil = unknown_oil.calibrations(system, recorded["oil_temperature_C"] + ZERO_CELSIUS)
    return (*oil, Calibration(exponent, apply, 1.0, ("exponent_change",)))


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
        ("film_thickness", film.with_other_exponent),
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
