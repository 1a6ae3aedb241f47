"""Search over explanations and selection of the noise model."""
