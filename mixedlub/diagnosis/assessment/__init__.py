"""From weights to an answer: tests, probabilities, cross-validation, location, next tests."""
