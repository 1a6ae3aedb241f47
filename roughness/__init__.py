"""Evaluation of profiles: filters, ISO parameters, moments, asperities, diagnostics."""

from roughness.asperities import Asperities, asperities, mccool_asperities
from roughness.cutoffs import choose_cutoffs, cutoff_for, short_cutoff_for
from roughness.defects import mask_edges, mask_outliers, without_edges
from roughness.elements import element_parameters
from roughness.filters import gaussian_mean_line
from roughness.material_ratio import core_parameters, material_ratio, material_ratio_curve
from roughness.moments import Moments, across_and_along, moments
from roughness.noise import height_quantum, noise_moments, tip_reconstructed, tip_traced, without_noise
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
from roughness.robust import robust_mean_line, spline_mean_line
from roughness.spectrum import autocorrelation, correlation_length, power_density
from roughness.uncertainty import bootstrap, resampled_moments, short_cutoff_band, smoothed_moments

__all__ = [
    "Asperities",
    "HeightParameters",
    "Moments",
    "NormalProbability",
    "across_and_along",
    "asperities",
    "autocorrelation",
    "bootstrap",
    "choose_cutoffs",
    "core_parameters",
    "correlation_length",
    "cutoff_for",
    "element_parameters",
    "evaluation_profile",
    "gaussian_mean_line",
    "height_parameters",
    "height_quantum",
    "level",
    "mask_edges",
    "mask_outliers",
    "material_ratio",
    "material_ratio_curve",
    "mccool_asperities",
    "moments",
    "noise_moments",
    "normal_probability",
    "power_density",
    "primary_profile",
    "profile_record",
    "remove_form",
    "resampled_moments",
    "robust_mean_line",
    "roughness_profile",
    "short_cutoff_band",
    "short_cutoff_for",
    "smoothed_moments",
    "spline_mean_line",
    "tip_reconstructed",
    "tip_traced",
    "trace_record",
    "trim",
    "waviness_profile",
    "without_edges",
    "without_noise",
]
