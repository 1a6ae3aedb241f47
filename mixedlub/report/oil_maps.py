"""Maps of oils: viscosity and film friction over temperature and pressure, hatched where no number is known."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.base_model.limits import FAR_FROM_OIL
from mixedlub.effects.limiting_shear_stress import limiting_shear_stress
from mixedlub.ehl.oil.fitted_shear import stresses
from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.laws.oil import LARGEST_LOG, ZERO_CELSIUS
from mixedlub.report.style import WIDTH, styled
from mixedlub.rig.build import lubricant
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant as Section
from mixedlub.schema.oil_file import oil_names
from mixedlub.schema.toml_file import parse

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CELSIUS = np.linspace(20.0, 200.0, 46)
PRESSURE = np.linspace(0.0, 2e9, 41)
"""Grid. Temperatures (degC) and pressures (Pa) of the maps."""
KNOWN_PRESSURE = 1e9
"""Judgement. Pressure (Pa) to which Roelands' law and fits of the modulus equation are trusted without data."""
SHEAR_RATE = 1e6
"""Judgement. Shear rate (1/s) of the maps of film friction: 0.3 m/s of sliding over 0.3 um."""
POWERS = np.arange(-3.0, 13.0, 1.0)
FRICTIONS = np.array([0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.15])
ABOVE = 0.05
"""Grid. Least pressure (GPa) of the map of friction, which is stress over pressure."""


def film_friction(of: Lubricant, rate: float, pressure: np.ndarray, kelvin: np.ndarray) -> np.ndarray:
    """Shear stress over pressure of an oil at a shear rate (1/s), by its Eyring stress or its traction part."""
    log = np.minimum(from_lubricant(of).log_viscosity(pressure, kelvin)[0], LARGEST_LOG)
    own: Any = of.eyring_stress
    if of.traction is not None:
        (own, *_), _ = stresses(pressure, kelvin, eyring_stress=own, part=of.traction)
    stress = own * np.arcsinh(np.exp(log) * rate / own)
    limit = {} if of.traction is None else of.traction.effects(uncertain=False).get("limiting_shear_stress", {})
    return np.asarray((limiting_shear_stress(stress, pressure, kelvin, **limit) if limit else stress) / pressure)


def known_range(of: Lubricant, *, traction: bool = False) -> tuple[tuple[float, float], tuple[float, float]]:
    """Temperatures (degC) and pressures (Pa) at which an oil is known; ``traction``: its film friction."""
    if traction and of.traction is not None:
        low, high = of.traction.pressure_GPa
        return of.traction.temperature_C, (low * 1e9, high * 1e9)
    low, high = sorted(of.temperature)
    return (low - ZERO_CELSIUS - FAR_FROM_OIL, high - ZERO_CELSIUS + FAR_FROM_OIL), (0.0, KNOWN_PRESSURE)


def oil_maps(oils: Sequence[str] = (), folder: Path = Path()) -> Figure:
    """Maps of viscosity (left) and film friction (right) of oils by name or file; by default all of the package."""
    from matplotlib.figure import Figure

    names = tuple(oils) or oil_names()
    with styled(), collected():
        figure = Figure(figsize=(WIDTH, 2.0 * len(names)), layout="constrained")
        axes = figure.subplots(len(names), 2, squeeze=False, sharex=True, sharey=True)
        for row, name in zip(axes, names, strict=True):
            of = lubricant(parse(Section, {"oil": name}, str(folder / "maps.toml")), folder=folder)
            _viscosity(row[0], of)
            _friction(row[1], of)
            row[0].set_ylabel(f"{name}\npressure (GPa)")
        axes[0, 0].set_title("viscosity (Pa s)")
        axes[0, 1].set_title(f"film friction at {SHEAR_RATE:.0e} 1/s (-)")
        for one in axes[-1]:
            one.set_xlabel("temperature (°C)")
    return figure


def _viscosity(axes: Axes, of: Lubricant) -> None:
    pressure, kelvin = np.meshgrid(PRESSURE, CELSIUS + ZERO_CELSIUS, indexing="ij")
    log = from_lubricant(of).log_viscosity(pressure, kelvin)[0] / np.log(10.0)
    lines = axes.contour(CELSIUS, PRESSURE * 1e-9, log, POWERS, cmap="viridis_r")
    axes.clabel(lines, fmt=lambda power: f"1e{power:.0f}", fontsize=6)
    _hatch(axes, *known_range(of))


def _friction(axes: Axes, of: Lubricant) -> None:
    height = np.maximum(PRESSURE, ABOVE * 1e9)
    pressure, kelvin = np.meshgrid(height, CELSIUS + ZERO_CELSIUS, indexing="ij")
    lines = axes.contour(
        CELSIUS, PRESSURE * 1e-9, film_friction(of, SHEAR_RATE, pressure, kelvin), FRICTIONS, cmap="viridis_r"
    )
    axes.clabel(lines, fmt="%g", fontsize=6)
    _hatch(axes, *known_range(of, traction=True))


def _hatch(axes: Axes, celsius: tuple[float, float], pressure: tuple[float, float]) -> None:
    """Hatch the part of a map outside the known range."""
    high = PRESSURE[-1] * 1e-9
    (cold, hot), (low, top) = celsius, (pressure[0] * 1e-9, pressure[1] * 1e-9)
    spans = (
        (CELSIUS[0], 0.0, cold - CELSIUS[0], high),
        (hot, 0.0, CELSIUS[-1] - hot, high),
        (cold, top, hot - cold, high - top),
        (cold, 0.0, hot - cold, low),
    )
    from matplotlib.patches import Rectangle

    for x, y, width, height in spans:
        if width > 0.0 and height > 0.0:
            axes.add_patch(
                Rectangle((x, y), width, height, fill=False, hatch="////", edgecolor="0.75", linewidth=0.0, zorder=0.5)
            )
    axes.set_xlim(CELSIUS[0], CELSIUS[-1])
    axes.set_ylim(0.0, high)
