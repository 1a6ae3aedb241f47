"""Settings: statements of the report."""

import numpy as np

# What is said
SIMILAR, SAME_SIGNATURE = 0.8, 0.95
"""Judgement. Cosine of two signatures from which they are similar, and from which they have nearly the same form."""
REJECTED = 0.01
"""Judgement. Probability below which an effect counts as rejected: a hundred to one."""
STAGE_SHOWN = 0.05
"""Judgement. Probability from which a step of the model is named: twenty to one."""
SURE = 0.9
"""Judgement. Probability from which an effect counts as certain: nine to one."""
MOST_TIED, MOST_SIMILAR, MOST_LISTED = 5, 3, 12
"""Judgement. Tied explanations, similar effects or quantities, and outliers that are listed: more are not read."""
LEAST_P = 1e-300
"""Definition. Smallest p-value that is printed: near the smallest float."""
SIGNS_DIFFER = 0.2
"""Judgement. Share of readings with another sign in the figures, from which the report explains them: one in five."""
ONE_SIGN = 0.3
"""Judgement. Net over total mismatch below which no sign is named: about two to one."""
NEAREST_SHARE = 0.5
"""Judgement. Share of the discrepancy from which the effects that explain it are named: a half."""
SECOND_SHARE = 0.1
"""Judgement. Share of the discrepancy that a second effect must explain to be named: less may be chance."""
USELESS_TEST, WEAK_TEST = 0.01, 0.1
"""Judgement. Expected information (bit) below which a test is not named, and called weak: 1 bit decides."""
WIDE_RANGE = 0.5
"""Judgement. Share of the recorded range above which an interval is too wide to refine around: a half."""
NOISE_CHANGED = 1.5
"""Judgement. Change of a stated standard deviation from which it is reported: a half."""
NOT_BETTER = 0.95
"""Judgement. Ratio of the error on left-out levels with and without the answer, above which it is not better."""
STRAINED = 2.0
"""Judgement. Prior standard deviations from which an input counts as strained: 95 % of the prior."""
FAR = 3.0
"""Judgement. Prior standard deviations from which a parameter is far from expected: 99.7 % of the prior."""
VAGUE = 0.8
"""Judgement. Posterior over prior standard deviation from which a parameter is undetermined: hardly narrowed."""
UNMOVED = 1e-6
"""Judgement. Change of the readings (sigma) by a prior standard deviation, below which a parameter has no influence."""
SAME_READING = 1e-9
"""Judgement. Relative difference of two predictions that is rounding."""
COLDEST = 200.0
"""Judgement. Kelvin above which a parameter is a temperature, not a difference of two: no oil is colder."""
RPM = 30.0 / np.pi
"""Definition. Revolutions per minute in one radian per second."""
FADED = 3.0
"""Definition. Time constants after which a decay is gone: 5 % of it are left."""
