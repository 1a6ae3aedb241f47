"""Evaluation of height maps: preparation, areal parameters of ISO 25178-2, figures."""

from roughness.maps.heights import HeightParameters, HybridParameters, height_parameters, hybrid_parameters
from roughness.maps.holes import filled
from roughness.maps.material import MaterialParameters, material_parameters
from roughness.maps.prepare import prepared_map
from roughness.maps.record import map_record
from roughness.maps.texture import Texture, texture_direction, texture_parameters

__all__ = [
    "HeightParameters",
    "HybridParameters",
    "MaterialParameters",
    "Texture",
    "filled",
    "height_parameters",
    "hybrid_parameters",
    "map_record",
    "material_parameters",
    "prepared_map",
    "texture_direction",
    "texture_parameters",
]
