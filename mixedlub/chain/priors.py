"""Prior distributions of parameters, each as a function of a standard-normal coordinate."""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, erf, erfc, exp, log, sinh, sqrt
from statistics import NormalDist


@dataclass(frozen=True)
class Normal:
    """A normal prior."""

    mean: float
    sd: float

    def value(self, z: float) -> float:
        """The value at standard-normal coordinate ``z``."""
        return self.mean + self.sd * z

    def __str__(self) -> str:
        return f"{self.mean:g} ± {self.sd:g}" if self.sd else f"{self.mean:g}, known"


@dataclass(frozen=True)
class SinhNormal:
    """``scale`` times the sinh of a standard-normal variable: about normal, with heavy tails."""

    scale: float

    def value(self, z: float) -> float:
        """The value at standard-normal coordinate ``z``."""
        return self.scale * sinh(z)

    def __str__(self) -> str:
        return f"0 ± {self.scale:g}, heavy tails"


@dataclass(frozen=True)
class LogNormal:
    """A lognormal prior; ``spread``: standard deviation of the logarithm."""

    median: float
    spread: float

    def value(self, z: float) -> float:
        """The value at standard-normal coordinate ``z``."""
        return self.median * exp(min(self.spread * z, 60.0))

    def __str__(self) -> str:
        return f"{self.median:g} ×/÷ {exp(self.spread):.2g}"


@dataclass(frozen=True)
class SignedLogNormal:
    """A lognormal prior of the absolute value with equally probable signs; values near zero are improbable."""

    median: float
    spread: float

    def value(self, z: float) -> float:
        """The value at standard-normal coordinate ``z``; zero at the median, between the two signs.

        >>> prior = SignedLogNormal(200.0, 0.25)
        >>> [round(prior.value(z)) for z in (-0.6745, -0.1, 0.0, 0.1, 0.6745)]   # quartiles at the medians
        [-200, -141, 0, 141, 200]
        """
        if z == 0.0:
            return 0.0
        size, normal = min(abs(z), 37.0) / sqrt(2.0), NormalDist()
        inner = normal.inv_cdf(erf(size)) if size < 0.7 else -normal.inv_cdf(erfc(size))
        return copysign(self.median * exp(min(self.spread * inner, 60.0)), z)

    def __str__(self) -> str:
        return f"±{self.median:g} ×/÷ {exp(self.spread):.2g}"


@dataclass(frozen=True)
class Uniform:
    """A uniform prior between two bounds."""

    low: float
    high: float

    def value(self, z: float) -> float:
        """The value at standard-normal coordinate ``z``."""
        return self.low + (self.high - self.low) * NormalDist().cdf(z)

    def __str__(self) -> str:
        return f"uniform from {self.low:g} to {self.high:g}"


@dataclass(frozen=True)
class LogUniform:
    """A log-uniform prior between two bounds: every order of magnitude is equally probable."""

    low: float
    high: float

    def value(self, z: float) -> float:
        """The value at standard-normal coordinate ``z``."""
        return self.low * exp(log(self.high / self.low) * NormalDist().cdf(z))

    def __str__(self) -> str:
        return f"log-uniform from {self.low:g} to {self.high:g}"


Prior = Normal | SinhNormal | LogNormal | SignedLogNormal | Uniform | LogUniform
