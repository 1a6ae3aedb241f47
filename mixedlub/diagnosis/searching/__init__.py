"""Every explanation tried and weighed, under the noise that the readings have."""
