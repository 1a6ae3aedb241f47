"""The base laws: each one pure function of arrays in SI."""
