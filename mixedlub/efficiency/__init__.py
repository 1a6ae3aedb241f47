"""Efficiency of gear stages and planetary stages in series: losses by origin, maps, mesh cycle and duty cycle."""

from importlib.resources import files

from mixedlub.efficiency.gearbox import Gearbox, Losses
from mixedlub.efficiency.prepare import read_gearbox

EXAMPLE = files("mixedlub.efficiency").joinpath("example.toml")
"""Template of a gearbox with two stages, written by `mixedlub new efficiency`."""

PLANETARY_EXAMPLE = files("mixedlub.efficiency").joinpath("planetary_example.toml")
"""Template of a gearbox with two planetary stages, written beside it."""

__all__ = ["EXAMPLE", "PLANETARY_EXAMPLE", "Gearbox", "Losses", "read_gearbox"]
