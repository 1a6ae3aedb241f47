"""From weights to an answer: tests, probabilities, levels left out, where it sits, what to measure next."""
