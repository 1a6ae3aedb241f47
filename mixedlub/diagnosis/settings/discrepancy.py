"""Settings: forms of the discrepancy."""

import numpy as np

# Smooth forms
SMOOTH_LENGTHS = (0.25, 0.7)
"""Grid. Correlation lengths of a smooth form, as shares of the range of a condition."""
ROUGH_LENGTH = 0.08
"""Judgement. Correlation length of a rough form of one condition: 12 levels are then nearly independent."""
READING_SIZES = (0.7, 2.0, 6.0, 20.0, 60.0)
"""Grid. Standard deviations of a discrepancy of the reading over the noise: factors of three."""
LOG_FACTOR_SIZES = (0.03, 0.1, 0.3, 1.0)
"""Grid. Standard deviations of the logarithm of a factor on a quantity of the chain: factors of three."""
SCREENED_SIZE = 2
"""Judgement. Index of the size with which a form is screened: the middle one."""
SCREENED_FORMS = 3
"""Cost limit. Best forms of the first screening that are fitted."""
FITTED_IN_FULL = 6
"""Cost limit. Forms of a family that are fitted with their own outliers; the others keep their quick evidence."""
DEPENDENT = 1e-6
"""Judgement. Relative norm below which a column is linearly dependent on the others: rounding."""
NO_INFLUENCE = 1e-9
"""Judgement. Change in standard deviations below which no reading depends on a quantity: rounding."""

# Peaks, steps and boxes
PEAK_WIDTHS = (0.01, 0.03, 0.1)
"""Grid. Standard deviations of a peak, as shares of the range of the condition; the least is a single level."""
LOCAL_LEVELS = 5
"""Judgement. Levels of a condition from which local forms are tried; among fewer, the smooth form follows a peak."""
MOST_PLACES = 40
"""Cost limit. Places of a condition that are tried first; the best ones are refined later."""
LOCAL_READINGS = 3.0
"""Judgement. Least effective readings within a local form: fewer are outliers."""
PEAK_SHARE = 0.4
"""Judgement. Share of the readings that a peak may cover; more is a trend."""
LOCAL_CONFOUNDED = 0.75
"""Judgement. Largest share of the variance of a form in time explained by a condition: beyond, the condition acts."""
SAME_FORM_WITHIN = 0.05
"""Judgement. Largest difference of two local forms of height one that count as the same: 5 %."""
BOX_SEEDS = 12
"""Cost limit. Readings with the largest residuals from which a box is grown."""
BOX_SWEEPS = 6
"""Cost limit. Sweeps over the ranges of a box."""

# History of conditions
FADING_TIMES = 5
"""Grid. Time constants of a decay or a memory: each about twice to three times the one before."""
SHORTEST_FADING, SLOWEST_FADING = 2.0, 0.3
"""Judgement. Least time constant in readings, and largest as a share of the recording; others are a jump or a drift."""
LEAST_PAST = 0.01
"""Judgement. Least standard deviation of a history coordinate, as a share of the range of its condition."""
EXPLAINED_BY_PRESENT = 0.75
"""Judgement. Largest share of the variance of a history coordinate explained by present conditions: as for forms in
time."""
SAME_PAST = 0.995
"""Judgement. Correlation from which two history coordinates count as one."""

# Waves in time
LEAST_PERIODS = 3.0
"""Judgement. Periods over a recording from which a wave is tried; the smooth form follows fewer."""
MOST_PERIODS = 200.0
"""Cost limit. Periods over a recording up to which a wave is tried."""
PERIODS_PER_LEVEL = 0.75
"""Judgement. Periods for each different time up to which a wave is tried: irregular times hardly resolve more."""
PERIOD_STEP = 0.25
"""Grid. Step in the number of periods: a quarter period keeps a wave in phase over the record."""
WAVE_REFINEMENT = PERIOD_STEP * np.linspace(-1.0, 1.0, 11)
"""Grid. Refinement of the number of periods about the best wave."""
WAVE_CONFOUNDED = 0.5
"""Judgement. Largest share of the variance of a wave explained by a condition: beyond, the condition acts."""
STEPPED_SHARE = 0.5
"""Judgement. Levels over readings below which a condition was stepped: each level was then read twice."""
