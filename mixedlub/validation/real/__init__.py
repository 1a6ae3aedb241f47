"""Battery on measured recordings with a truth that is known because it was concealed.

A recording is a case folder with ``source.toml``: where it comes from, what acts by its source and by plain physics,
channels that can be hidden, groups of rows that differ by one known thing. Expectations are written before an answer is
seen. Four classes of case are dealt: an effect *planted* on the readings, a channel *hidden*, two *paired* groups
without the column that tells them apart, and the recording *untouched*.
"""
