"""Settings: priors of the explanations, and the noise."""

import numpy as np

# Priors of the explanations
PRIOR = {"nothing": 0.42, "single": 0.38, "pair": 0.08, "triple": 0.02, "discrepancy": 0.12}
"""Judgement. Prior weights before any reading: nothing missing is as probable as one effect, each further one is about
a fifth as probable."""
LEAST_NOTHING_ODDS = 14.0
"""Judgement. Least prior odds of nothing missing over each single effect: they prevent ties with effects that the
readings neither need nor exclude."""
FULL_PAIR_PRIOR = 25
"""Judgement. Number of effects from which pairs have their whole prior; among fewer, pairs are fewer too, and triples
by the square."""
LAW_ODDS = 0.02
"""Judgement. Prior odds that a step of the base model follows another published law, on a given rig."""
FURTHER_LAW_ODDS = 0.1
"""Judgement. Odds of each further such step after the first: deviating laws occur together, on one rig or on none."""
EXPECTED_CHANCE = 0.9
"""Judgement. Prior probability of an effect that mechanics demands: a reading may have been corrected for it."""
AFFECTED = 0.1
"""Judgement. Share of the largest change by an explanation from which a reading is affected: less is hardly seen."""

# Cost
ADDED_TO, MOST_ADDED, ROUNDS = 6, 16, 3
"""Cost limit. Best explanations to which a law or an effect is added, such additions that are fitted, and rounds."""
MOST_EFFECTS = 3
"""Judgement. Effects that are looked for at once: more are seldom told apart."""
MANY = 1200
"""Cost limit. Readings beyond which explanations are searched on a subset."""
SUBSET = 600
"""Cost limit. Readings of this subset."""
REFITTED_ON_ALL = 8
"""Cost limit. Most probable explanations of a subset that are fitted again to all readings."""
PUBLISHED_WITHIN = 20.0
"""Cost limit. Log odds behind the best within which published laws of an explanation are weighed."""
LAWS_REFITTED_WITHIN = 8.0
"""Cost limit. Log odds behind the best within which they are fitted instead of linearised: 3e-4, far beyond any tie."""

# Size of the noise
INFLATION_FACTORS = np.array([1.1, 1.25, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0, 4.0, 6.0, 10.0])
"""Grid. Inflation factors of the stated noise."""
INFLATION_GAIN = 8.0
"""Measured (tests/diagnosis/test_noise_gain.py): pure noise gains less from inflation in each of 4,000 recordings."""
INFLATION_ROUNDS = 4
"""Cost limit. Steps of inflation: fits under too little noise follow it, and one step seldom suffices."""
MOST_INFLATION = 4.0
"""Judgement. Largest inflation of stated noise that is still noise; more scatter is an unexplained discrepancy."""
BOUND_LEVEL = 1e-3
"""Judgement. Significance level at which the scatter of repeats bounds the noise: a usual convention."""
EXTRA_SHARES = np.array([0.003, 0.006, 0.01, 0.015, 0.02, 0.03, 0.05])
"""Grid. Extra relative noise where a column of standard deviations may be repeatability only."""
FIRST_SHARE = 2
"""Judgement. Index of the share that is tried first: 1 %, as of a rig in good order."""
SHARE_GAIN = 4.0
"""Judgement. Gain in log probability from which extra noise is accepted: less than for stated noise, because a column
of standard deviations is weaker evidence."""
MIXTURE_FACTORS = np.geomspace(0.3, 3.0, 13)
"""Grid. Factors on an estimated noise with another mixture of its parts."""
LEAST_FREEDOM = 10
"""Judgement. Degrees of freedom from which the scatter of residuals is known well enough: within 22 %."""
OVERSTATED_VARIANCE = 0.25
"""Judgement. Variance of residuals over the stated one below which noise is overstated: half the stated noise."""

# Errors of set-ups
SETUP_SHARES = (0.003, 0.01, 0.03, 0.1, 0.3)
"""Grid. Errors that readings of one set-up share, over the typical reading: more is physics or another specimen."""
SETUP_WHITE_SHARES, FINER_SHARES = (1.0, 0.35, 0.12), (0.5, 0.6, 0.7, 0.85, 1.0, 1.2, 1.4, 1.7, 2.0)
"""Grid. Shares of the noise that are left for single readings beside an error of set-ups, and factors on the best."""

# Correlated noise
LEAST_BATCHES = 16
"""Judgement. Batches from which the variance of their sums is estimated: its standard error is then 35 %."""
DRIFT_HALF_WAVES = 2
"""Judgement. Half waves over a recording that count as drift and are removed: a trend and one turn."""
DRIFT_READINGS = 40
"""Judgement. Readings from which a correlated error is looked for: fewer hardly show a correlation time."""
CORRELATION_SHARES = (0.02, 0.04, 0.08)
"""Grid. Correlation times, as shares of the record; a longer one is a change of the surfaces, not noise."""
ERROR_SIZES = (0.5, 1.0, 2.0, 4.0)
"""Grid. Standard deviations of the correlated error over the noise of a single reading: factors of two."""
WHITE_SHARES = (0.7, 0.5, 0.35)
"""Grid. Shares of the noise for single readings; the rest is correlated."""
DRIFT_CANDIDATES = 6
"""Cost limit. Most probable effects with a fitted correlated error, beside nothing missing and the discrepancy."""
MOST_UNDER_NULL = 2.0
"""Judgement. Largest correlated error if nothing is missing, over the scatter between neighbours; more is physics."""
DRIFT_GAIN = 12.0
"""Judgement. Gain in log probability from which a correlated error or a missing effect is accepted: best of many."""
