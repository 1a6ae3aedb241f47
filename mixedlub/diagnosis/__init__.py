"""Diagnosis of the difference between simulation and recording: location, missing physics and probability."""
