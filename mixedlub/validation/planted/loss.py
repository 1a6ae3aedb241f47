"""Loss-stage effects: rolling, windage, churning, bearings, seals, elastic hysteresis."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Form, Knob, strength


def _rpm(c: Contact) -> np.ndarray:
    return np.asarray(c.rig.conditions["speed_rpm"].astype(float))


def _viscosity(c: Contact) -> np.ndarray:
    """Viscosity (Pa s) of the bath at its recorded temperature, independent of the teeth, by reading."""
    factor = (c.viscosity / c.rig.oil.viscosity_at(c.temperature))[:, 0]
    return np.asarray(factor * c.rig.oil.viscosity_at(c.rig.temperature))


def _viscosity_mm2_s(c: Contact) -> np.ndarray:
    """Kinematic viscosity (mm2/s) of the bath by reading, calibration included."""
    return np.asarray(1e6 * _viscosity(c) / c.rig.oil.density_at(c.rig.temperature))


def _heavy(c: Contact) -> np.ndarray:
    """Density of the bath over its density at 15 C."""
    return np.asarray(c.rig.oil.density_at(c.rig.temperature) / c.rig.oil.density_15)


def _added(c: Contact, more: np.ndarray) -> Contact:
    return replace(c, recorded=c.recorded + more)


def _resisted(c: Contact, per_width: np.ndarray) -> Contact:
    """Add a rolling force per width (N/m) on each surface: power on gears, friction on discs."""
    if c.rig.is_mesh:
        power = per_width * c.rig.width * (c.rig.speed_1 + c.rig.speed_2)
        return _added(c, np.sum(np.broadcast_to(power, c.force.shape), axis=1) * c.rig.step)
    return _added(c, (per_width / c.line_load)[:, 0])


def _pumping(c: Contact, speed_power: float, load_power: float) -> np.ndarray:
    """(G U)^a W^b R/alpha (N/m): G = alpha E', U = eta0 u/(E' R), W the line load over E' R."""
    size = c.rig.solid.reduced * c.rig.radius
    thick = c.pressure_viscosity * c.rig.solid.reduced * c.viscosity * c.entrainment / size
    return np.asarray(thick**speed_power * (c.line_load / size) ** load_power * c.rig.radius / c.pressure_viscosity)


def _inlet_heat(c: Contact) -> np.ndarray:
    """L = beta eta0 u^2/k."""
    beta = c.rig.oil.thinning_at(c.temperature)
    return np.asarray(beta * c.viscosity * c.entrainment**2 / c.rig.oil.conductivity)


def rolling_resistance(c: Contact, strength: float) -> Contact:
    """Goksem-Hargreaves pumping force f' = 4.318 (G U)^0.658 W^0.0126 R/alpha per width."""
    return _resisted(c, strength * 4.318 * _pumping(c, 0.658, 0.0126))


def rolling_free_of_load(c: Contact, strength: float) -> Contact:
    """Biboulet and Houpert: f' = 1.47 U^0.75 E' R per width, U = 2 eta0 u/(E' R), at any load."""
    size = c.rig.solid.reduced * c.rig.radius
    return _resisted(c, strength * 1.47 * (2 * c.viscosity * c.entrainment / size) ** 0.75 * size)


def rolling_under_load(c: Contact, strength: float) -> Contact:
    """Zhou and Hoeprich: f' = 29.2 (G U)^0.648 W^0.246 R/alpha per width, without inlet heating.

    J. Tribol. 113 (1991) 590, equation 17, a fit to solutions for W of 1e-4 to 4e-4 and U of 1e-11 to 1e-9.
    """
    return _resisted(c, strength * 29.2 * _pumping(c, 0.648, 0.246))


def rolling_as_bearings_are_tested(c: Contact, strength: float) -> Contact:
    """Aihara: f' = 88 (G U)^0.658 W^0.31 R/alpha/(1 + 0.29 L^0.78) per width, L = beta eta0 u^2/k.

    J. Tribol. 109 (1987) 471, equation 27 over 2 R, from tests of some two hundred bearings and of two discs.
    """
    return _resisted(c, strength * 88.0 * _pumping(c, 0.658, 0.31) / (1 + 0.29 * _inlet_heat(c) ** 0.78))


