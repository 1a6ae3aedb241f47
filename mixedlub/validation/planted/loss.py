"""Loss-stage effects: rolling, windage, churning, bearings, seals, elastic hysteresis."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Form, Knob, strength


def _rpm(c: Contact) -> np.ndarray:
    return np.asarray(c.rig.conditions["speed_rpm"].astype(float))


def _viscosity(c: Contact) -> np.ndarray:
    """Viscosity (Pa s) of the bath, which is as warm as recorded whatever the teeth are, one value a reading."""
    factor = (c.viscosity / c.rig.oil.viscosity_at(c.temperature))[:, 0]
    return np.asarray(factor * c.rig.oil.viscosity_at(c.rig.temperature))


def _viscosity_mm2_s(c: Contact) -> np.ndarray:
    """Kinematic viscosity (mm2/s) of the bath, calibration included, one value a reading."""
    return np.asarray(1e6 * _viscosity(c) / c.rig.oil.density_at(c.rig.temperature))


def _heavy(c: Contact) -> np.ndarray:
    """Density of the bath over that at 15 C."""
    return np.asarray(c.rig.oil.density_at(c.rig.temperature) / c.rig.oil.density_15)


def _added(c: Contact, more: np.ndarray) -> Contact:
    return replace(c, recorded=c.recorded + more)


def _resisted(c: Contact, per_width: np.ndarray) -> Contact:
    """Adds a rolling force per width (N/m) on each surface: power on gears, part of the friction on discs."""
    if c.rig.is_mesh:
        power = per_width * c.rig.width * (c.rig.speed_1 + c.rig.speed_2)
        return _added(c, np.sum(np.broadcast_to(power, c.force.shape), axis=1) * c.rig.step)
    return _added(c, (per_width / c.line_load)[:, 0])


def rolling_resistance(c: Contact, strength: float) -> Contact:
    """Goksem-Hargreaves pumping force f' = 4.318 (G U)^0.658 W^0.0126 R/alpha per width."""
    modulus, radius = c.rig.solid.reduced, c.rig.radius
    speed = c.viscosity * c.entrainment / (modulus * radius)
    load = c.line_load / (modulus * radius)
    group = (c.pressure_viscosity * modulus * speed) ** 0.658 * load**0.0126
    return _resisted(c, strength * 4.318 * group * radius / c.pressure_viscosity)


def elastic_hysteresis(c: Contact, strength: float) -> Contact:
    """A share 0.01 s of the elastic energy passing through is lost: f' = 0.01 s w b/(3 pi R) on either body."""
    return _resisted(c, 0.01 * strength * c.half_width * c.line_load / (3 * np.pi * c.rig.radius))


def elastic_damping(c: Contact, strength: float, power: float) -> Contact:
    """Lazan: metals damp with a power n of stress between 2 and 3: the share lost is 0.01 s (p0/1 GPa)^(n - 2)."""
    share = 0.01 * strength * (c.pressure / 1e9) ** (power - 2)
    return _resisted(c, share * c.half_width * c.line_load / (3 * np.pi * c.rig.radius))


def windage(c: Contact, strength: float) -> Contact:
    """Dawson: n^2.9 (0.16 D^3.9 + D^2.9 F^0.75 m^1.15) 1e-20 kW, both wheels (rpm, mm), mist of 5 x air."""
    width, module = 1e3 * c.rig.width, 1e3 * c.rig.extras["module"]
    total = np.zeros(len(c.recorded))
    for key, ratio in (("pitch_diameter", 1.0), ("wheel_diameter", c.rig.extras["ratio"])):
        size = 1e3 * c.rig.extras[key]
        shape = 0.16 * size**3.9 + size**2.9 * width**0.75 * module**1.15
        total = total + (_rpm(c) * ratio) ** 2.9 * shape * 1e-17
    return _added(c, 5 * strength * total)


def windage_in_mist(c: Contact, strength: float) -> Contact:
    """Anderson and Loewenthal, in kW, m, rpm, mPa s: 2.82e-7 (1 + 2.3 F/R) n^2.8 R^4.6 (0.028 eta + 0.019)^0.2."""
    thickened = (28.0 * _viscosity(c) + 0.019) ** 0.2
    total = np.zeros(len(c.recorded))
    for key, ratio in (("pitch_diameter", 1.0), ("wheel_diameter", c.rig.extras["ratio"])):
        radius = 0.5 * c.rig.extras[key]
        total = total + (1 + 2.3 * c.rig.width / radius) * (_rpm(c) * ratio) ** 2.8 * radius**4.6
    return _added(c, 5 * strength * 2.82e-4 * total * thickened)


def churning(c: Contact, strength: float, speed_power: float, viscosity_power: float) -> Contact:
    """Dip loss as dip tests are fitted: P = 12 W strength (n/1500 rpm)^a (nu/15 mm2/s)^q."""
    power = (_rpm(c) / 1500) ** speed_power * (_viscosity_mm2_s(c) / 15) ** viscosity_power
    return _added(c, 12 * strength * power)


