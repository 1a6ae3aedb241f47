"""Properties of a recording: conditions, set points, noise and correlated error."""
