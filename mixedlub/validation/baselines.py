"""Baseline methods of an engineer, on the same cases and files, so that the same scores apply.

Each baseline has the signature of the diagnosis: a case folder in, a folder of answers out. All start from this
package's base model, recalibrated under the stated priors.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import numpy as np

from mixedlub.validation.case_folder import read_case
from mixedlub.validation.measures import FLOOR
from mixedlub.validation.planted import NAMED
from mixedlub.validation.rig import Case, Rig
from mixedlub.validation.rigs import discs, gears
from mixedlub.validation.rivals import FARTHEST, descend, sensitivity
from profiles.errors import InputError

RIGS: dict[str, Callable[[Case], Rig]] = {"gear_pair": gears.rig_of, "disc": discs.rig_of}
"""Rigs described completely by their case folder; a baseline can model only these."""
ROUNDS = 20


def refuse_without_learners() -> None:
    """Raise an error if scikit-learn, which the baselines need, is not installed."""
    _learner("base")


def _learner(name: str) -> ModuleType:
    """Module of scikit-learn; an error with the command to install it."""
    import importlib

    try:
        return importlib.import_module(f"sklearn.{name}")
    except ModuleNotFoundError as error:
        rule = "the baselines need scikit-learn: pip install scikit-learn; --quick --cases N does without baselines"
        raise InputError(rule, where="proof") from error


@dataclass(frozen=True)
class Fitted:
    """A recalibrated case: recorded rows first, then rows to predict."""

    name: str
    rig: Rig
    recorded: np.ndarray
    run: np.ndarray
    sd: np.ndarray
    value: np.ndarray
    slopes: np.ndarray
    z: np.ndarray
    base: np.ndarray
    spoiled: np.ndarray

    @property
    def n_recorded(self) -> int:
        return len(self.recorded)

    @property
    def good(self) -> np.ndarray:
        """Indices of the recorded rows without outliers."""
        return np.flatnonzero(~self.spoiled)

    @property
    def residual(self) -> np.ndarray:
        """Recorded minus calibrated values over the sd, at the good rows."""
        return ((self.recorded - self.value[: self.n_recorded]) / self.sd[: self.n_recorded])[self.good]

    @property
    def squares(self) -> float:
        """Chi-square of the recalibrated base model with the prior penalty."""
        return float(self.residual @ self.residual + self.z @ self.z)

    @property
    def calibration_sd(self) -> np.ndarray:
        """Standard deviation of every row due to the uncertain calibration."""
        part = self.slopes[self.good] / self.sd[self.good, None]
        covariance = np.linalg.inv(part.T @ part + np.eye(len(self.z)))
        return np.sqrt(np.einsum("ij,jk,ik->i", self.slopes, covariance, self.slopes))


def recalibrate(folder: Path) -> Fitted:
    """Base model fitted to the recordings of a case under the priors, twice: the second fit omits outliers."""
    recording = read_case(folder)
    table = folder / "conditions.csv"
    wanted = read_case(folder, "conditions.csv").columns if table.exists() else {}
    quantity = recording.settings["recording"]["quantity"]
    recorded = recording.columns[quantity]
    names = [name for name in recording.columns if name != quantity]
    columns = {name: np.concatenate([recording.columns[name], wanted.get(name, [])]) for name in names}
    rig = RIGS[recording.kind](Case(settings=recording.settings, columns=columns, share=recording.share))
    noise = rig.settings["recording"]["noise"]
    count, start = len(recorded), np.zeros(len(rig.names))
    base = rig.model(start, ())
    sd = np.sqrt((noise["relative"] * np.concatenate([recorded, base[count:]])) ** 2 + noise["absolute"] ** 2)
    spoiled = np.zeros(count, dtype=bool)
    z, limit = start, np.full(len(start), FARTHEST)
    for _ in range(2):

        def residual(z: np.ndarray, weight: np.ndarray = ~spoiled / sd[:count]) -> np.ndarray:
            return np.concatenate([(rig.model(z, ())[:count] - recorded) * weight, z])

        z, _ = descend(residual, z, -limit, limit)
        standardised = (recorded - rig.model(z, ())[:count]) / sd[:count]
        scatter = max(1.4826 * float(np.median(np.abs(standardised - np.median(standardised)))), 1.0)
        spoiled = np.abs(standardised - np.median(standardised)) > 5 * scatter
    return Fitted(
        folder.name, rig, recorded, columns["run"], sd, rig.model(z, ()), sensitivity(rig, z), z, base, spoiled
    )


def _features(fitted: Fitted) -> np.ndarray:
    """Standardised conditions and composite roughness; logarithms except for temperature and sequence."""
    columns = fitted.rig.columns
    names = [n for n, column in columns.items() if n != "run" and column.dtype != object]
    table = [columns[n] if n in ("oil_temperature_C", "sequence") else np.log(columns[n].astype(float)) for n in names]
    roughness = [
        np.log(sum(fitted.rig.settings["surfaces"][name]["m0_um2"] for name in pair))
        for pair in zip(*(column for name, column in columns.items() if "surface" in name))
    ]
    matrix = np.column_stack([*table, roughness]).astype(float)
    return (matrix - matrix.mean(axis=0)) / np.maximum(matrix.std(axis=0), 1e-9)


def write_answer(
    fitted: Fitted,
    out: Path,
    probabilities: dict[str, float],
    explanations: Sequence[Sequence[str]],
    predicted: np.ndarray,
    extra_sd: np.ndarray | float = 0.0,
    base: np.ndarray | None = None,
) -> None:
    """Write the two files of an answer: verdict first, mismatch against ``base`` or the calibrated model."""
    import pandas as pd

    out.mkdir(parents=True, exist_ok=True)
    everything = dict.fromkeys((*NAMED, "none", "unknown"), FLOOR) | probabilities
    mismatch = (predicted - (fitted.value if base is None else base)) / fitted.sd
    verdict = list(explanations[0])
    spread = np.sqrt(fitted.sd**2 + fitted.calibration_sd**2 + extra_sd**2)
    record = {
        "schema": "mixedlub-diagnosis/1",
        "case": fitted.name,
        "mismatch": {"detected": verdict != ["none"], "chi2_before": fitted.squares, "rows": fitted.n_recorded},
        "verdict": verdict,
        "tied": [list(names) for names in explanations],
        "probabilities": {name: float(np.clip(p, FLOOR, 1 - FLOOR)) for name, p in everything.items()},
        "location": {
            "rows": {str(run): float(z) for run, z in zip(fitted.run[: fitted.n_recorded], mismatch)},
        },
        "calibration": {},
        "outlier_runs": [int(run) for run in fitted.run[: fitted.n_recorded][fitted.spoiled]],
    }
    table = {
        "run": fitted.run,
        "base": fitted.base,
        "calibrated": fitted.value,
        "predicted": predicted,
        "low90": predicted - 1.645 * spread,
        "high90": predicted + 1.645 * spread,
        "mismatch_z": mismatch,
    }
    pd.DataFrame(table).to_csv(out / "predictions.csv", index=False)
    (out / "diagnosis.json").write_text(json.dumps(record, indent=1), encoding="utf-8")


def _nameless(fitted: Fitted, out: Path, nats: float, predicted: np.ndarray, extra_sd: np.ndarray) -> None:
    """Write the answer of a method without effect names: evidence for a mismatch (nats), shared evenly by the ids.

    A fifth goes to unknown, which is the verdict if a mismatch is likelier than not.
    """
    something = float(1 / (1 + np.exp(-np.clip(nats, -30, 30))))
    ids = sorted(fitted.rig.ids)
    shared = dict.fromkeys(ids, 0.9 * something / len(ids))
    shared |= {"unknown": 0.2 * something, "none": 1 - something}
    verdict = "unknown" if something > 0.5 else "none"
    write_answer(fitted, out, shared, [[verdict]], predicted, extra_sd)


def recalibration_only(folder: Path, out: Path) -> None:
    """Recalibrated base model: unknown if its chi-square is improbable, without effect names."""
    from scipy.stats import chi2

    fitted = recalibrate(folder)
    tail = float(chi2.logsf(fitted.squares, len(fitted.good)))
    _nameless(fitted, out, -tail + np.log(0.01), fitted.value, np.zeros_like(fitted.value))


def gaussian_process(folder: Path, out: Path) -> None:
    """Gaussian process over the conditions for the recalibrated residuals, as in Kennedy and O'Hagan."""
    process = _learner("gaussian_process")
    kernels = _learner("gaussian_process.kernels")
    fitted = recalibrate(folder)
    x = _features(fitted)
    kernel = kernels.ConstantKernel(1.0, (1e-3, 1e4)) * kernels.RBF(np.ones(x.shape[1]), (0.2, 30.0))
    machine = process.GaussianProcessRegressor(kernel, alpha=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        machine.fit(x[fitted.good], fitted.residual)
        mean, sd = machine.predict(x, return_std=True)
    count = len(fitted.good)
    null = -0.5 * float(fitted.residual @ fitted.residual) - 0.5 * count * np.log(2 * np.pi)
    fee = 0.5 * len(kernel.theta) * np.log(count)
    evidence = float(machine.log_marginal_likelihood_value_) - null - fee
    _nameless(fitted, out, evidence, fitted.value + mean * fitted.sd, sd * fitted.sd)


def gradient_boosting(folder: Path, out: Path) -> None:
    """Boosted trees over the conditions for the recalibrated residuals; evidence from five-fold prediction."""
    ensemble, selection = _learner("ensemble"), _learner("model_selection")
    fitted = recalibrate(folder)
    x = _features(fitted)
    features, residual = x[fitted.good], fitted.residual
    machine = ensemble.GradientBoostingRegressor(
        n_estimators=100, max_depth=3, learning_rate=0.08, subsample=0.8, random_state=0
    )
    folds = selection.KFold(5, shuffle=True, random_state=0)
    guessed = selection.cross_val_predict(machine, features, residual, cv=folds)
    evidence = 0.5 * float(residual @ residual - (residual - guessed) @ (residual - guessed)) - 3.0
    machine.fit(features, residual)
    doubt = np.sqrt(max(float(np.mean((residual - guessed) ** 2)) - 1.0, 0.0))
    predicted = fitted.value + machine.predict(x) * fitted.sd
    _nameless(fitted, out, evidence, predicted, doubt * fitted.sd)


def _signatures(fitted: Fitted) -> tuple[list[str], np.ndarray]:
    """Names and signatures (rows by effects, in sds) of all effects at half their typical strength."""
    names, columns = [], []
    for name, effect in NAMED.items():
        if name in fitted.rig.ids:
            typical = {knob.name: 0.5 * sum(knob.typical) for knob in effect.knobs}
            typical["strength"] *= 0.5
            extra = (fitted.rig.model(fitted.z, [effect.hide(typical)]) - fitted.value) / fitted.sd
            if np.linalg.norm(extra[fitted.good]) > 1e-6:
                names.append(name)
                columns.append(extra)
    return names, np.array(columns).T


def sparse_regression(folder: Path, out: Path) -> None:
    """Cross-validated lasso on linearised effect signatures; probabilities are bootstrap selection rates.

    The signatures come from the generator, which flatters this baseline; the calibration is projected out first.
    """
    linear = _learner("linear_model")
    fitted = recalibrate(folder)
    names, extra = _signatures(fitted)
    slopes = fitted.slopes / fitted.sd[:, None]
    calibration_slopes, rows = slopes[fitted.good], fitted.good
    taken = np.linalg.solve(
        calibration_slopes.T @ calibration_slopes + np.eye(calibration_slopes.shape[1]),
        calibration_slopes.T @ extra[rows],
    )
    cleared = extra - slopes @ taken
    x = cleared / np.linalg.norm(cleared[rows], axis=0) * np.sqrt(len(rows))
    train, residual = x[rows], fitted.residual
    rng = np.random.default_rng(fitted.n_recorded)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ceiling = np.max(np.abs(train.T @ residual)) / len(rows)
        grid = ceiling * np.geomspace(1.0, 1e-3, 40)
        search = linear.LassoCV(alphas=grid, cv=5, fit_intercept=False, max_iter=4000)
        search.fit(train, residual)
        chosen = np.zeros(len(names))
        for _ in range(ROUNDS):
            drawn = rng.integers(0, len(rows), len(rows))
            machine = linear.Lasso(alpha=search.alpha_, fit_intercept=False, max_iter=4000)
            machine.fit(train[drawn], residual[drawn])
            chosen += np.abs(machine.coef_) > 0.1
    rates = chosen / ROUNDS
    probabilities = dict(zip(names, rates.tolist()))
    probabilities["none"] = float(np.prod(1 - rates))
    predicted = fitted.value + x @ search.coef_ * fitted.sd
    likely = sorted(name for name in names if probabilities[name] > 0.5) or ["none"]
    write_answer(fitted, out, probabilities, [likely], predicted)


BASELINES: dict[str, Callable[[Path, Path], None]] = {
    "recalibration only": recalibration_only,
    "Gaussian process": gaussian_process,
    "gradient boosting": gradient_boosting,
    "sparse regression": sparse_regression,
}
