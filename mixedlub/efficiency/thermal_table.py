"""Tables of the thermal balance: steady temperatures of every condition, and temperatures over the duty cycle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from mixedlub.efficiency.thermal import NO_BALANCE, Balance, ThermalModel
from mixedlub.efficiency.thermal_cycle import HOUR, Cycle, cycle
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.findings import Finding
from mixedlub.schema.result import described

RPM = 30.0 / np.pi
KWH = 3.6e6
BALANCED, OPEN, UNSETTLED = "converged", "none up to the highest temperature", "not converged"
AT = {"torque_Nm": "torque of the input", "speed_rpm": "speed of the input"}
STEADY = {
    "sump_temperature_C": "oil temperature at which the heat to the surroundings equals all losses",
    "housing_temperature_C": "outer wall of the housing; empty without a housing",
    "STAGE_tooth_temperature_C": "bulk temperature of the teeth, by teeth_W_K or ISO/TR 15144-1",
    "total_loss_W": "all losses at these temperatures",
    "gearbox_efficiency_percent": "1 less all losses over input power; empty without torque",
    "WAY_heat_W": "heat by a way, positive to the surroundings",
    "heat_difference": "heat out less heat in, over heat in",
    "balance": "text: converged; none up to the highest temperature, or not converged: numbers are empty",
    "validity": f"text: valid, or what is not; {NO_BALANCE} where no temperature balances the heat",
}
TABLES = {
    "thermal": described(**AT, **STEADY),
    "thermal_duty": described(
        **AT,
        duration_h="duration of the operating point",
        start_temperature_C="sump as the point begins",
        end_temperature_C="sump as it ends",
        highest_temperature_C="highest temperature of the sump",
        mean_temperature_C="mean temperature of the sump over time",
        loss_energy_kWh="heat of the losses, at the temperatures of the point",
        removed_energy_kWh="heat to the surroundings",
        stored_energy_kWh="heat kept by oil, wheels and housing",
    ),
    "thermal_history": described(
        point="number of the operating point", time_h="time since the start of the cycle", sump_temperature_C="sump"
    ),
}
"""Columns of the tables of the thermal balance."""


def thermal_tables(model: ThermalModel, steady: Balance) -> tuple[dict[str, pd.DataFrame], list[Finding]]:
    """Tables of the balance and of the duty cycle, and findings."""
    made, notes = {"thermal": steady_table(steady)}, list(steady.findings)
    duty = model.gearbox.file.duty
    if duty is None or model.section.heat_capacity_kJ_K is None:
        return made, notes
    torque, speed = np.array(duty.torque_Nm), np.array(duty.speed_rpm) / RPM
    hours = np.array(duty.duration_h)
    over = cycle(model, torque, speed, hours * HOUR)
    notes += over.findings(model)
    made["thermal_duty"] = duty_table(over, torque, speed, hours)
    time = {"point": over.point, "time_h": over.time / HOUR, "sump_temperature_C": over.sump - ZERO_CELSIUS}
    made["thermal_history"] = pd.DataFrame(time)
    return made, notes


def steady_table(one: Balance) -> pd.DataFrame:
    """A row a condition: temperatures, losses, and heat by way; empty where no balance was found."""
    wall = one.paths.wall(one.sump) if one.paths.section.housing is not None else np.full_like(one.sump, np.nan)
    numbers = {
        "sump_temperature_C": one.sump - ZERO_CELSIUS,
        "housing_temperature_C": wall - ZERO_CELSIUS,
        **{f"{name}_tooth_temperature_C": one.sump - ZERO_CELSIUS + rise for name, rise in one.rise.items()},
        "total_loss_W": one.losses.total(),
        "gearbox_efficiency_percent": 100.0 * one.losses.efficiency(),
        **{f"{name}_heat_W": values for name, values in one.heat.items()},
        "heat_difference": one.gap,
    }
    columns = {
        "torque_Nm": one.losses.torque,
        "speed_rpm": one.losses.speed * RPM,
        **{name: np.where(one.found, values, np.nan) for name, values in numbers.items()},
        "balance": np.where(one.found, BALANCED, np.where(one.too_hot, OPEN, UNSETTLED)),
        "validity": np.where(one.found, np.array(one.losses.validity), NO_BALANCE),
    }
    return pd.DataFrame(columns)


def duty_table(over: Cycle, torque: np.ndarray, speed: np.ndarray, hours: np.ndarray) -> pd.DataFrame:
    """A row an operating point of the duty cycle."""
    temperatures = {name: getattr(over, name) - ZERO_CELSIUS for name in ("start", "end", "highest", "mean")}
    return pd.DataFrame(
        {
            "torque_Nm": torque,
            "speed_rpm": speed * RPM,
            "duration_h": hours,
            **{f"{name}_temperature_C": values for name, values in temperatures.items()},
            "loss_energy_kWh": over.lost / KWH,
            "removed_energy_kWh": over.removed / KWH,
            "stored_energy_kWh": over.stored / KWH,
        }
    )


def thermal_lines(made: dict[str, pd.DataFrame]) -> Iterator[str]:
    """Lines of the report."""
    table = made["thermal"]
    held = table[table["balance"] == BALANCED]
    if held.empty:
        yield "  thermal balance: no condition of the map is in balance"
    else:
        low, high = held["sump_temperature_C"].min(), held["sump_temperature_C"].max()
        share, most = 100.0 * len(held) / len(table), held["heat_difference"].abs().max()
        yield (
            f"  thermal balance: sump {low:.4g} to {high:.4g} °C over {share:.4g} % of the map, in balance "
            f"(heat in and out within {most:.1g})"
        )
    if "thermal_duty" in made:
        duty = made["thermal_duty"]
        yield (
            f"  duty cycle: sump from {duty['start_temperature_C'].iloc[0]:.4g} °C, highest "
            f"{duty['highest_temperature_C'].max():.4g} °C, at the end {duty['end_temperature_C'].iloc[-1]:.4g} °C, "
            f"{duty['loss_energy_kWh'].sum():.4g} kWh lost"
        )
