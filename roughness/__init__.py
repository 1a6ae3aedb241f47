"""What is computed from a profile: filters, ISO parameters, moments, asperities, diagnostics."""

from roughness.moments import Moments, moments
from roughness.parameters import HeightParameters, height_parameters
from roughness.prepare import (
    level,
    primary_profile,
    remove_form,
    roughness_profile,
    trim,
    waviness_profile,
)

__all__ = [
    "HeightParameters",
    "Moments",
    "height_parameters",
    "level",
    "moments",
    "primary_profile",
    "remove_form",
    "roughness_profile",
    "trim",
    "waviness_profile",
]
