"""Settings: assessment of the answer, and doubts about it."""

from fractions import Fraction

import numpy as np

# Test against nothing missing
FALSE_ALARM_RATE = 0.01
"""Judgement. False-alarm rate of the test where the user states none: a usual convention."""
LEVELS = (1e-9, 0.5)
"""Judgement. Lowest and highest level that a user may state: at the highest, every other case would be called wrong."""
TEST_SEED = 20240229
"""Definition. Seed of the simulated recordings of the test."""
DRAWS = 2000
"""Cost limit. Simulated recordings without a mismatch: a p-value of 0.01 is then known to 22 %."""
SMOOTH_ALTERNATIVES = ((0.7, False), (0.25, True))
"""Judgement. Correlation length of the smooth alternatives, and whether they have products of pairs: power only."""
ALTERNATIVE_SIZES = (1.0, 4.0)
"""Judgement. Sizes of the alternatives in standard deviations, just visible and plain: power only."""
WEIGHT_OF_EFFECTS = 0.6
"""Judgement. Prior weight of the effects among the alternatives; smooth functions share the rest: power only."""
SMALLEST_P = 1e-304
"""Definition. Smallest p-value representable in the answer."""
BAYES_FACTOR_MARGIN = 10.0
"""Judgement. Margin for the approximations of the search's Bayes factor: an error of 2.3 in log evidence."""
STATED_NOISE_SCALES = (1.0,)
"""Definition. Factors on stated noise: it is known."""
UNSTATED_NOISE_SCALES = tuple(np.geomspace(0.12, 2.0, 13))
"""Grid. Factors on unstated noise, relative to the noise under the calibrated base model."""

# Cross-validation
MOST_FOLDS = 8
"""Cost limit. Folds; further levels are joined."""
LEAST_FOLDS = 3
"""Judgement. Levels from which leaving one out is a test: two others then show a slope."""
UNORDERED_FOLDS = 5
"""Source: T. Hastie, R. Tibshirani, J. Friedman, The Elements of Statistical Learning, 2nd ed. (2009), p. 243, which
recommends five or ten. Folds where no condition has enough levels: every fifth reading."""
WIDE_SPAN = 0.2
"""Judgement. Span of a condition over its size, from which leaving out its levels tests a prediction: levels that lie
close together predict one another whatever the law. It only ranks conditions that were varied."""
MOST_PENALTY = 20.0
"""Judgement. Largest penalty in log odds: 2e-9 leaves no doubt."""
CHANCE_GAIN = 5.0
"""Judgement. Gain in log probability on left-out levels that chance gives: odds of 150."""

# Probabilities and averages
TIE = 0.1
"""Judgement. Ratio to the verdict's probability from which an explanation ties with it: ten to one."""
OUTSIDE = 0.02
"""Judgement. Probability that no explanation considered holds: about the share of claims above 0.9 that were wrong on
rigs simulated by another author's laws, whatever their evidence."""
FLOOR = 1e-6
"""Judgement. Least stated probability, and least difference from one: models are not surer."""
TEST_MARGIN = 1.25
"""Judgement. Odds by which the test puts "nothing missing" behind or ahead of the best explanation: just visible."""
MOST_AVERAGED = 6
"""Cost limit. Explanations that are averaged."""
NEGLIGIBLE = 2e-3
"""Judgement. Probability below which an explanation is left out of the average: it hardly changes the average."""
HALVINGS = 40
"""Judgement. Halvings towards the end of an interval of an average: to 1e-12 of the distance between its parts."""

# Published laws and their ranges
LAW_REJECTED = -4.6
"""Source: H. Jeffreys, Theory of Probability, 3rd ed. (1961), appendix B. Log odds below which a law is rejected: a
Bayes factor of a hundred against it, from which evidence is decisive."""
LAW_OPEN = -2.3
"""Source: H. Jeffreys, Theory of Probability, 3rd ed. (1961), appendix B. Log odds above which a law cannot be
excluded: a Bayes factor of ten against it, from which evidence is strong."""
EXACT_EXPONENT = 0.01
"""Judgement. Difference of an exponent from a law's at the end of its prior that counts as zero: as printed."""

# Power laws
EXPONENTS = tuple(s * Fraction(n, m) for n, m in ((1, 3), (1, 2), (2, 3), (1, 1), (2, 1)) for s in (1, -1))
"""Grid. Exponents of a power law, as in simple physics."""
COLLINEAR = 0.999
"""Judgement. Correlation of two quantities from which they are equivalent: no reading is so exact."""
VARIED_FROM = 0.05
"""Judgement. Range of the logarithm of a quantity from which it varied: 5 %."""
BEAM_WIDTH = 12
"""Cost limit. Forms kept and extended at each step."""
BLOCK_CELLS = 4_000_000
"""Cost limit. Numbers held in memory at once."""
LAW_BLOCKS = 6
"""Cost limit. Blocks of left-out levels."""
LAW_READINGS = 1500
"""Cost limit. Readings on which forms are tried."""
LARGEST_LOG_FORM = 30.0
"""Judgement. Largest logarithm of a form: it prevents overflow."""
ABSORBING_LENGTH = 0.7
"""Judgement. Correlation length of a free factor on a quantity, as a share of the range: slow."""
MOST_ERROR_SHARE = 0.7
"""Judgement. Ratio of the error on left-out levels with and without a power law, above which it is rejected."""
CONDITIONS_WON = 0.75
"""Judgement. Share of the conditions in which a power law must predict left-out levels better: most of them."""

