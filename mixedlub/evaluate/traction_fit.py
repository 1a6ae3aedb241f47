"""Traction part of an oil from two discs: Eyring stress and limiting stress over pressure and temperature."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from scipy.optimize import least_squares

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.chain.effect import Parameter
from mixedlub.effects import find
from mixedlub.evaluate.uncertainty import NORMAL_90
from mixedlub.kinds.oil_priors import missing
from mixedlub.schema.findings import Finding, collected, finding
from mixedlub.schema.oil_file import MODULUS, SCHEMA, oil_of
from mixedlub.schema.toml_file import to_toml
from mixedlub.schema.traction_part import EYRING, LIMIT, WITHOUT_RATE, Traction, TractionNumber
from profiles.errors import InputError

STRESS_SPREAD = 0.5
"""Judgement. Prior sd of the logarithm of the Eyring stress about the oil's: fitted stresses are 2 to 15 MPa."""
LEAST_GAIN = 9.0
"""Judgement. Fall of chi-square over its widening for which a limiting stress is told: three standard deviations."""
LEAST_READINGS = 8
"""Judgement. Fewest readings: the parameters of the part and one."""
TOLD = 0.7
"""Judgement. Posterior over prior sd below which the readings tell a parameter."""
ASSUMED_NOISE = 0.02
"""Judgement. Relative sd of a reading without a stated noise; the misfit widens it."""
REACH = 6.0
"""Grid. Largest standard-normal coordinate of a parameter."""
POOR_FIT = 2.0
"""Judgement. Reduced chi-square above which the readings do not follow the part within their noise."""
SHEAR, LIMITING, STRESS = "shear_law", "limiting_shear_stress", "eyring_stress"
KEYS = {
    STRESS: "eyring_stress_MPa",
    **{f"{SHEAR}.{name}": own for own, name in EYRING.items()},
    **{f"{LIMITING}.{name}": own for own, name in LIMIT.items()},
}
"""Key of the part by parameter of the fit."""


@dataclass(frozen=True, eq=False)
class TractionFit:
    """A fitted part, its parameters with intervals as a table, findings, and the oil file with the part."""

    part: Traction
    table: pd.DataFrame
    findings: tuple[Finding, ...]
    file: str

    @property
    def lines(self) -> Iterator[str]:
        """Lines of the report."""
        for row in self.table.to_dict("records"):
            known = "" if row["told"] == "yes" else ", not told by the readings"
            interval = f"{row['value']:.4g} ({row['low90']:.4g} to {row['high90']:.4g})"
            yield f"{row['parameter']}: {interval}{known}"


class _Problem:
    """Whitened residuals over standard-normal coordinates of calibration and of the parameters of the part."""

    def __init__(self, case: Case, forward: Forward, *, limited: bool) -> None:
        self.forward = forward
        free = [c.parameter for c in forward.calibrations if not c.base_law]
        effects = {SHEAR: EYRING, **({LIMITING: LIMIT} if limited else {})}
        for effect in find(tuple(effects)):
            names = effects[effect.id].values()
            free += [replace(p, name=f"{effect.id}.{p.name}") for p in effect.parameters if p.name in names]
        self.free: list[Parameter] = free
        assert case.recordings is not None
        self.values = case.recordings[case.quantity]
        self.root = np.linalg.cholesky(_covariance(case, self.values))

    def parameters(self, z: np.ndarray) -> dict[str, float]:
        """Parameters at coordinates."""
        within = np.clip(z, -REACH, REACH)
        return {p.name: p.prior.value(float(x)) for p, x in zip(self.free, within, strict=True)}

    def residuals(self, z: np.ndarray) -> np.ndarray:
        """Residuals of the readings over their noise, then the coordinates themselves, as their prior has them."""
        values = self.parameters(z)
        effects: dict[str, dict[str, float]] = {SHEAR: dict(WITHOUT_RATE)}
        for name, value in values.items():
            effect, _, parameter = name.partition(".")
            if effect in (SHEAR, LIMITING):
                effects.setdefault(effect, {})[parameter] = value
        calibration = {name: value for name, value in values.items() if name.partition(".")[0] not in effects}
        with np.errstate(all="ignore"):
            off = self.forward.predict(calibration, effects) - self.values
        return np.concatenate([np.linalg.solve(self.root, np.nan_to_num(off, nan=1e3)), z])

    def solved(self) -> Any:
        """Most probable coordinates, the best of descents from several limits."""
        starts = np.zeros((3, len(self.free)))
        for row, shift in zip(starts, (0.0, 1.0, -1.0), strict=True):
            row[[p.name == f"{LIMITING}.coefficient" for p in self.free]] = shift
        found = [least_squares(self.residuals, row) for row in starts[: 3 if len(self.free) > len(EYRING) else 1]]
        return min(found, key=lambda one: one.cost)

    def reduced_chi2(self, found: Any) -> float:
        """Chi-square of the readings per degree of freedom, of a result of `solved`."""
        count = len(self.values)
        return float(np.sum(found.fun[:count] ** 2)) / max(count - len(self.free), 1)


