"""Settings: conventions, and fits of one explanation."""

import numpy as np

# Conventions of all rooms
SEED = 1
"""Definition. Seed of every random subset, so that the same case gives the same answer."""
LIKELY = 0.5
"""Definition. Probability above which a statement is more probable than its opposite."""
NINETY = 1.6449
"""Definition. Half-width of a 90 % interval in standard deviations of a normal distribution."""
INTERVAL_ENDS = (0.05, 0.95)
"""Definition. Quantiles at the ends of a 90 % interval."""
SIGNIFICANT = 2.0
"""Source: R. A. Fisher, Statistical Methods for Research Workers (1925). Standard errors within which a deviation is
chance: about 95 % of a normal distribution."""
STRONG_EVIDENCE = 3.0
"""Source: R. E. Kass, A. E. Raftery, J. Am. Stat. Assoc. 90 (1995) 773, doi:10.1080/01621459.1995.10476572, table on
p. 777. Gain in log evidence that counts: a Bayes factor of 20, from which evidence is strong."""
LARGEST_EXPONENT = 700.0
"""Definition. Largest exponent with an exponential in the range of a double, rounded down."""

# Differences and the size of noise
FINITE_STEP = 1e-4
"""Judgement. Step of differences, in prior standard deviations: far above rounding, far below the curvature of laws."""
MOST_COORDINATE = 4.5
"""Judgement. Largest coordinate in prior standard deviations: 99.9993 % of the prior."""
SMALLEST_READING = 1e-30
"""Judgement. Lower bound on predictions in logarithms: far below any reading."""
NOISE_BY_READING_BELOW = 0.1
"""Judgement. Prediction over reading below which relative noise refers to the reading: the model lacks a part."""

# Outliers
OUTLIER_SHARE = 0.01
"""Judgement. Prior fraction of outliers: one reading of a hundred."""
OUTLIER_WIDTH = 10.0
"""Judgement. Half-width of the outlier distribution in standard deviations: clearly wider than noise."""
OUTLIER_WEIGHT = 0.5
"""Judgement. Precision weight below which a reading is treated as an outlier: it has lost half of its weight."""
CLIPPED_AT = 3.0
"""Judgement. Robust standard deviations at which residuals are clipped, so that single outliers do not dominate."""
HUBER_BOUND = 5.0
"""Judgement. Bound of the Huber loss in a robust prefit over the robust standard deviation: keeps distant readings."""

# Fits
REWEIGHTINGS = 30
"""Cost limit. Iterations in which a linear fit decides on its outliers."""
QUICK_REWEIGHTINGS = 4
"""Cost limit. Iterations of a fit that only ranks starting values."""
WEIGHTS_CONVERGED = 1e-3
"""Judgement. Change of every weight below which these iterations have converged."""
GAUSS_NEWTON_STEPS = 20
"""Cost limit. Steps of a fit."""
DAMPING_TRIALS = 8
"""Cost limit. Dampings that are tried for one step."""
DAMPING_START, DAMPING_RETRY = 1e-2, 1e-3
"""Judgement. Damping of the first step, and the least after a failed one, over the curvature: small."""
DAMPING_RISE, DAMPING_FALL, LEAST_DAMPING = 6.0, 5.0, 1e-9
"""Judgement. Factors on the damping after a failed and a good step, and its least value: one of each nearly cancel."""
LONGEST_STEP = 2.0
"""Judgement. Longest step of a coordinate in prior standard deviations: linearised laws are poor beyond."""
PREFIT_TOLERANCE = 0.5
"""Judgement. Gain in log probability below which a robust prefit ends: it only needs to be near."""
FIT_TOLERANCE = 2e-3
"""Judgement. Gain in log probability below which a fit ends: invisible in any odds."""
NESTED_TOLERANCE = 0.05
"""Judgement. Tolerance of fits with published laws, which only change the odds of an explanation."""
SAME_FIT_WITHIN = 0.1
"""Judgement. Prior standard deviations within which two prefits lead to the same result."""
HOPELESS_BEHIND = 60.0
"""Cost limit. Log evidence behind the best from which a fit is given up, or not repeated under a new noise."""
PRECISION_BEHIND = 0.01
"""Cost limit. Precision of the evidence of a fit behind the best, over the distance between them."""
EVIDENCE_BOUND_FACTOR = 2.0
"""Judgement. Possible gain of a fit over the gain of its linearisation, before the fit is given up: twice."""
STEPS_BEFORE_GIVING_UP = 3
"""Judgement. Steps before a fit may be given up: the first ones are far from linear."""
STEP_LENGTHS = (1.0, 0.5, 0.25, 0.1, 0.0)
"""Grid. Lengths of a damped step over the full step."""

# Starting values
PRIOR_DRAWS = 18
"""Cost limit. Draws of the prior for each parameter of an effect."""
PRIOR_TAIL = 0.02
"""Judgement. Share of the prior at either end from which no draw is taken: fits may still reach it."""
START_WITHIN = 25.0
"""Judgement. Log evidence behind the best draw within which another one is a start: fits gain much over draws."""
STARTS_APART = 1.2
"""Judgement. Least distance of two starts in prior standard deviations: nearer ones rarely lead elsewhere."""
STARTS, STARTS_UP_TO = 3, 6
"""Cost limit. Starts of a fit of an effect of up to so many parameters; one more for each parameter beyond."""
FITTED_FIRST = 4
"""Cost limit. Most promising fits from which the rival of the others is taken."""
SCANNED_TO = 3.0
"""Judgement. Largest coordinate of a scan in prior standard deviations: 99.7 % of the prior."""
VISIBLE_FROM = 1.0
"""Judgement. Sum of squared changes of the readings, in standard deviations, from which a draw is visible."""
STRAINED_CALIBRATION = 25.0
"""Definition. Squared length of calibration coordinates that five of them exceed with a probability of 1e-4."""

# Change points
SCAN_PLACES = 121
"""Grid. Places in the scan of a change point: a twentieth of a prior standard deviation apart."""
MOST_HALVINGS = 12
"""Cost limit. Times that the gap between two places is halved."""
STEEP = 0.7
"""Judgement. Change of the log density between two places from which their gap is halved: a factor of two."""
NEGLIGIBLE_DENSITY = 15.0
"""Judgement. Log density below the largest one that does not count in an integral: 3e-7 of it."""
REFIT_GAIN = 0.5
"""Judgement. Gain in log density from which the fit is repeated from another place: less is the scan's coarseness."""
MOST_LOG_RATIO = 50.0
"""Judgement. Bound on the log density relative to the fit in an integral: it prevents overflow."""
CHANGE_POINT_QUANTILES = (np.arange(20) + 0.5) / 20.0
"""Grid. Quantiles of the posterior of a change point over which predictions are averaged."""

# Published laws
SPIKE = 0.5
"""Judgement. Prior probability of exactly the published laws of an effect: principle of indifference."""
HOPELESS_LAW = 15.0
"""Judgement. Log odds against a law from which it adds nothing: 3e-7."""

LINEAR_ROUNDS = 2
"""Cost limit. Rounds in which the rest of an explanation follows a fixed law with the slopes of the free fit."""

# Pairs of effects
PAIR_LEADERS = 12
"""Cost limit. Best single effects with which pairs are formed; other pairs are found from their draws."""
PAIRS = 45
"""Cost limit. Pairs that are fitted, by the weights of the single fits."""
