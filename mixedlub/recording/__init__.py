"""What a recording says of itself: conditions, set points, noise and correlated error."""