def churning_of_rim_and_faces(c: Contact, strength: float, rim: float) -> Contact:
    """Seetharaman and Kahraman: a film at the rim, n^2 nu, and turbulent layers at the faces, n^2.86 nu^0.14.

    12 W strength at 1500 rpm and 15 mm2/s, ``rim`` of it at the rim; both are proportional to the density.
    """
    n, nu = _rpm(c) / 1500, _viscosity_mm2_s(c) / 15
    return _added(c, 12 * strength * _heavy(c) * (rim * n**2 * nu + (1 - rim) * n**2.86 * nu**0.14))


DISC_TRANSITION = (3.70 / 0.102) ** (1 / 0.3)


def churning_past_transition(c: Contact, strength: float, transition: float) -> Contact:
    """Layers on the faces that turn turbulent: moment over rho omega^2 as Re^-1/2, past a Reynolds number as Re^-1/5.

    Daily and Nece 1960, enclosed discs with separate layers: 3.70 (s/a)^0.1 Re^-1/2 and 0.102 (s/a)^0.1 Re^-1/5, which
    meet at 1.6e5; a stirred bath is turbulent sooner. ``transition`` is n/1500 rpm over nu/15 mm2/s there.
    12 W strength at 1500 rpm and 15 mm2/s in the laminar layer, with the density. Their coefficients and exponents are
    from memory, not checked against the paper.

    >>> round(DISC_TRANSITION, -3)
    158000.0
    """
    n, nu = _rpm(c) / 1500, _viscosity_mm2_s(c) / 15
    turning = n / nu
    moment = np.where(turning < transition, turning**-0.5, transition**-0.3 * turning**-0.2)
    return _added(c, 12 * strength * _heavy(c) * n**3 * moment)


def bearing_drag(c: Contact, strength: float, sliding_share: float) -> Contact:
    """SKF-like ball bearings: rolling phi_ish phi_rs F^0.54 (nu n)^0.6 plus sliding F^(5/3) mu_sl.

    Bearing force is the tooth force; mean diameter 50 mm; ``sliding_share`` is the sliding moment at 150 Nm,
    in parts of the rolling one at 1500 rpm and 15 mm2/s.
    """
    n, nu, size = _rpm(c), _viscosity_mm2_s(c), 50.0
    shear = 1 / (1 + 1.84e-9 * (n * size) ** 1.28 * nu**0.64)
    starved = np.exp(-3e-8 * nu * n * 100 * np.sqrt(3.1 / (2 * 40.0)))
    load = c.rig.conditions["torque_Nm"].astype(float) / 150
    boundary = np.exp(-2.6e-8 * (n * nu) ** 1.4 * size)
    sliding = (0.12 * boundary + 0.05 * (1 - boundary)) / 0.05
    moment = shear * starved * load**0.54 * (n * nu / 22500) ** 0.6 + sliding_share * sliding * load ** (5 / 3)
    return _added(c, strength * 0.08 * moment * n * np.pi / 30)


def seal_drag(c: Contact, strength: float) -> Contact:
    """Lip seals soften in heat (Linke): (145 - 1.6 T + 350 loglog(nu40 + 0.8)) d^2 n 1e-7 W, d 35 mm."""
    nu40 = 1e6 * c.rig.oil.kinematic_at(np.array(40.0))
    warm = np.maximum(145 - 1.6 * c.rig.temperature + 350 * np.log10(np.log10(nu40 + 0.8)), 5.0)
    return _added(c, strength * warm * 35.0**2 * _rpm(c) * 1e-7)


EFFECTS = (
    Form("rolling_resistance", "loss", rolling_resistance, (strength(0.0, 8.0),), "Goksem and Hargreaves 1978"),
    Form("windage", "loss", windage, (strength(0.0, 200.0),), "Dawson 1984", within=True),
    Form("windage", "loss", windage_in_mist, (strength(0.0, 200.0),), "Anderson and Loewenthal 1980"),
    Form(
        "churning",
        "loss",
        churning,
        (
            strength(0.0, 20.0),
            Knob("speed_power", 1.2, 2.4, (1.3, 2.1)),
            Knob("viscosity_power", 0.05, 0.4, (0.08, 0.3)),
        ),
        "power-law fit of dip tests",
        within=True,
    ),
    Form(
        "churning",
        "loss",
        churning_of_rim_and_faces,
        (strength(0.0, 20.0), Knob("rim", 0.0, 1.0, (0.15, 0.5))),
        "Seetharaman and Kahraman 2009",
    ),
    Form(
        "churning",
        "loss",
        churning_past_transition,
        (strength(0.0, 20.0), Knob("transition", 0.2, 20.0, (0.8, 3.0))),
        "discs in a housing, Daily and Nece 1960",
    ),
    Form(
        "bearing_drag",
        "loss",
        bearing_drag,
        (strength(0.0, 20.0), Knob("sliding_share", 0.0, 2.0, (0.2, 0.8))),
        "SKF friction model form",
    ),
    Form("seal_drag", "loss", seal_drag, (strength(0.0, 20.0),), "Linke 1971"),
    Form(
        "elastic_hysteresis",
        "loss",
        elastic_hysteresis,
        (strength(0.0, 40.0, (0.8, 2.0)),),
        "elastic energy share",
        rarity=0.4,
        within=True,
    ),
    Form(
        "elastic_hysteresis",
        "loss",
        elastic_damping,
        (strength(0.0, 40.0, (0.8, 2.0)), Knob("power", 2.0, 3.0, (2.3, 3.0))),
        "Lazan 1968",
        rarity=0.4,
    ),
)
