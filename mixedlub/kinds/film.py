"""Central film thickness of a contact, as interferometry reads it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mixedlub.chain.effect import Parameter
from mixedlub.chain.model import Chain
from mixedlub.chain.priors import LogNormal, Normal
from mixedlub.kinds import columns, oil_priors
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.disc import COLUMNS, contact_inputs
from mixedlub.kinds.kind import Inputs, Kind, bookkeeping_inputs, column, programme, varies
from mixedlub.kinds.standard import OIL, StandardRig
from mixedlub.laws import contact, film, load
from mixedlub.laws.film import DOWSON_TOYODA, POINT_EXPONENT
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.lubricant import Lubricant
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.table import Column, Table

FRINGE_NM = (167.0, 225.0)
"""Definition. One interference order, wavelength/(2 n): visible light of 500 to 620 nm, refractive index 1.38 to
1.5."""
MOST_SCATTER = 30.0
"""Judgement. Largest deviation (nm) of a reading from a whole order that noise may cause."""

EXPONENT_SPREAD, LINE_EXPONENT_SPREAD, LINE_LOAD_SPREAD = 0.015, 0.03, 0.3
"""Judgement. Relative standard deviations of the film law's exponents: regressions have 0.67 and 0.68 (balls) or 0.67
to 0.71 (rollers) for speed, and -0.10 to -0.17 for load."""
KNOWN_OIL, UNNAMED_OIL = 0.5, 1.0
"""Judgement. Prior for the film of a ball between the regression and the formula for all regimes."""

FRINGE_ORDER = Column(
    "fringe_order",
    at_least=0.0,
    required=False,
    meaning="interference order that the instrument counted",
    words=("order", "fringe order"),
)
FILM_THICKNESS = Column(
    "film_thickness_nm",
    meaning="central film thickness",
    words=("average film", "film thickness", "film", "central film thickness"),
)


def reading(film_thickness: np.ndarray) -> np.ndarray:
    """The rig reads the central film thickness (m).

    >>> float(reading(2e-7))
    2e-07
    """
    return film_thickness


def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table."""
    assert system.contact is not None
    temperature = column(table["oil_temperature_C"]) + ZERO_CELSIUS
    oil = rig.oil()
    return {
        **contact_inputs(system.contact, table),
        **oil.inputs(temperature),
        **bookkeeping_inputs(system, table),
        **programme(table, recorded),
        **orders(table, recorded),
        **_middle(oil, recorded),
        "oil_temperature": temperature,
    }


def _middle(oil: Lubricant, recorded: Table) -> Inputs:
    """Inputs for other exponents of the film law, which pivot about the middle of the recording."""
    flow = oil.viscosity(column(recorded["oil_temperature_C"]) + ZERO_CELSIUS) * column(
        recorded["entrainment_speed_m_s"]
    )
    return {
        **dict.fromkeys(("film_regime", "speed_exponent_change", "load_exponent_change"), 0.0),
        "middle_flow": float(np.exp(np.mean(np.log(flow)))),
        "middle_load": float(np.exp(np.mean(np.log(recorded["load_N"])))),
    }


def orders(table: Table, recorded: Table) -> Inputs:
    """Interference orders, where they vary in the recording; rows without one have the lowest."""
    if "fringe_order" not in recorded or np.ptp(recorded["fringe_order"]) == 0:
        return {}
    first = float(np.min(recorded["fringe_order"]))
    orders = table["fringe_order"] if "fringe_order" in table else np.full(len(table), first)
    return {"fringe_order": column(orders), "first_fringe_order": first}


def extra_calibration(system: system_file.System, recorded: Table) -> tuple[Calibration, ...]:
    """Broad priors for an unspecified oil; the film law is as uncertain as the differences of published laws."""
    oil = oil_priors.calibrations(system, recorded["oil_temperature_C"] + ZERO_CELSIUS)
    return (*oil, *(_of_line(recorded["load_N"]) if _is_line(system) else _of_ball(system)))


def _of_ball(system: system_file.System) -> Iterator[Calibration]:
    spread = UNNAMED_OIL if oil_priors.missing(system) else KNOWN_OIL
    meaning = "film law: 0 Hamrock and Dowson, 1 Nijenbanning and others; between them a film between both"
    regime = Parameter("film_regime", "-", Normal(0.0, spread), meaning)
    yield Calibration(regime, lambda inputs, value: {"film_regime": value}, 0.0, ("film_regime",))
    yield _exponent("film_exponent", "speed", POINT_EXPONENT, EXPONENT_SPREAD)


