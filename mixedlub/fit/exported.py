"""Fitted laws in the files of studies, cases and the solver: options, a law file, an oil, a viscosity section."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.friction_law import FrictionLaw
from mixedlub.chain.priors import LogNormal
from mixedlub.chain.slots import FILM
from mixedlub.ehl.oil.declared import OilLaw, Pair
from mixedlub.fit.candidates import FACTOR
from mixedlub.fit.inference import Fit, predicted_from
from mixedlub.fit.readings import MADE, Readings
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.own_laws import FileLaw
from mixedlub.schema.oil_file import SCHEMA as OIL

NORMAL_90 = 1.6449
"""Definition. Half width of the middle 90 % of a normal distribution in standard deviations."""
TYPICAL_DENSITY = (870.0, 7e-4)
"""Judgement. Density of a mineral oil at 15 degC (kg/m^3) and its relative fall per kelvin, where none is recorded."""
GRADED = (40.0, 100.0)
"""Definition. Temperatures (degC) at which oils are graded."""
SMALL_PRESSURE = 1e6
"""Grid. Pressure step (Pa) of the pressure-viscosity coefficient."""


def exported(found: Fit, readings: Readings) -> dict[str, str]:
    """Files of a fitted law by name."""
    house = found.law.house
    if readings.quantity == "contact_viscosity" and "oil_temperature" in found.law.reads:
        files = {"viscosity.toml": _viscosity(found, readings, house)} if isinstance(house, OilLaw) else {}
        return {**files, "oil.toml": _oil(found, readings), **_over_temperature(found, readings)}
    if isinstance(house, Effect):
        files = {"law.toml": _form(found, readings)}
    elif isinstance(house, FrictionLaw):
        files = {"options.toml": _friction_options(found, readings)}
        files |= {"law.toml": _factor(found, readings, "friction", "boundary")} if FACTOR in found.parameters else {}
    elif readings.quantity == "film_thickness":
        files = {"law.toml": _factor(found, readings, "film_thickness", "film")}
        if found.law.name in FILM.choices:
            head = _head(found, readings, "the section of a study; law.toml has the factor")
            files["options.toml"] = f'{head}[options]\nfilm = "{found.law.name}"\n'
    else:
        files = {}
    return files


def _over_temperature(found: Fit, readings: Readings) -> dict[str, str]:
    """Law file of a form that reads temperature alone."""
    own = isinstance(found.law.house, Effect) and "pressure" not in found.law.reads
    return {"law.toml": _form(found, readings)} if own else {}


def _head(found: Fit, readings: Readings, use: str) -> str:
    lines = [
        f"{found.law.title}, fitted to {len(readings)} readings of {readings.source}.",
        "Written by `mixedlub fit`.",
        f"Use: {use}.",
    ]
    return "".join(f"# {line}\n" for line in lines)


def _number(value: float) -> str:
    return f"{value:.6g}"


def _friction_options(found: Fit, readings: Readings) -> str:
    values = {name: value for name, value in found.parameters.items() if name != FACTOR}
    text = f'[options]\nfriction = "{found.law.name}"\n'
    if values:
        inner = ", ".join(f"{name} = {_number(value)}" for name, value in values.items())
        text += f"friction_coefficients = {{ {inner} }}\n"
    use = "the section of a study" + ("; law.toml has the factor" if FACTOR in found.parameters else "")
    return _head(found, readings, use) + text


def _spread(found: Fit, name: str) -> str:
    """Key of a law file with the spread of a parameter, of its logarithm if the prior is; empty without a spread."""
    low, high = found.low90[name], found.high90[name]
    if not high > low:
        return ""
    if any(p.name == name and isinstance(p.prior, LogNormal) for p in found.law.parameters):
        own = float(np.log(high / low)) / (2.0 * NORMAL_90)
        return f"prior = {{ lognormal = [{_number(found.parameters[name])}, {_number(own)}] }}"
    return f"sd = {_number((high - low) / (2.0 * NORMAL_90))}"


def _factor(found: Fit, readings: Readings, acts_on: str, stage: str) -> str:
    description = f"Measured over the law {found.law.name}."
    head = _head(found, readings, "[effects] of a study or case, by path, beside the law itself")
    return head + _law_text(
        {
            "id": f"{found.law.name}_factor",
            "description": description,
            "stage": stage,
            "acts_on": acts_on,
            "form": "factor",
            "expression": FACTOR,
            "source": f"fit to {readings.source}",
        },
        {FACTOR: ("-", found.parameters[FACTOR], _spread(found, FACTOR), "measured over the law as published")},
        {},
    )


def _form(found: Fit, readings: Readings) -> str:
    """Law file of a form, in quantities that studies and cases have."""
    assert found.law.house is not None
    law = found.law.house.law
    assert isinstance(law, FileLaw)
    expression, acts_on = law.file.expression, law.file.acts_on
    for name in MADE:
        if re.search(rf"\b{name}\b", expression):
            expression = re.sub(rf"\b{name}\b", _written(readings, name), expression)
    expression = re.sub(r"\bpressure\b", "hertz_pressure", expression)
    if acts_on == "friction" and readings.written("speed") == ("drive_speed",):
        acts_on, expression = "friction_torque", f"sign(drive_speed)*({expression})"
    parameters = {
        p.name: (law.file.parameters[p.name].unit, found.parameters[p.name], _spread(found, p.name), p.meaning)
        for p in found.law.parameters
    }
    names = {name for name in re.findall(r"[a-z_]+[a-z]", expression) if name in readings.state}
    ranges = {name: readings.state[name] for name in sorted(names)}
    head = _head(found, readings, "[effects] of a study or case, by path, or hypotheses/ of a case")
    return head + _law_text(
        {
            "id": f"{found.law.name}_fitted",
            "description": f"{law.file.description}",
            "stage": law.file.stage,
            "acts_on": acts_on,
            "form": law.file.form,
            "expression": expression,
            "source": f"{found.law.source}; fit to {readings.source}",
        },
        parameters,
        {name: (float(np.min(np.abs(v))), float(np.max(np.abs(v)))) for name, v in ranges.items() if np.ptp(v) > 0.0},
    )


def _written(readings: Readings, name: str) -> str:
    """Speed or Hersey number in quantities of the glossary."""
    parts = readings.written(name)
    if name == "speed":
        return f"abs({parts[0]})"
    viscosity, speed, bearing = parts
    return f"({viscosity}*abs({speed})/{bearing})"


def _law_text(
    keys: Mapping[str, str],
    parameters: Mapping[str, tuple[str, float, str, str]],
    ranges: Mapping[str, tuple[float, float]],
) -> str:
    lines = [f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in keys.items()]
    for name, (unit, value, spread, meaning) in parameters.items():
        lines += ["", f"[parameters.{name}]", f'unit = "{unit}"', f"value = {_number(value)}"]
        lines += [spread] if spread else []
        lines.append(f"meaning = {json.dumps(meaning, ensure_ascii=False)}")
    if ranges:
        lines += [
            "",
            "[range]",
            *(f"{name} = [{_number(low)}, {_number(high)}]" for name, (low, high) in ranges.items()),
        ]
    return "\n".join(lines) + "\n"


def _viscosity(found: Fit, readings: Readings, house: OilLaw) -> str:
    """Section of an oil file of the solver."""
    lines = ["[viscosity]", f'law = "{house.name}"']
    for given in house.keys:
        if given.key in found.law.constants:
            value = found.law.constants[given.key]
            text = str(list(value)) if isinstance(value, tuple) else _number(value)
        elif given.type is Pair:
            text = "[" + ", ".join(_number(found.parameters[f"{given.key}_{i}"]) for i in (1, 2)) + "]"
        else:
            text = _number(found.parameters[given.key])
        lines.append(f"{given.key} = {text}")
    return _head(found, readings, "the section of an oil file of `mixedlub ehl`") + "\n".join(lines) + "\n"


def _at(found: Fit, readings: Readings, celsius: np.ndarray, pressure: float) -> np.ndarray:
    """Viscosity by the fitted law (Pa s)."""
    kelvin = celsius + ZERO_CELSIUS
    state = {"oil_temperature": kelvin, "pressure": np.full(kelvin.shape, pressure)}
    density = readings.get("oil_density")
    if density is not None:
        state["oil_density"] = np.full(kelvin.shape, float(np.mean(density)))
    blank = Readings(readings.source, readings.quantity, np.ones(kelvin.shape), None, state, {})
    return predicted_from(found, blank)


def _oil(found: Fit, readings: Readings) -> str:
    """Oil file for the key ``oil`` of studies and cases."""
    temperatures = np.array(GRADED)
    density15, fall = TYPICAL_DENSITY
    recorded = readings.get("oil_density")
    density = density15 * (1.0 - fall * (temperatures - 15.0))
    if recorded is not None:
        density = np.full(2, float(np.mean(recorded)))
    kinematic = _at(found, readings, temperatures, 0.0) / density * 1e6
    fitted = f"fit of {found.law.name} to {readings.source}"
    kelvin = readings.get("oil_temperature")
    assert kelvin is not None
    known = (float(kelvin.min() - ZERO_CELSIUS), float(kelvin.max() - ZERO_CELSIUS))
    how = "derived" if known[0] <= GRADED[0] + 5.0 and known[1] >= GRADED[1] - 5.0 else "typical"
    outside = "" if how == "derived" else f"; readings are from {known[0]:.4g} to {known[1]:.4g} °C: extrapolated"
    typical = "" if recorded is not None else f" over a typical density of {density15:g} kg/m³ at 15 °C"
    properties = [
        ("temperature_C", list(GRADED), "derived", "temperatures of the values below"),
        ("kinematic_viscosity_mm2_s", [float(_number(v)) for v in kinematic], how, fitted + typical + outside),
    ]
    pressure = readings.get("pressure")
    if pressure is not None and np.ptp(pressure) > 0.0:
        rise = np.log(_at(found, readings, temperatures, SMALL_PRESSURE) / _at(found, readings, temperatures, 0.0))
        alpha = [float(_number(v)) for v in rise / SMALL_PRESSURE * 1e9]
        properties.append(("pressure_viscosity_per_GPa", alpha, how, fitted + ", slope at no pressure" + outside))
    lines = [
        f'schema = "{OIL}"',
        f"name = {json.dumps(f'oil of {readings.source}', ensure_ascii=False)}",
        'about = "Properties that the readings do not have are those of a mineral oil; base names another."',
        'base = "mineral"',
    ]
    for name, value, status, source in properties:
        lines += ["", f"[properties.{name}]", f"value = {value}", f'status = "{status}"']
        lines.append(f"source = {json.dumps(source, ensure_ascii=False)}")
    return _head(found, readings, 'the key oil = "oil.toml" of [lubricant]') + "\n".join(lines) + "\n"
