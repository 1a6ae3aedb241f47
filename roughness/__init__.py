"""What is computed from a profile: filters, ISO parameters, moments, asperities, diagnostics."""

from roughness.asperities import Asperities, asperities, mccool_asperities
from roughness.cutoffs import choose_cutoffs, cutoff_for, short_cutoff_for
from roughness.defects import mask_edges, mask_outliers, without_edges
from roughness.elements import element_parameters
from roughness.material_ratio import core_parameters, material_ratio, material_ratio_curve
from roughness.moments import Moments, across_and_along, moments
from roughness.parameters import HeightParameters, height_parameters
from roughness.prepare import (
    level,
    primary_profile,
    remove_form,
    roughness_profile,
    trim,
    waviness_profile,
)
from roughness.probability import NormalProbability, normal_probability
from roughness.record import evaluation_profile, profile_record, trace_record
from roughness.spectrum import autocorrelation, correlation_length, power_density

__all__ = [
    "Asperities",
    "HeightParameters",
    "Moments",
    "NormalProbability",
    "across_and_along",
    "asperities",
    "autocorrelation",
    "choose_cutoffs",
    "core_parameters",
    "correlation_length",
    "cutoff_for",
    "element_parameters",
    "evaluation_profile",
    "height_parameters",
    "level",
    "mask_edges",
    "mask_outliers",
    "material_ratio",
    "material_ratio_curve",
    "mccool_asperities",
    "moments",
    "normal_probability",
    "power_density",
    "primary_profile",
    "profile_record",
    "remove_form",
    "roughness_profile",
    "short_cutoff_for",
    "trace_record",
    "trim",
    "waviness_profile",
    "without_edges",
]