# Table of the missing part
NODES_OF_TABLE = 2000
"""Cost limit. Rows of a table of the missing part."""
NODES_OF_CONDITION = 12
"""Cost limit. Nodes of a condition in the table; with fewer levels, the levels."""
NODES_OF_WAVE = 16
"""Judgement. Nodes of a period of a wave: linear interpolation is then wrong by 2 % of its height."""
NODES_OF_PEAK = 13
"""Judgement. Nodes over four widths of a peak: linear interpolation is then wrong by 1 % of its height."""

EDGE = 1e-6
"""Definition. Distance of the two nodes of a step, as a share of the range: narrow."""

# Next tests
MOST_CONDITIONS = 600
"""Cost limit. Evaluated conditions."""
WORTH_TESTING = 0.01
"""Judgement. Probability from which an explanation competes for a test: a hundred to one."""
MOST_RIVALS = 8
"""Cost limit. Explanations that tests have to separate."""
RIVAL_WEIGHT = 0.05
"""Judgement. Least weight of a rival in the choice of a test, so that improbable ones can still be excluded."""
BATCH = 10
"""Judgement. Tests of a batch: a morning on a rig."""
BEYOND_TESTS, TESTS_APART = 3, 2
"""Judgement. Tests beyond the recording, and the conditions in which each two differ: a short list without twins."""
BEYOND_SPAN, BEYOND_LOWEST = 0.25, 0.6
"""Judgement. Tests beyond the recorded range: excess over the range, and least level over the lowest recorded."""
INNER_LEVELS = 4
"""Grid. Recorded levels of a condition that are tried, together with one in the middle of each two."""
TEST_LEVELS = 8
"""Cost limit. Levels of a condition that are tried."""
TEST_DIGITS = 3
"""Judgement. Digits of a level between two recorded ones: as a rig is set."""
WIDE_RATIO = 3.0
"""Judgement. Ratio of the highest to the lowest level from which a level between two is their geometric mean."""
LEAST_SHARED = 0.03
"""Judgement. Shared uncertainty, over the noise of a reading, below which it is left out: 0.1 % in squares."""
CHOICE_DRAWS, STATED_DRAWS = 96, 1000
"""Cost limit. Simulated outcomes for the choice of a test, and for the stated numbers (chance known to 1.3 %)."""
CHANCE_OF_SETTLED = 0.8
"""Judgement. Chance of a settled answer for which the readings are counted: four to one."""
MOST_READINGS = 60
"""Cost limit. Readings up to which this chance is looked for: more are another programme."""

# Where the mismatch lies, and what lies beyond the recording
NO_MISMATCH = 1e-9
"""Judgement. Mismatch in standard deviations below which it counts as zero: rounding."""
LARGE_SHARE = 0.5
"""Judgement. Share of the largest mismatch from which a reading belongs to the region: a half."""
MOST_CUTS = 3
"""Judgement. Conditions that are cut: more cannot be read."""
MOST_ENDS = 12
"""Cost limit. Ends of a cut that are tried along one condition."""
CUT_GAIN = 0.02
"""Judgement. Gain in F-score by which a further cut is accepted: a simpler region is better."""
OUTSIDE_OF_SPAN, OUTSIDE_OF_END, OUTSIDE_OF_LOWEST = 0.1, 0.02, 0.25
"""Judgement. A condition extrapolates when it is past an end by a tenth of the span and 2 % of the end, or below 3/4 of
the lowest: scatter about a set point does not."""

# Doubts about the answer
MANY_OUTLIERS = 0.1
"""Judgement. Share of outliers from which the answer is doubted: ten times the prior share."""
FAILED_SHARE = 1.0 / 3.0
"""Judgement. Share of outliers above which an explanation fails: no instrument is wrong so often, but a law may be."""
FAILED_PENALTY = 1e3
"""Definition. Penalty in log odds of an explanation that fails: beyond any evidence."""
OPPOSITE_WITHIN = 0.3
"""Judgement. Sum of reading and prediction over the reading, below which an outlier has the opposite sign: roughly."""
LEAST_STREAK, RARE = 3, 0.05
"""Judgement. Least length of a reported streak of outliers, and largest number of such streaks by chance: 5 % level."""
MOST_OF_LEVEL = 0.75
"""Judgement. Share of the readings of a level from which a streak counts as that level: most of them."""
POOR_PREDICTION = 3.0
"""Judgement. Error on left-out levels, in sd of a reading, from which the prediction fails: beyond noise."""
LARGE_NOISE = 0.1
"""Judgement. Share of a reading from which estimated noise is doubted: rigs do better."""
LARGEST_SCATTER = 0.2
"""Judgement. Largest share of a reading that is still noise where none is stated: every development recording of
`mixedlub prove --real` with more scatter conceals a specimen, a condition or a mixture."""
VISIBLE = 3.0
"""Judgement. Change in standard deviations from which an effect is visible: clearly beyond noise."""
CHANNEL_READINGS = 5
"""Judgement. Least readings for a correlation with a second channel: fewer correlate by chance."""

# Steps of conditions
CLEAR_JUMP = 5.0
"""Judgement. Jump of a residual at a step, in noise, that is clear."""
RELAXED = 0.5
"""Judgement. Part of a jump that is gone before the next step, from which it relaxes."""
MOST_OF_STEPS = 0.5
"""Judgement. Share of the steps with a clear jump, from which the steps are where the mismatch begins."""
STEPS_LISTED = 4
"""Judgement. Steps that a message lists at most."""
