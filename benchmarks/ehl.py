"""How fast line contacts are solved, and how many of random ones: `name, figure, unit, ratio to what is asked for`.

Above one is better than asked. Times of one contact are medians on one core; batches share the cores of the machine.
"""

from __future__ import annotations

import statistics
import time

import numpy as np
from threadpoolctl import threadpool_limits

import mixedlub as ml
from mixedlub.ehl import Oil

CONTACTS = 200
ALONE = 40
"""Contacts of which each is solved alone."""


def line(name: str, figure: float, unit: str, ratio: float) -> None:
    """Print one result."""
    print(f"{name}, {figure:.4g}, {unit}, {ratio:.3g}", flush=True)


def isothermal_contacts(oil: Oil) -> dict[str, np.ndarray]:
    """Contacts with M of 1 to 300 and L of 3 to 22, spread evenly over the logarithm of M and over L."""
    random = np.random.default_rng(1)
    load, material = 10.0 ** random.uniform(0.0, np.log10(300.0), CONTACTS), random.uniform(3.0, 22.0, CONTACTS)
    viscosity, coefficient = oil.at_ambient(np.array(333.15))
    modulus, radius = 226.37e9, 0.01
    twice = (material / (coefficient * modulus)) ** 4.0
    speed = twice * modulus * radius / (2.0 * viscosity)
    return {"radius": np.array(radius), "line_load": load * np.sqrt(twice) * modulus * radius, "speed": speed}


def thermal_contacts() -> dict[str, np.ndarray]:
    """Contacts of gears: 0.3 to 2 GPa, 1 to 30 m/s, slide-roll ratios to 1.2, oil of 50 to 110 degC."""
    random = np.random.default_rng(2)
    radius = 10.0 ** random.uniform(-2.5, -1.4, CONTACTS)
    pressure, speed = random.uniform(0.3e9, 2.0e9, CONTACTS), 10.0 ** random.uniform(0.0, 1.5, CONTACTS)
    return {
        "radius": radius,
        "line_load": 2.0 * np.pi * radius * pressure**2 / 226.37e9,
        "speed": speed,
        "sliding_speed": speed * random.uniform(-1.2, 1.2, CONTACTS),
        "oil_temperature": random.uniform(323.0, 383.0, CONTACTS),
    }


def timed(name: str, oil: Oil, given: dict[str, np.ndarray], *, thermal: bool, wanted: float, least: float) -> None:
    """The median of contacts alone, the time of all at once, and the share that is solved."""
    every = {key: np.broadcast_to(values, CONTACTS) for key, values in given.items()}
    ml.ehl.solve(oil, **{key: values[:1] for key, values in every.items()}, thermal=thermal)
    alone = []
    for number in range(ALONE):
        start = time.perf_counter()
        ml.ehl.solve(oil, **{key: values[number : number + 1] for key, values in every.items()}, thermal=thermal)
        alone.append(time.perf_counter() - start)
    median = statistics.median(alone)
    line(f"{name}_contact_alone", median * 1e3, "ms", wanted / median)
    start = time.perf_counter()
    found = ml.ehl.solve(oil, **every, thermal=thermal)
    taken = time.perf_counter() - start
    line(f"{name}_contacts_200", taken, "s", 20.0 / taken)
    share = float(np.mean(found["status"] == "converged"))
    line(f"{name}_contacts_solved", 100.0 * share, "%", share / least)


if __name__ == "__main__":
    example = ml.ehl.example_oil()
    wide = Oil(**{**vars(example), "largest_pressure": np.inf})
    with threadpool_limits(1):
        isothermal = {**isothermal_contacts(wide), "oil_temperature": np.array(333.15)}
        timed("isothermal", wide, isothermal, thermal=False, wanted=0.060, least=1.0)
        timed("thermal", example, thermal_contacts(), thermal=True, wanted=0.3, least=0.95)
