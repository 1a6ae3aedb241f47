"""The chain of laws: quantities, effects, the model that runs them, and the base models."""
