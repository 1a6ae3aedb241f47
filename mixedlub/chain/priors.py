"""Priors of parameters: what is believed of a number before any reading is seen."""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, erf, erfc, exp, log, sinh, sqrt
from statistics import NormalDist


@dataclass(frozen=True)
class Normal:
    """A normal prior: what either sign may have."""

    mean: float
    sd: float

    def value(self, z: float) -> float:
        """The value that lies ``z`` standard deviations up the prior."""
        return self.mean + self.sd * z

    def __str__(self) -> str:
        return f"{self.mean:g} ± {self.sd:g}"


@dataclass(frozen=True)
class Wide:
    """A prior of either sign with wide wings: usually about ``scale``, now and then ten times that."""

    scale: float

    def value(self, z: float) -> float:
        """The value that lies ``z`` standard deviations up the prior."""
        return self.scale * sinh(z)

    def __str__(self) -> str:
        return f"about 0 ± {self.scale:g}, wide wings"


@dataclass(frozen=True)
class LogNormal:
    """A lognormal prior: positive, known to within a factor; ``spread`` is the sd of its logarithm."""

    median: float
    spread: float

    def value(self, z: float) -> float:
        """The value that lies ``z`` standard deviations up the prior."""
        return self.median * exp(min(self.spread * z, 60.0))

    def __str__(self) -> str:
        return f"{self.median:g} ×/÷ {exp(self.spread):.2g}"


@dataclass(frozen=True)
class EitherSign:
    """A lognormal prior of either sign: the size is known to within a factor, and nothing small is meant."""

    median: float
    spread: float

    def value(self, z: float) -> float:
        """The value that lies ``z`` standard deviations up the prior; zero in the middle, between the two signs.

        >>> prior = EitherSign(200.0, 0.25)
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
class Between:
    """A prior that is even between two bounds."""

    low: float
    high: float

    def value(self, z: float) -> float:
        """The value that lies ``z`` standard deviations up the prior."""
        return self.low + (self.high - self.low) * NormalDist().cdf(z)

    def __str__(self) -> str:
        return f"even in {self.low:g} to {self.high:g}"


@dataclass(frozen=True)
class BetweenLog:
    """A prior whose logarithm is even between two bounds: the order of magnitude is all that is known."""

    low: float
    high: float

    def value(self, z: float) -> float:
        """The value that lies ``z`` standard deviations up the prior."""
        return self.low * exp(log(self.high / self.low) * NormalDist().cdf(z))

    def __str__(self) -> str:
        return f"even in order of magnitude, {self.low:g} to {self.high:g}"


Prior = Normal | Wide | LogNormal | EitherSign | Between | BetweenLog
