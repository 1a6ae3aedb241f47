"""The catalogue: one physical effect a file; whatever lies here is found, nobody keeps a list."""
