"""The chain of laws: glossary, effects, the model that runs them, and the base models."""
