"""Settings: errors of the laws."""

# Errors of form
FORM_ERRORS = ((0.0, 0.30), (0.08, 0.30), (0.25, 0.25), (0.6, 0.15))
"""Judgement. Relative rms error of an effect's form, and its prior probability: about the spread of published forms."""
FORM_ERROR_LENGTH, SIGNED_FORM_ERROR_LENGTH = 0.7, 0.35
"""Judgement. Correlation lengths of an error of form along a condition of one sign, and of both signs: half as long."""
FORM_ERROR_FUNCTIONS, SIGNED_FORM_ERROR_FUNCTIONS = 4, 8
"""Cost limit. Functions of an error of form along a condition of one sign, and of both signs."""
FORM_ERROR_PRODUCTS = 3
"""Cost limit. Functions of each condition in products of two conditions."""
FORM_ERROR_LEAST = 0.3
"""Judgement. Share of the typical change that replaces a small one: another form need not vanish there."""

# Errors of the base model
BASE_ERRORS = ((0.0, 0.3), (0.001, 0.1), (0.002, 0.1), (0.005, 0.2), (0.01, 0.15), (0.02, 0.1), (0.05, 0.05))
"""Judgement. Relative rms error of the base model after calibration, and its prior probability: from exact laws to the
few per cent by which published film and friction formulas differ from full solutions of the same contact."""
BASE_ERROR_LENGTH = 0.7
"""Judgement. Correlation length of this error along a condition, as a share of its range: laws differ slowly."""
LARGEST_SHARE = 50.0
"""Judgement. Largest reading over its noise, in typical ones: a reading of nearly no noise would decide alone."""
LEAST_DIRECTION = 0.2
"""Judgement. Length of a direction of the largest error, in standard deviations, from which it can be seen."""
SCREENED_BASE_ERROR, SCREENED_FORM_ERROR = 0.02, 0.08
"""Judgement. Sizes of both errors at which outliers are decided: in the middle of the sizes tried."""