def rolling_in_warm_inlets(c: Contact, strength: float) -> Contact:
    """Goksem and Hargreaves with heat: f' = (R W/alpha) D^(52/79 + L^(20/63)/94) e^(-114/701)/(1 + (86/209) L^(70/99)).

    L = beta eta0 u^2/k; exponents as in Aihara's equation 20; D = 11.81 G U/W^1.5 for their isothermal limit.
    """
    size = c.rig.solid.reduced * c.rig.radius
    load, heat = c.line_load / size, _inlet_heat(c)
    thick = c.pressure_viscosity * c.rig.solid.reduced * c.viscosity * c.entrainment / size
    dynamic = 11.812 * thick / load**1.5
    grown = dynamic ** (52 / 79 + heat ** (20 / 63) / 94) * np.exp(-114 / 701) / (1 + 86 / 209 * heat ** (70 / 99))
    return _resisted(c, strength * load * grown * c.rig.radius / c.pressure_viscosity)


def elastic_hysteresis(c: Contact, strength: float) -> Contact:
    """A share 0.01 s of the elastic energy passing through is lost: f' = 0.01 s w b/(3 pi R) on either body."""
    return _resisted(c, 0.01 * strength * c.half_width * c.line_load / (3 * np.pi * c.rig.radius))


def elastic_damping(c: Contact, strength: float, power: float) -> Contact:
    """Lazan: metals damp with a power n of stress between 2 and 3; energy share lost 0.01 s (p0/1 GPa)^(n - 2)."""
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


def _each_wheel(c: Contact) -> tuple[tuple[float, np.ndarray, float], ...]:
    """Pitch radius (m), angular speed (rad/s) and teeth of both wheels, the pinion first."""
    extras, pinion = c.rig.extras, _rpm(c) * np.pi / 30
    return (
        (0.5 * extras["pitch_diameter"], pinion, extras["teeth"]),
        (0.5 * extras["wheel_diameter"], pinion * extras["ratio"], extras["teeth"] / extras["ratio"]),
    )


def windage_of_teeth(c: Contact, strength: float) -> Contact:
    """Diab: 0.5 C rho w^3 R^5 a wheel, C = 60 Re^-0.25 (b/R)^0.8 z^-0.4 2 (h/R)^0.56, h = R/2, mist of 5 x air.

    Re = rho w R^2/eta with air of 1.2 kg/m3 and 1.8e-5 Pa s.
    """
    total = np.zeros(len(c.recorded))
    for radius, speed, teeth in _each_wheel(c):
        reynolds = 1.2 * speed * radius**2 / 1.8e-5
        drag = 120 * 0.5**0.56 * reynolds**-0.25 * (c.rig.width / radius) ** 0.8 * teeth**-0.4
        total = total + 0.5 * drag * 1.2 * speed**3 * radius**5
    return _added(c, 5 * strength * total)


