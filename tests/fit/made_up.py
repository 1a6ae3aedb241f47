"""Made-up readings of known laws, each law written again from its source, in the units of the table."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

Table = dict[str, np.ndarray]
NOISE = 0.02


@dataclass(frozen=True)
class MadeUp:
    """A law: its name in the package, the table of conditions, and the reading, with random constants."""

    law: str
    conditions: Callable[[np.random.Generator], Table]
    quantity: str
    reading: Callable[[Table, np.random.Generator], np.ndarray]
    constants: Mapping[str, float] = field(default_factory=dict)

    def table(self, seed: int) -> Table:
        """Conditions and readings with relative noise."""
        random = np.random.default_rng(seed)
        conditions = self.conditions(random)
        exact = np.asarray(self.reading(conditions, random), dtype=float)
        noisy = exact * (1.0 + NOISE * random.standard_normal(exact.size))
        return {**conditions, self.quantity: noisy}


def grid(**levels: np.ndarray) -> Table:
    """Every combination of levels."""
    axes = np.meshgrid(*levels.values(), indexing="ij")
    return {name: axis.ravel() for name, axis in zip(levels, axes, strict=True)}


# Oils: temperature in degC, pressure in MPa, viscosity in mPa s.
def temperatures(random: np.random.Generator) -> Table:
    return grid(temperature_C=np.linspace(-10.0, 130.0, 22) + random.uniform(-3.0, 3.0))


def both(random: np.random.Generator) -> Table:
    return grid(temperature_C=np.array([20.0, 40.0, 70.0, 100.0, 130.0]), pressure_MPa=np.linspace(0.1, 600.0, 6))


DENSITY = 860.0


def walther(t: np.ndarray, at_40: float, at_100: float) -> np.ndarray:
    kelvin = t + 273.15
    first, second = (np.log10(np.log10(nu + 0.7)) for nu in (at_40, at_100))
    slope = (first - second) / (np.log10(373.15) - np.log10(313.15))
    return 10.0 ** (10.0 ** (first - slope * (np.log10(kelvin) - np.log10(313.15)))) - 0.7


def oil_level(random: np.random.Generator) -> tuple[float, float]:
    at_40 = random.uniform(30.0, 300.0)
    return at_40, 0.45 * at_40**0.68


def by_d341(c: Table, random: np.random.Generator) -> np.ndarray:
    return walther(c["temperature_C"], *oil_level(random)) * DENSITY * 1e-3


def by_vogel(c: Table, random: np.random.Generator) -> np.ndarray:
    k, b, t0 = random.uniform(0.03, 0.1), random.uniform(800.0, 1100.0), random.uniform(-110.0, -90.0)
    return k * np.exp(b / (c["temperature_C"] - t0))


def by_andrade(c: Table, random: np.random.Generator) -> np.ndarray:
    return 1e-3 * np.exp(random.uniform(2900.0, 3600.0) / (c["temperature_C"] + 273.15))


def by_reynolds(c: Table, random: np.random.Generator) -> np.ndarray:
    return random.uniform(60.0, 300.0) * np.exp(-random.uniform(0.025, 0.04) * c["temperature_C"])


def by_slotte(c: Table, random: np.random.Generator) -> np.ndarray:
    return 50.0 * (90.0 / (c["temperature_C"] + 50.0)) ** random.uniform(2.5, 3.5)


def alpha(t: np.ndarray) -> np.ndarray:
    return 20.0 - 0.08 * (t - 40.0)


def by_walther_barus(c: Table, random: np.random.Generator) -> np.ndarray:
    return by_d341(c, random) * np.exp(alpha(c["temperature_C"]) * c["pressure_MPa"] * 1e-3)


def by_walther_roelands(c: Table, random: np.random.Generator) -> np.ndarray:
    eta = by_d341(c, random)
    size = np.log(eta * 1e-3) + 9.67
    z = alpha(c["temperature_C"]) * 0.196 / size
    return eta * np.exp(size * ((1.0 + c["pressure_MPa"] / 196.0) ** z - 1.0))


def by_houpert(c: Table, random: np.random.Generator) -> np.ndarray:
    eta0 = random.uniform(0.02, 0.08)
    size = np.log(eta0) + 9.67
    z, s0 = 18e-9 * 1.96e8 / size, 0.04 * (348.15 - 138.0) / size
    warm = ((c["temperature_C"] + 273.15 - 138.0) / (348.15 - 138.0)) ** -s0
    return 1e3 * eta0 * np.exp(size * ((1.0 + c["pressure_MPa"] / 196.0) ** z * warm - 1.0))


# Films: a ball or a roller; speed in m/s, load in N, viscosity in mPa s, coefficient in 1/GPa.
BALL = {"radius_mm": 9.525, "transverse_radius_mm": 9.525, "reduced_modulus_GPa": 117.0}
ROLLER = {"radius_mm": 12.0, "contact_width_mm": 8.0, "reduced_modulus_GPa": 226.0}
OIL = {"viscosity_mPa_s": np.array([80.0, 20.0, 6.0]), "pressure_viscosity_per_GPa": np.array([22.0, 18.0, 14.0])}


def _with_oil(table: Table) -> Table:
    """Three oils in turn."""
    size = next(iter(table.values())).size
    return {
        **{name: np.repeat(values, 3) for name, values in table.items()},
        **{name: np.tile(values, size) for name, values in OIL.items()},
    }


def balls(random: np.random.Generator) -> Table:
    return _with_oil(grid(entrainment_speed_m_s=np.geomspace(0.05, 3.0, 6), load_N=np.array([5.0, 20.0, 80.0])))


def rollers(random: np.random.Generator) -> Table:
    return _with_oil(grid(entrainment_speed_m_s=np.geomspace(0.3, 12.0, 6), load_N=np.array([300.0, 1000.0, 4000.0])))


def groups(c: Table, on: Mapping[str, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """U, G, W of a ball, or of a roller by its line load, and the radius in nm."""
    e, r = on["reduced_modulus_GPa"] * 1e9, on["radius_mm"] * 1e-3
    speed = c["viscosity_mPa_s"] * 1e-3 * c["entrainment_speed_m_s"] / (e * r)
    load = c["load_N"] / (e * r * (on["contact_width_mm"] * 1e-3 if "contact_width_mm" in on else r))
    return speed, c["pressure_viscosity_per_GPa"] * 1e-9 * e, load, r * 1e9


def powers(
    constant: float, u: float, g: float, w: float, on: Mapping[str, float]
) -> Callable[[Table, np.random.Generator], np.ndarray]:
    def film(c: Table, random: np.random.Generator) -> np.ndarray:
        speed, material, load, size = groups(c, on)
        return random.uniform(0.93, 1.07) * constant * size * speed**u * material**g * load**w

    return film


CIRCULAR = 2.69 * (1.0 - 0.61 * np.exp(-0.73 * 1.03))


def by_moes(c: Table, random: np.random.Generator) -> np.ndarray:
    speed, material, load, size = groups(c, ROLLER)
    m, n = load / np.sqrt(2.0 * speed), material * (2.0 * speed) ** 0.25
    ri, rp, ei, ep = 3.0 / m, 1.287 * n ** (2 / 3), 2.621 * m**-0.2, 1.311 * m**-0.125 * n**0.75
    s = (7.0 + 8.0 * np.exp(-2.0 * ei / ri)) / 5.0
    h = ((ri ** (7 / 3) + ei ** (7 / 3)) ** (3 * s / 7) + (rp**-3.5 + ep**-3.5) ** (-2 * s / 7)) ** (1 / s)
    return random.uniform(0.93, 1.07) * size * np.sqrt(2.0 * speed) * h


# Friction: a slider (speed in mm/s), a journal, discs, a mesh, a drive.
def slider(random: np.random.Generator) -> Table:
    return {"sliding speed (mm/s)": np.repeat(np.geomspace(2.0, 3000.0, 20), 2)}


def stribeck(shape: Callable[[np.ndarray], np.ndarray]) -> Callable[[Table, np.random.Generator], np.ndarray]:
    def friction(c: Table, random: np.random.Generator) -> np.ndarray:
        v = c["sliding speed (mm/s)"] * 1e-3
        low, fall, at = random.uniform(0.03, 0.06), random.uniform(0.05, 0.1), random.uniform(0.08, 0.3)
        return low + fall * shape(v / at) + random.uniform(0.005, 0.02) * v

    return friction


def by_coulomb(c: Table, random: np.random.Generator) -> np.ndarray:
    return random.uniform(0.03, 0.1) + random.uniform(0.01, 0.03) * c["sliding speed (mm/s)"] * 1e-3


def journal(random: np.random.Generator) -> Table:
    return grid(
        speed_rpm=np.geomspace(20.0, 3000.0, 8),
        **{"specific load (MPa)": np.array([0.5, 1.0, 2.0])},
        viscosity_mPa_s=np.array([20.0, 60.0]),
    )


def hersey(c: Table) -> np.ndarray:
    return c["viscosity_mPa_s"] * 1e-3 * c["speed_rpm"] * np.pi / 30.0 / (c["specific load (MPa)"] * 1e6)


def by_petroff(c: Table, random: np.random.Generator) -> np.ndarray:
    return np.pi / random.uniform(8e-4, 2e-3) * hersey(c)


def by_mckee(c: Table, random: np.random.Generator) -> np.ndarray:
    return random.uniform(0.001, 0.004) + np.pi / random.uniform(8e-4, 2e-3) * hersey(c)


def by_emmens(c: Table, random: np.random.Generator) -> np.ndarray:
    boundary, film = random.uniform(0.1, 0.15), random.uniform(0.01, 0.03)
    start, end = 3e-7 * random.uniform(0.7, 1.5), 1e-5 * random.uniform(0.7, 1.5)
    place = np.log10(hersey(c) ** 2 / (start * end)) / np.log10(start / end)
    return 0.5 * (boundary + film + (boundary - film) * np.tanh(place))


def by_bongaerts(c: Table, random: np.random.Generator) -> np.ndarray:
    h, at = hersey(c), 2e-6 * random.uniform(0.5, 2.0)
    film, boundary = 0.01 * (h / at) ** 0.55, random.uniform(0.1, 0.15) * (h / at) ** -0.05
    return film + (boundary - film) / (1.0 + (h / at) ** random.uniform(1.6, 2.6))


def discs(random: np.random.Generator) -> Table:
    return grid(
        load_N=np.array([500.0, 2000.0]),
        entrainment_speed_m_s=np.array([1.5, 4.0, 9.0]),
        slide_roll_ratio=np.array([0.1, 0.3, 0.8]),
        viscosity_mPa_s=np.array([8.0, 30.0]),
    )


DISCS = {
    **ROLLER,
    "composite_roughness_um": 0.3,
    "density_kg_m3": 860.0,
    "pressure_viscosity_per_GPa": 18.0,
}


def by_benedict(c: Table, random: np.random.Generator) -> np.ndarray:
    inch, u = 0.0254, c["entrainment_speed_m_s"]
    w = c["load_N"] / 8e-3 / 175.12684
    slide, roll = c["slide_roll_ratio"] * u / inch, 2.0 * u / inch
    rough = 50.0 / (50.0 - 0.3 / 0.0254)
    return 0.0127 * rough * np.log10(3.17e8 * w / (c["viscosity_mPa_s"] * slide * roll**2))


def by_tc60(c: Table, random: np.random.Generator) -> np.ndarray:
    w = c["load_N"] / 8.0
    return 0.12 * (w * 0.3 / (12.0 * 2.0 * c["entrainment_speed_m_s"] * c["viscosity_mPa_s"])) ** 0.25


def by_misharin(c: Table, random: np.random.Generator) -> np.ndarray:
    u = c["entrainment_speed_m_s"]
    return 0.325 * (c["slide_roll_ratio"] * u * 2.0 * u * c["viscosity_mPa_s"] / 0.86) ** -0.25


def by_xu(c: Table, random: np.random.Generator) -> np.ndarray:
    s, u, eta = c["slide_roll_ratio"], c["entrainment_speed_m_s"], c["viscosity_mPa_s"]
    p = np.sqrt(c["load_N"] / 8e-3 * 226e9 / (2.0 * np.pi * 12e-3)) * 1e-9
    b = (-8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958, 0.620305)
    x = s * p * np.log10(eta)
    f = b[0] + b[3] * x + b[4] * np.exp(-x) + b[8] * np.exp(0.3)
    return np.exp(f) * p ** b[1] * s ** b[2] * u ** b[5] * eta ** b[6] * 12e-3 ** b[7]


def mesh(random: np.random.Generator) -> Table:
    return grid(
        mesh_line_load_N_mm=np.array([100.0, 250.0, 500.0]),
        pitch_entrainment_speed_m_s=np.array([0.8, 2.5, 8.0]),
        viscosity_mPa_s=np.array([8.0, 25.0, 80.0]),
        mean_roughness_um=np.array([0.2, 0.6]),
    )


def by_schlenk(c: Table, random: np.random.Generator) -> np.ndarray:
    load = c["mesh_line_load_N_mm"] / (2.0 * c["pitch_entrainment_speed_m_s"] * 8.4)
    return 0.048 * random.uniform(0.7, 1.0) * load**0.2 * c["viscosity_mPa_s"] ** -0.05 * c["mean_roughness_um"] ** 0.25


def drive(random: np.random.Generator) -> Table:
    speed = np.geomspace(1.0, 60.0, 14)
    return {"speed_rpm": np.concatenate([-speed[::-1], speed])}


def by_gauss_drive(c: Table, random: np.random.Generator) -> np.ndarray:
    w = c["speed_rpm"] * np.pi / 30.0
    size = random.uniform(1.0, 3.0)
    return size * np.sign(w) * (1.0 + 0.6 * np.exp(-((np.abs(w) / random.uniform(0.5, 1.2)) ** 2)) + 0.05 * np.abs(w))


MADE_UP = (
    MadeUp("d341", temperatures, "viscosity_mPa_s", by_d341, {"density_kg_m3": DENSITY}),
    MadeUp("vogel", temperatures, "viscosity_mPa_s", by_vogel, {"density_kg_m3": DENSITY}),
    MadeUp("andrade", temperatures, "viscosity_mPa_s", by_andrade, {"density_kg_m3": DENSITY}),
    MadeUp("barus", temperatures, "viscosity_mPa_s", by_reynolds, {"density_kg_m3": DENSITY}),
    MadeUp("slotte", temperatures, "viscosity_mPa_s", by_slotte, {"density_kg_m3": DENSITY}),
    MadeUp("d341_barus", both, "viscosity_mPa_s", by_walther_barus, {"density_kg_m3": DENSITY}),
    MadeUp("d341_roelands", both, "viscosity_mPa_s", by_walther_roelands, {"density_kg_m3": DENSITY}),
    MadeUp("roelands", both, "viscosity_mPa_s", by_houpert, {"density_kg_m3": DENSITY}),
    MadeUp("hamrock_dowson", balls, "film_thickness_nm", powers(CIRCULAR, 0.67, 0.53, -0.067, BALL), BALL),
    MadeUp("dowson_toyoda_central", rollers, "film_thickness_nm", powers(3.06, 0.69, 0.56, -0.10, ROLLER), ROLLER),
    MadeUp("dowson_higginson_minimum", rollers, "film_thickness_nm", powers(2.65, 0.70, 0.54, -0.13, ROLLER), ROLLER),
    MadeUp("pan_and_hamrock", rollers, "film_thickness_nm", powers(2.922, 0.692, 0.470, -0.166, ROLLER), ROLLER),
    MadeUp("grubin", rollers, "film_thickness_nm", powers(1.95, 8 / 11, 8 / 11, -1 / 11, ROLLER), ROLLER),
    MadeUp("moes", rollers, "film_thickness_nm", by_moes, ROLLER),
    MadeUp("tustin", slider, "friction_coefficient", stribeck(lambda x: np.exp(-x))),
    MadeUp("gauss", slider, "friction_coefficient", stribeck(lambda x: np.exp(-(x**2)))),
    MadeUp("bo_pavelescu", slider, "friction_coefficient", stribeck(lambda x: np.exp(-(x**0.5)))),
    MadeUp("hess_soom", slider, "friction_coefficient", stribeck(lambda x: 1.0 / (1.0 + x**2))),
    MadeUp("coulomb_viscous", slider, "friction_coefficient", by_coulomb),
    MadeUp("petroff", journal, "friction_coefficient", by_petroff),
    MadeUp("mckee", journal, "friction_coefficient", by_mckee),
    MadeUp("emmens", journal, "friction_coefficient", by_emmens),
    MadeUp("bongaerts", journal, "friction_coefficient", by_bongaerts),
    MadeUp("benedict_kelley", discs, "friction_coefficient", by_benedict, DISCS),
    MadeUp("iso_tc60", discs, "friction_coefficient", by_tc60, DISCS),
    MadeUp("misharin", discs, "friction_coefficient", by_misharin, DISCS),
    MadeUp("xu_kahraman", discs, "friction_coefficient", by_xu, DISCS),
    MadeUp("schlenk", mesh, "friction_coefficient", by_schlenk, {"pitch_radius_mm": 8.4}),
    MadeUp("gauss", drive, "friction_torque_Nm", by_gauss_drive),
)
