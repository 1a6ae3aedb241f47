"""Films read by interferometry: a ball on a glass disc, speeds over three decades, a few temperatures."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.contact import Calibration, Contact, Inputs, start
from mixedlub.validation.disclosure import with_data_sheet, without_data_sheet
from mixedlub.validation.planted import viscosity_temperature
from mixedlub.validation.planted.film import OF_LOCAL_CONTACTS
from mixedlub.validation.planted.measurement import channel
from mixedlub.validation.rig import Form, Knob, Rig, play, strength
from mixedlub.validation.rigs.ball import film_chain, inputs_of, lubricate_ball_in_any_regime
from mixedlub.validation.sample_rig import between, draw_oil, pick, progress, repeated, rounded

PAIRS = (
    ("inlet_shear_heating", "boundary_film"),
    ("starvation", "boundary_film"),
    ("inlet_shear_thinning", "sensor_offset"),
    ("inlet_shear_heating", "fringe_order"),
    ("starvation", "zero_drift"),
    ("viscosity_temperature_law", "zero_drift"),
)
NEEDS_DATA_SHEET = frozenset({"sensor_gain"})
"""Faults invisible for an oil without data sheet, since its viscosity level is free."""


def joined_by_cubes(c: Contact, strength: float) -> Contact:
    """A layer of 8 nm strength below the fluid film: the cube root of the sum of cubes."""
    return replace(c, film=np.cbrt(c.film**3 + (8e-9 * strength) ** 3))


def squeezed_out(c: Contact, strength: float) -> Contact:
    """A layer of 8 nm strength that gives way to the growing fluid film: h + b e^(-h/(3 b))."""
    if strength <= 0:
        return c
    layer = 8e-9 * strength
    return replace(c, film=c.film + layer * np.exp(-c.film / (3 * layer)))


def thickened_near_the_wall(c: Contact, strength: float, gain: float) -> Contact:
    """Oil within 12 nm strength of the walls is ``gain`` times as viscous: h times its share's 0.67th power."""
    if strength <= 0:
        return c
    near = np.exp(-c.film / (12e-9 * strength))
    return replace(c, film=c.film * (1 + (gain - 1) * near) ** 0.67)


def even_growth(c: Contact, strength: float) -> Contact:
    """eta (1 + 0.2 strength s), s from 0 to 1 over the programme."""
    return replace(c, viscosity=c.viscosity * np.clip(1 + 0.2 * strength * c.rig.sequence, 0.05, None)[:, None])


def slowing_growth(c: Contact, strength: float) -> Contact:
    """eta exp(0.2 strength s^0.5)."""
    return replace(c, viscosity=c.viscosity * np.exp(0.2 * strength * np.sqrt(c.rig.sequence))[:, None])


def orders(film_nm: np.ndarray, spacer: float, period: float) -> np.ndarray:
    """Interference order of a film over a spacer layer, both optical paths over half a wavelength."""
    return np.floor((film_nm + spacer) / period)


def _oil_forms() -> tuple[Form, ...]:
    layer = (strength(0.0, 8.0),)
    gain = Knob("gain", 1.2, 8.0, (1.5, 4.0))
    drift = (strength(-4.0, 4.0),)
    return (
        Form("boundary_film", "film", joined_by_cubes, layer, "cubes joined", within=True),
        Form("boundary_film", "film", squeezed_out, layer, "layer that is squeezed out"),
        Form("boundary_film", "film", thickened_near_the_wall, (*layer, gain), "Smeeth, Spikes and Gunsel 1996"),
        Form("viscosity_drift", "oil", even_growth, drift, "evaporation at an even pace", rarity=0.5),
        Form("viscosity_drift", "oil", slowing_growth, drift, "diffusion-limited", rarity=0.5),
    )


def _fringe_forms(spacer: float, period: float, onset: tuple[float, float], counted: bool) -> tuple[Form, ...]:
    def past_first(c: Contact) -> np.ndarray:
        count = orders(1e9 * c.film[:, 0], spacer, period)
        return np.asarray(count - count.min())

    def one_order(c: Contact, strength: float, onset: float) -> Contact:
        """Above a film thickness (nm) the count is off by a whole order."""
        return replace(c, recorded=c.recorded + strength * period * (c.recorded > onset))

    def each_order(c: Contact, strength: float) -> Contact:
        """Every order adds the same 10 nm strength."""
        return replace(c, recorded=c.recorded + 10 * strength * past_first(c))

    def growing(c: Contact, strength: float, growth: float) -> Contact:
        """The error of the index: later orders add more than the first."""
        place = past_first(c)
        return replace(c, recorded=c.recorded + 10 * strength * place * (1 + growth * (place - 1)))

    step = strength(-6.0, 6.0, (0.4, 1.2))
    forms = [
        Form("fringe_order", "sensor", one_order,
             (strength(-1.0, 2.0, (1.0, 1.0)), Knob("onset", 0.5 * onset[0], onset[1], onset)), "one order miscounted",
             rigid=True, within=True),
    ]  # fmt: skip
    if counted:
        forms.append(Form("fringe_step", "sensor", each_order, (step,), "even steps", within=True))
        forms.append(
            Form("fringe_step", "sensor", growing, (step, Knob("growth", 0.0, 0.3, (0.05, 0.2))), "steps that grow")
        )
    return tuple(forms)


