"""The full factorial: every pairing of surfaces at every torque, speed and oil temperature."""

from mixedlub.study.plan import Study, counted, factors, read_study
from mixedlub.study.results import Results, run_study

__all__ = ["Results", "Study", "counted", "factors", "read_study", "run_study"]