def _of_line(load: np.ndarray) -> Iterator[Calibration]:
    yield _exponent("film_exponent", "speed", DOWSON_TOYODA.speed, LINE_EXPONENT_SPREAD)
    if varies(load):
        yield _exponent("film_load_exponent", "load", DOWSON_TOYODA.load, LINE_LOAD_SPREAD)


def _exponent(name: str, of: str, nominal: float, spread: float) -> Calibration:
    parameter = Parameter(name, "-", LogNormal(1.0, spread), f"factor on the film's exponent of {of}")
    change = f"{of}_exponent_change"
    return Calibration(parameter, lambda inputs, value: {change: nominal * (value - 1.0)}, 1.0, (change,), factor=True)


def _is_line(system: system_file.System) -> bool:
    return system.contact is not None and system.contact.geometry == "line"


def chain(system: system_file.System, table: Table) -> Chain:
    """Hamrock-Dowson for a ball, Dowson-Toyoda for a roller."""
    if _is_line(system):
        contact_laws: Chain = (
            ("line_load", load.disc_line_load),
            ("hertz_pressure", contact.line_hertz_pressure),
            ("hertz_half_width", contact.line_hertz_half_width),
            ("moes_load", film.moes_load),
            ("isoviscous_ratio", film.isoviscous_ratio),
            ("law_film", film.dowson_toyoda),
        )
    else:
        contact_laws = (
            ("hertz_pressure", contact.point_hertz_pressure),
            ("hertz_half_width", contact.point_hertz_half_width),
            ("isoviscous_ratio", film.point_isoviscous_ratio),
            ("regression_film", film.hamrock_dowson),
            ("regime_film", film.nijenbanning),
            ("law_film", film.between_laws),
        )
    return (
        ("slide_roll_ratio", load.slide_roll_ratio),
        *contact_laws,
        ("film_thickness", film.with_other_exponents),
        ("reading", reading),
    )


def instrument_fault(recorded: Table, row: int, excess: float, sd: float) -> str | None:
    """Identify a reading that deviates by one or two interference orders as miscounted.

    A corrected film below zero is not explained by an order.
    """
    if recorded["film_thickness_nm"][row] < 0.0:
        return None
    scatter = min(2.0 * sd, MOST_SCATTER)
    for orders in (1, 2):
        off = max(orders * FRINGE_NM[0] - abs(excess), abs(excess) - orders * FRINGE_NM[1])
        if off <= scatter:
            count = "one interference order" if orders == 1 else "two interference orders"
            side = "above" if excess > 0 else "below"
            count += " within the noise of the reading" if off > 0.0 else ""
            return (
                f"{abs(excess):.0f} nm {side} what the other readings say: {count} (wavelength/2n, "
                f"{FRINGE_NM[0]:.0f} to {FRINGE_NM[1]:.0f} nm each) miscounted by the instrument"
            )
    if "fringe_order" in recorded and row > 0 and recorded["fringe_order"][row] != recorded["fringe_order"][row - 1]:
        return "off where the instrument changes its interference order: a change of order, not of the film"
    return None


ORDER_NM = 196.0
"""Definition. One interference order of the standard rig: green light in oil."""
STANDARD = StandardRig(
    sections={
        "contact": {
            "geometry": "point",
            "radius_mm": (9.525, float("inf")),
            "youngs_modulus_GPa": (206.0, 75.0),
            "poisson_ratio": (0.3, 0.22),
        },
        "lubricant": OIL,
    },
    noise=1.0,
    conditions={
        "load": ("load_N", (10.0, 20.0, 40.0)),
        "speed": ("entrainment_speed_m_s", (0.01, 0.03, 0.1, 0.3, 1.0, 3.0)),
        "slide_roll_ratio": ("slide_roll_ratio", (0.0, 0.1, 0.5)),
        "oil_temperature": ("oil_temperature_C", (40.0, 70.0, 100.0)),
    },
    channels=lambda columns, reading: {FRINGE_ORDER.name: np.floor(reading() / ORDER_NM)},
)
"""A ball on glass."""

KIND = Kind(
    name="film",
    subject="contact",
    readings=(FILM_THICKNESS,),
    columns=(*COLUMNS, columns.TIME),
    instrument_channels=(FRINGE_ORDER,),
    sections=("contact",),
    uses=("lubricant",),
    base_model=(
        "Hamrock-Dowson central film thickness of a point contact, Dowson-Toyoda of a line contact: fully "
        "flooded, smooth, isothermal, Newtonian."
    ),
    chain=chain,
    inputs=inputs,
    extra_calibration=extra_calibration,
    instrument_fault=instrument_fault,
    scale=1e9,
    asks_for_oil=True,
    standard=STANDARD,
)