def _span(values: np.ndarray) -> np.ndarray:
    """Place between the smallest and the largest value, on a log scale."""
    logs = np.log(values)
    return np.asarray((logs - logs.min()) / max(np.ptp(logs), 1e-9))


def _outside(columns: dict[str, np.ndarray]) -> tuple[Form, ...]:
    place = _span(columns["entrainment_speed_m_s"])[:, None]
    slip = np.abs(columns["slide_roll_ratio"])[:, None]
    load = columns["load_N"][:, None]
    time = columns["sequence"][:, None]
    celsius = columns["oil_temperature_C"][:, None]

    def trembling(c: Contact, strength: float, centre: float, width: float) -> Contact:
        """The rig resonates in one band of speed and the mean film deviates."""
        return replace(c, film=c.film * (1 + 0.1 * strength * np.exp(-0.5 * ((place - centre) / width) ** 2)))

    def waves(c: Contact, strength: float, count: float) -> Contact:
        return replace(c, film=c.film * (1 + 0.08 * strength * np.sin(2 * np.pi * count * place)))

    def refilled(c: Contact, strength: float, when: float) -> Contact:
        """Another oil from one moment on."""
        return replace(c, film=c.film * (1 + 0.1 * strength * (time > when)))

    def slip_lifts(c: Contact, strength: float) -> Contact:
        """Sliding thickens the film."""
        return replace(c, film=c.film * (1 + 0.2 * strength * slip**1.5))

    def load_squeezes(c: Contact, strength: float) -> Contact:
        """The film falls with load much faster than it should."""
        return replace(c, film=c.film * (load / load.min()) ** (-0.15 * strength))

    def one_bath(c: Contact, strength: float) -> Contact:
        """The bath temperature deviates from its thermometer at the middle level."""
        levels = np.unique(celsius)
        return replace(c, film=c.film * (1 + 0.1 * strength * (celsius == levels[len(levels) // 2])))

    either = strength(-6.0, 8.0)
    forms = [
        Form("trembling", "film", trembling,
             (either, Knob("centre", 0.2, 0.8, (0.3, 0.7)), Knob("width", 0.05, 0.15, (0.06, 0.12))), "constructed"),
        Form("waves", "film", waves, (either, Knob("count", 1.2, 3.0, (1.5, 2.5))), "constructed"),
    ]  # fmt: skip
    if abs(np.corrcoef(time[:, 0], place[:, 0])[0, 1]) < 0.5:
        forms.append(Form("refilled", "film", refilled, (either, Knob("when", 0.2, 0.8, (0.3, 0.7))), "constructed"))
    if len(np.unique(slip)) > 2:
        forms.append(Form("slip_lifts", "film", slip_lifts, (strength(0.0, 8.0),), "constructed"))
    if len(np.unique(load)) > 2:
        forms.append(Form("load_squeezes", "film", load_squeezes, (strength(0.0, 6.0),), "constructed"))
    if len(np.unique(celsius)) > 2:
        forms.append(Form("one_bath", "film", one_bath, (either,), "constructed"))
    return tuple(forms)


def _programme(rng: np.random.Generator) -> tuple[dict[str, np.ndarray], bool]:
    speeds = np.geomspace(between(rng, 0.002, 0.03), between(rng, 1.0, 4.0), int(rng.integers(15, 31)))
    speeds = np.array([rounded(u) for u in speeds])
    baths = pick(
        rng,
        ([between(rng, 25, 60, 2)], [40.0, 100.0], [40.0, 80.0, 120.0], [30.0, 60.0, 90.0], [20.0, 60.0, 100.0, 140.0]),
    )
    loads = [rounded(x) for x in pick(rng, ([between(rng, 20, 50, 2)], [20.0, 50.0], [10.0, 25.0, 60.0]))]
    slips = pick(rng, ([0.0], [0.0], [0.0, 0.5], [0.0, 0.25, 0.5, 1.0]))
    if len(baths) * len(loads) * len(slips) > 6:
        loads, slips = loads[:1], slips[:1]
    grid = np.array([(u, t, f, s) for t in baths for f in loads for s in slips for u in speeds])
    order = str(pick(rng, ("up", "shuffled", "up and down")))
    if order == "up and down":
        grid = np.concatenate([grid[::2], grid[1::2][::-1]])
    if order == "shuffled":
        grid = grid[rng.permutation(len(grid))]
    columns = {
        "load_N": grid[:, 2],
        "entrainment_speed_m_s": grid[:, 0],
        "slide_roll_ratio": grid[:, 3],
        "oil_temperature_C": grid[:, 1],
    }
    again = len(grid) <= 60 and rng.random() < 0.2
    columns = repeated(columns, 3 if again else 1)
    columns["sequence"] = progress(len(columns["run"]))
    return columns, again


def _interferometer(rng: np.random.Generator) -> tuple[Inputs, dict[str, Any], dict[str, np.ndarray], bool]:
    """A steel ball on a disc, oil and programme: rig, case with all known data, columns, repeats."""
    columns, again = _programme(rng)
    disc = pick(rng, ((75.0, 0.22), (81.0, 0.21), (430.0, 0.25)))
    priors = {"viscosity": pick(rng, (0.05, 0.1, 0.2)), "pressure_viscosity": pick(rng, (0.06, 0.12))}
    settings: dict[str, Any] = {
        "schema": "mixedlub-case/1",
        "kind": "film",
        "contact": {
            "geometry": "point",
            "radius_mm": [pick(rng, (9.525, 9.525, 12.7)), float("inf")],
            "youngs_modulus_GPa": [207.0, disc[0]],
            "poisson_ratio": [0.3, disc[1]],
        },
        "lubricant": draw_oil(rng),
        "uncertainty": priors,
        "recording": {"quantity": "film_thickness_nm"},
    }
    return inputs_of(settings, columns, np.ones(3) * 1e-12), settings, columns, again


def draw(rng: np.random.Generator) -> Rig:
    """An interferometer with known oil; films by the regression, its exponent within the spread of published values."""
    inputs, settings, columns, again = _interferometer(rng)
    priors = settings["uncertainty"]
    disclosed = with_data_sheet(inputs, priors["viscosity"], priors["pressure_viscosity"])
    rig = Rig(
        settings=settings,
        columns=columns,
        names=disclosed.names,
        model=disclosed.model,
        theta=lambda z: {f"{name}_scale": value for name, value in disclosed.factors(z).items()},
        forms=viscosity_temperature.of_contacts(inputs),
        outside=(),
        repeats=again,
    )
    return read_by(rng, rig, True)


def draw_without_data_sheet(rng: np.random.Generator) -> Rig:
    """An interferometer with unknown oil; films by the law of all regimes at its true properties."""
    inputs, settings, columns, again = _interferometer(rng)
    disclosed, sections = without_data_sheet(rng, inputs)
    kept = {name: table for name, table in settings.items() if name not in ("lubricant", "uncertainty")}
    start_of = start(inputs, Calibration())
    chain = film_chain(lubricate_ball_in_any_regime)
    rig = Rig(
        settings={**kept, **sections},
        columns=columns,
        names=disclosed.names,
        model=disclosed.model,
        theta=lambda z: {},
        forms=viscosity_temperature.of_unknown_oil(inputs, "lubricant" in sections),
        outside=(),
        repeats=again,
        planted=lambda acts: np.asarray(play(chain, start_of, acts).recorded),
    )
    return read_by(rng, rig, False)


def read_by(rng: np.random.Generator, rig: Rig, sheet: bool) -> Rig:
    """Rig with its instrument and all possible effects; a wrong span is visible only with a data ``sheet``."""
    columns = rig.columns
    nominal = rig.records(np.zeros(len(rig.names)), ())
    period, spacer = rounded(rng.uniform(185, 215)), rounded(rng.uniform(100, 500))
    counted = bool(np.ptp(orders(nominal, spacer, period)) >= 2 and rng.random() < 0.6)

    def settle(values: np.ndarray) -> dict[str, np.ndarray]:
        return {"fringe_order": orders(values, spacer, period)} if counted else {}

    top = float(np.quantile(nominal, 0.93))
    onset = (float(np.quantile(nominal, 0.6)), top) if top > period else (0.6 * top, top)
    forms = (
        OF_LOCAL_CONTACTS
        + _oil_forms()
        + rig.forms
        + _fringe_forms(spacer, period, onset, counted)
        + channel(columns["sequence"], True, sheet, True)
    )
    return replace(rig, forms=forms, outside=_outside(columns), quantile=0.1, floor=(0.1, 1.0), settle=settle)
