"""Worm drives: film, friction and efficiency of the mesh in the forms of ISO/TR 14521."""

from importlib.resources import files

EXAMPLE = files("mixedlub.worm_gears").joinpath("example.toml")
"""Template of a worm drive, written by `mixedlub new worm`."""

__all__ = ["EXAMPLE"]