def _covariance(case: Case, values: np.ndarray) -> np.ndarray:
    """Covariance of the readings: their noise, and errors that readings of a set-up share."""
    table, noise = case.recordings, case.system.recording.noise
    assert table is not None
    own = f"{case.quantity}_sd"
    if own in table:
        sd = table[own]
    else:
        relative, absolute = (getattr(noise, name, None) or 0.0 for name in ("relative", "absolute"))
        sd = np.hypot((relative or (0.0 if absolute else ASSUMED_NOISE)) * values, absolute)
    sd = np.maximum(sd, 1e-6 * np.max(np.abs(values)))
    setup = table["setup"] if "setup" in table else np.zeros(len(values))
    same = setup[:, None] == setup
    shared = [getattr(noise, f"setup_{name}", None) or 0.0 for name in ("relative", "absolute")]
    return np.diag(sd**2) + same * (shared[0] ** 2 * np.outer(values, values) + shared[1] ** 2)


def fitted_traction(case: Case, source: str) -> TractionFit:
    """Fit the traction part of the oil of a case of two discs to its readings; ``source``: of these readings.

    Film, viscosity under pressure and asperities are those of the base model, with the uncertainties of the case. The
    pressure of the stresses is the largest Hertz pressure.
    """
    forward = _forward(case)
    plain, limited = (_Problem(case, forward, limited=one) for one in (False, True))
    without, within = plain.solved(), limited.solved()
    told_limit = 2.0 * (without.cost - within.cost) > LEAST_GAIN * max(limited.reduced_chi2(within), 1.0)
    problem, found = (limited, within) if told_limit else (plain, without)
    count = len(problem.values)
    own, chi2 = found.jac[:count], problem.reduced_chi2(found)
    spread = np.linalg.inv(own.T @ own / max(chi2, 1.0) + np.eye(len(problem.free)))
    sds = np.sqrt(np.diag(spread))
    nominal = float(np.ravel(forward.inputs[STRESS])[0])
    table = _table(problem, found.x, sds, nominal)
    numbers = {
        row["parameter"]: TractionNumber(
            value=_rounded(row["value"]), sd=_rounded(row["sd"]), status="fitted" if row["told"] == "yes" else "typical"
        )
        for row in table.to_dict("records")
    }
    assert case.recordings is not None
    pressure = forward.base_quantity("hertz_pressure") * 1e-9
    celsius = case.recordings["oil_temperature_C"]
    part = Traction(
        **numbers,
        pressure_GPa=(_rounded(pressure.min()), _rounded(pressure.max())),
        temperature_C=(float(celsius.min()), float(celsius.max())),
        source=f"{count} readings of {source}; viscosity by Roelands at the largest Hertz pressure",
    )
    findings = tuple(_findings(table, case, chi2, told_limit=told_limit))
    return TractionFit(part, table, findings, oil_file(case, part))


def fits_traction(case: Case) -> bool:
    """Whether a case can tell a traction part."""
    rows = case.recordings
    return (
        case.kind.name == "disc"
        and rows is not None
        and case.quantity == "friction_coefficient"
        and not missing(case.system)
        and len(rows) >= LEAST_READINGS
        and bool(np.any(rows["slide_roll_ratio"]))
    )


