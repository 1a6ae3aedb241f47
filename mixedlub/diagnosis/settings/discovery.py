"""Settings: search for a law without a name."""

# Terms
POWERS = (-4.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 4.0)
"""Grid. Exponents of a term before they are fitted."""
FEW_POWERS = (-2.0, -1.0, 1.0, 2.0, 4.0)
"""Grid. Exponents of a term in a product or an addition, before they are fitted."""
PLACES = 9
"""Cost limit. Places of a threshold, a step or a resonance along a condition, before they are fitted."""
FEW_PLACES = 5
"""Cost limit. Places of a step or a resonance in a product."""
STEP_WIDTHS = (0.03, 0.15)
"""Grid. Widths of a step as a share of the range, before they are fitted."""
RESONANCE_WIDTHS = (0.1, 0.2, 0.35)
"""Grid. Widths of a resonance as a share of the range, before they are fitted."""
LEAST_LEVELS_OF_PLACE = 4
"""Judgement. Levels of a condition from which a place along it can be told."""
LARGEST_LOG = 30.0
"""Judgement. Largest logarithm in a term: it prevents overflow."""

# Priors
EXPONENT_SD = 1.5
"""Judgement. Standard deviation of an exponent: laws of friction and film rarely have more than two."""
LOG_FACTOR_SD = 0.7
"""Judgement. Standard deviation of the logarithm of a factor: a factor of two either way."""
ADDITION_SD = 30.0
"""Judgement. Standard deviation of an addition to the reading in standard deviations of its noise: plain."""
WIDTH_SPREAD = 0.7
"""Judgement. Standard deviation of the logarithm of a width: a factor of two either way."""
WIDTH_MEDIAN = 0.15
"""Judgement. Median width of a step or a resonance as a share of the range."""

FADING_NEAR = (0.65, 0.8, 1.25, 1.55)
"""Grid. Fading times of a memory over that of the discrepancy: steps between the times of the coarse grid."""
FADING_SPREAD = 1.5
"""Judgement. Standard deviation of the logarithm of a time constant: from a few readings to the whole recording."""

# Search
SCREENED_ROWS = 300
"""Cost limit. Readings on which terms are screened."""
KEPT_OF_TARGET = 6
"""Cost limit. Terms of a quantity that get a second term."""
FORMS_FITTED = {"single": 4, "powers": 1, "product": 2, "sum": 2}
"""Cost limit. Forms of each kind that are fitted in full on the best quantity."""
REPLACEMENTS_FITTED = 3
"""Cost limit. Replacements of a quantity that are fitted in full."""
FORMS_ELSEWHERE = 2
"""Cost limit. Fitted forms that are tried on every other quantity."""
PROVED = 4
"""Cost limit. Laws refitted without each level."""
FIT_GAIN = 8.0
"""Judgement. Least log evidence of a law over none: odds of 3000, because thousands of terms are tried."""
PRODUCT_PRIOR, SUM_PRIOR = 0.5, 0.5
"""Judgement. Prior of a product, and of a sum of two terms, over a single term: half, like a further factor."""
OTHER_SHAPES = 5
"""Definition. Shapes of a term beside powers, which share half of the prior."""
SAME_WITHIN = 3.0
"""Judgement. Difference in log evidence within which two laws cannot be told apart: odds of 20."""
FAR_BEHIND = 8.0
"""Judgement. Log evidence behind the best law from which a law is not considered: odds of 3000."""
LISTED_BEHIND, RIVALS = 30.0, 8
"""Judgement. Log evidence behind a law up to which rivals are listed, and their number: more are not read."""
EQUIVALENT_WITHIN = 0.1
"""Judgement. Ratio less one of the errors on left-out levels of laws that cannot be told apart."""
MOST_EXCESS = 0.5
"""Judgement. Largest excess of the squared error on left-out levels over noise with a law, as a share of the excess
with calibration alone: a law explains at least half of the mismatch."""