def _dipping(c: Contact) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Half rho w^3 R^3 S of a wheel dipping by half its radius (W), Froude and Reynolds numbers, width/diameter."""
    (radius, speed, teeth) = _each_wheel(c)[1]
    nu, width = 1e-6 * _viscosity_mm2_s(c), c.rig.width
    wetted = np.arccos(0.5)
    flanks = 2 * teeth * width * 2.25 * c.rig.extras["module"] * wetted / (np.pi * np.cos(np.radians(20.0)))
    area = radius**2 * (2 * wetted - np.sin(2 * wetted)) + 2 * radius * width * wetted + flanks
    power = 0.5 * c.rig.oil.density_at(c.rig.temperature) * speed**3 * radius**3 * area
    return power, speed**2 * radius / 9.81, speed * radius**2 / nu, width / (2 * radius)


def churning_of_splash(c: Contact, strength: float) -> Contact:
    """Changenet and Velex, slow: 0.5 rho w^3 R^3 S C, C = 1.366 (h/D)^0.45 (V/D^3)^0.1 Fr^-0.6 Re^-0.21, h = D/4.

    The wheel dips into 1.5 D^3 of oil.
    """
    power, froude, reynolds, _ = _dipping(c)
    return _added(c, strength * power * 1.366 * 0.25**0.45 * 1.5**0.1 * froude**-0.6 * reynolds**-0.21)


def churning_past_splash(c: Contact, strength: float) -> Contact:
    """Changenet and Velex: the slow law, and C = 3.644 (h/D)^0.1 (V/D^3)^-0.35 Fr^-0.88 (b/D)^0.85 at speed.

    Linear transition for w^2 (R b m)^(1/3) between 750 and 1250 m/s2.
    """
    power, froude, reynolds, slim = _dipping(c)
    radius, speed, _ = _each_wheel(c)[1]
    flung = np.clip((speed**2 * np.cbrt(radius * c.rig.width * c.rig.extras["module"]) - 750) / 500, 0.0, 1.0)
    slow = 1.366 * 0.25**0.45 * 1.5**0.1 * froude**-0.6 * reynolds**-0.21
    fast = 3.644 * 0.25**0.1 * 1.5**-0.35 * froude**-0.88 * slim**0.85
    return _added(c, strength * power * ((1 - flung) * slow + flung * fast))


def churning_of_standard(c: Contact, strength: float) -> Contact:
    """ISO/TR 14179-1: P = 12 W strength (n/1500 rpm)^3 (nu/15 mm2/s), with its powers of speed and viscosity."""
    return _added(c, 12 * strength * (_rpm(c) / 1500) ** 3 * _viscosity_mm2_s(c) / 15)


def churning_of_boness(c: Contact, strength: float, reynolds: float) -> Contact:
    """Boness: w^3 C, C = 20/Re below 2000, 8.6e-4 Re^(1/3) to 1e5, 5e8/Re^2 beyond; 12 W at 1500 rpm, 15 mm2/s, Re 1e4.

    ``reynolds``: Re/1e4 at 1500 rpm and 15 mm2/s; in the middle range thin oil is churned more than thick oil.
    """
    n = _rpm(c) / 1500
    number = 1e4 * reynolds * n / (_viscosity_mm2_s(c) / 15)
    drag = np.where(number < 2000, 20 / number, np.where(number < 1e5, 8.6e-4 * np.cbrt(number), 5e8 / number**2))
    return _added(c, 12 * strength * _heavy(c) * n**3 * drag / (8.6e-4 * np.cbrt(1e4)))


def churning(c: Contact, strength: float, speed_power: float, viscosity_power: float) -> Contact:
    """Dip loss by a fit to dip tests: P = 12 W strength (n/1500 rpm)^a (nu/15 mm2/s)^q."""
    power = (_rpm(c) / 1500) ** speed_power * (_viscosity_mm2_s(c) / 15) ** viscosity_power
    return _added(c, 12 * strength * power)


def churning_of_rim_and_faces(c: Contact, strength: float, rim: float) -> Contact:
    """Seetharaman and Kahraman: a film at the rim, n^2 nu, and turbulent layers at the faces, n^2.86 nu^0.14.

    12 W strength at 1500 rpm and 15 mm2/s, a share ``rim`` at the rim; both are proportional to the density.
    """
    n, nu = _rpm(c) / 1500, _viscosity_mm2_s(c) / 15
    return _added(c, 12 * strength * _heavy(c) * (rim * n**2 * nu + (1 - rim) * n**2.86 * nu**0.14))


DISC_TRANSITION = (3.70 / 0.102) ** (1 / 0.3)


def churning_past_transition(c: Contact, strength: float, transition: float) -> Contact:
    """Layers on the faces that turn turbulent: moment over rho omega^2 as Re^-1/2, past a Reynolds number as Re^-1/5.

    Daily and Nece 1960, enclosed discs with separate layers: 3.70 (s/a)^0.1 Re^-1/2 and 0.102 (s/a)^0.1 Re^-1/5, which
    meet at 1.6e5; a stirred bath is turbulent sooner. ``transition``: n/1500 rpm over nu/15 mm2/s at this point. 12 W
    strength at 1500 rpm and 15 mm2/s in the laminar layer, with the density. Coefficients and exponents are from
    memory, not checked against the paper.

    >>> round(DISC_TRANSITION, -3)
    158000.0
    """
    n, nu = _rpm(c) / 1500, _viscosity_mm2_s(c) / 15
    turning = n / nu
    moment = np.where(turning < transition, turning**-0.5, transition**-0.3 * turning**-0.2)
    return _added(c, 12 * strength * _heavy(c) * n**3 * moment)


def bearing_drag(c: Contact, strength: float, sliding_share: float) -> Contact:
    """SKF-like ball bearings: rolling phi_ish phi_rs F^0.54 (nu n)^0.6 plus sliding F^(5/3) mu_sl.

    F the tooth force; mean diameter 50 mm; ``sliding_share``: moment at 150 Nm over rolling at 1500 rpm and 15 mm2/s.
    """
    return _on_bearings(c, strength, sliding_share, 3.1, 0.05, (0.54, 5 / 3))


def bearing_drag_of_rollers(c: Contact, strength: float, sliding_share: float) -> Contact:
    """SKF-like roller bearings: rolling phi_ish phi_rs F^0.31 (nu n)^0.6 plus sliding F mu_sl.

    Sliding friction is 0.02 in a full film; otherwise as for ball bearings.
    """
    return _on_bearings(c, strength, sliding_share, 5.1, 0.02, (0.31, 1))


def _on_bearings(
    c: Contact,
    strength: float,
    sliding_share: float,
    geometry: float,
    film_friction: float,
    powers: tuple[float, float],
) -> Contact:
    """Contact with the moments of SKF's model, rolling and sliding each with its power of the tooth force."""
    n, nu, size = _rpm(c), _viscosity_mm2_s(c), 50.0
    shear = 1 / (1 + 1.84e-9 * (n * size) ** 1.28 * nu**0.64)
    starved = np.exp(-3e-8 * nu * n * 100 * np.sqrt(geometry / (2 * 40.0)))
    load = c.rig.conditions["torque_Nm"].astype(float) / 150
    boundary = np.exp(-2.6e-8 * (n * nu) ** 1.4 * size)
    sliding = (0.12 * boundary + film_friction * (1 - boundary)) / film_friction
    rolled = shear * starved * load ** powers[0] * (n * nu / 22500) ** 0.6
    moment = rolled + sliding_share * sliding * load ** powers[1]
    return _added(c, strength * 0.08 * moment * n * np.pi / 30)


