"""Gears on skew axes: bevel and hypoid pairs, from the blank to contact lines, friction and efficiency."""

from importlib.resources import files

EXAMPLE = files("mixedlub.skew_gears").joinpath("example.toml")
"""Template of a hypoid pair, written by `mixedlub new bevel`."""

__all__ = ["EXAMPLE"]
