"""Forms of friction histories: surface states during a programme, elastic compliance of the bodies at small slip."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mixedlub.validation.rig import Form, Knob, strength

FALL, EITHER = strength(0.0, 6.0), strength(-2.2, 5.0)


@dataclass(frozen=True)
class Track:
    """Friction of a track under constant conditions: its level, and the recorded share."""

    level: np.ndarray
    recorded: np.ndarray


def _scaled(state: Any, factor: np.ndarray) -> Any:
    if isinstance(state, Track):
        return replace(state, level=state.level * factor)
    return replace(state, boundary_friction=state.boundary_friction * factor[:, None])


def histories(time: np.ndarray) -> dict[str, tuple[Form, ...]]:
    """Forms of a surface state over the programme (0 to 1), by id; they scale the friction of touching surfaces."""
    return {
        "friction_run_in": _run_ins(time),
        "tribofilm_growth": _growths(time),
        "two_time_scales": _successions(time),
        "friction_event": _events(time),
        "wandering": _wanderings(time),
    }


def _run_ins(time: np.ndarray) -> tuple[Form, ...]:
    def hyperbolic(state: Any, strength: float, pace: float) -> Any:
        """mu (1 + 0.3 strength/(1 + t/pace))."""
        return _scaled(state, 1 + 0.3 * strength / (1 + time / pace))

    def power_law(state: Any, strength: float, pace: float, exponent: float) -> Any:
        """mu (1 + 0.3 strength (1 + t/pace)^-n), n the exponent."""
        return _scaled(state, 1 + 0.3 * strength * (1 + time / pace) ** -exponent)

    def stretched(state: Any, strength: float, pace: float, exponent: float) -> Any:
        """mu (1 + 0.3 strength e^(-(t/pace)^n)), n the exponent."""
        return _scaled(state, 1 + 0.3 * strength * np.exp(-((time / pace) ** exponent)))

    def worn_in(state: Any, strength: float, pace: float) -> Any:
        """mu (1 + 0.3 strength [1 - ln(1 + t/pace)/ln(1 + 1/pace)])."""
        return _scaled(state, 1 + 0.3 * strength * (1 - np.log1p(time / pace) / np.log1p(1 / pace)))

    def exponential(state: Any, strength: float, pace: float) -> Any:
        """mu (1 + 0.3 strength e^(-t/pace))."""
        return _scaled(state, 1 + 0.3 * strength * np.exp(-time / pace))

    pace = Knob("pace", 0.01, 1.0, (0.03, 0.25))
    return (
        Form("friction_run_in", "boundary", exponential, (FALL, pace), "Blau 2005, exponential", within=True),
        Form("friction_run_in", "boundary", hyperbolic, (FALL, pace), "second-order wear-in", within=True),
        Form("friction_run_in", "boundary", power_law,
             (FALL, pace, Knob("exponent", 0.3, 2.0, (0.5, 1.5))), "power law", within=True),
        Form("friction_run_in", "boundary", stretched,
             (FALL, pace, Knob("exponent", 0.5, 1.2, (0.6, 0.9))), "stretched"),
        Form("friction_run_in", "boundary", worn_in, (FALL, pace), "logarithmic wear-in"),
    )  # fmt: skip


def _growths(time: np.ndarray) -> tuple[Form, ...]:
    def logistic(state: Any, strength: float, middle: float, width: float) -> Any:
        """mu (1 + 0.4 strength [g(t) - g(0)]), g = 1/(1 + e^(-(t - m)/(m width))), m the middle."""
        at_start = 1 / (1 + np.exp(middle / (width * middle)))
        return _scaled(state, 1 + 0.4 * strength * (1 / (1 + np.exp(-(time - middle) / (width * middle))) - at_start))

    def avrami(state: Any, strength: float, pace: float, exponent: float) -> Any:
        """mu (1 + 0.4 strength (1 - e^(-(t/pace)^n))), n the exponent."""
        return _scaled(state, 1 + 0.4 * strength * -np.expm1(-((time / pace) ** exponent)))

    def parabolic(state: Any, strength: float, pace: float) -> Any:
        """mu (1 + 0.4 strength (t/(t + pace))^0.5)."""
        return _scaled(state, 1 + 0.4 * strength * np.sqrt(time / (time + pace)))

    def first_order(state: Any, strength: float, pace: float) -> Any:
        """mu (1 + 0.4 strength (1 - e^(-t/pace)))."""
        return _scaled(state, 1 - 0.4 * strength * np.expm1(-time / pace))

    steep = Knob("exponent", 1.2, 4.0, (1.6, 3.0))
    return (
        Form("tribofilm_growth", "boundary", first_order, (EITHER, Knob("pace", 0.05, 2.0, (0.1, 0.6))),
             "coverage of first order, Fujita and Spikes 2005", within=True),
        Form("tribofilm_growth", "boundary", logistic,
             (EITHER, Knob("middle", 0.05, 0.8, (0.15, 0.5)), Knob("width", 0.1, 0.5, (0.15, 0.35))), "autocatalytic"),
        Form("tribofilm_growth", "boundary", avrami, (EITHER, Knob("pace", 0.05, 1.0, (0.15, 0.5)), steep),
             "Avrami 1939", within=True),
        Form("tribofilm_growth", "boundary", parabolic, (EITHER, Knob("pace", 0.05, 2.0, (0.1, 0.6))), "diffusion"),
    )  # fmt: skip


def _successions(time: np.ndarray) -> tuple[Form, ...]:
    """A quick transient on top of a lasting change."""

    def difference(state: Any, strength: float, quick: float, lasting: float) -> Any:
        """A film that forms and passes, on a track with uniform wear."""
        passing = np.exp(-time / (4 * quick)) - np.exp(-time / quick)
        return _scaled(state, 1 + strength * (0.5 * passing - 0.3 * lasting * time))

    def chained(state: Any, strength: float, quick: float, lasting: float) -> Any:
        """Reactions in a row: bare to film to worn track, A to B to C of chemical kinetics."""
        slow = 0.35
        film = slow / (slow - quick) * (np.exp(-time / slow) - np.exp(-time / quick))
        worn = 1 - (slow * np.exp(-time / slow) - quick * np.exp(-time / quick)) / (slow - quick)
        return _scaled(state, 1 + strength * (0.15 * film - 0.35 * lasting * worn))

    lasting = Knob("lasting", -2.0, 2.0, (0.5, 1.2))
    quick = Knob("quick", 0.01, 0.12, (0.02, 0.06))
    return (
        Form("two_time_scales", "boundary", difference, (EITHER, quick, lasting), "two exponentials", 1),
        Form("two_time_scales", "boundary", chained, (EITHER, quick, lasting), "consecutive reactions", 1),
    )


def _swings(place: np.ndarray, waves: float) -> np.ndarray:
    """A film that grows and is torn off: rises with a root, falls at once, smoothed over a quarter of a swing."""
    fine = np.linspace(-0.2, 1.2, 2801)
    phase = (fine * waves) % 1.0
    shape = np.sqrt(phase) - 2 / 3
    width = max(int(0.25 / waves / (fine[1] - fine[0])), 1)
    return np.asarray(np.interp(place, fine, np.convolve(shape, np.hanning(width) / np.hanning(width).sum(), "same")))


def _wanderings(time: np.ndarray) -> tuple[Form, ...]:
    def sines(state: Any, strength: float, waves: float, phase: float) -> Any:
        """mu (1 + 0.1 strength [sin 2 pi (n t + phase) + 0.6 sin 2 pi (1.63 n t + 0.3)]), n the waves."""
        swing = np.sin(2 * np.pi * (waves * time + phase)) + 0.6 * np.sin(2 * np.pi * (1.63 * waves * time + 0.3))
        return _scaled(state, 1 + 0.1 * strength * swing)

    def torn(state: Any, strength: float, waves: float) -> Any:
        """mu (1 + 0.25 strength g(n t)): g rises with a root and falls at once, n times."""
        return _scaled(state, 1 + 0.25 * strength * _swings(time, waves))

    def cosines(state: Any, strength: float, **more: float) -> Any:
        """Any slow history: a cosine series of twelve terms."""
        terms = [0.1 * strength, *(0.1 * value for value in more.values())]
        return _scaled(state, np.exp(sum(a * np.cos((k + 1) * np.pi * time) for k, a in enumerate(terms))))

    waves = Knob("waves", 0.8, 3.2, (1.2, 2.4))
    return (
        Form("wandering_surface_state", "boundary", sines,
             (EITHER, waves, Knob("phase", 0.0, 1.0, (0.0, 1.0))), "two swings", 2),
        Form("wandering_surface_state", "boundary", torn, (EITHER, waves), "growth and tearing", 2),
        Form("wandering_surface_state", "boundary", cosines,
             (strength(-20.0, 20.0), *(Knob(f"term_{k}", -20.0, 20.0, (0.0, 0.0)) for k in range(2, 13))),
             "cosine series", 2, rarity=0.0, within=True),
    )  # fmt: skip


def washed_in(since: np.ndarray, mixing: float) -> np.ndarray:
    """Share of new oil in a stirred sump, 1 - exp(-t/mixing) from a moment on (Danckwerts 1953); shares of a programme.

    Cited from memory; the form is the balance of the sump and has no constants from the source.

    >>> [round(float(share), 6) for share in washed_in(np.array([-0.1, 0.0, 0.05]), 0.05)]
    [0.0, 0.0, 0.632121]
    """
    return np.asarray(-np.expm1(-np.maximum(since, 0.0) / mixing))


def hump(since: np.ndarray, coming: float, passing: float) -> np.ndarray:
    """Amount of an intermediate product, A to B to C, over its peak: quick entry, slow loss (Bateman 1910).

    Unequal times ``coming`` and ``passing`` in shares of a programme; peak at ln(passing/coming)/(1/coming -
    1/passing). Cited from memory; the form solves the rates, without constants of the source.

    >>> [round(float(size), 6) for size in hump(np.array([-0.1, 0.0, 0.04 * np.log(2)]), 0.02, 0.04)]
    [0.0, 0.0, 1.0]
    """
    ratio = passing / coming
    peak = ratio ** (-1 / (ratio - 1)) * (1 - 1 / ratio)
    late = np.maximum(since, 0.0)
    return np.asarray((np.exp(-late / passing) - np.exp(-late / coming)) / peak)


def _events(time: np.ndarray) -> tuple[Form, ...]:
    def dosed(state: Any, strength: float, when: float) -> Any:
        """An additive is dosed: friction steps from one reading to the next."""
        return _scaled(state, 1 + 0.1 * strength * (time > when))

    def renewed(state: Any, strength: float, when: float) -> Any:
        """Oil is renewed: friction moves to another level within three hundredths of the programme."""
        return _scaled(state, 1 + 0.1 * strength * np.clip((time - when) / 0.03, 0.0, 1.0))

    def mixed_in(state: Any, strength: float, when: float, mixing: float) -> Any:
        """Other oil is fed to a stirred sump: friction moves gradually to another level, fast at first."""
        return _scaled(state, 1 + 0.1 * strength * washed_in(time - when, mixing))

    def passing(state: Any, strength: float, when: float, lasting: float) -> Any:
        """Water or dirt gets in and is driven out again: a hump of friction that relaxes to its former level."""
        return _scaled(state, 1 + 0.15 * strength * hump(time - when, 0.2 * lasting, lasting))

    def scuffing(state: Any, strength: float, reach: float) -> Any:
        """The film breaks down: friction runs away at the end."""
        return _scaled(state, 1 + 0.3 * strength * (reach / (1 - time + reach)) ** 2)

    when = (strength(-5.0, 8.0), Knob("when", 0.2, 0.8, (0.3, 0.75)))
    return (
        Form("friction_event", "boundary", dosed, when, "sudden", 1, within=True),
        Form("friction_event", "boundary", renewed, when, "over a while", 1),
        Form("friction_event", "boundary", mixed_in,
             (*when, Knob("mixing", 0.02, 0.2, (0.04, 0.12))), "washed in, Danckwerts 1953", 1),
        Form("friction_event", "boundary", passing,
             (*when, Knob("lasting", 0.02, 0.3, (0.04, 0.15))), "a hump that relaxes, Bateman 1910", 1),
        Form("friction_event", "boundary", scuffing,
             (strength(0.0, 8.0), Knob("reach", 0.02, 0.12, (0.04, 0.09))), "running away", 1),
    )  # fmt: skip


def creeps(slip: np.ndarray) -> tuple[Form, ...]:
    """Forms of the elastic compliance of the bodies at small slip, as a share of full friction."""

    def reached(state: Any, share: np.ndarray) -> Any:
        if isinstance(state, Track):
            return replace(state, recorded=state.recorded * share)
        return replace(state, friction=state.friction * share[:, None])

    def tangent(state: Any, strength: float) -> Any:
        """mu tanh(slip/(0.008 strength))."""
        return reached(state, np.tanh(slip / (0.008 * strength))) if strength > 0 else state

    def polach(state: Any, strength: float) -> Any:
        """mu (2/pi) [g/(1 + g^2) + arctan g], g = slip/(0.006 strength)."""
        if strength <= 0:
            return state
        grip = slip / (0.006 * strength)
        return reached(state, 2 / np.pi * (grip / (1 + grip**2) + np.arctan(grip)))

    def gradual(state: Any, strength: float) -> Any:
        """mu [1 - e^(-slip/(0.008 strength))]."""
        return reached(state, -np.expm1(-slip / (0.008 * strength))) if strength > 0 else state

    def cubic(state: Any, strength: float) -> Any:
        """mu [1 - (1 - slip/S)^3] below the slip S = 0.016 strength, mu beyond it."""
        return reached(state, 1 - np.maximum(1 - slip / (0.016 * strength), 0.0) ** 3) if strength > 0 else state

    size = (strength(0.0, 12.0, (0.4, 2.0)),)
    forms = (
        (tangent, "hyperbolic tangent", False),
        (polach, "Polach 2005", False),
        (gradual, "exponential", True),
        (cubic, "Vermeulen and Johnson 1964", True),
    )
    return tuple(Form("contact_creep", "loss", law, size, source, within=within) for law, source, within in forms)
