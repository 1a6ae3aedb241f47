"""Line contacts by the full equations of elastohydrodynamic lubrication: film, pressure, shear and temperature."""

from pathlib import Path

from mixedlub.ehl.oil.file import read_oil
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.rough import wave_amplitudes
from mixedlub.ehl.solve import contacts, solve

__all__ = ["Oil", "contacts", "example_oil", "read_oil", "solve", "wave_amplitudes"]

EXAMPLE = Path(__file__).parent / "oil" / "example.toml"
"""Example file of an oil."""


def example_oil() -> Oil:
    """The example oil."""
    return read_oil(EXAMPLE)
