"""Central film thickness of a contact, as interferometry reads it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mixedlub import bodies, config
from mixedlub.calibration import Calibration
from mixedlub.chain import Chain
from mixedlub.kinds import unknown_oil
from mixedlub.kinds.disc import COLUMNS, contact_inputs
from mixedlub.kinds.kind import Inputs, Kind, bookkeeping_inputs, column, programme
from mixedlub.laws import contact, film, load
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.table import Column, Table

FRINGE_NM = (167.0, 225.0)
"""One interference order, wavelength/(2 n): visible light of 500 to 620 nm, refractive index 1.38 to 1.5."""

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
        "oil_temperature": temperature,
    }


def _orders(table: Table, recorded: Table) -> Inputs:
    """Interference orders, where the recording changes them; rows without one read as the lowest does."""
    if "fringe_order" not in recorded or np.ptp(recorded["fringe_order"]) == 0:
        return {}
    first = float(np.min(recorded["fringe_order"]))
    orders = table["fringe_order"] if "fringe_order" in table else np.full(len(table), first)
    return {"fringe_order": column(orders), "first_fringe_order": first}


def extra_calibration(system: config.System, recorded: Table) -> tuple[Calibration, ...]:
    """An unnamed oil takes broad priors."""
    return unknown_oil.calibrations(system, recorded["oil_temperature_C"] + ZERO_CELSIUS)


def chain(system: config.System, table: Table) -> Chain:
    """Hamrock-Dowson for a ball, Dowson-Toyoda for a roller."""
    if system.contact is not None and system.contact.geometry == "line":
        contact_laws: Chain = (
            ("line_load", load.disc_line_load),
            ("hertz_pressure", contact.line_hertz_pressure),
            ("hertz_half_width", contact.line_hertz_half_width),
            ("film_thickness", film.dowson_toyoda),
        )
    else:
        contact_laws = (
            ("hertz_pressure", contact.point_hertz_pressure),
            ("hertz_half_width", contact.point_hertz_half_width),
            ("film_thickness", film.hamrock_dowson),
        )
    return (("slide_roll_ratio", load.slide_roll_ratio), *contact_laws, ("reading", reading))


def reading_fault(recorded: Table, row: int, excess: float) -> str | None:
    """A reading that is off by one or two interference orders was miscounted, whatever the oil does.

    One below zero is no film, and nothing that an order explains.
    """
    if recorded["film_thickness_nm"][row] < 0.0:
        return None
    for orders in (1, 2):
        if orders * FRINGE_NM[0] <= abs(excess) <= orders * FRINGE_NM[1]:
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
