"""Truth of a case and answer of a tool, read from their folders."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation.case_folder import read_columns
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.worlds.misfit import CLEAR
from profiles.errors import InputError

IDENTIFIABLE = 9.0


@dataclass(frozen=True)
class Truth:
    """Truth of a case; arrays over all readings, visible and withheld.

    ``within``: the catalogue's laws can become the planted laws; None if nothing is planted. ``forms``: sources of the
    planted forms. ``laws``: steps with another law; ``clear_laws``: steps that recalibration cannot hide, alone or with
    the others; ``sole_laws``: clear steps without imitation by a law of another step. ``flaws``: defects of the
    recording. ``beyond``: conditions beyond the recorded range. ``beside``: effects that come with the concealed one.
    ``solved``: the concealed part of a rig of full physics; ``full_base``: its case has full solutions as base.
    """

    case: str
    kind: str
    group: str
    effects: tuple[str, ...]
    label: frozenset[str]
    visibility: float
    identifiable: bool
    mimic: bool
    small: bool
    outliers: frozenset[int]
    theta: dict[str, float]
    run: np.ndarray
    withheld: np.ndarray
    values: np.ndarray
    base: np.ndarray
    sd: np.ndarray
    within: bool | None = None
    forms: tuple[str, ...] = ()
    no_data_sheet: bool = False
    rivals: frozenset[str] = frozenset()
    laws: frozenset[str] = frozenset()
    clear_laws: frozenset[str] = frozenset()
    sole_laws: frozenset[str] = frozenset()
    flaws: frozenset[str] = frozenset()
    beyond: np.ndarray = field(default_factory=lambda: np.zeros(0, bool))
    beside: frozenset[str] = frozenset()
    solved: str = ""
    full_base: bool = False

    @property
    def candidates(self) -> frozenset[str]:
        """Effects of the catalogue that are planted or were tried as rivals."""
        planted = frozenset() if self.group == "unknown" else frozenset(self.effects)
        return planted | {name for name in self.rivals if "+" not in name}

    @property
    def off(self) -> np.ndarray:
        """Deviation of the base model at the true calibration, in sds."""
        return (self.values - self.base) / self.sd


@dataclass(frozen=True)
class Answer:
    """Answer of a tool to a case: verdict, probabilities, flagged runs, and predictions by run.

    ``laws``: quantity and expression of the law found without a name, and of the laws that cannot be told from it.
    """

    case: str
    verdict: frozenset[str]
    tied: tuple[frozenset[str], ...]
    probabilities: dict[str, float]
    detected: bool
    outliers: frozenset[int]
    location: dict[int, float]
    calibration: dict[str, tuple[float, float]]
    run: np.ndarray
    calibrated: np.ndarray
    predicted: np.ndarray
    low: np.ndarray
    high: np.ndarray
    seconds: float = float("nan")
    laws: tuple[tuple[str, str], ...] = ()


def silent(truth: Truth) -> Answer:
    """Answer counted for a tool that broke down on a case: no verdict, and every reading flagged."""
    nothing, base = frozenset({"no answer"}), truth.base
    wrong = frozenset(int(run) for run in truth.run[~truth.withheld])
    return Answer(truth.case, nothing, (nothing,), {}, True, wrong, {}, {}, truth.run, base, base, base, base)


def _names(label: Any) -> frozenset[str]:
    return frozenset([label] if isinstance(label, str) else label)


def _clear_laws(truth: dict[str, Any]) -> tuple[frozenset[str], frozenset[str]]:
    """Identifiable laws, and the identifiable laws that no law of another step imitates."""
    clear = frozenset(n for n, found in truth.get("law_misfit", {}).items() if min(found.values()) > CLEAR)
    nearest = {name: min(found.values(), default=np.inf) for name, found in truth.get("law_alternatives", {}).items()}
    return clear, frozenset(name for name in clear if nearest[name] > IDENTIFIABLE)


def read_truth(folder: Path) -> Truth:
    """Truth of a case; classes and identifiability are derived if the file lacks them."""
    truth = json.loads((folder / "truth.json").read_text(encoding="utf-8"))
    rows = {name: np.array(values) for name, values in truth["rows"].items()}
    label = _names(truth["label"])
    group = truth.get("class")
    if group is None:
        single = "measurement" if label <= MEASUREMENT else "single"
        group = "none" if label == {"none"} else "unknown" if label == {"unknown"} else single
        group = "pair" if len(label) > 1 else group
    forms = [one["within"] for one in truth.get("info", ()) if "within" in one]
    clear, sole = _clear_laws(truth)
    least = min(truth["alternatives"].values(), default=np.inf) - truth.get("own", 0.0)
    return Truth(
        case=folder.name,
        kind=truth.get("rig", ""),
        group=group,
        effects=tuple(truth.get("effects", sorted(label - {"none", "unknown"}))),
        label=label,
        visibility=float(truth["info"][0].get("snr", np.nan)) if truth.get("info") else 0.0,
        identifiable=bool(truth.get("identifiable", label == {"none"} or least > IDENTIFIABLE)),
        mimic=bool(truth.get("mimic", False)),
        small=bool(truth.get("small", False)),
        outliers=frozenset(truth["outliers"]),
        theta=truth["theta"],
        run=rows["run"],
        withheld=rows["withheld"].astype(bool),
        values=rows["truth"],
        base=rows["base"],
        sd=rows["sd"],
        within=all(forms) if forms else None,
        forms=tuple(str(one.get("form", "")) for one in truth.get("info", ())),
        no_data_sheet=bool(truth.get("unnamed_oil", False)),
        rivals=frozenset(truth["alternatives"]) - {"none"},
        laws=frozenset(truth.get("laws", ())),
        clear_laws=clear,
        sole_laws=sole,
        flaws=frozenset(truth.get("flaws", ())),
        beyond=np.array(rows.get("beyond", np.zeros(rows["run"].size)), bool),
        beside=frozenset(truth.get("beside", ())),
        solved=str(truth.get("solved", "")),
        full_base=bool(truth.get("full_base", False)),
    )


def read_answer(folder: Path) -> Answer:
    """Answer of a case from ``diagnosis.json`` and ``predictions.csv``, with the duration from ``seconds.json``."""
    for name in ("diagnosis.json", "predictions.csv"):
        if not (folder / name).exists():
            raise InputError(f"{name} is missing: the case was not answered", where=str(folder))
    record = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))
    table = read_columns(folder / "predictions.csv")
    timed = folder / "seconds.json"
    return Answer(
        case=folder.name,
        verdict=_names(record["verdict"]),
        tied=tuple(_names(one) for one in record.get("tied", [record["verdict"]])),
        probabilities={name: float(p) for name, p in record["probabilities"].items()},
        detected=bool(record["mismatch"]["detected"]),
        outliers=frozenset(record.get("outlier_runs", [])),
        location={int(run): float(z) for run, z in record.get("location", {}).get("rows", {}).items()},
        calibration={
            name: (float(value["low90"]), float(value["high90"]))
            for name, value in record.get("calibration", {}).items()
        },
        run=table["run"],
        calibrated=table["calibrated"],
        predicted=table["predicted"],
        low=table["low90"],
        high=table["high90"],
        seconds=float(json.loads(timed.read_text(encoding="utf-8"))) if timed.exists() else float("nan"),
        laws=_laws(record.get("law")),
    )


def _laws(law: dict[str, Any] | None) -> tuple[tuple[str, str], ...]:
    """Quantity and expression of a law and of its equivalents."""
    if law is None:
        return ()
    every = [law, *(rival for rival in law.get("rivals", ()) if rival.get("equivalent"))]
    return tuple((one["acts_on"], one["expression"]) for one in every)
