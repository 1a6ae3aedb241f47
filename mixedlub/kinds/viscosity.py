"""Viscosity of a sample against temperature and pressure."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.model import Chain
from mixedlub.kinds import columns, oil_priors
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.kind import Inputs, Kind, bookkeeping_inputs, column, programme
from mixedlub.kinds.standard import OIL, StandardRig
from mixedlub.laws import oil
from mixedlub.rig import build
from mixedlub.rig.lubricant import Lubricant
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.table import Column, Table

AMBIENT_MPA = 0.101325
"""Definition. Standard atmosphere."""
NEAR_AMBIENT_MPA = 50.0
"""Judgement. Pressure up to which a reading shows the viscosity at ambient pressure: the exponent is then still
small."""
UNREAD = ("eyring_stress_MPa", "thermal_conductivity_W_mK", "specific_heat_J_kgK")
"""Properties of an oil that do not affect its viscosity."""

COLUMNS = (
    Column(
        "temperature_C",
        at_least=-100.0,
        at_most=400.0,
        meaning="temperature of the sample",
        words=("temperature", "temp"),
    ),
    Column(
        "pressure_MPa",
        at_least=0.0,
        at_most=5000.0,
        required=False,
        meaning="pressure on the sample; ambient where there is no such column",
        words=("pressure",),
    ),
    columns.TIME,
)
VISCOSITY = Column("viscosity_mPa_s", above=0.0, meaning="dynamic viscosity", words=("viscosity", "dynamic viscosity"))


def reading(contact_viscosity: np.ndarray) -> np.ndarray:
    """The rig reads the viscosity of the sample (Pa s).

    >>> float(reading(0.05))
    0.05
    """
    return contact_viscosity


def under_pressure(viscosity: np.ndarray, pressure_viscosity: np.ndarray, hertz_pressure: np.ndarray) -> np.ndarray:
    """Viscosity at the applied pressure (Pa s) by Barus' law, the base model.

    >>> round(float(under_pressure(0.01, 20e-9, 0.1e9)), 5)
    0.07389
    """
    return oil.barus_viscosity(viscosity, pressure_viscosity, hertz_pressure)


def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table; rows without pressure were measured at ambient pressure."""
    temperature = column(table["temperature_C"]) + oil.ZERO_CELSIUS
    return {
        **_oil(system, rig, recorded).inputs(temperature),
        **bookkeeping_inputs(system, table),
        **programme(table, recorded),
        "oil_temperature": temperature,
        "hertz_pressure": column(_pressure(table)),
    }


def _oil(system: system_file.System, rig: Rig, recorded: Table) -> Lubricant:
    """The oil; an unknown viscosity level is estimated from the readings."""
    kelvin = recorded["temperature_C"] + oil.ZERO_CELSIUS
    return oil_priors.moved(rig.oil(), oil_priors.pivot_of(kelvin), _level(system, recorded))


def _pressure(table: Table) -> np.ndarray:
    return 1e6 * (table["pressure_MPa"] if "pressure_MPa" in table else np.full(len(table), AMBIENT_MPA))


def _level(system: system_file.System, recorded: Table) -> float:
    """Factor on an assumed viscosity, estimated from readings near ambient pressure."""
    if "viscosity" not in oil_priors.missing(system):
        return 1.0
    near = _pressure(recorded) <= max(NEAR_AMBIENT_MPA * 1e6, float(_pressure(recorded).min()))
    rows = recorded.take(near)
    guess = build.lubricant(system.lubricant, UNREAD).viscosity(rows["temperature_C"] + oil.ZERO_CELSIUS)
    return oil_priors.level_of(rows, "viscosity_mPa_s", guess * 1e3)


def extra_calibration(system: system_file.System, recorded: Table) -> tuple[Calibration, ...]:
    """Broad priors for an unspecified oil: level and slope against temperature and against pressure."""
    kelvin = recorded["temperature_C"] + oil.ZERO_CELSIUS
    pressurised = float(np.ptp(_pressure(recorded))) > 0
    return tuple(
        c
        for c in oil_priors.calibrations(system, kelvin, level=_level(system, recorded))
        if pressurised or not c.name.startswith("pressure")
    )


def chain(system: system_file.System, table: Table) -> Chain:
    """The chain: ASTM D341 for temperature (in the inputs), Barus for pressure."""
    return (("contact_viscosity", under_pressure), ("reading", reading))


STANDARD = StandardRig(
    sections={"lubricant": OIL},
    noise=0.02,
    conditions={
        "oil_temperature": ("temperature_C", (20.0, 40.0, 70.0, 100.0)),
        "pressure": ("pressure_MPa", (0.1, 100.0, 300.0, 600.0, 1000.0)),
    },
)

KIND = Kind(
    name="viscosity",
    subject="oil",
    readings=(VISCOSITY,),
    columns=COLUMNS,
    sections=(),
    uses=("lubricant",),
    base_model="ASTM D341 over temperature, Barus over pressure.",
    chain=chain,
    inputs=inputs,
    extra_calibration=extra_calibration,
    logarithmic=True,
    scale=1e3,
    is_logged=True,
    unread_of_oil=UNREAD,
    standard=STANDARD,
)