def bearing_drag_of_palmgren(c: Contact, strength: float, loaded: float) -> Contact:
    """Palmgren: M_0 = 1e-7 f_0 (nu n)^(2/3) d^3 N mm, constant below nu n = 2000, and M_1 = f_1 F d.

    f_0 = 2, d = 50 mm; both shafts, F the tooth force; ``loaded``: M_1 at 150 Nm over M_0 at 1500 rpm and 15 mm2/s.
    """
    load, total = c.rig.conditions["torque_Nm"].astype(float) / 150, np.zeros(len(c.recorded))
    for ratio in (1.0, c.rig.extras["ratio"]):
        motion = np.maximum(_rpm(c) * ratio * _viscosity_mm2_s(c), 2000.0)
        moment = motion ** (2 / 3) + loaded * load * 22500 ** (2 / 3)
        total = total + 2e-10 * 50**3 * moment * _rpm(c) * ratio * np.pi / 30
    return _added(c, 2 * strength * total)


def seal_drag_of_standard(c: Contact, strength: float) -> Contact:
    """ISO/TR 14179-2: 7.69e-6 d^2 n W per shaft (mm, rpm) in a lip seal, d = 35 mm, for any oil."""
    return _added(c, strength * 7.69e-6 * 35.0**2 * _rpm(c) * (1 + c.rig.extras["ratio"]))


def seal_drag(c: Contact, strength: float) -> Contact:
    """Lip seals soften in heat (Linke): (145 - 1.6 T + 350 loglog(nu40 + 0.8)) d^2 n 1e-7 W, d 35 mm."""
    nu40 = 1e6 * c.rig.oil.kinematic_at(np.array(40.0))
    warm = np.maximum(145 - 1.6 * c.rig.temperature + 350 * np.log10(np.log10(nu40 + 0.8)), 5.0)
    return _added(c, strength * warm * 35.0**2 * _rpm(c) * 1e-7)


