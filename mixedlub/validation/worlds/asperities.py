"""Real area and pressure of elastic asperities at a separation, by other theories with the same spectral moments."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mixedlub.validation.contact import Contact, summits
from mixedlub.validation.worlds import random_surface
from mixedlub.validation.worlds.gaussian import excess


@dataclass(frozen=True)
class Asperities:
    """Functions of the separation (m): real over nominal area, and pressure on the nominal area (Pa)."""

    area: Callable[[np.ndarray], np.ndarray]
    pressure: Callable[[np.ndarray], np.ndarray]


Theory = Callable[[Contact], Asperities]


def greenwood_williamson(c: Contact) -> Asperities:
    """pi D R s F_1(t) and (4/3) E* D R^1/2 s^3/2 F_3/2(t) with McCool's summits: the base model."""
    s, modulus = summits(c), 0.5 * c.rig.solid.reduced
    load = 4 / 3 * modulus * s.density * np.sqrt(s.radius) * s.spread**1.5

    def depth(film: np.ndarray) -> np.ndarray:
        return np.asarray((film - s.offset) / s.spread)

    return Asperities(
        area=lambda film: np.pi * s.density * s.radius * s.spread * excess(1.0, depth(film)),
        pressure=lambda film: load * excess(1.5, depth(film)),
    )


def greenwood_tripp(c: Contact) -> Asperities:
    """Pairs of summits that meet off their axes (Greenwood and Tripp, Proc. Instn Mech. Engrs 185 (1970) 625).

    Between two rough surfaces of densities D, radii R and composite rms height s: area pi^2 D1 R1 D2 R2 s^2 F_2(h/s),
    pressure (16 pi/15) E* D1 D2 (R1 + R2) [R1 R2/(R1 + R2)]^1/2 s^5/2 F_5/2(h/s); for equal surfaces the paper's
    equations. Separation of the mean planes, heights normal about them.
    """
    m0, m2, m4 = (c.rig.shares[:, :, k].T[:, :, None] * moment for k, moment in enumerate((c.m0, c.m2, c.m4)))
    density = m4 / (m2 * 6 * np.pi * np.sqrt(3.0))
    radius = 0.375 * np.sqrt(np.pi / m4)
    height, modulus = np.sqrt(m0.sum(axis=0)), 0.5 * c.rig.solid.reduced
    meeting = np.prod(density * radius, axis=0) * np.pi**2 * height**2
    both, one = radius.sum(axis=0), np.sqrt(np.prod(radius, axis=0) / radius.sum(axis=0))
    load = 16 * np.pi / 15 * modulus * np.prod(density, axis=0) * both * one * height**2.5
    return Asperities(
        area=lambda film: meeting * excess(2.0, film / height),
        pressure=lambda film: load * excess(2.5, film / height),
    )


def bush_gibson_thomas(c: Contact) -> Asperities:
    """All summits of a Gaussian surface, each an ellipse (Bush, Gibson and Thomas, Wear 35 (1975) 87).

    Joint distribution of heights, curvatures and ellipses instead of the base model's single radius. Elastic,
    isotropic, without interaction of summits: areas well below one.
    """
    nayak, height = c.m0 * c.m4 / c.m2**2, c.roughness
    area, pressure = random_surface.tables()
    modulus = 0.5 * c.rig.solid.reduced
    return Asperities(
        area=lambda film: random_surface.read(area, nayak, film / height),
        pressure=lambda film: modulus * np.sqrt(c.m2) * random_surface.read(pressure, nayak, film / height),
    )


def persson(c: Contact) -> Asperities:
    """erf(sqrt(2) p/(E* g)) with the rms slope g = sqrt(2 m2) (Persson, J. Chem. Phys. 115 (2001) 3840).

    The theory gives the area at a pressure; the pressure against separation needs the whole spectrum and is taken from
    Greenwood and Williamson. Elastic, without adhesion, up to full contact.
    """
    from scipy.special import erf

    base = greenwood_williamson(c)
    steep = 0.5 * c.rig.solid.reduced * np.sqrt(2 * c.m2)
    return Asperities(area=lambda film: erf(np.sqrt(2) * base.pressure(film) / steep), pressure=base.pressure)