def _forward(case: Case) -> Forward:
    """Base model of a case of two discs with a free Eyring stress and without a stated traction part."""
    system, rows = case.system, case.recordings
    if case.kind.name != "disc" or rows is None or case.quantity != "friction_coefficient":
        rule = "a traction part is fitted to recorded friction coefficients of two discs"
        raise InputError(rule, where="kind", value=case.kind.name)
    if gaps := missing(system):
        rule = f"a traction part needs an oil with {' and '.join(gaps).replace('_', '-')}"
        raise InputError(rule, where="lubricant")
    if len(rows) < LEAST_READINGS:
        raise InputError(f"a traction part needs {LEAST_READINGS} readings", where=rows.source, value=len(rows))
    if not np.any(rows["slide_roll_ratio"]):
        raise InputError("a traction part needs readings with sliding", where=f"{rows.source}: slide_roll_ratio")
    sds = system.uncertainty.model_copy(update={STRESS: STRESS_SPREAD})
    effects = {name: one for name, one in system.effects.items() if name not in (SHEAR, LIMITING)}
    other = system.model_copy(update={"uncertainty": sds, "effects": effects, "base": "formulas"})
    with collected():
        return Forward(replace(case, system=other), rows)


def _table(problem: _Problem, z: np.ndarray, sds: np.ndarray, nominal: float) -> pd.DataFrame:
    """Parameters of the part with 90 % intervals."""
    rows: list[dict[str, Any]] = []
    for p, at, sd in zip(problem.free, z, sds, strict=True):
        if p.name not in KEYS:
            continue
        factor = nominal * 1e-6 if p.name == STRESS else 1.0
        value, low, high = (factor * p.prior.value(float(at + step)) for step in (0.0, -NORMAL_90 * sd, NORMAL_90 * sd))
        row = {"parameter": KEYS[p.name], "value": value, "sd": (high - low) / (2.0 * NORMAL_90)}
        unit = {STRESS: "MPa", "fall": "1/K"}.get(p.name.rpartition(".")[2], "-")
        rows.append({**row, "low90": low, "high90": high, "unit": unit, "told": "yes" if sd < TOLD else "no"})
    order = list(KEYS.values())
    rows.sort(key=lambda one: order.index(str(one["parameter"])))
    return pd.DataFrame(rows)


def _findings(table: pd.DataFrame, case: Case, chi2: float, *, told_limit: bool) -> Iterator[Finding]:
    assert case.recordings is not None
    open_ = [row["parameter"] for row in table.to_dict("records") if row["told"] == "no"]
    if open_:
        text = f"the readings do not tell {', '.join(open_)}, which have the values of their priors"
        yield finding("traction_weak", text, "traction")
    if not told_limit:
        most = float(np.max(np.abs(case.recordings[case.quantity])))
        text = f"no limiting stress is told: readings reach {most:.3g} of the largest Hertz pressure without one"
        yield finding("traction_weak", text, "traction")
    if chi2 > POOR_FIT:
        text = f"the readings depart from the part by {np.sqrt(chi2):.2g} times their noise; the intervals are widened"
        yield finding("traction_weak", text, "traction")


def oil_file(case: Case, part: Traction) -> str:
    """Oil file with the properties of the case's oil and a traction part, without the modulus equation: the stresses
    are fitted with viscosities by Roelands."""
    section = case.system.lubricant
    assert section is not None
    known = None if section.oil is None else oil_of(section.oil, case.folder)
    apart = {"name", "base", "oil", "traction", KEYS[STRESS], *MODULUS}
    stated = section.model_dump(exclude_none=True, exclude=apart)
    properties: dict[str, Any] = {}
    for name, value in stated.items():
        own = {"value": value, "status": "stated", "source": f"[lubricant] of {case.name}"}
        key = name
        if name == "known_pressure_viscosity":
            key = "pressure_viscosity_per_GPa"
            own |= {"value": value["coefficient_per_GPa"], "temperature_C": value["temperature_C"]}
            own |= {"carried": value["carried"]}
        of_oil = None if known is None else known.properties.get(key)
        if of_oil is not None and of_oil.value == own["value"]:
            own |= {"status": of_oil.status, "source": of_oil.source}
        properties[key] = own
    head = (
        "# Traction part fitted to friction of two discs.\n# Use: the key oil in [lubricant] of a study, case, stage\n"
    )
    content = {
        "schema": SCHEMA,
        "name": section.name,
        "about": "Its traction part belongs to the viscosities of this file.",
        "base": section.base or "mineral",
        "properties": properties,
        "traction": part.model_dump(exclude_none=True),
    }
    return f"{head}# or of contacts of `mixedlub ehl`.\n{to_toml(content)}"


def _rounded(value: float) -> float:
    return float(f"{value:.5g}")