EFFECTS = (
    Form("rolling_resistance", "loss", rolling_resistance, (strength(0.0, 8.0),), "Goksem and Hargreaves 1978"),
    Form("rolling_resistance", "loss", rolling_free_of_load, (strength(0.0, 8.0),), "Biboulet and Houpert 2010",
         within=True, holds="W above 1e-4"),
    Form("rolling_resistance", "loss", rolling_under_load, (strength(0.0, 8.0),), "Zhou and Hoeprich 1991",
         holds="W 1e-4 to 4e-4"),
    Form("rolling_resistance", "loss", rolling_as_bearings_are_tested, (strength(0.0, 8.0),), "Aihara 1987"),
    Form("rolling_resistance", "loss", rolling_in_warm_inlets, (strength(0.0, 8.0),),
         "Goksem and Hargreaves 1978, heated inlet", holds="L up to 5000"),
    Form("windage", "loss", windage, (strength(0.0, 200.0),), "Dawson 1984", within=True),
    Form("windage", "loss", windage_of_teeth, (strength(0.0, 200.0),), "Diab et al. 2004", within=True),
    Form("windage", "loss", windage_in_mist, (strength(0.0, 200.0),), "Anderson and Loewenthal 1980"),
    Form("churning", "loss", churning, (strength(0.0, 20.0), Knob("speed_power", 1.2, 2.4, (1.3, 2.1)),
         Knob("viscosity_power", 0.05, 0.4, (0.08, 0.3))), "power-law fit of dip tests", within=True),
    Form("churning", "loss", churning_of_rim_and_faces, (strength(0.0, 20.0), Knob("rim", 0.0, 1.0, (0.15, 0.5))),
         "Seetharaman and Kahraman 2009"),
    Form("churning", "loss", churning_of_splash, (strength(0.0, 20.0),), "Changenet and Velex 2007, slow",
         within=True, holds="up to 750 m/s2"),
    Form("churning", "loss", churning_past_splash, (strength(0.0, 20.0),), "Changenet and Velex 2007", within=True),
    Form("churning", "loss", churning_of_standard, (strength(0.0, 20.0),), "ISO/TR 14179-1", within=True),
    Form("churning", "loss", churning_of_boness, (strength(0.0, 20.0), Knob("reynolds", 0.1, 20.0, (0.5, 4.0))),
         "Boness 1989"),
    Form("churning", "loss", churning_past_transition, (strength(0.0, 20.0),
         Knob("transition", 0.2, 20.0, (0.8, 3.0))), "discs in a housing, Daily and Nece 1960"),
    Form("bearing_drag", "loss", bearing_drag, (strength(0.0, 20.0), Knob("sliding_share", 0.0, 2.0, (0.2, 0.8))),
         "SKF friction model form"),
    Form("bearing_drag", "loss", bearing_drag_of_rollers, (strength(0.0, 20.0),
         Knob("sliding_share", 0.0, 2.0, (0.2, 0.8))), "SKF friction model, roller bearings"),
    Form("bearing_drag", "loss", bearing_drag_of_palmgren, (strength(0.0, 20.0),
         Knob("loaded", 0.0, 4.0, (0.3, 1.5))), "Palmgren 1964", within=True),
    Form("seal_drag", "loss", seal_drag, (strength(0.0, 20.0),), "Linke 1971"),
    Form("seal_drag", "loss", seal_drag_of_standard, (strength(0.0, 20.0),), "ISO/TR 14179-2", within=True),
    Form("elastic_hysteresis", "loss", elastic_hysteresis, (strength(0.0, 40.0, (0.8, 2.0)),),
         "elastic energy share", rarity=0.4, within=True),
    Form("elastic_hysteresis", "loss", elastic_damping, (strength(0.0, 40.0, (0.8, 2.0)),
         Knob("power", 2.0, 3.0, (2.3, 3.0))), "Lazan 1968", rarity=0.4),
)  # fmt: skip
