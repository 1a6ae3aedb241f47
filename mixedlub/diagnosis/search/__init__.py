"""Every explanation fitted and weighed, under the noise that the readings have."""
