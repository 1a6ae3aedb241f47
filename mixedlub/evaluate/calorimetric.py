"""Load-dependent gear loss and mean friction of the mesh from the heat carried away by the oil."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pandas as pd
from pydantic import Field, model_validator

from mixedlub.evaluate.evaluation import CaseDraft, Curve, Evaluated, Evaluation, Panel, case_draft, check_surfaces
from mixedlub.evaluate.load_stages import LoadStages, Split, split_loss
from mixedlub.evaluate.outlying import check_lines
from mixedlub.evaluate.result_columns import CALORIMETRIC
from mixedlub.evaluate.uncertainty import Errors, combined, interval
from mixedlub.gear import GearPair, Sharing, local_loss_factor, mesh
from mixedlub.gear.build import gear_pair, sharing
from mixedlub.kinds import columns
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.recording.set_points import near_values
from mixedlub.rig.build import lubricant
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.result import curve
from mixedlub.schema.section import Number, Section, key
from mixedlub.schema.system_file import Gears, RigFile
from mixedlub.schema.table import RUN, Column, Table, read_table
from mixedlub.schema.toml_file import named_file
from profiles.errors import InputError

SOURCE = (
    '"Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s", '
    "equations 1, 3 and 8"
)
Share = Annotated[Number, Field(ge=0.0, lt=1.0)]
Size = Annotated[Number, Field(ge=0.0)]


class Meters(Section):
    flow_sd: Share = key("of the flow meter, relative; common to all readings", 0.005)
    flow_noise: Share = key("of the flow, relative; from reading to reading", 0.002)
    rise_sd_K: Size = key("of the rise from inlet to outlet; common to all readings", 0.1)
    rise_noise_K: Annotated[Number, Field(gt=0.0)] = key("of the rise; from reading to reading", 0.05)
    density_sd: Share = key("of the density of the oil, relative", 0.002)
    specific_heat_sd: Share = key("of the specific heat of the oil, relative", 0.01)
    torque_sd: Share = key("of the torque meter, relative; common to all readings", 0.002)


class Housing(Section):
    shaft_heat_share: Annotated[Number, Field(gt=-1.0, lt=1.0)] = key(
        "part of the oil's heat that came in through the shafts; below 0: that left through them", 0.0, example=0.065
    )
    shaft_heat_share_sd: Share = key("its standard deviation", 0.0, example=0.01)
    shaft_conductance_W_K: Size = key("heat through the shafts per kelvin from bearings to oil outlet", 0.0)
    shaft_conductance_sd: Share = key("its standard deviation, relative", 0.0)
    wall_conductance_W_K: Size = key("heat through the walls per kelvin from housing to ambient", 0.0)
    wall_conductance_sd: Share = key("its standard deviation, relative", 0.0)

    @model_validator(mode="after")
    def _one_way_of_shafts(self) -> Housing:
        if self.shaft_heat_share and self.shaft_conductance_W_K:
            raise ValueError("heat of the shafts is either a share or a conductance: shaft_conductance_W_K, not both")
        return self


class Friction(Section):
    loss_factor_sd: Share = key("of the loss factor of the local load, relative", 0.02)
    load_exponent_sd: Share = key("of the exponent by which friction changes with the load within a series", 0.03)


class CalorimetricFile(RigFile):
    """Input file of a rig with gears, oil and a calorimeter for the heat of the oil."""

    schema_: Literal["mixedlub-calorimetric/1"] = key(
        "format of the file", example="mixedlub-calorimetric/1", alias="schema"
    )
    title: str = key("title of the figures", "Calorimetric gear loss", example="High-speed gears B")
    readings: str = key("table of the readings, relative to this file", example="readings.csv")
    gears: Gears = key("the gear pair and its load sharing, from which the loss factor follows")
    lubricant: Lubricant = key("the oil: density and specific heat")
    meters: Meters = key("standard deviations of the meters and of the oil", Meters())
    housing: Housing = key("heat that does not come from the gears, or does not reach the oil", Housing())
    friction: Friction = key("what the split of the loss assumes", Friction())


COLUMNS = (
    RUN,
    Column("series", "name", required=False, meaning="load stages that share a load-independent loss"),
    Column("torque_Nm", at_least=0.0, meaning="torque on the pinion; 0: a stage without load"),
    columns.SPEED,
    Column("oil_flow_L_min", above=0.0, meaning="volume flow of the oil through the gear housing"),
    Column("oil_inlet_temperature_C", at_least=-60.0, at_most=300.0, meaning="temperature of the oil at the inlet"),
    Column("oil_outlet_temperature_C", at_least=-60.0, at_most=400.0, meaning="temperature of the oil at the outlet"),
    Column("bearing_temperature_C", at_least=-60.0, at_most=400.0, required=False, meaning="of the bearings"),
    Column("housing_temperature_C", at_least=-60.0, at_most=400.0, required=False, meaning="of the walls"),
    Column("ambient_temperature_C", at_least=-60.0, at_most=100.0, required=False, meaning="around the housing"),
    Column("pinion_surface", "name", required=False, meaning="a surface of the file, for the case"),
    Column("gear_surface", "name", required=False, meaning="a surface of the file, for the case"),
)


SURFACES = ("pinion_surface", "gear_surface")
MOST_TORQUES = 24
"""Cost limit. Torques with a load distribution; loss factors at other torques are interpolated."""


@dataclass(frozen=True, eq=False)
class Heat:
    """Heat balance of n readings (W): heat taken up by the oil, loss of the gears, and errors of the loss."""

    oil: np.ndarray
    loss: np.ndarray
    errors: Errors


def oil_heat(density: np.ndarray, specific_heat: float, flow: np.ndarray, rise: np.ndarray) -> np.ndarray:
    r"""Heat taken up by the oil (W), :math:`\dot Q = c_p\,\rho\,\dot V\,(\theta_{out} - \theta_{in})`.

    Density (kg/m3) at the temperature of the flow meter, specific heat in J/(kg K), flow in m3/s, rise in K.
    Source: "Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s",
    equation 8.

    >>> round(float(oil_heat(np.array(900.0), 2000.0, np.array(10e-3 / 60), np.array(10.0))))   # 0.15 kg/s
    3000
    """
    return specific_heat * density * flow * rise


def heat_balance(table: Table, file: CalorimetricFile, density: np.ndarray, specific_heat: float) -> Heat:
    """Loss of the gears from the heat balance of oil, shafts and walls."""
    rise = table["oil_outlet_temperature_C"] - table["oil_inlet_temperature_C"]
    if np.any(rise <= 0.0):
        worst = int(np.argmin(rise))
        place = f"{table.source}, run {table['run'][worst]}, oil_outlet_temperature_C"
        raise InputError("the oil gets no warmer, so no heat is carried away", where=place, value=_outlet(table, worst))
    heat = oil_heat(density, specific_heat, table["oil_flow_L_min"] / 60e3, rise)
    meters, housing = file.meters, file.housing
    shafts = housing.shaft_conductance_W_K * _difference(
        table, "bearing_temperature_C", "oil_outlet_temperature_C", housing.shaft_conductance_W_K
    )
    walls = housing.wall_conductance_W_K * _difference(
        table, "housing_temperature_C", "ambient_temperature_C", housing.wall_conductance_W_K
    )
    kept = heat * (1.0 - housing.shaft_heat_share)
    independent = kept * np.hypot(meters.flow_noise, meters.rise_noise_K / rise)
    common = {
        "flow meter": kept * meters.flow_sd,
        "density": kept * meters.density_sd,
        "specific heat": kept * meters.specific_heat_sd,
        "temperature rise": kept / rise * meters.rise_sd_K,
        "heat of the shafts": heat * housing.shaft_heat_share_sd + shafts * housing.shaft_conductance_sd,
        "heat of the walls": walls * housing.wall_conductance_sd,
    }
    return Heat(heat, kept - shafts + walls, Errors(independent, common))


def _outlet(table: Table, row: int) -> float:
    return float(table["oil_outlet_temperature_C"][row])


def _difference(table: Table, warm: str, cold: str, conductance: float) -> np.ndarray:
    """Difference of two temperatures; zero without a conductance."""
    if not conductance:
        return np.zeros(len(table))
    for name in (warm, cold):
        if name not in table:
            raise InputError(f"a conductance needs the column {name!r}", where=table.source)
    return np.asarray(table[warm] - table[cold])


def loss_factor(pair: GearPair, shared: Sharing, torque: np.ndarray) -> np.ndarray:
    """Local loss factor at each torque; at zero load, the factor of the smallest load."""
    loaded = np.unique(torque[torque > 0.0])
    if loaded.size == 0:
        raise InputError("no reading has a load, so there is no friction to find", where="torque_Nm", value=0.0)
    if loaded.size > MOST_TORQUES:
        loaded = np.linspace(loaded[0], loaded[-1], MOST_TORQUES)
    return np.interp(torque, loaded, local_loss_factor(mesh(pair, shared), loaded))


def _series(table: Table) -> tuple[list[str], np.ndarray]:
    """Names of the series and series of each reading: as given, or by speed, oil temperature and surfaces."""
    if "series" in table:
        names, index = np.unique(table["series"], return_inverse=True)
        return names.tolist(), index
    levels = [near_values(table["speed_rpm"]), near_values(table["oil_inlet_temperature_C"])]
    levels += [np.unique(table[n], return_inverse=True)[1] for n in ("pinion_surface", "gear_surface") if n in table]
    _, first, index = np.unique(np.stack(levels), axis=1, return_index=True, return_inverse=True)
    index = index.ravel()
    named = []
    for one in first:
        speed, temperature = table["speed_rpm"][one], table["oil_inlet_temperature_C"][one]
        surfaces = [str(table[n][one]) for n in ("pinion_surface", "gear_surface") if n in table]
        named.append(", ".join([f"{speed:.5g} rpm", f"{temperature:.3g} °C", *dict.fromkeys(surfaces)]))
    return named, index


def run(file: CalorimetricFile, path: Path) -> Evaluated:
    """Evaluate the heat balance, split the loss of each series over its load stages, and return mean friction."""
    table = read_table(named_file(path.parent, file.readings, "readings"), COLUMNS)
    with collected() as findings:
        pair, shared = gear_pair(file.gears), sharing(file.gears.load_sharing, path.parent)
        oil = lubricant(file.lubricant, folder=path.parent)
    density = oil.density(table["oil_inlet_temperature_C"] + ZERO_CELSIUS)
    heat = heat_balance(table, file, density, oil.heat_capacity)
    omega = table["speed_rpm"] * math.pi / 30.0
    factor = loss_factor(pair, shared, table["torque_Nm"])
    stages = LoadStages(table["torque_Nm"], table["torque_Nm"] * omega, factor)
    names, index = _series(table)
    channel = f"{table.source}, loss from flow and temperatures (W)"
    check_lines(stages.product, heat.loss, index, table["run"], channel, exponent=file.friction.load_exponent_sd)
    splits = []
    for number, name in enumerate(names):
        rows = np.flatnonzero(index == number)
        part = Errors(heat.errors.independent[rows], {n: e[rows] for n, e in heat.errors.common.items()})
        relative = {"torque": file.meters.torque_sd, "loss factor": file.friction.loss_factor_sd}
        splits.append(
            split_loss(
                *(name, rows, heat.loss[rows], part, stages.take(rows)),
                relative=relative,
                load_exponent_sd=file.friction.load_exponent_sd,
            )
        )
    pitch_speed = omega * pair.operating_radius[0]
    tables = {
        "loss": _loss_table(table, names, index, heat, stages, splits, pitch_speed),
        "series": _series_table(table, splits, pitch_speed),
        "budget": pd.concat([_budget(split) for split in splits], ignore_index=True),
    }
    notes = [str(one) for one in dict.fromkeys(findings)] + [text for split in splits for text in split.notes]
    if not any((file.housing.shaft_heat_share, file.housing.shaft_heat_share_sd, file.housing.shaft_conductance_W_K)):
        notes.append(
            "no heat of the shafts in the balance; on the insulated rig of the source it is 5 to 8 % of the heat"
        )
    case = _case(file, path, table, heat)
    if case is None:
        notes.append("no case folder: name pinion_surface and gear_surface in the readings and give [surfaces.NAME]")
    return Evaluated(
        file.title, tables, _figures(tables, splits, stages, heat), tuple(_lines(splits)), tuple(notes), case
    )


def _loss_table(
    table: Table,
    names: list[str],
    index: np.ndarray,
    heat: Heat,
    stages: LoadStages,
    splits: list[Split],
    pitch_speed: np.ndarray,
) -> pd.DataFrame:
    """Table of readings."""
    found: dict[str, Any] = {"run": table["run"], "series": np.array(names)[index]}
    found |= {name: table[name] for name in ("torque_Nm", "speed_rpm")}
    found |= {"oil_temperature_C": table["oil_inlet_temperature_C"]}
    found |= {name: table[name] for name in SURFACES if name in table}
    found |= {"pitch_line_velocity_m_s": pitch_speed, "oil_heat_W": heat.oil}
    found |= interval("power_loss_W", heat.loss, heat.errors.sd(np.eye(heat.loss.size)))
    found |= {"transmitted_power_W": stages.power, "loss_factor": stages.factor}
    order = np.argsort(np.concatenate([split.rows for split in splits]))
    for column in splits[0].readings:
        found[column] = np.concatenate([split.readings[column] for split in splits])[order]
    return pd.DataFrame(found)


def _series_table(table: Table, splits: list[Split], pitch_speed: np.ndarray) -> pd.DataFrame:
    """Table of series."""
    rows = []
    for split in splits:
        row: dict[str, Any] = {"series": split.name, "readings": split.rows.size}
        row["speed_rpm"] = table["speed_rpm"][split.rows].mean()
        row["pitch_line_velocity_m_s"] = pitch_speed[split.rows].mean()
        row["oil_inlet_temperature_C"] = table["oil_inlet_temperature_C"][split.rows].mean()
        for name, (value, budget) in split.found.items():
            row |= {column: float(x) for column, x in interval(name, value, combined(budget)).items()}
            row[f"{name}_sd_own"] = float(budget["readings"])
        rows.append(row | {"chi_square": split.chi_square, "degrees_of_freedom": split.rows.size - 2})
    return pd.DataFrame(rows)


def _budget(split: Split) -> pd.DataFrame:
    """Contribution of each source of error to the standard deviations of a series."""
    sources = list(next(iter(split.found.values()))[1])
    columns_ = {f"{name}_sd": [float(budget[s]) for s in sources] for name, (_, budget) in split.found.items()}
    return pd.DataFrame({"series": split.name, "source": sources, **columns_})


def _lines(splits: list[Split]) -> Iterator[str]:
    for split in splits:
        (idle, idle_sd), (friction, friction_sd) = ((v, combined(b)) for v, b in split.found.values())
        yield (
            f"{split.name}: load-independent loss {idle:.4g} W (sd {idle_sd:.2g} W), mean friction {friction:.4f} "
            f"(sd {friction_sd:.2g})"
        )


def _figures(
    tables: dict[str, pd.DataFrame], splits: list[Split], stages: LoadStages, heat: Heat
) -> dict[str, tuple[Panel, ...]]:
    lines, series = [], tables["series"].sort_values("pitch_line_velocity_m_s")
    for number, split in enumerate(splits):
        x = stages.product[split.rows] * 1e-3
        reach = np.array([0.0, x.max()])
        lines += [
            Curve(x, heat.loss[split.rows], split.name, marker=True, group=number),
            Curve(reach, split.intercept + split.slope * reach * 1e3, group=number),
        ]
    friction = curve(series, "pitch_line_velocity_m_s", "mean_friction", marker=True)
    return {
        "load_stages": (Panel("input power times loss factor (kW)", "gear loss (W)", tuple(lines)),),
        "friction": (Panel("pitch line velocity (m/s)", "mean friction coefficient (-)", (friction,)),),
    }


def _case(file: CalorimetricFile, path: Path, table: Table, heat: Heat) -> CaseDraft | None:
    """Case of gear loss from the readings, load-independent loss included."""
    if not file.surfaces or any(name not in table for name in SURFACES):
        return None
    for name in SURFACES:
        check_surfaces(file.surfaces, table[name], f"{table.source}: {name}")
    loaded = table["torque_Nm"] > 0.0
    common = heat.errors.common
    scale = combined({name: common[name] / heat.loss for name in ("flow meter", "density", "specific heat")})
    shift = combined({name: common[name] for name in ("temperature rise", "heat of the shafts", "heat of the walls")})
    noise = {"setup_relative": float(scale.mean()), "setup_absolute": float(shift.mean())}
    recording = {
        "quantity": "power_loss_W",
        "includes": "all losses in the gear housing: mesh, churning and windage",
        "noise": noise,
    }
    recorded = {name: table[name][loaded] for name in ("run", "torque_Nm", "speed_rpm")}
    recorded |= {"oil_temperature_C": table["oil_inlet_temperature_C"][loaded]}
    recorded |= {name: table[name][loaded] for name in SURFACES}
    recorded |= {"setup": np.full(int(loaded.sum()), "calorimeter"), "power_loss_W": heat.loss[loaded]}
    recorded |= {"power_loss_W_sd": heat.errors.independent[loaded]}
    return case_draft(path, "gear_pair", ("gears", "lubricant", "surfaces"), recording, recorded)


OIL_IN_HEAT = {"density_15C_kg_m3": 1000.0, "density_change_per_K": 7e-4, "specific_heat_J_kgK": 2000.0}
"""Oil properties of the template for the heat balance."""

EVALUATION = Evaluation(
    name="calorimetric",
    about="heat that the oil carries away over load stages, into loss and mean friction of gears",
    source=SOURCE,
    file=CalorimetricFile,
    columns={"the readings": COLUMNS},
    run=run,
    results=CALORIMETRIC,
    example={
        "schema": "mixedlub-calorimetric/1",
        "title": "High-speed gears B",
        "readings": "readings.csv",
        "gears": {"preset": "high_speed_b"},
        "lubricant": {"oil": "mil_prf_23699", **OIL_IN_HEAT, "eyring_stress_MPa": 5.0},
        "surfaces": {
            "ground": {"m0_um2": 0.16, "m2": 0.0031, "m4_per_um2": 0.0021},
            "superfinished": {"m0_um2": 0.01, "m2": 0.0008, "m4_per_um2": 0.0012},
        },
        "housing": {"shaft_heat_share": 0.065, "shaft_heat_share_sd": 0.01},
        "meters": {"flow_sd": 0.005, "rise_sd_K": 0.1, "rise_noise_K": 0.05},
    },
)
