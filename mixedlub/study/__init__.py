"""The full factorial: every pairing of surfaces at every torque, speed and oil temperature."""

from mixedlub.study.results import Results, run_study
from mixedlub.study.study import Study, read_study

__all__ = ["Results", "Study", "read_study", "run_study"]
